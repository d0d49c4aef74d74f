"""The design table of a disc cam with its follower."""

import math
from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import Field, model_validator

from mechwright import FIRST, FITTED, GIVEN, MaterialName, Parameters
from mechwright.contracts.keyed import KeywayDepth, KeywayRelief, KeywayWidth, keyed_together
from mechwright.standards.linear_guides import LinearGuide, linear_guide
from mechwright.units import Millimetres, RevPerMin, Unit
from mechwright_cam_follower.defaults.proportions import FOLLOWS, fitted, followed, left_out
from mechwright_cam_follower.field_kinds import (
    DEFAULTS,
    MOST_SEGMENTS,
    ONLY,
    SPRINGS,
    WHOLE,
    Angle,
    GuideName,
    LawName,
    Lift,
    SpringName,
    Swing,
)


class CamParams(Parameters):
    """A cam that turns at constant speed, and what follows it.

    Fields that are left out have the value that their description says. ``check`` says what cannot be built.

    Examples
    --------
    >>> CamParams(angles=(180.0, 180.0), lifts=(10.0, 0.0)).stroke
    10.0
    """

    also: ClassVar[Mapping[str, str]] = {
        "lift": "lifts has one for each segment of a turn, beside angles",
        "rise": "angles and lifts are lists, with one number for each segment of a turn",
        "dwell": "a segment of angles with the lift of the one before is a dwell",
        "fall": "angles and lifts are lists, with one number for each segment of a turn",
        "law": "laws has one for each segment of a turn",
        "base_circle": "base_radius is its radius",
        "roller_diameter": "roller_radius is half of it",
    }

    follower: Literal["translating", "oscillating"] = Field(
        "translating", description="A follower that slides, or a lever.", json_schema_extra=FIRST
    )
    contact: Literal["roller", "flat"] = Field(
        "roller",
        description="Contact of the follower with the cam: a roller or a flat face.",
        json_schema_extra=FIRST,
    )
    conjugate: bool = Field(
        False,
        description="Two cams on one shaft, two rollers on one follower, which hold each other: no spring.",
    )
    angles: Annotated[tuple[Angle, ...], Field(min_length=1, max_length=MOST_SEGMENTS)] = Field(
        (120.0, 60.0, 120.0, 60.0),
        description="Segments of the turn, 360 together: angles of the cam, in the order in which they pass.",
        json_schema_extra=FIRST,
    )
    lifts: Annotated[tuple[Lift, ...], Field(min_length=1, max_length=MOST_SEGMENTS)] | None = Field(
        None,
        description=(
            "Lift of a translating follower at the end of each segment, 0 where it is lowest; the turn "
            "begins with the last. Default: 15, 15, 0, 0."
        ),
        json_schema_extra=FIRST,
    )
    swings: Annotated[tuple[Swing, ...], Field(min_length=1, max_length=MOST_SEGMENTS)] | None = Field(
        None,
        description="Angle of a lever at the end of each segment. Default: 20, 20, 0, 0.",
        json_schema_extra=FIRST,
    )
    laws: Annotated[tuple[LawName, ...], Field(min_length=1, max_length=MOST_SEGMENTS)] = Field(
        ("cycloidal",),
        description="Law of each rise and return in their order, or one for all; dwells have none.",
        json_schema_extra=FIRST,
    )
    polynomial: (
        Annotated[
            tuple[Annotated[float, Field(ge=-1e4, le=1e4), Unit("")], ...],
            Field(min_length=2, max_length=16),
        ]
        | None
    ) = Field(None, description='Coefficients c0, c1, ... of s(u) for the law "polynomial".')
    table: (
        Annotated[
            tuple[
                tuple[
                    Annotated[float, Field(ge=0, le=1), Unit("")],
                    Annotated[float, Field(ge=-1, le=2), Unit("")],
                ],
                ...,
            ],
            Field(min_length=2, max_length=2000),
        ]
        | None
    ) = Field(None, description='Rows (u, s) from (0, 0) to (1, 1) for the law "table", eleven at least.')
    base_radius: Millimetres = Field(
        40.0,
        ge=2,
        le=1000,
        description="Radius of the base circle: the cam where the follower is lowest.",
        json_schema_extra=FIRST,
    )
    roller_radius: Annotated[float, Field(ge=1, le=200), Unit("mm")] | None = Field(
        None, description="Radius of the rollers. Default: 8.", json_schema_extra=FIRST
    )
    offset: Annotated[float, Field(ge=-500, le=500), Unit("mm")] | None = Field(
        None,
        description=(
            "How far a translating follower slides off the cam's axis, to +x; with the turn "
            "counter-clockwise more of it lowers the pressure angle of the rise. Default: 0."
        ),
        json_schema_extra=FIRST,
    )
    centre_distance: Annotated[float, Field(ge=5, le=2000), Unit("mm")] | None = Field(
        None,
        description=(
            "From the cam's axis to the lever's. Default: it grows with the cam: 90 for the usual one, "
            "68 with a flat face."
        ),
        json_schema_extra=FIRST,
    )
    arm_length: Annotated[float, Field(ge=5, le=2000), Unit("mm")] | None = Field(
        None,
        description=(
            "From the lever's axis to its roller. Default: it grows with the cam: 75 for the usual one."
        ),
        json_schema_extra=FIRST,
    )
    face_offset: Annotated[float, Field(ge=2, le=300), Unit("mm")] | None = Field(
        None,
        description=(
            "From a lever's axis to its flat face, towards the cam. Default: half the width of the follower."
        ),
    )
    face_margin: Annotated[float, Field(ge=0.2, le=50), Unit("mm")] | None = Field(
        None, description="How far a flat face goes on beyond its last contact on either side. Default: 2."
    )
    turning: Literal["ccw", "cw"] = Field("ccw", description="How the cam turns, seen from above.")
    pressure_limit: Annotated[float, Field(ge=5, le=80), Unit("deg")] | None = Field(
        None,
        description="Greatest pressure angle that is no warning. Default: 30, of a lever 35.",
        json_schema_extra=GIVEN,
    )
    speed: RevPerMin = Field(
        120.0, ge=0.01, le=20000, description="Constant speed of the cam.", json_schema_extra=FIRST
    )
    mass: Annotated[float, Field(ge=0.001, le=1000), Unit("kg")] | None = Field(
        None, description="All that slides with the follower. Default: 0.3.", json_schema_extra=FIRST
    )
    inertia: Annotated[float, Field(ge=1e-7, le=1000), Unit("kg*m^2")] | None = Field(
        None, description="All that swings with the lever. Default: 0.001."
    )
    load: Annotated[float, Field(ge=-1e5, le=1e5), Unit("N")] | None = Field(
        None, description="Constant force that presses a follower to the cam. Default: 0."
    )
    load_torque: Annotated[float, Field(ge=-1e5, le=1e5), Unit("N*m")] | None = Field(
        None, description="Constant torque that presses a lever to the cam. Default: 0."
    )
    spring_preload: Annotated[float, Field(ge=0, le=1e5), Unit("N")] | None = Field(
        None, description="Force of the spring at the lowest place. Default: 60."
    )
    spring_rate: Annotated[float, Field(ge=0, le=1e4), Unit("N/mm")] | None = Field(
        None, description="Rate of the spring: its force over the lift. Default: 4."
    )
    spring_torque: Annotated[float, Field(ge=0, le=1e5), Unit("N*m")] | None = Field(
        None, description="Torque of a lever's spring at the lowest place. Default: 4."
    )
    spring_stiffness: Annotated[float, Field(ge=0, le=1e4), Unit("N*m/rad")] | None = Field(
        None, description="Rate of a lever's spring: its torque over the swing. Default: 4."
    )
    spring: SpringName | None = Field(
        None,
        description=(
            'Extension spring to buy: "auto", or wire x outside x free length such as "1.25x12.5x50", mm, in '
            "place of the other keys of a spring. Default: a spring of your own with those."
        ),
    )
    thickness: Millimetres = Field(
        10.0, ge=1, le=100, description="Thickness of a cam, and length of a roller.", json_schema_extra=FIRST
    )
    follower_thickness: Millimetres = Field(
        8.0, ge=1, le=100, description="Thickness of bar or lever; a flat one is as thick as the cam."
    )
    follower_width: Millimetres = Field(20.0, ge=3, le=200, description="Width of bar or lever.")
    axial_gap: Millimetres = Field(1.0, ge=0.1, le=20, description="Between a cam and the follower over it.")
    pin_diameter: Millimetres = Field(
        8.0,
        ge=1,
        le=100,
        description="Stud of a roller, and its hole in the follower. Default: 8, and less in small rollers.",
        json_schema_extra=FITTED,
    )
    pivot_bore: Millimetres = Field(10.0, ge=2, le=100, description="Bore of a lever for its shaft.")
    guide_length: Millimetres = Field(
        40.0, ge=5, le=500, description="Length of the rails that guide a translating follower."
    )
    guide: GuideName | None = Field(
        None,
        description=(
            "Guide of a translating follower: rails that are cut from plate, or a linear guide to buy, which "
            "a frame carries. Default: rails."
        ),
    )
    guide_clearance: Millimetres = Field(
        0.05, ge=0.005, le=1, description="Between the follower and each rail."
    )
    guide_screw: Millimetres = Field(
        5.5, ge=2, le=30, description="Diameter of the two holes of a rail, for its screws."
    )
    bore: Millimetres = Field(
        15.0,
        ge=0,
        le=300,
        description="Shaft bore of the cam; 0 for none. Default: 15, and less in small cams.",
        json_schema_extra={**FIRST, **FITTED},
    )
    keyway_width: KeywayWidth = Field(
        0.0, description="Width of the cam's keyway, along +x at the start; 0 for none."
    )
    keyway_depth: KeywayDepth = None
    keyway_relief: KeywayRelief = 0.0
    screw_diameter: Millimetres = Field(
        0.0, ge=0, le=30, description="Diameter of the holes that screw the cam to a flange; 0 for none."
    )
    screw_circle: Millimetres = Field(
        30.0, ge=4, le=600, description="Diameter of the circle on which those holes stand."
    )
    screws: int = Field(4, ge=2, le=12, description="Number of those holes.")
    least_wall: Millimetres = Field(
        2.0, ge=0.2, le=50, description="Thinnest wall that may stay between openings and edges."
    )
    material: MaterialName = Field(
        "steel", description="Of the cam, and of what follows it.", json_schema_extra=FIRST
    )
    roller_material: MaterialName = Field("steel", description="Of the rollers.")

    def fitted(self) -> Mapping[str, Any]:
        """The bore of a small cam, and the stud of a small roller."""
        names = left_out(self.model_fields_set, self.keyway_width > 0, self.contact)
        return {name: fitted(self, name) for name in names}

    @model_validator(mode="after")
    def _together(self) -> Self:
        for name, (choice, value) in ONLY.items():
            if getattr(self, name) is not None and getattr(self, choice) != value:
                raise ValueError(f'{name} is for {choice} = "{value}"; leave it out, or set that')
        self._kinds()
        total = sum(self.angles)
        if abs(total - 360) > WHOLE:
            raise ValueError(f"angles add up to {total:g} degrees; a turn has 360")
        ends, name = self.ends, "lifts" if self.translating else "swings"
        if len(ends) != len(self.angles):
            raise ValueError(
                f"{name} has {len(ends)} values for {len(self.angles)} angles; give one for each"
            )
        if min(ends) != 0 or max(ends) <= 0:
            raise ValueError(
                f"{name} is 0 where the follower is lowest and above 0 elsewhere; make the least one 0"
            )
        if len(self.laws) not in {1, self.moves}:
            raise ValueError(
                f"laws has {len(self.laws)} names for {self.moves} rises and returns; give one, or as many"
            )
        for law in ("polynomial", "table"):
            if (law in self.laws) != (getattr(self, law) is not None):
                raise ValueError(f'{law} and the law "{law}" need each other; give both or none')
        return self

    def _kinds(self) -> None:
        if self.conjugate and self.contact == "flat":
            raise ValueError('conjugate cams hold rollers; set contact = "roller", or conjugate = false')
        if self.arm_length is not None and self.contact == "flat":
            raise ValueError('arm_length is for contact = "roller"; leave it out')
        if self.offset is not None and self.contact == "flat":
            raise ValueError("offset is for rollers: a flat face does not feel it; leave it out")
        if self.face_offset is not None and (self.translating or self.contact == "roller"):
            raise ValueError("face_offset is for levers with a flat face; leave it out")
        for name in SPRINGS:
            if self.conjugate and getattr(self, name) is not None:
                raise ValueError(f"{name}: conjugate cams need no spring; leave it out")
            if self.spring is not None and getattr(self, name) is not None:
                raise ValueError(f"{name}: the spring that is bought has its own; leave it out, or spring")
        if self.conjugate and self.spring is not None:
            raise ValueError("spring: conjugate cams need none; leave it out")
        if self.guide is not None and (not self.translating or self.conjugate):
            raise ValueError("guide is for a translating follower with one cam; leave it out")
        if self.translating and self.spring is not None and self.linear_guide is None:
            raise ValueError('spring: that of a slide lies over a linear guide; set guide = "linear-15"')
        keyed_together(self)

    def value(self, name: str) -> float:
        """A field that belongs to one kind of follower, or what it is where it is left out."""
        given = getattr(self, name)
        if given is None and name in SPRINGS and self.conjugate:
            return 0.0
        if given is None:
            given = followed(self, name) if name in FOLLOWS else DEFAULTS[name]
        found: float = given
        return found

    @property
    def translating(self) -> bool:
        """Whether the follower slides."""
        return self.follower == "translating"

    @property
    def linear_guide(self) -> LinearGuide | None:
        """That of a slide; None for a lever, and for rails that are cut from plate."""
        return None if self.guide in {None, "rails"} else linear_guide(str(self.guide))

    @property
    def ends(self) -> tuple[float, ...]:
        """Lift, mm, or swing, degrees, at the end of each segment."""
        name = "lifts" if self.translating else "swings"
        given: tuple[float, ...] | None = getattr(self, name)
        if given is None:
            found: tuple[float, ...] = DEFAULTS[name]
            return found
        return given

    @property
    def moves(self) -> int:
        """Number of rises and returns."""
        ends = self.ends
        return sum(one != other for one, other in zip(ends, (ends[-1], *ends[:-1]), strict=True))

    @property
    def stroke(self) -> float:
        """Greatest lift, mm, or swing, degrees."""
        return max(self.ends)

    @property
    def face(self) -> float:
        """From a lever's axis to its flat face, mm."""
        return self.follower_width / 2 if self.face_offset is None else self.face_offset

    @property
    def sense(self) -> int:
        """1 where the cam turns counter-clockwise, -1 where it turns clockwise."""
        return 1 if self.turning == "ccw" else -1

    @property
    def steepest(self) -> float:
        """Greatest pressure angle that is no warning, degrees."""
        if self.pressure_limit is not None:
            return self.pressure_limit
        return 30.0 if self.translating else 35.0

    @property
    def omega(self) -> float:
        """Speed of the cam, rad/s."""
        return self.speed * math.tau / 60
