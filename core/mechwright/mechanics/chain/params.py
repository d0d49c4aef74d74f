"""The tables ``[[stage]]`` of a chain."""

from typing import Annotated

from pydantic import Field, InstanceOf, SerializeAsAny

from mechwright.contracts.parameters import Parameters
from mechwright.units import Degrees, Unit

MOST_STAGES = 8
"""More shafts in a row lose all that they carry to play."""


class StageTable(Parameters):
    """One stage: a mechanism, how it is set to the one before, and where it stands."""

    family: str = Field(description="The family of the mechanism.")
    start: Degrees = Field(
        0.0,
        ge=-3600,
        le=3600,
        description="Angle of this stage's input, as its own channels count it, when the chain begins.",
    )
    turned: Degrees = Field(
        0.0, ge=-360, le=360, description="By how much the stage is turned about its input's shaft."
    )
    gap: Annotated[float, Field(ge=0.1, le=500), Unit("mm")] | None = Field(
        None, description="Air between the planes of the stage before and of this one; left out, 1."
    )
    parameters: SerializeAsAny[InstanceOf[Parameters]] = Field(description="Of its family.")


class ChainParams(Parameters):
    """A chain of mechanisms; the first one begins and turns as it does alone."""

    stage: Annotated[tuple[StageTable, ...], Field(min_length=2, max_length=MOST_STAGES)] = Field(
        description="The stages from the input to the output."
    )
