"""The design table of a pair, or of a train of two pairs, of elliptic gears."""

import math
from collections.abc import Mapping
from functools import partial
from itertools import pairwise
from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import Field, field_validator, model_validator

from mechwright import FIRST, FITTED, MaterialName, Parameters
from mechwright.contracts.gear_fields import Backlash, FaceWidth, LoadTorque, ShaftBore
from mechwright.contracts.keyed import KeywayDepth, KeywayRelief, KeywayWidth, keyed_together
from mechwright.units import Degrees, Millimetres, Ratio, RevPerMin, Unit

LEAST_MODULE = 0.1
"""mm. Finer teeth are below what the smallest end mills can cut, and near the outline's own tolerance."""

LEAST_TEETH = 6
"""Fewer have no room for a root and a shaft."""

MOST_TEETH = 600
"""More teeth than that say nothing new."""


OFF_LINE = 2000
"""mm. Bound of ``point_across``: twice the largest ``semi_major``; ``check`` knows the coupler's reach."""

REPORTED_PHASES = (0.0, 45.0, 90.0, 135.0, 180.0)
"""Degrees: the phase angles of the published trains."""

USUAL_PHASE = 90.0
"""Degrees: the published train with the longest window of near-constant speed."""

USUAL_GAP = 2.0
"""Height of spacers, mm: chips and a little wobble of a plate on its shaft have room."""

MOST_PHASES = 36
"""Marks of a joint that people can still tell apart: every ten degrees."""

Phase = Annotated[float, Field(ge=0, le=360), Unit("deg")]

TRAIN_ONLY = (
    "phase",
    "phase_joint",
    "phases",
    "clamp_screw",
    "clamp_screws",
    "gap",
    "pin_diameter",
    "coupler_thickness",
    "tracer_diameter",
    "base_thickness",
    "bushes",
    "stub_diameter",
    "stub_length",
    "screw_hole",
    "screw_offset",
    "dowel_diameter",
    "dowel_circle",
)
"""Fields that a single pair has no use for."""


def cap_screws() -> list[float]:
    """Threads of the screws that can clamp, mm: those with a socket head."""
    from mechwright.standards.screws import screw_sizes  # it imports numpy, which a listing has no use for

    return [one.size for one in screw_sizes() if one.head]


class EllipticGearParams(Parameters):
    """Congruent elliptic gears, each turning about one focus of its pitch ellipse: a pair, or a train of two.

    Lengths of the tooth profile are in modules. Fields that are left out have the value that their
    description or :mod:`mechwright_elliptic_gears.parts.layout` says. ``check`` says what cannot be built.

    Examples
    --------
    >>> EllipticGearParams(eccentricity=0.4, teeth=39, module=2.0).semi_major is None
    True
    """

    also: ClassVar[Mapping[str, str]] = {
        "ratio": "the speed changes between (1 - e)/(1 + e) and (1 + e)/(1 - e), e the eccentricity",
        "ratio_max": "the speed changes between (1 - e)/(1 + e) and (1 + e)/(1 - e), e the eccentricity",
        "centre_distance": "it is twice semi_major",
        "center_distance": "it is twice semi_major",
        "distance": "the centre distance is twice semi_major",
        "major_axis": "semi_major is half of it",
        "e": "it is called eccentricity",
        "a": "it is called semi_major",
        "number_of_teeth": "it is called teeth",
    }

    stages: int = Field(
        1,
        ge=1,
        le=2,
        description="1: gears 2 and 4; 2: a train of gears 2 and 3, 4 and 5, with its coupler.",
        json_schema_extra=FIRST,
    )
    phase: Phase | None = Field(
        None,
        description="Phase angle γ of a train: gear 2 stands there when gear 4 is at 0. Default: 90.",
        json_schema_extra=FIRST,
    )
    phase_joint: Literal["fixed", "pins", "clamp"] | None = Field(
        None,
        description=(
            "Joint of gears 3 and 4. fixed: a key or three dowels, for one phase; pins: a pin in one hole "
            "of a dividing circle, a hole for each of phases; clamp: screws and a scale with a mark for "
            "each. Default: fixed."
        ),
    )
    phases: Annotated[tuple[Phase, ...], Field(min_length=1, max_length=MOST_PHASES)] | None = Field(
        None, description="Phase angles that the joint can be set to. Default: 0, 45, 90, 135, 180."
    )
    eccentricity: Ratio = Field(
        0.4,
        ge=0,
        le=0.9,  # at 0.9 the ratio swings from 1:19 to 19:1
        description="Eccentricity of the pitch ellipse; the speed ratio swings up to (1 + e) / (1 - e).",
        json_schema_extra=FIRST,
    )
    teeth: int = Field(
        25,
        ge=LEAST_TEETH,
        le=MOST_TEETH,
        description="Number of teeth of each gear. Default: 25, or the least greater one without undercut.",
        json_schema_extra={**FIRST, **FITTED},
    )
    module: Annotated[float, Field(ge=LEAST_MODULE, le=25), Unit("mm")] | None = Field(
        None, description="Pitch on the ellipse over π; give this or semi_major."
    )
    semi_major: Annotated[float, Field(ge=2, le=1000), Unit("mm")] | None = Field(
        50.0,
        description="Half the major axis, half the centre distance; give this or module.",
        json_schema_extra=FIRST,
    )
    tooth_offset: Annotated[float, Field(ge=0, lt=1), Unit("")] | None = Field(
        None,
        description=(
            "Arc from the far vertex to the middle of a tooth, in pitches: 0 or 0.5 for an odd number of "
            "teeth, 0.25 or 0.75 for an even one. Default: the smaller."
        ),
    )
    pressure_angle: Degrees = Field(20.0, ge=10, le=30, description="Pressure angle of the generating rack.")
    addendum: Ratio = Field(1.0, ge=0.3, le=1.5, description="Tooth height over the pitch curve, in modules.")
    dedendum: Ratio = Field(
        1.25,
        ge=0.4,
        le=2,
        description="Depth below the pitch curve, in modules. Default: 1.25, or 0.25 above a high addendum.",
        json_schema_extra=FITTED,
    )
    tip_radius: Ratio = Field(
        0.38,
        ge=0,
        le=0.6,
        description="Radius at the tip of the generating rack, in modules. Default: 0.38, or what its tooth "
        "has room for.",
        json_schema_extra=FITTED,
    )
    backlash: Backlash | None = Field(
        None,
        description=(
            "Circumferential play of the pair on the pitch curve, a quarter per flank. Default: the least "
            "with which gears as made turn: 0.067 at e = 0.4, of a train 0.107."
        ),
    )
    thickness: FaceWidth = 10.0
    material: MaterialName = Field("aluminium", description="Workpiece material.", json_schema_extra=FIRST)
    bore: ShaftBore = Field(
        10.0,
        description="Diameter of the shaft bore, 0 for none. Default: 10, or the largest standard one below "
        "that leaves the rim of a small gear.",
    )
    keyway_width: KeywayWidth = Field(
        0.0, description="Width of the hub keyway, towards the far vertex; 0 for none."
    )
    keyway_depth: KeywayDepth = None
    keyway_relief: KeywayRelief = 0.0
    speed: RevPerMin = Field(
        60.0, ge=0.001, le=20000, description="Constant speed of gear 2.", json_schema_extra=FIRST
    )
    load_torque: LoadTorque = Field(
        0.0,
        description="Constant torque against the turning of the last gear, 4 of a pair or 5 of a train.",
    )
    point_along: Ratio = Field(
        0.5, ge=-1, le=2, description="Where point Q stands along the coupler: 0 at J, 1 at K."
    )
    point_across: Millimetres = Field(
        0.0, ge=-OFF_LINE, le=OFF_LINE, description="Distance of Q from the line J-K, to its left."
    )
    band: Annotated[float, Field(gt=0, le=1e6), Unit("mm/s")] | None = Field(
        None,
        description="Spread of Q's speed that still counts as constant. Default: 0.02 semi_major × speed.",
    )
    gap: Annotated[float, Field(ge=0.2, le=50), Unit("mm")] | None = Field(
        None, description="Height of the spacers between the plates of a train. Default: 2."
    )
    pin_diameter: Annotated[float, Field(ge=0.5, le=100), Unit("mm")] | None = Field(
        None, description="Joints J and K of the coupler. Default: half the bore."
    )
    coupler_thickness: Annotated[float, Field(ge=0.3, le=100), Unit("mm")] | None = Field(
        None, description="Plate of the coupler. Default: 6."
    )
    tracer_diameter: Annotated[float, Field(ge=0, le=100), Unit("mm")] | None = Field(
        None, description="Hole at Q for a pen or a tool, 0 for none. Default: the pin's."
    )
    base_thickness: Annotated[float, Field(ge=0.3, le=200), Unit("mm")] | None = Field(
        None, description="Base plate. Default: 10."
    )
    bushes: bool | None = Field(
        None,
        description="Sintered bronze bushes (ISO 2795) wherever something turns on or in a plate. Default: "
        "plates and shafts run on each other.",
    )
    stub_diameter: Annotated[float, Field(ge=0.5, le=300), Unit("mm")] | None = Field(
        None, description="Of the input's shaft below the base plate. Default: the bore's."
    )
    stub_length: Annotated[float, Field(ge=1, le=1000), Unit("mm")] | None = Field(
        None, description="How far it stands out there. Default: two bores."
    )
    screw_hole: Annotated[float, Field(ge=1, le=50), Unit("mm")] | None = Field(
        None,
        description="Holes in the corners of the base plate, for the screws of a frame. Default: four under "
        "the gears fix it.",
    )
    screw_offset: Annotated[float, Field(ge=0, le=5000), Unit("mm")] | None = Field(
        None,
        description="Distance of those holes from the axes of gears 2 and 5. Default: 8 beyond the teeth.",
    )
    dowel_diameter: Annotated[float, Field(ge=0.5, le=50), Unit("mm")] | None = Field(
        None,
        description=(
            "Three dowels that join gears 3 and 4 without a key, or the pin of a dividing circle. Default: "
            "a third of the bore."
        ),
    )
    dowel_circle: Annotated[float, Field(ge=1, le=1000), Unit("mm")] | None = Field(
        None,
        description=(
            "Diameter of the circle of the dowels, or of the inner dividing circle. Default: as small as "
            "the spacer allows, or the walls between the holes of one circle."
        ),
    )

    clamp_screw: Annotated[float, Field(ge=2, le=12), Unit("mm")] | None = Field(
        None, description="Thread of the clamp's screws, M2 to M12. Default: at most a third of the bore."
    )
    clamp_screws: Annotated[int, Field(ge=3, le=8)] | None = Field(
        None, description="Number of the clamp's screws. Default: 4."
    )

    def fitted(self) -> Mapping[str, Any]:
        """Teeth that can be cut, and a bore that is smaller than usual in small gears."""
        from mechwright_elliptic_gears.parts.defaults import following

        if self.module is None and self.semi_major is None:  # which is refused
            return {}
        found = following(partial(getattr, self), self.model_fields_set)
        return {name: value if value.ndim else value.item() for name, value in found.items()}

    @field_validator("band", mode="before")
    @classmethod
    def _band_has_a_width(cls, value: Any) -> Any:
        if isinstance(value, (int, float)) and not isinstance(value, bool) and value <= 0:
            raise ValueError(
                "is no spread of speeds; give one above 0 mm/s, or leave it out for 0.02 semi_major × speed"
            )
        return value

    @model_validator(mode="before")
    @classmethod
    def _module_replaces_default_size(cls, table: Any) -> Any:
        if isinstance(table, dict) and table.get("module") is not None and "semi_major" not in table:
            return {**table, "semi_major": None}
        return table

    @model_validator(mode="after")
    def _together(self) -> Self:
        if (self.module is None) == (self.semi_major is None):
            raise ValueError("give exactly one of module and semi_major")
        keyed_together(self)
        if self.stages == 1:
            for name in TRAIN_ONLY:
                if getattr(self, name) is not None:
                    raise ValueError(f"{name} belongs to a train; set stages = 2, or leave it out")
        elif self.bore == 0:
            raise ValueError("stages = 2 needs shafts; set bore")
        elif self.stub_diameter is not None and self.stub_diameter > self.bore:
            raise ValueError(
                f"stub_diameter is {self.stub_diameter:g}, and the shaft goes through a base plate with "
                f"bores of {self.bore:g}; make it smaller, or leave it out"
            )
        elif self.screw_offset is not None and self.screw_hole is None:
            raise ValueError("screw_offset needs holes; set screw_hole = 5.5, or leave it out")
        elif self.keyed_phase and (self.dowel_diameter or self.dowel_circle):
            raise ValueError(
                "dowel_diameter and dowel_circle are for gears without a key; leave them out, "
                "or set keyway_width = 0"
            )
        self._what_the_joint_has()
        return self

    def _what_the_joint_has(self) -> None:
        clamped = self.phase_joint == "clamp"
        for name in ("clamp_screw", "clamp_screws"):
            if getattr(self, name) is not None and not clamped:
                raise ValueError(f'{name} needs a clamp; set phase_joint = "clamp", or leave it out')
        for name in ("dowel_diameter", "dowel_circle"):
            if getattr(self, name) is not None and clamped:
                raise ValueError(f"{name} has no place in a clamp; leave it out")
        sizes = cap_screws()
        if self.clamp_screw is not None and self.clamp_screw not in sizes:
            nearest = min(sizes, key=lambda size: abs(size - (self.clamp_screw or 0)))
            raise ValueError(f"clamp_screw is no thread of a screw; the nearest is {nearest:g}")
        if self.phases is None:
            return
        if not self.adjustable:
            raise ValueError(
                'phases needs a joint that can be set; set phase_joint = "pins", or leave it out'
            )
        turned = sorted(phase % 360 for phase in self.phases)
        twice = [one for one, other in pairwise(turned) if one == other]
        if twice:
            raise ValueError(f"phases has {twice[0]:g} degrees twice, 0 and 360 are one; leave one out")

    @property
    def spacing(self) -> float:
        """Height of the spacers between the plates of a train, mm."""
        return USUAL_GAP if self.gap is None else self.gap

    @property
    def adjustable(self) -> bool:
        """Whether the phase is set on the machine: gears 3 and 4 are the same for all phases."""
        return self.phase_joint not in {None, "fixed"}

    @property
    def keyed_phase(self) -> bool:
        """Whether keys of the middle shaft hold gears 3 and 4."""
        return self.stages == 2 and not self.adjustable and self.keyway_width > 0

    @property
    def dowelled(self) -> bool:
        """Whether three dowels join gears 3 and 4."""
        return self.stages == 2 and not self.adjustable and self.keyway_width == 0

    @property
    def set_phases(self) -> tuple[float, ...]:
        """Phase angles, degrees, of all settings of the train: one if its joint is fixed."""
        if self.adjustable:
            return self.phases or REPORTED_PHASES
        return () if self.stages == 1 else (self.phase_degrees,)

    @property
    def phase_degrees(self) -> float:
        """The phase angle that is set, degrees: left out, 90 or the first of the phases that it can have."""
        if self.phase is not None:
            return self.phase
        return self.phases[0] if self.phases and USUAL_PHASE not in self.phases else USUAL_PHASE

    @property
    def phase_angle(self) -> float | None:
        """Phase angle γ, rad; None for a single pair."""
        if self.stages == 1:
            return None
        return self.phase_degrees * (math.pi / 180)
