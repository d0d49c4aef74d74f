"""The design table of a pair of elliptic gears."""

from typing import Annotated, Any, Self

from pydantic import AfterValidator, Field, model_validator

from mechwright.materials import MATERIALS, material
from mechwright.parameters import Parameters
from mechwright.units import Degrees, Millimetres, Ratio, RevPerMin, Unit

MaterialName = Annotated[
    str,
    AfterValidator(lambda name: material(name).name),
    Field(json_schema_extra={"enum": sorted(MATERIALS)}),
]


LEAST_MODULE = 0.1
"""mm. Finer teeth are below what the smallest end mills can cut, and near the outline's own tolerance."""

MOST_TEETH = 300
"""More teeth say nothing new and take minutes to prove and to cut."""


class EllipticGearParams(Parameters):
    """Two congruent elliptic gears, each turning about one focus of its pitch ellipse.

    Lengths of the tooth profile are in modules. ``check`` says what cannot be built.

    Examples
    --------
    >>> EllipticGearParams(eccentricity=0.4, teeth=39, module=2.0).semi_major is None
    True
    """

    eccentricity: Ratio = Field(
        0.4,
        ge=0,
        le=0.9,  # at 0.9 the ratio swings from 1:19 to 19:1
        description="Eccentricity of the pitch ellipse; the speed ratio swings up to (1 + e) / (1 - e).",
    )
    teeth: int = Field(25, ge=6, le=MOST_TEETH, description="Number of teeth of each gear.")
    module: Annotated[float, Field(ge=LEAST_MODULE, le=25), Unit("mm")] | None = Field(
        None, description="Pitch on the ellipse over π; give this or semi_major."
    )
    semi_major: Annotated[float, Field(ge=2, le=1000), Unit("mm")] | None = Field(
        50.0, description="Half the major axis, half the centre distance; give this or module."
    )
    tooth_offset: Annotated[float, Field(ge=0, lt=1), Unit("")] | None = Field(
        None,
        description=(
            "Arc from the far vertex to the middle of a tooth, in pitches: 0 or 0.5 for an odd number of "
            "teeth, 0.25 or 0.75 for an even one; left out, the smaller."
        ),
    )
    pressure_angle: Degrees = Field(20.0, ge=10, le=30, description="Pressure angle of the generating rack.")
    addendum: Ratio = Field(1.0, ge=0.3, le=1.5, description="Tooth height over the pitch curve, in modules.")
    dedendum: Ratio = Field(1.25, ge=0.4, le=2, description="Depth below the pitch curve, in modules.")
    tip_radius: Ratio = Field(
        0.38, ge=0, le=0.6, description="Radius at the tip of the generating rack, in modules."
    )
    backlash: Millimetres = Field(
        0.0,
        ge=0,
        le=2,
        description="Circumferential play of the pair on the pitch curve; each flank gives a quarter of it.",
    )
    thickness: Millimetres = Field(10.0, ge=0.1, le=200, description="Face width.")
    material: MaterialName = Field("aluminium", description="Workpiece material.")
    bore: Millimetres = Field(10.0, ge=0, le=300, description="Diameter of the shaft bore; 0 for none.")
    keyway_width: Millimetres = Field(
        0.0, ge=0, le=60, description="Width of the hub keyway, towards the far vertex; 0 for none."
    )
    keyway_depth: Annotated[float, Field(ge=0.1, le=30), Unit("mm")] | None = Field(
        None,
        description="Hub depth t2 over the bore (DIN 6885); left out, the standard one of this width.",
    )
    keyway_relief: Millimetres = Field(
        0.0,
        ge=0,
        le=20,
        description="Diameter of the reliefs in the keyway's corners, for a round cutter; 0 for none.",
    )
    speed: RevPerMin = Field(60.0, ge=0.001, le=20000, description="Constant speed of gear 2.")

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
        if self.keyway_width > 0 and self.bore == 0:
            raise ValueError("keyway_width needs a bore; set bore, or keyway_width = 0")
        if self.keyway_width == 0 and (self.keyway_depth is not None or self.keyway_relief > 0):
            raise ValueError("keyway_depth and keyway_relief need a keyway; set keyway_width")
        return self
