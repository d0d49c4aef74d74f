"""Kinds and defaults of the fields of the design table, and to which follower they belong."""

from typing import Annotated, Any, Literal

from pydantic import AfterValidator, Field

from mechwright import DesignError
from mechwright.standards.springs import extension_spring
from mechwright.units import Unit

MOST_SEGMENTS = 24
"""Of a turn: more are a table."""

LEAST_ANGLE = 1.0
"""Degrees of a segment: shorter ones are a step."""

WHOLE = 1e-6
"""Degrees by which angles may miss a full turn: what three thirds written with eight digits leave."""

LawName = Literal[
    "cycloidal",
    "modified-sine",
    "modified-trapezoid",
    "3-4-5",
    "4-5-6-7",
    "simple-harmonic",
    "polynomial",
    "table",
]


def _spring(text: str) -> str:
    """Refuse the name of a spring that is in no table."""
    if text != AUTO:
        try:
            extension_spring(text)
        except DesignError as error:
            raise ValueError(f'{error}; or "{AUTO}"') from error
    return text


AUTO = "auto"
"""In place of a spring's name: the program chooses."""

GuideName = Literal["rails", "linear-9", "linear-12", "linear-15"]
SpringName = Annotated[str, Field(max_length=40), AfterValidator(_spring)]
Angle = Annotated[float, Field(ge=LEAST_ANGLE, le=360), Unit("deg")]
Lift = Annotated[float, Field(ge=0, le=300), Unit("mm")]
Swing = Annotated[float, Field(ge=0, le=120), Unit("deg")]

DEFAULTS: dict[str, Any] = {
    "lifts": (15.0, 15.0, 0.0, 0.0),
    "swings": (20.0, 20.0, 0.0, 0.0),
    "roller_radius": 8.0,
    "offset": 0.0,
    "face_margin": 2.0,
    "spring_preload": 60.0,
    "spring_rate": 4.0,
    "spring_torque": 4.0,
    "spring_stiffness": 4.0,
    "load": 0.0,
    "load_torque": 0.0,
    "mass": 0.3,
    "inertia": 0.001,
}
"""Field to its value where it is left out and the kind of follower has it."""

ONLY: dict[str, tuple[str, str]] = {
    **dict.fromkeys(
        ("lifts", "offset", "spring_preload", "spring_rate", "load", "mass"), ("follower", "translating")
    ),
    **dict.fromkeys(
        (
            "swings",
            "centre_distance",
            "arm_length",
            "spring_torque",
            "spring_stiffness",
            "load_torque",
            "inertia",
        ),
        ("follower", "oscillating"),
    ),
    "roller_radius": ("contact", "roller"),
    "face_margin": ("contact", "flat"),
}
"""Field to the choice that it belongs to."""

SPRINGS = ("spring_preload", "spring_rate", "spring_torque", "spring_stiffness")
"""What a conjugate pair, or a follower whose spring is bought, has no use for."""
