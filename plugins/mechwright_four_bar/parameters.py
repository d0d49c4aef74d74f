"""The design table of a four-bar linkage."""

from collections.abc import Mapping
from functools import partial
from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import Field, model_validator

from mechwright import FIRST, FITTED, MaterialName, Parameters
from mechwright.mechanics.linkage import fields
from mechwright.mechanics.planar.course import MOST_RATIO
from mechwright.units import Degrees, Millimetres, Ratio, Unit

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

    also: ClassVar[Mapping[str, str]] = {
        "rocker": "it is called follower",
        "output": "the output link is called follower",
        "input": "the input link is called crank",
        "driver": "it is called crank",
        "rod": "the link between crank and follower is called coupler",
        "base": "it is called ground",
        "fixed": "the fixed link is called ground",
        "link1": "the links are called crank, coupler, follower and ground",
        "length": "the links are called crank, coupler, follower and ground",
    }

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
    ground_angle: fields.GroundAngle = 0.0
    branch: Literal["open", "crossed"] = Field(
        "open",
        description="Assembly: B to the left of the line from A to B0, or to the right of it.",
        json_schema_extra=FIRST,
    )
    pivot_x: fields.PivotX = 0.0
    pivot_y: fields.PivotY = 0.0
    coupler_point_x: Place | None = Field(
        None,
        description="Coupler point along the coupler, from A towards B. Default: none.",
        json_schema_extra=FIRST,
    )
    coupler_point_y: Place | None = Field(
        None,
        description="Coupler point across the coupler, positive to the left of A to B.",
        json_schema_extra=FIRST,
    )
    speed: fields.Speed = 60.0
    acceleration_ratio: Ratio = Field(
        0.0,
        ge=-MOST_RATIO,
        le=MOST_RATIO,
        description="Acceleration of the crank over the square of its speed, per radian, counter-clockwise "
        "positive, constant over the period; speed is then that at its start.",
    )
    direction: fields.Direction = "ccw"
    swing_from: fields.SwingFrom = None
    swing_to: fields.SwingTo = None
    setting_angle: fields.SettingAngle = None
    phases: tuple[PhaseTable, ...] = Field(
        (),
        max_length=7,
        description="Further phases: the coupler has more holes for A and B; its point stays.",
    )
    phase: fields.Phase = 1
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
    ground_thickness: fields.GroundThickness = 8.0
    pin_diameter: Millimetres = Field(
        6.0,
        ge=1,
        le=200,
        description="Pins of all joints. Default: 6, or the largest of 5, 4, 3, 2, 1.5 and 1 with which the "
        "bores leave their rims.",
        json_schema_extra={**FIRST, **FITTED},
    )
    bushing_wall: fields.BushingWall = 1.0
    running_fit: fields.RunningFit = 0.03
    rim: fields.Rim = 4.0
    web_width: Millimetres = Field(
        10.0,
        ge=1,
        le=500,
        description="Width of straight and bent links between their bosses. Default: 10, or less as the "
        "pins.",
        json_schema_extra=FITTED,
    )
    coupler_bend: Millimetres = Field(
        0.0,
        ge=-2000,
        le=2000,
        description="Offset of the coupler's elbow to the left of A to B; 0 for a straight coupler.",
    )
    clearance: fields.Clearance = 1.0
    washer: fields.Washer = 0.5
    frame: Literal["auto", "one", "two"] = Field(
        "auto",
        description="Ground plates: one below the links, two with the links between, or one where that goes.",
    )
    screw_hole: Annotated[float, Field(ge=1, le=200), Unit("mm")] | None = Field(
        None,
        description="Diameter of the holes in the corners of the ground plates. Default: that of the pins. "
        "Through those of two plates go the bolts of their posts, which it gives ends for a frame's pillars.",
    )
    screw_offset: Annotated[float, Field(ge=1, le=10000), Unit("mm")] | None = Field(
        None,
        description="Least distance of the holes in the ground plate's corners from the line A0-B0. "
        "Default: as near as the bores leave room.",
    )
    material: MaterialName = Field("aluminium", description="Of the plates.", json_schema_extra=FIRST)

    def fitted(self) -> Mapping[str, Any]:
        """The sizes of the joints, smaller than usual where links are short."""
        from mechwright.mechanics.linkage.usual import of_table
        from mechwright_four_bar.parts.usual import USUAL, fits

        return of_table(USUAL, self, fits(partial(getattr, self)))

    @model_validator(mode="after")
    def _together(self) -> Self:
        if (self.coupler_point_x is None) != (self.coupler_point_y is None):
            raise ValueError("give both coupler_point_x and coupler_point_y, or neither")
        if self.coupler_point_x is not None and self.coupler_bend != 0:
            raise ValueError(
                "coupler_bend is for a coupler without a point; leave out coupler_point_x and _y"
            )
        fields.phases_together(self.setting_angle, self.phases, self.phase)
        if self.phases and self.coupler_bend != 0:
            raise ValueError("coupler_bend is for a coupler of one phase; leave it out, or phases")
        fields.swing_together(self.swing_from, self.swing_to, self.direction)
        return self

    @property
    def coupler_point(self) -> complex | None:
        """The coupler point in the coupler's frame, x + i y, mm."""
        if self.coupler_point_x is None or self.coupler_point_y is None:
            return None
        return self.coupler_point_x + 1j * self.coupler_point_y
