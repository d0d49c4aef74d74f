"""What a slider-crank can be synthesised from: the tables ``[requirement]``."""

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from mechwright import Parameters
from mechwright.mechanics.planar.course import MOST_RATIO
from mechwright.mechanics.tracing.requirement import PlanePath
from mechwright.units import Degrees, Millimetres, Ratio, Unit
from mechwright_slider_crank.parameters import LONGEST

Length = Annotated[float, Field(ge=0.5, le=LONGEST), Unit("mm")]
Coordinate = Annotated[float, Field(ge=-LONGEST, le=LONGEST), Unit("mm")]
Turn = Annotated[float, Field(ge=-360, le=360), Unit("deg")]
AccelerationRatio = Annotated[float, Field(ge=-MOST_RATIO, le=MOST_RATIO), Unit("")]


class StrokeRequirement(Parameters):
    """A stroke and a time ratio, and at most one of the three lengths."""

    stroke: Millimetres = Field(120.0, ge=0.1, le=LONGEST, description="Stroke H of the slider.")
    time_ratio: Ratio = Field(
        1.5,
        ge=0.1,
        le=10,
        description="Time of the slow stroke over that of the quick one, K, from 1 (no offset) to below 3.",
    )
    quick: Literal["inward", "outward"] = Field(
        "inward",
        description="Which stroke is the quick one where the crank turns counter-clockwise: that towards it, "
        "or away from it.",
    )
    crank: Length | None = Field(None, description="Crank a; give at most one of crank, rod and offset.")
    rod: Length | None = Field(None, description="Rod c.")
    offset: Length | None = Field(None, description="Offset e, without its sign.")
    slide_direction: Degrees = Field(0.0, ge=-360, le=360, description="Direction of the slide.")

    @model_validator(mode="after")
    def _one_length(self) -> Self:
        given = [name for name in ("crank", "rod", "offset") if getattr(self, name) is not None]
        if len(given) > 1:
            raise ValueError(f"give at most one of crank, rod and offset, not {' and '.join(given)}")
        return self


class PathRequirement(PlanePath):
    """The table ``[requirement]`` of the kind ``path``: a coupler point through points, in this order.

    Examples
    --------
    >>> PathRequirement().shortest_link
    10.0
    """


class PolesRequirement(Parameters):
    """Acceleration poles that the coupler has to have, on the ground with the crank's pivot in the origin."""

    poles: tuple[tuple[Coordinate, Coordinate], ...] = Field(
        ((60.0, -12.6), (41.2, 41.6)),
        min_length=2,
        max_length=3,
        description="X and Y of two poles, or of three with free crank angles.",
    )
    rotations: tuple[Turn, ...] = Field(
        (47.0,),
        max_length=2,
        description="Crank angle from the first pole to the second; [] with three poles: free angles.",
    )
    acceleration_ratios: tuple[AccelerationRatio, ...] = Field(
        (0.0,),
        min_length=1,
        max_length=3,
        description="Acceleration of the crank over the square of its speed at each pole, per radian, "
        "counter-clockwise positive, or one for all.",
    )
    slide_direction: Degrees = Field(0.0, ge=-360, le=360, description="Direction of the slide.")
    starts: int = Field(6000, ge=10, le=100_000, description="Random starting points for each assembly.")
    seed: int = Field(1, ge=0, le=2**31, description="Seed of the random starting points.")

    @model_validator(mode="after")
    def _square_system(self) -> Self:
        if (len(self.poles), len(self.rotations)) not in {(2, 1), (3, 0)}:
            raise ValueError(
                f"rotations: {len(self.poles)} poles with {len(self.rotations)} rotations; give two poles "
                "and one rotation, or three poles and rotations = []"
            )
        if len(self.acceleration_ratios) not in {1, len(self.poles)}:
            raise ValueError(
                f"acceleration_ratios: {len(self.acceleration_ratios)} for {len(self.poles)} poles; give one "
                "for all, or one for each"
            )
        if len(set(self.poles)) < len(self.poles):
            raise ValueError("poles: two of them are the same; leave one out")
        return self
