"""The design table of a pair of gears by a law."""

import math
from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import Field, field_validator, model_validator

from mechwright import FIRST, FITTED, MaterialName, Parameters
from mechwright.contracts.gear_fields import Backlash, FaceWidth, LoadTorque, ShaftBore
from mechwright.contracts.keyed import KeywayDepth, KeywayRelief, KeywayWidth, keyed_together
from mechwright.mechanics.formula import LONGEST
from mechwright.units import Degrees, Ratio, RevPerMin, Unit
from mechwright_noncircular_gears.consistency import pair_together
from mechwright_noncircular_gears.fields import (
    ALSO,
    LEAST_MODULE,
    LEAST_TEETH,
    MOST_HARMONICS,
    MOST_LOBES,
    MOST_SECTOR,
    MOST_SWING,
    MOST_TEETH,
    USUAL,
    USUAL_OF,
    USUAL_SINE,
)

Amplitude = Annotated[float, Field(ge=-90, le=90), Unit("deg")]
FormulaText = Annotated[str, Field(min_length=1, max_length=LONGEST)]
Turned = Annotated[float, Field(ge=0, le=3600), Unit("deg")]


class NoncircularParams(Parameters):
    """A driver and the gear that it drives by a law; lengths of the tooth profile are in modules.

    Fields that are left out have the value that their description says. ``check`` says what cannot be built.

    Examples
    --------
    >>> NoncircularParams(law="ellipse", mate_lobes=2, eccentricity=0.3, teeth=30).mate_teeth
    60
    """

    also: ClassVar[Mapping[str, str]] = ALSO

    law: Literal[
        "fourier",
        "window",
        "table",
        "ratio",
        "angle",
        "spiral",
        "slider",
        "geneva",
        "ellipse",
        "limacon",
        "eccentric-circle",
    ] = Field(
        "fourier",
        description=(
            "Where the law comes from. fourier: harmonics; window: a window of constant ratio; table: pairs "
            "of angles; ratio, angle: a formula of either; slider: constant speed of a slider-crank behind "
            "it; geneva: least acceleration of a straight Geneva wheel behind it; spiral: a logarithmic "
            "spiral, of sectors; ellipse, limacon, "
            "eccentric-circle: the pitch curve of the driver."
        ),
        json_schema_extra=FIRST,
    )
    lobes: int = Field(1, ge=1, le=MOST_LOBES, description="Lobes N1 of the driver.", json_schema_extra=FIRST)
    mate_lobes: int = Field(
        1,
        ge=1,
        le=MOST_LOBES,
        description="Lobes N2 of the driven gear, which turns N1/N2 as fast in the mean.",
        json_schema_extra=FIRST,
    )
    sines: Annotated[tuple[Amplitude, ...], Field(max_length=MOST_HARMONICS)] | None = Field(
        None,
        description=(
            'Amplitudes of sin(N1 φ), sin(2 N1 φ), ... for law = "fourier". Default: 15, with more than two '
            "mate_lobes 30 over their number, or none beside cosines."
        ),
        json_schema_extra=FIRST,
    )
    cosines: Annotated[tuple[Amplitude, ...], Field(max_length=MOST_HARMONICS)] | None = Field(
        None, description='Amplitudes of 1 - cos(N1 φ), 1 - cos(2 N1 φ), ... for law = "fourier".'
    )
    window_ratio: Annotated[float, Field(gt=0, le=20), Unit("")] | None = Field(
        None, description='Constant ratio, output over input, for law = "window". Default: 0.85.'
    )
    window: Annotated[float, Field(gt=0, lt=360), Unit("deg")] | None = Field(
        None,
        description=(
            "Angle of the driver over which ratio or slider speed is constant, or a Geneva wheel goes on by "
            "a slot. Default: 100, of a slider 150, of a Geneva wheel 180."
        ),
    )
    blend: Annotated[float, Field(gt=0, lt=180), Unit("deg")] | None = Field(
        None,
        description="Angle of the driver on each side of the window for the change. Default: 90, geneva 60.",
    )
    nodes: Annotated[tuple[tuple[Turned, Turned], ...], Field(min_length=2, max_length=720)] | None = Field(
        None,
        description=(
            'Pairs [φ, ψ] of both gears over one lobe for law = "table", from [0, 0]; the end of the lobe '
            "follows from the lobes."
        ),
    )
    ratio: FormulaText | None = Field(
        None,
        description=(
            'Formula of phi (rad) for law = "ratio", such as "exp(0.3*cos(phi))"; its shape counts: it is '
            "multiplied by what closes the turn."
        ),
    )
    angle: FormulaText | None = Field(
        None,
        description=(
            'Formula of phi (rad) for law = "angle", the angle of the driven gear in rad, such as '
            '"phi + 0.3*sin(phi)".'
        ),
    )
    rod_ratio: Annotated[float, Field(gt=1, le=100), Unit("")] | None = Field(
        None, description='Rod over crank for law = "slider". Default: 4.'
    )
    stroke_start: Annotated[float, Field(gt=0, lt=180), Unit("deg")] | None = Field(
        None,
        description="Crank from its outer dead centre where constant speed begins. Default: 50.",
    )
    stroke_end: Annotated[float, Field(gt=0, lt=180), Unit("deg")] | None = Field(
        None, description="Crank where it ends. Default: 130."
    )
    slots: Annotated[int, Field(ge=3, le=24)] | None = Field(
        None, description='Slots of the straight wheel behind the pair for law = "geneva". Default: 4.'
    )
    ramp: Annotated[float, Field(ge=0.02, le=0.45), Unit("")] | None = Field(
        None,
        description=(
            "Half the share of the index over which the wheel's acceleration changes its sign; the smaller, "
            "the less acceleration and the sharper the pitch curves. Default: 0.145."
        ),
    )
    first_ratio: Annotated[float, Field(ge=0.05, le=20), Unit("")] | None = Field(
        None, description='Ratio at φ = 0 for law = "spiral". Default: 0.7.'
    )
    last_ratio: Annotated[float, Field(ge=0.05, le=20), Unit("")] | None = Field(
        None, description='Ratio at the end of the travel for law = "spiral". Default: 1.4.'
    )
    eccentricity: Annotated[float, Field(ge=0, le=0.9), Unit("")] | None = Field(
        None,
        description=(
            "Shape of the driver's pitch curve: of an ellipse its eccentricity, of a limacon the change of "
            "its radius, of a circle the place of its axis, in mean radii. Default: 0.2."
        ),
    )
    sector: Annotated[float, Field(ge=5, le=MOST_SECTOR), Unit("deg")] | None = Field(
        None,
        description=(
            "Travel of the driver where both gears are sectors, from φ = 0 there and back. Default: they go "
            'all the way round. For law = "ratio", "angle", "table" and "spiral", which need not close then.'
        ),
        json_schema_extra=FIRST,
    )
    sector_hub: Annotated[float, Field(ge=2, le=1000), Unit("mm")] | None = Field(
        None,
        description="Diameter of both sectors' hubs. Default: what the shaft's opening needs.",
    )
    teeth: int = Field(
        40,
        ge=LEAST_TEETH,
        le=MOST_TEETH,
        description=(
            "Number of teeth of the driver; the driven gear has teeth × N2/N1. Of sectors, pitches of the "
            "travel; there are teeth for half a pitch more at each end. Default: 40, or the least greater "
            "number without undercut."
        ),
        json_schema_extra={**FIRST, **FITTED},
    )
    module: Annotated[float, Field(ge=LEAST_MODULE, le=25), Unit("mm")] | None = Field(
        2.0,
        description="Pitch on the pitch curves over π; give this or centre_distance.",
        json_schema_extra=FIRST,
    )
    centre_distance: Annotated[float, Field(ge=4, le=3000), Unit("mm")] | None = Field(
        None, description="Distance of the axes; give this or module."
    )
    internal: bool = Field(
        False,
        description=(
            "Whether the driven gear is a ring with teeth inside, in which the driver runs; it has more "
            "lobes than the driver and turns the same way round."
        ),
        json_schema_extra=FIRST,
    )
    ring_addendum: Annotated[float, Field(ge=0.3, le=1.5), Unit("")] | None = Field(
        None, description="Tooth height of the ring, in modules. Default: 0.6: hollow tips reach farther."
    )
    ring_outside: Annotated[float, Field(ge=10, le=3000), Unit("mm")] | None = Field(
        None,
        description="Diameter of the ring. Default: what its rim and holes need, in whole millimetres.",
    )
    ring_holes: Annotated[int, Field(ge=0, le=24)] | None = Field(
        None, description="Holes in the ring's rim, by which it is screwed on. Default: 6."
    )
    ring_hole: Annotated[float, Field(ge=1, le=100), Unit("mm")] | None = Field(
        None, description="Their diameter. Default: 5.5, for M5."
    )
    tooth_offset: Annotated[float, Field(ge=0, lt=1), Unit("")] = Field(
        0.0,
        description="From the pitch point at φ = 0 to the middle of a tooth of the driver, in pitches.",
    )
    pressure_angle: Degrees = Field(20.0, ge=10, le=30, description="Pressure angle of the teeth.")
    cutter: Literal["rack", "shaper"] | None = Field(
        None,
        description=(
            "Cutter that makes the fillets. rack: of pitch curves that are convex; shaper: a round cutter, "
            "of hollow ones too. Default: a rack where both curves are convex."
        ),
    )
    shaper_radius: Annotated[float, Field(ge=4, le=100), Unit("")] | None = Field(
        None, description="Pitch radius of the shaper's cutter, in modules. Default: 9."
    )
    addendum: Annotated[float, Field(ge=0.3, le=1.5), Unit("")] | None = Field(
        None,
        description="Tooth height over the pitch curve, in modules. Default: 1, with a shaper 0.8.",
    )
    dedendum: Ratio = Field(
        1.25,
        ge=0.4,
        le=2,
        description="Depth below the pitch curve, in modules. Default: 1.25, or 0.25 above a high addendum.",
        json_schema_extra=FITTED,
    )
    tip_radius: Annotated[float, Field(ge=0, le=0.6), Unit("")] | None = Field(
        None,
        description="Radius at the tip of the cutter, in modules. Default: 0.38, with a shaper 0.2, "
        "or what its tooth has room for.",
    )
    backlash: Backlash | None = Field(
        None,
        description=(
            "Circumferential play on the pitch curves, a quarter per flank. Default: the least with which "
            "gears as made turn."
        ),
    )
    thickness: FaceWidth = 10.0
    material: MaterialName = Field("aluminium", description="Workpiece material.", json_schema_extra=FIRST)
    bore: ShaftBore = Field(
        10.0,
        description="Diameter of both shaft bores, 0 for none. Default: 10, or the largest standard one "
        "below that leaves the rim of a small gear, or what a chain asks for.",
    )
    keyway_width: KeywayWidth = Field(
        0.0, description="Width of both hub keyways, along +x at φ = 0; 0 for none."
    )
    keyway_depth: KeywayDepth = None
    keyway_relief: KeywayRelief = 0.0
    speed: RevPerMin = Field(
        60.0, ge=0.001, le=20000, description="Constant speed of the driver.", json_schema_extra=FIRST
    )
    load_torque: LoadTorque = Field(
        0.0,
        description="Constant torque against the turning of the driven gear.",
    )

    @field_validator("sector", mode="before")
    @classmethod
    def _no_several_turns(cls, value: Any) -> Any:
        if isinstance(value, (int, float)) and not isinstance(value, bool) and value > MOST_SECTOR:
            raise ValueError(
                "is no travel of plane gears: from a turn on, the body under one turn stands in the way of "
                f"the mate at the next; make it {MOST_SECTOR:g} at most, or leave it out to go right round"
            )
        return value

    @model_validator(mode="before")
    @classmethod
    def _distance_replaces_module(cls, table: Any) -> Any:
        if isinstance(table, dict) and table.get("centre_distance") is not None and "module" not in table:
            return {**table, "module": None}
        return table

    @model_validator(mode="after")
    def _together(self) -> Self:
        if (self.module is None) == (self.centre_distance is None):
            raise ValueError("give exactly one of module and centre_distance")
        keyed_together(self)
        pair_together(self)
        if self.shaper_radius is not None and self.cutter == "rack":
            raise ValueError('shaper_radius is for cutter = "shaper"; leave one of both out')
        if self.teeth * self.mate_lobes % self.lobes and "teeth" in self.model_fields_set:
            step = self.lobes // math.gcd(self.lobes, self.mate_lobes)
            more = -(-self.teeth // step) * step
            raise ValueError(
                f"teeth × mate_lobes / lobes is {self.teeth * self.mate_lobes / self.lobes:g}, no whole "
                f"number of teeth of the driven gear; make teeth {more}"
            )
        return self

    def value(self, name: str) -> Any:
        """A field of the law or the ring, or what it is where it is left out; in the units of the table."""
        given = getattr(self, name)
        if given is not None:
            return given
        if name == "sines":
            return () if self.cosines is not None else (min(USUAL_SINE, MOST_SWING / self.mate_lobes),)
        return USUAL_OF.get((self.law, name), USUAL[name])

    @property
    def mate_teeth(self) -> int:
        """Number of teeth of the driven gear."""
        return self.teeth * self.mate_lobes // self.lobes

    @property
    def side(self) -> int:
        """σ: 1 of two gears beside each other, -1 of a gear in a ring."""
        return -1 if self.internal else 1
