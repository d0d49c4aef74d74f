"""Fields of design tables that linkages of plates share, and what must hold between them."""

from collections.abc import Sequence
from typing import Annotated, Literal

from pydantic import Field

from mechwright.contracts.parameters import FIRST, FITTED
from mechwright.units import Degrees, Millimetres, RevPerMin, Unit

PivotX = Annotated[Millimetres, Field(ge=-10000, le=10000, description="X of the crank's pivot A0.")]
PivotY = Annotated[Millimetres, Field(ge=-10000, le=10000, description="Y of the crank's pivot A0.")]
GroundAngle = Annotated[
    Degrees,
    Field(ge=-360, le=360, description="Direction from A0 to B0, counter-clockwise from X."),
]
Speed = Annotated[
    RevPerMin,
    Field(
        ge=0.001,
        le=20000,
        description="Speed of the crank; of a lever, swings there and back in a minute.",
        json_schema_extra=FIRST,
    ),
]
Direction = Annotated[
    Literal["ccw", "cw"],
    Field(description="Sense of the crank, or of a lever's first swing, seen from above."),
]
SwingFrom = Annotated[
    Annotated[float, Field(ge=-720, le=720), Unit("deg")] | None,
    Field(
        description="One end of the swing of a crank that is a lever, counter-clockwise from X. Default: it "
        "turns fully, or goes as far as it can."
    ),
]
SwingTo = Annotated[
    Annotated[float, Field(ge=-720, le=720), Unit("deg")] | None,
    Field(description="The other end of that swing."),
]
SettingAngle = Annotated[
    Annotated[float, Field(ge=-720, le=720), Unit("deg")] | None,
    Field(description="Crank angle from X in phase 1 at which the machine is set to another phase."),
]
Phase = Annotated[int, Field(ge=1, le=8, description="Phase that motion and parts show.")]
GroundThickness = Annotated[Millimetres, Field(ge=1, le=100, description="Of the ground plate.")]
BushingWall = Annotated[
    Millimetres,
    Field(
        ge=0,
        le=50,
        description="Wall of the plain bushings in the turning joints, 0 for none. Default: 1, or less as "
        "the pins.",
        json_schema_extra=FITTED,
    ),
]
LOOSEST = 0.5
"""Diameter by which a turning bore may be larger than its pin, mm, at most."""

RunningFit = Annotated[
    Millimetres,
    Field(ge=0.005, le=LOOSEST, description="Diameter by which a turning bore is larger than its pin."),
]
Rim = Annotated[
    Millimetres,
    Field(
        ge=0.5,
        le=100,
        description="Material of the plates around the bores. Default: 4, or less as the pins.",
        json_schema_extra=FITTED,
    ),
]
Clearance = Annotated[
    Millimetres, Field(ge=0.1, le=50, description="Least distance in plan of what moves in one layer.")
]
Washer = Annotated[Millimetres, Field(ge=0.05, le=20, description="Air between the layers of plates.")]


def phases_together(setting_angle: float | None, phases: Sequence[object], phase: int) -> None:
    """Refuse phases without a pose of setting, and a shown phase that there is not; raises ValueError."""
    if (setting_angle is None) != (not phases):
        raise ValueError("give both setting_angle and phases, or neither")
    if phase > 1 + len(phases):
        raise ValueError(f"phase is {phase}, and there are {1 + len(phases)}; give the others in phases")


def swing_together(swing_from: float | None, swing_to: float | None, direction: str) -> None:
    """Refuse half a swing, one of nothing, and one that is to begin clockwise; raises ValueError."""
    if (swing_from is None) != (swing_to is None):
        raise ValueError("give both swing_from and swing_to, or neither")
    if swing_from is None:
        return
    if swing_from == swing_to:
        raise ValueError("swing_from and swing_to are the same angle, so nothing moves; give two")
    if direction == "cw":
        raise ValueError("direction is that of a crank that turns; exchange swing_from and swing_to")
