"""What a chain can be asked for: the table ``[requirement]`` of a file with tables ``[[stage]]``."""

from typing import Annotated, Self

from pydantic import Field, model_validator

from mechwright.contracts.parameters import Parameters

MOST_FREE = 8
"""Keys that are sought at once: a search of some hundred chains sees no more."""


class FreeKey(Parameters):
    """A number of a stage that may change."""

    key: Annotated[str, Field(min_length=1, max_length=200)] = Field(
        description=(
            'Where it stands: "stage.1.parameters.ramp", "stage.2.start"; of a list its place as well, '
            '"stage.1.parameters.sines.2".'
        )
    )
    low: float = Field(ge=-1e6, le=1e6, description="Least value, in the unit of the key.")
    high: float = Field(ge=-1e6, le=1e6, description="Greatest value.")

    @model_validator(mode="after")
    def _rising(self) -> Self:
        if self.low >= self.high:
            raise ValueError(f"{self.key}: high is to be above low")
        return self


class FigureLimit(Parameters):
    """A bound of a figure of the chain's motion."""

    figure: Annotated[str, Field(min_length=1, max_length=200)] = Field(
        description='As solve tells it, with the number of its stage: "1.pressure_angle_max", "2.index_time".'
    )
    least: Annotated[float, Field(ge=-1e12, le=1e12)] | None = Field(
        None, description="Least value; angles in degrees."
    )
    most: Annotated[float, Field(ge=-1e12, le=1e12)] | None = Field(
        None, description="Greatest value; angles in degrees."
    )

    @model_validator(mode="after")
    def _bounds(self) -> Self:
        if self.least is None and self.most is None:
            raise ValueError(f"{self.figure}: give least or most, or both")
        return self


class ChainRequirement(Parameters):
    """The chain of the file's stages whose figure is the least, over some of their numbers within bounds."""

    least: Annotated[str, Field(min_length=1, max_length=200)] = Field(
        description='Figure of the motion that is made the least, such as "2.Ca"; with a minus before it, '
        "the greatest."
    )
    free: Annotated[tuple[FreeKey, ...], Field(min_length=1, max_length=MOST_FREE)] = Field(
        description="Numbers that may change, each with its bounds; all others stay as the stages have them."
    )
    limits: Annotated[tuple[FigureLimit, ...], Field(max_length=16)] = Field(
        (), description="Bounds of figures of the motion that a design has to keep."
    )
    tries: int = Field(120, ge=4, le=5000, description="Chains that are tried at most.")
    seed: int = Field(1, ge=0, le=2**31, description="Of the first tries.")
