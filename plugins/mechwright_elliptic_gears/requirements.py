"""What the synthesis can be asked for: bounds of the design, and what to make the most of."""

import math
from typing import Annotated, Self

from pydantic import Field, model_validator

from mechwright import Parameters
from mechwright.units import Degrees, Millimetres, Ratio, RevPerMin, Unit

RADIANS_PER_SECOND = 60 / math.tau
"""One rad/s in rev/min."""

BOUNDED = ("eccentricity", "phase", "semi_major", "speed", "point_along", "point_across")
"""Fields of a design between whose bounds the search moves, each ``_min`` and ``_max``."""


class TrainRequirement(Parameters):
    """Bounds of the search. Where both are equal the value stands; the defaults are the published trains'."""

    eccentricity_min: Ratio = Field(0.2, ge=0.01, le=0.9, description="Least eccentricity.")
    eccentricity_max: Ratio = Field(0.8, ge=0.01, le=0.9, description="Greatest eccentricity.")
    phase_min: Degrees = Field(0.0, ge=0, le=360, description="Least phase angle.")
    phase_max: Degrees = Field(
        180.0, ge=0, le=360, description="Greatest phase angle; past 180 time turns round."
    )
    semi_major_min: Millimetres = Field(50.0, ge=2, le=1000, description="Least half of the major axis.")
    semi_major_max: Millimetres = Field(50.0, ge=2, le=1000, description="Greatest half of the major axis.")
    length: Annotated[float, Field(ge=1, le=3600), Unit("mm")] | None = Field(
        None, description="Wanted length 4 a e of the figure of eight; it decides semi_major."
    )
    speed_min: RevPerMin = Field(
        10 * RADIANS_PER_SECOND, ge=0.001, le=20000, description="Least speed of gear 2."
    )
    speed_max: RevPerMin = Field(
        10 * RADIANS_PER_SECOND, ge=0.001, le=20000, description="Greatest speed of gear 2."
    )
    point_along_min: Ratio = Field(0.5, ge=0, le=1, description="Least place of Q from J (0) to K (1).")
    point_along_max: Ratio = Field(0.5, ge=0, le=1, description="Greatest place of Q from J (0) to K (1).")
    point_across_min: Millimetres = Field(
        0.0, ge=-1000, le=1000, description="Least distance of Q to the left of J-K."
    )
    point_across_max: Millimetres = Field(
        0.0, ge=-1000, le=1000, description="Greatest distance of Q to the left of J-K."
    )
    band: Annotated[float, Field(gt=0, le=1e6), Unit("mm/s")] = Field(
        10.0, description="Spread of Q's speed that counts as constant."
    )
    bore: Millimetres = Field(12.0, ge=1, le=300, description="Diameter of the shafts.")
    thickness: Millimetres = Field(10.0, ge=0.1, le=200, description="Face width of the gears.")
    cutter: Millimetres = Field(
        2.0, ge=0.1, le=50, description="Smallest end mill at hand; it has to cut every fillet exactly."
    )
    designs: int = Field(3, ge=1, le=20, description="How many designs to give at most.")
    starts: int = Field(2, ge=1, le=50, description="Independent searches for each design.")
    seed: int = Field(1, ge=0, le=2**31, description="Of the random starts: the same one, the same designs.")

    @model_validator(mode="after")
    def _bounds_hold_something(self) -> Self:
        for name in BOUNDED:
            low, high = self.bounds(name)
            if low > high:
                raise ValueError(f"{name}_min = {low:g} is above {name}_max = {high:g}; exchange them")
        return self

    def bounds(self, name: str) -> tuple[float, float]:
        """Least and greatest value of a field of the design."""
        return getattr(self, f"{name}_min"), getattr(self, f"{name}_max")


class LongestWindow(TrainRequirement):
    """The longest part of a turn on which Q moves at a near-constant speed."""


class LeastAcceleration(TrainRequirement):
    """The least peak of Q's acceleration, with a wanted window."""

    window: Annotated[float, Field(ge=0, le=360), Unit("deg")] = Field(
        115.0, description="Wanted length of the part of near-constant speed, an angle of gear 2."
    )


class LeastJerk(TrainRequirement):
    """The least peak of Q's jerk, with a wanted window."""

    window: Annotated[float, Field(ge=0, le=360), Unit("deg")] = Field(
        143.0, description="Wanted length of the part of near-constant speed, an angle of gear 2."
    )


REQUIREMENTS: dict[str, type[TrainRequirement]] = {
    "longest-window": LongestWindow,
    "least-acceleration": LeastAcceleration,
    "least-jerk": LeastJerk,
}
"""Kind of synthesis to its table."""
