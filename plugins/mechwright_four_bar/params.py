"""The design table of a four-bar linkage."""

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from mechwright import FIRST, MaterialName, Parameters
from mechwright.mechanics.planar.course import MOST_RATIO
from mechwright.units import Degrees, Millimetres, Ratio, RevPerMin, Unit

Place = Annotated[float, Field(ge=-10000, le=10000), Unit("mm")]
"""A coordinate."""


class PhaseTable(Parameters):
    """A further phase: how far crank and follower are turned to it in the pose of setting."""

    crank_turn: Degrees = Field(
        0.0, ge=-360, le=360, description="Of the crank from phase 1 to this one, counter-clockwise."
    )
    follower_turn: Degrees = Field(0.0, ge=-360, le=360, description="Of the follower, likewise.")


class FourBarParams(Parameters):
    """A crank that turns fully or swings as a lever, a coupler, a follower and the ground, made of plates.

    Examples
    --------
    >>> FourBarParams().coupler_point_x is None
    True
    """

    crank: Millimetres = Field(
        30.0, ge=1, le=2000, description="Crank a, from A0 to A; it drives.", json_schema_extra=FIRST
    )
    coupler: Millimetres = Field(
        80.0, ge=1, le=5000, description="Coupler c, from A to B.", json_schema_extra=FIRST
    )
    follower: Millimetres = Field(
        70.0, ge=1, le=5000, description="Follower b, from B0 to B.", json_schema_extra=FIRST
    )
    ground: Millimetres = Field(
        90.0, ge=1, le=5000, description="Ground f, from A0 to B0.", json_schema_extra=FIRST
    )
    ground_angle: Degrees = Field(
        0.0, ge=-360, le=360, description="Direction from A0 to B0, counter-clockwise from X."
    )
    branch: Literal["open", "crossed"] = Field(
        "open",
        description="Assembly: B to the left of the line from A to B0, or to the right of it.",
        json_schema_extra=FIRST,
    )
    pivot_x: Millimetres = Field(0.0, ge=-10000, le=10000, description="X of the crank's pivot A0.")
    pivot_y: Millimetres = Field(0.0, ge=-10000, le=10000, description="Y of the crank's pivot A0.")
    coupler_point_x: Place | None = Field(
        None,
        description="Coupler point along the coupler, from A towards B; left out, there is none.",
        json_schema_extra=FIRST,
    )
    coupler_point_y: Place | None = Field(
        None,
        description="Coupler point across the coupler, positive to the left of A to B.",
        json_schema_extra=FIRST,
    )
    speed: RevPerMin = Field(
        60.0,
        ge=0.001,
        le=20000,
        description="Speed of the crank; of a lever, swings there and back in a minute.",
        json_schema_extra=FIRST,
    )
    acceleration_ratio: Ratio = Field(
        0.0,
        ge=-MOST_RATIO,
        le=MOST_RATIO,
        description="Acceleration of the crank over the square of its speed, per radian, counter-clockwise "
        "positive, constant over the period; speed is then that at its start.",
    )
    direction: Literal["ccw", "cw"] = Field(
        "ccw", description="Sense of the crank, or of a lever's first swing, seen from above."
    )
    swing_from: Annotated[float, Field(ge=-360, le=360), Unit("deg")] | None = Field(
        None,
        description="One end of the swing of a crank that is a lever, counter-clockwise from X; left out, it "
        "turns fully, or goes as far as it can.",
    )
    swing_to: Annotated[float, Field(ge=-360, le=360), Unit("deg")] | None = Field(
        None, description="The other end of that swing."
    )
    setting_angle: Annotated[float, Field(ge=-720, le=720), Unit("deg")] | None = Field(
        None,
        description="Crank angle from X in phase 1 at which the machine is set to another phase.",
    )
    phases: tuple[PhaseTable, ...] = Field(
        (),
        max_length=7,
        description="Further phases: the coupler has more holes for A and B; its point stays.",
    )
    phase: int = Field(1, ge=1, le=8, description="Phase that motion and parts show.")
    load_torque: Annotated[float, Unit("N*m")] = Field(
        0.0,
        ge=-10000,
        le=10000,
        description="Torque of the load on the follower, counter-clockwise.",
        json_schema_extra=FIRST,
    )
    thickness: Millimetres = Field(
        6.0, ge=1, le=100, description="Of crank, coupler and follower.", json_schema_extra=FIRST
    )
    ground_thickness: Millimetres = Field(8.0, ge=1, le=100, description="Of the ground plate.")
    pin_diameter: Millimetres = Field(
        6.0, ge=1, le=200, description="Pins of all joints.", json_schema_extra=FIRST
    )
    bushing_wall: Millimetres = Field(
        1.0, ge=0, le=50, description="Wall of the plain bushings in the turning joints; 0 for none."
    )
    running_fit: Millimetres = Field(
        0.03, ge=0.005, le=0.5, description="Diameter by which a turning bore is larger than its pin."
    )
    rim: Millimetres = Field(4.0, ge=0.5, le=100, description="Material of the plates around the bores.")
    web_width: Millimetres = Field(
        10.0, ge=1, le=500, description="Width of straight and bent links between their bosses."
    )
    coupler_bend: Millimetres = Field(
        0.0,
        ge=-2000,
        le=2000,
        description="Offset of the coupler's elbow to the left of A to B; 0 for a straight coupler.",
    )
    clearance: Millimetres = Field(
        1.0, ge=0.1, le=50, description="Least distance in plan of what moves in one layer."
    )
    washer: Millimetres = Field(0.5, ge=0.05, le=20, description="Air between the layers of plates.")
    frame: Literal["auto", "one", "two"] = Field(
        "auto",
        description="Ground plates: one below the links, two with the links between, or one where that goes.",
    )
    screw_hole: Annotated[float, Field(ge=1, le=200), Unit("mm")] | None = Field(
        None,
        description="Diameter of the holes in the corners of one ground plate; left out, that of the pins. "
        "Between two ground plates the bolts of their posts go through.",
    )
    screw_offset: Annotated[float, Field(ge=1, le=10000), Unit("mm")] | None = Field(
        None,
        description="Least distance of the holes in the ground plate's corners from the line A0-B0; left "
        "out, as near as the bores leave room.",
    )
    material: MaterialName = Field("aluminium", description="Of the plates.", json_schema_extra=FIRST)

    @model_validator(mode="after")
    def _together(self) -> Self:
        if (self.coupler_point_x is None) != (self.coupler_point_y is None):
            raise ValueError("give both coupler_point_x and coupler_point_y, or neither")
        if self.coupler_point_x is not None and self.coupler_bend != 0:
            raise ValueError(
                "coupler_bend is for a coupler without a point; leave out coupler_point_x and _y"
            )
        if (self.setting_angle is None) != (not self.phases):
            raise ValueError("give both setting_angle and phases, or neither")
        if self.phases and self.coupler_bend != 0:
            raise ValueError("coupler_bend is for a coupler of one phase; leave it out, or phases")
        if self.phase > 1 + len(self.phases):
            raise ValueError(
                f"phase is {self.phase}, and there are {1 + len(self.phases)}; give the others in phases"
            )
        if (self.swing_from is None) != (self.swing_to is None):
            raise ValueError("give both swing_from and swing_to, or neither")
        if self.swing_from is not None and self.swing_from == self.swing_to:
            raise ValueError("swing_from and swing_to are the same angle, so nothing moves; give two")
        if self.swing_from is not None and self.direction == "cw":
            raise ValueError("direction is that of a crank that turns; exchange swing_from and swing_to")
        return self

    @property
    def coupler_point(self) -> complex | None:
        """The coupler point in the coupler's frame, x + i y, mm."""
        if self.coupler_point_x is None or self.coupler_point_y is None:
            return None
        return complex(self.coupler_point_x, self.coupler_point_y)
