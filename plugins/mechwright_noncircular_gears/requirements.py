"""What a person can ask of a law: tables of ``mechwright synthesize``."""

from typing import Annotated, Self

from pydantic import Field, model_validator

from mechwright import FIRST, MaterialName, Parameters
from mechwright.units import Degrees, Millimetres, Ratio, RevPerMin, Unit
from mechwright_noncircular_gears.fields import LEAST_MODULE, LEAST_TEETH, MOST_HARMONICS, MOST_TEETH


class FitRequirement(Parameters):
    """What every fit has: limits of the pitch curves, and the gears that are to follow the law."""

    pressure_limit: Annotated[float, Field(gt=10, le=50), Unit("deg")] = Field(
        50.0, description="Greatest pressure angle at the shafts that the law may ask for."
    )
    least_ratio: Ratio = Field(
        0.15, ge=0.02, le=0.9, description="Least ratio: the driver's pitch curve passes its shaft there."
    )
    hollow: bool = Field(
        True,
        description="Whether pitch curves may be hollow, for a shaper's teeth; false for convex ones alone.",
    )
    harmonics: int = Field(
        12, ge=1, le=MOST_HARMONICS, description="Harmonics of the law: more follow the wish more closely."
    )
    teeth: int = Field(60, ge=LEAST_TEETH, le=MOST_TEETH, description="Teeth of each gear.")
    module: Millimetres = Field(2.0, ge=LEAST_MODULE, le=25, description="Pitch over π.")
    pressure_angle: Degrees = Field(20.0, ge=10, le=30, description="Pressure angle of the teeth.")
    thickness: Millimetres = Field(10.0, ge=0.1, le=200, description="Face width.")
    bore: Millimetres = Field(10.0, ge=0, le=300, description="Diameter of both shaft bores; 0 for none.")
    material: MaterialName = Field("aluminium", description="Workpiece material.")
    speed: RevPerMin = Field(60.0, ge=0.001, le=20000, description="Constant speed of the driver.")

    @model_validator(mode="after")
    def _room(self) -> Self:
        if self.pressure_limit <= self.pressure_angle:
            raise ValueError(
                f"pressure_limit is to be above pressure_angle, that of the teeth, {self.pressure_angle:g}"
            )
        return self


class GenevaRequirement(FitRequirement):
    """The driver of a Geneva wheel with straight slots turns with the driven gear: least acceleration."""

    slots: int = Field(4, ge=3, le=12, description="Slots of the wheel.", json_schema_extra=FIRST)
    index_angle: Annotated[float, Field(ge=20, le=340), Unit("deg")] = Field(
        180.0, description="Turn of the input in which the wheel moves on.", json_schema_extra=FIRST
    )


class SliderRequirement(FitRequirement):
    """The crank of a slider-crank turns with the driven gear: its slider is to keep its speed."""

    rod_ratio: Annotated[float, Field(gt=1, le=100), Unit("")] = Field(
        4.0, description="Rod over crank.", json_schema_extra=FIRST
    )
    stroke_start: Annotated[float, Field(gt=0, lt=180), Unit("deg")] = Field(
        50.0,
        description="Crank from its outer dead centre where the speed is to begin.",
        json_schema_extra=FIRST,
    )
    stroke_end: Annotated[float, Field(gt=0, lt=180), Unit("deg")] = Field(
        130.0, description="Crank where it may end.", json_schema_extra=FIRST
    )
    window: Annotated[float, Field(ge=10, le=340), Unit("deg")] = Field(
        150.0, description="Turn of the input over that part of the stroke.", json_schema_extra=FIRST
    )

    @model_validator(mode="after")
    def _forth(self) -> Self:
        if self.stroke_start >= self.stroke_end:
            raise ValueError("stroke_end is to be above stroke_start")
        return self


class QuickReturnRequirement(FitRequirement):
    """The driven gear takes longer for one part of its turn than for the rest: flattest pitch curves."""

    time_ratio: Ratio = Field(
        1.5,
        ge=1.01,
        le=10,
        description="Time of the slow part over that of the rest, at constant speed of the driver.",
        json_schema_extra=FIRST,
    )
    forward_angle: Annotated[float, Field(ge=20, le=340), Unit("deg")] = Field(
        180.0, description="Turn of the driven gear in the slow part.", json_schema_extra=FIRST
    )


class ApproachRequirement(FitRequirement):
    """The driven gear all but rests over a part of the driver's turn: least ratio that the limits allow."""

    window: Annotated[float, Field(ge=10, le=300), Unit("deg")] = Field(
        60.0, description="Turn of the driver over which it is to be slow.", json_schema_extra=FIRST
    )


REQUIREMENTS: dict[str, type[FitRequirement]] = {
    "geneva": GenevaRequirement,
    "slider": SliderRequirement,
    "quick-return": QuickReturnRequirement,
    "approach": ApproachRequirement,
}
"""Kind of requirement to its table."""
