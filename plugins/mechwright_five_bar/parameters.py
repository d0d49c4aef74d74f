"""The design table of a geared five-bar linkage."""

from collections.abc import Mapping
from functools import partial
from typing import Annotated, Any, Literal, Self

from pydantic import Field, model_validator

from mechwright import FIRST, FITTED, MaterialName, Parameters
from mechwright.mechanics.linkage import fields
from mechwright.units import Degrees, Millimetres, Unit
from mechwright_five_bar.defaults.limits import LEAST_TEETH, MOST_TEETH, USUAL_FACE

Angle = Annotated[float, Field(ge=-720, le=720), Unit("deg")]


class PhaseTable(Parameters):
    """A further phase: how far crank and rocker are turned to it in the pose of setting, the arm at rest."""

    crank_turn: Degrees = Field(
        0.0, ge=-360, le=360, description="Of the crank from phase 1 to this one, the gears open."
    )
    rocker_turn: Degrees = Field(0.0, ge=-360, le=360, description="Of the rocker about B1, likewise.")
    swing_from: Angle | None = Field(None, description="One end of the crank's swing. Default: as phase 1.")
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
    ground_angle: fields.GroundAngle = 0.0
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
    pivot_x: fields.PivotX = 0.0
    pivot_y: fields.PivotY = 0.0
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
        20,
        ge=LEAST_TEETH,
        le=MOST_TEETH,
        description="Teeth of the crank's gear. Default: 20, or with a module half as many as the arm's, "
        "which reach over the ground.",
        json_schema_extra={**FIRST, **FITTED},
    )
    arm_teeth: int = Field(
        40,
        ge=LEAST_TEETH,
        le=MOST_TEETH,
        description="Teeth of the arm's gear. Default: 40, or with a module twice as many as the crank's.",
        json_schema_extra={**FIRST, **FITTED},
    )
    idler_teeth: int = Field(
        20,
        ge=0,
        le=MOST_TEETH,
        description="Teeth of the idler that lets both turn the same way, 0 for none. Default: 20, or with "
        "a module as many as reach from gear to gear.",
        json_schema_extra={**FIRST, **FITTED},
    )
    module: Annotated[float, Field(ge=0.3, le=50), Unit("mm")] | None = Field(
        None, description="Module of the gears. Default: the one with which their axes stand in line."
    )
    backlash: Millimetres = Field(0.08, ge=0, le=2, description="Play of two gears along the pitch circle.")
    speed: fields.Speed = 60.0
    direction: fields.Direction = "ccw"
    swing_from: fields.SwingFrom = None
    swing_to: fields.SwingTo = None
    setting_angle: fields.SettingAngle = None
    phases: tuple[PhaseTable, ...] = Field(
        (),
        max_length=7,
        description="Further phases: the coupler has more places for A and C; its point stays.",
    )
    phase: fields.Phase = 1
    load_x: Annotated[float, Unit("N")] = Field(
        0.0, ge=-1e5, le=1e5, description="Force of the load on the coupler point along X."
    )
    load_y: Annotated[float, Unit("N")] = Field(
        0.0, ge=-1e5, le=1e5, description="Force of the load on the coupler point along Y."
    )
    thickness: Millimetres = Field(
        6.0, ge=1, le=100, description="Of crank, arm, coupler and rocker.", json_schema_extra=FIRST
    )
    gear_thickness: Millimetres = Field(
        USUAL_FACE,
        ge=1,
        le=100,
        description="Of the gears and their clamp. Default: 8, or up to 12 modules as the load asks for it.",
        json_schema_extra=FITTED,
    )
    ground_thickness: fields.GroundThickness = 10.0
    screw_hole: Annotated[float, Field(ge=1, le=50), Unit("mm")] | None = Field(
        None,
        description="Holes in the corners of the ground plate, for the screws of a frame. Default: it "
        "stands on posts that are pressed into it.",
    )
    post_offset: Millimetres = Field(
        0.0, ge=0, le=1000, description="By how much posts or screws stand farther out than the gears ask."
    )
    pin_diameter: Millimetres = Field(
        8.0,
        ge=1,
        le=200,
        description="Pins and shafts of all joints. Default: 8, or the largest of 5, 4, 3, 2, 1.5 and 1 "
        "with which the bores of links and gears leave their rims.",
        json_schema_extra={**FIRST, **FITTED},
    )
    bushing_wall: fields.BushingWall = 1.0
    running_fit: fields.RunningFit = 0.03
    rim: fields.Rim = 4.0
    web_width: Millimetres = Field(
        12.0,
        ge=1,
        le=500,
        description="Width of straight links between their bosses. Default: 12, or less as the pins.",
        json_schema_extra=FITTED,
    )
    clearance: fields.Clearance = 1.0
    washer: fields.Washer = 0.5
    material: MaterialName = Field("aluminium", description="Of the plates.", json_schema_extra=FIRST)

    def fitted(self) -> Mapping[str, Any]:
        """Teeth that reach over the ground, joints that fit short links or fine gears."""
        from mechwright.mechanics.linkage.usual import of_table
        from mechwright_five_bar.defaults.teeth import USUAL, fits, teeth_left_out

        given = self.model_fields_set
        found: dict[str, Any] = {**teeth_left_out(partial(getattr, self), given)}
        return found | of_table(
            USUAL, self, fits(lambda name: found[name] if name in found else getattr(self, name))
        )

    @model_validator(mode="after")
    def _together(self) -> Self:
        if 0 < self.idler_teeth < LEAST_TEETH:
            raise ValueError(
                f"idler_teeth is {self.idler_teeth}; fewer than {LEAST_TEETH} are undercut: give 0 for no "
                "idler, "
                f"or {LEAST_TEETH} and more"
            )
        self.phased()
        return self

    def phased(self) -> None:
        """Raise ValueError where phases and swings do not go together."""
        fields.phases_together(self.setting_angle, self.phases, self.phase)
        fields.swing_together(self.swing_from, self.swing_to, self.direction)
        for row in self.phases:
            fields.swing_together(row.swing_from, row.swing_to, "ccw")
        if self.swing_from is None and any(row.swing_from is not None for row in self.phases):
            raise ValueError("swing_from of a phase goes with one of phase 1; give that, or leave both out")

    @property
    def coupler_point(self) -> complex:
        """The coupler point in the coupler's frame, x + i y, mm."""
        return self.coupler_point_x + 1j * self.coupler_point_y

    @property
    def ratio(self) -> float:
        """Turns of the arm per turn of the crank: below 0 without an idler."""
        return (1 if self.idler_teeth else -1) * self.crank_teeth / self.arm_teeth
