"""What a cam can be asked for: the table ``[requirement]``."""

from typing import Annotated, Any, Literal, Self

from pydantic import Field, ValidationError, model_validator

from mechwright import FIRST, Parameters
from mechwright.units import Millimetres, RevPerMin, Unit
from mechwright_cam_follower.field_kinds import MOST_SEGMENTS, Angle, LawName, Lift, Swing
from mechwright_cam_follower.parameters import CamParams

CARRIED = (
    "follower",
    "contact",
    "conjugate",
    "angles",
    "lifts",
    "swings",
    "laws",
    "turning",
    "roller_radius",
    "offset",
    "arm_length",
    "centre_distance",
    "bore",
    "speed",
)
"""Keys of a requirement that go into the design as they are, where they are given."""

ARM_LENGTH = 75.0
"""mm, of a lever whose cam is not known yet: a design's follows from its cam."""

SMALLEST = 2.0
"""Base radius, mm, at which a search begins: as the design table has it."""


class SizeRequirement(Parameters):
    """The motion and limits of a cam; what is wanted is the smallest cam that keeps them."""

    follower: Literal["translating", "oscillating"] = Field(
        "translating", description="A follower that slides, or a lever.", json_schema_extra=FIRST
    )
    contact: Literal["roller", "flat"] = Field(
        "roller", description="A roller or a flat face.", json_schema_extra=FIRST
    )
    conjugate: bool = Field(False, description="Two cams and two rollers.")
    angles: Annotated[tuple[Angle, ...], Field(min_length=1, max_length=MOST_SEGMENTS)] = Field(
        (120.0, 60.0, 120.0, 60.0), description="Segments of the turn, 360 together.", json_schema_extra=FIRST
    )
    lifts: Annotated[tuple[Lift, ...], Field(min_length=1, max_length=MOST_SEGMENTS)] | None = Field(
        None, description="Lift at the end of each segment. Default: 15, 15, 0, 0.", json_schema_extra=FIRST
    )
    swings: Annotated[tuple[Swing, ...], Field(min_length=1, max_length=MOST_SEGMENTS)] | None = Field(
        None,
        description="Angle of a lever at the end of each segment. Default: 20, 20, 0, 0.",
        json_schema_extra=FIRST,
    )
    laws: Annotated[tuple[LawName, ...], Field(min_length=1, max_length=MOST_SEGMENTS)] = Field(
        ("cycloidal",),
        description="Law of each rise and return, or one for all; table and polynomial aside.",
        json_schema_extra=FIRST,
    )
    turning: Literal["ccw", "cw"] = Field("ccw", description="How the cam turns, seen from above.")
    greatest_pressure_angle: Annotated[float, Field(ge=5, le=80), Unit("deg")] = Field(
        30.0, description="Pressure angle that no place of the turn may pass.", json_schema_extra=FIRST
    )
    least_curvature_radius: Millimetres = Field(
        5.0,
        ge=0.1,
        le=500,
        description="Radius below which no convex place of the cam may be.",
        json_schema_extra=FIRST,
    )
    roller_radius: Annotated[float, Field(ge=1, le=200), Unit("mm")] | None = Field(
        None, description="Radius of the rollers. Default: 8.", json_schema_extra=FIRST
    )
    offset: Annotated[float, Field(ge=-500, le=500), Unit("mm")] | None = Field(
        None, description="Offset of a slide. Default: the best."
    )
    arm_length: Annotated[float, Field(ge=5, le=2000), Unit("mm")] | None = Field(
        None, description="Arm of a lever with a roller. Default: 75."
    )
    centre_distance: Annotated[float, Field(ge=5, le=2000), Unit("mm")] | None = Field(
        None, description="Between the axes of cam and lever. Default: the best."
    )
    bore: Millimetres = Field(
        15.0, ge=0, le=300, description="Shaft bore of the cam; 0 for none.", json_schema_extra=FIRST
    )
    speed: RevPerMin = Field(
        120.0, ge=0.01, le=20000, description="Constant speed of the cam.", json_schema_extra=FIRST
    )

    @model_validator(mode="after")
    def _together(self) -> Self:
        if {"table", "polynomial"} & set(self.laws):
            raise ValueError('laws "table" and "polynomial" need rows, which a design has; name another')
        try:
            self.design()
        except ValidationError as error:
            first = error.errors(include_url=False)[0]
            raise ValueError(str(first["msg"]).removeprefix("Value error, ")) from error
        return self

    def design(self, **sizes: Any) -> CamParams:
        """The design of these sizes, and of what the requirement says."""
        table = {name: getattr(self, name) for name in CARRIED}
        given = {name: value for name, value in table.items() if value is not None}
        if self.follower == "oscillating" and self.contact == "roller":
            given.setdefault("arm_length", ARM_LENGTH)
        limit = self.greatest_pressure_angle
        return CamParams.model_validate({**given, "pressure_limit": limit, **sizes})
