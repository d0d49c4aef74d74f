"""The design table of a geared five-bar linkage."""

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from mechwright import FIRST, MaterialName, Parameters
from mechwright.units import Degrees, Millimetres, RevPerMin, Unit

Angle = Annotated[float, Field(ge=-720, le=720), Unit("deg")]

LEAST_TEETH = 18
"""A gear of fewer teeth is undercut by the rack of 20 degrees: 2/sin² 20° is 17.1."""


class PhaseTable(Parameters):
    """A further phase: how far crank and rocker are turned to it in the pose of setting, the arm at rest."""

    crank_turn: Degrees = Field(
        0.0, ge=-360, le=360, description="Of the crank from phase 1 to this one, the gears open."
    )
    rocker_turn: Degrees = Field(0.0, ge=-360, le=360, description="Of the rocker about B1, likewise.")
    swing_from: Angle | None = Field(None, description="One end of the crank's swing; left out, as phase 1.")
    swing_to: Angle | None = Field(None, description="The other end of that swing.")


class FiveBarParams(Parameters):
    """A crank, an arm that gears turn with it, and coupler and rocker between, made of plates.

    Examples
    --------
    >>> FiveBarParams().ratio
    0.5
    """

    crank: Millimetres = Field(
        24.0, ge=1, le=2000, description="Crank R1, from A0 to A; it drives.", json_schema_extra=FIRST
    )
    coupler: Millimetres = Field(
        82.0,
        ge=1,
        le=5000,
        description="Coupler, from A to C; it carries the point.",
        json_schema_extra=FIRST,
    )
    rocker: Millimetres = Field(
        82.0, ge=1, le=5000, description="Rocker R3, from B1 to C.", json_schema_extra=FIRST
    )
    arm: Millimetres = Field(
        24.0,
        ge=1,
        le=2000,
        description="Arm R4, from B0 to B1; geared to the crank.",
        json_schema_extra=FIRST,
    )
    ground: Millimetres = Field(
        105.0, ge=1, le=5000, description="Ground, from A0 to B0.", json_schema_extra=FIRST
    )
    ground_angle: Degrees = Field(
        0.0, ge=-360, le=360, description="Direction from A0 to B0, counter-clockwise from X."
    )
    arm_angle: Degrees = Field(
        60.0,
        ge=-720,
        le=720,
        description="Angle of the arm from X in phase 1 where that of the crank is 0.",
        json_schema_extra=FIRST,
    )
    branch: Literal["open", "crossed"] = Field(
        "open",
        description="Assembly: C to the left of the line from A to B1, or to the right of it.",
        json_schema_extra=FIRST,
    )
    pivot_x: Millimetres = Field(0.0, ge=-10000, le=10000, description="X of the crank's pivot A0.")
    pivot_y: Millimetres = Field(0.0, ge=-10000, le=10000, description="Y of the crank's pivot A0.")
    coupler_point_x: Millimetres = Field(
        40.0,
        ge=-10000,
        le=10000,
        description="Coupler point along the coupler, from A towards C.",
        json_schema_extra=FIRST,
    )
    coupler_point_y: Millimetres = Field(
        30.0,
        ge=-10000,
        le=10000,
        description="Coupler point across the coupler, positive to the left of A to C.",
        json_schema_extra=FIRST,
    )
    crank_teeth: int = Field(
        20, ge=LEAST_TEETH, le=200, description="Teeth of the crank's gear.", json_schema_extra=FIRST
    )
    arm_teeth: int = Field(
        40, ge=LEAST_TEETH, le=200, description="Teeth of the arm's gear.", json_schema_extra=FIRST
    )
    idler_teeth: int = Field(
        20,
        ge=0,
        le=200,
        description="Teeth of the idler that lets both turn the same way; 0 for none.",
        json_schema_extra=FIRST,
    )
    module: Annotated[float, Field(ge=0.3, le=50), Unit("mm")] | None = Field(
        None, description="Module of the gears; left out, the one with which their axes stand in line."
    )
    backlash: Millimetres = Field(0.08, ge=0, le=2, description="Play of two gears along the pitch circle.")
    speed: RevPerMin = Field(
        60.0,
        ge=0.001,
        le=20000,
        description="Speed of the crank; of a lever, swings there and back in a minute.",
        json_schema_extra=FIRST,
    )
    direction: Literal["ccw", "cw"] = Field(
        "ccw", description="Sense of the crank, or of a lever's first swing, seen from above."
    )
    swing_from: Angle | None = Field(
        None,
        description="One end of the swing of a crank that is a lever, counter-clockwise from X; left out, it "
        "turns fully, or goes as far as it can.",
    )
    swing_to: Angle | None = Field(None, description="The other end of that swing.")
    setting_angle: Angle | None = Field(
        None, description="Crank angle from X in phase 1 at which the machine is set to another phase."
    )
    phases: tuple[PhaseTable, ...] = Field(
        (),
        max_length=7,
        description="Further phases: the coupler has more places for A and C; its point stays.",
    )
    phase: int = Field(1, ge=1, le=8, description="Phase that motion and parts show.")
    load_x: Annotated[float, Unit("N")] = Field(
        0.0, ge=-1e5, le=1e5, description="Force of the load on the coupler point along X."
    )
    load_y: Annotated[float, Unit("N")] = Field(
        0.0, ge=-1e5, le=1e5, description="Force of the load on the coupler point along Y."
    )
    thickness: Millimetres = Field(
        6.0, ge=1, le=100, description="Of crank, arm, coupler and rocker.", json_schema_extra=FIRST
    )
    gear_thickness: Millimetres = Field(8.0, ge=1, le=100, description="Of the gears and their clamp.")
    ground_thickness: Millimetres = Field(10.0, ge=1, le=100, description="Of the ground plate.")
    screw_hole: Annotated[float, Field(ge=1, le=50), Unit("mm")] | None = Field(
        None,
        description="Holes in the corners of the ground plate, for the screws of a frame; left out, it "
        "stands on posts that are pressed into it.",
    )
    post_offset: Millimetres = Field(
        0.0, ge=0, le=1000, description="By how much posts or screws stand farther out than the gears ask."
    )
    pin_diameter: Millimetres = Field(
        8.0, ge=1, le=200, description="Pins and shafts of all joints.", json_schema_extra=FIRST
    )
    bushing_wall: Millimetres = Field(
        1.0, ge=0, le=50, description="Wall of the plain bushings in the turning joints; 0 for none."
    )
    running_fit: Millimetres = Field(
        0.03, ge=0.005, le=0.5, description="Diameter by which a turning bore is larger than its pin."
    )
    rim: Millimetres = Field(4.0, ge=0.5, le=100, description="Material of the plates around the bores.")
    web_width: Millimetres = Field(
        12.0, ge=1, le=500, description="Width of straight links between their bosses."
    )
    clearance: Millimetres = Field(
        1.0, ge=0.1, le=50, description="Least distance in plan of what moves in one layer."
    )
    washer: Millimetres = Field(0.5, ge=0.05, le=20, description="Air between the layers of plates.")
    material: MaterialName = Field("aluminium", description="Of the plates.", json_schema_extra=FIRST)

    @model_validator(mode="after")
    def _together(self) -> Self:
        if 0 < self.idler_teeth < LEAST_TEETH:
            raise ValueError(
                f"idler_teeth is {self.idler_teeth}; fewer than {LEAST_TEETH} are undercut: give 0 for no "
                "idler, "
                f"or {LEAST_TEETH} and more"
            )
        if (self.setting_angle is None) != (not self.phases):
            raise ValueError("give both setting_angle and phases, or neither")
        if self.phase > 1 + len(self.phases):
            raise ValueError(
                f"phase is {self.phase}, and there are {1 + len(self.phases)}; give the others in phases"
            )
        ends = [(self.swing_from, self.swing_to), *((row.swing_from, row.swing_to) for row in self.phases)]
        for one, two in ends:
            if (one is None) != (two is None):
                raise ValueError("give both swing_from and swing_to, or neither")
            if one is not None and one == two:
                raise ValueError("swing_from and swing_to are the same angle, so nothing moves; give two")
        if self.swing_from is not None and self.direction == "cw":
            raise ValueError("direction is that of a crank that turns; exchange swing_from and swing_to")
        if self.swing_from is None and any(row.swing_from is not None for row in self.phases):
            raise ValueError("swing_from of a phase goes with one of phase 1; give that, or leave both out")
        return self

    @property
    def coupler_point(self) -> complex:
        """The coupler point in the coupler's frame, x + i y, mm."""
        return complex(self.coupler_point_x, self.coupler_point_y)

    @property
    def ratio(self) -> float:
        """Turns of the arm per turn of the crank: below 0 without an idler."""
        return (1 if self.idler_teeth else -1) * self.crank_teeth / self.arm_teeth
