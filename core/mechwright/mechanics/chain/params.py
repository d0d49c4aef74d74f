"""The tables ``[[stage]]`` of a chain."""

from typing import Annotated, Any

from pydantic import Field, InstanceOf, SerializeAsAny

from mechwright.contracts.family import Family
from mechwright.contracts.parameters import FITTED, Parameters
from mechwright.units import Degrees, Unit

Families = tuple[Family[Any], ...]
"""Of the stages of a chain, in their order."""

MOST_STAGES = 8
"""More shafts in a row lose all that they carry to play."""


class StageTable(Parameters):
    """One stage: a mechanism, how it is set to the one before, and where it stands."""

    family: str = Field(description="The family of the mechanism.")
    start: Degrees = Field(
        0.0,
        ge=-3600,
        le=3600,
        description="Angle of this stage's input, as its own channels count it, when the chain begins. "
        "Default: 0, and for sectors the angle that puts their swing into their travel.",
        json_schema_extra=FITTED,
    )
    turned: Degrees = Field(
        0.0, ge=-360, le=360, description="By how much the stage is turned about its input's shaft."
    )
    gap: Annotated[float, Field(ge=0.1, le=500), Unit("mm")] | None = Field(
        None, description="Air between the planes of the stage before and of this one. Default: 1."
    )
    most_ca: Annotated[float, Field(gt=4, le=1000), Unit("")] | None = Field(
        None, description="Greatest Ca = α T²/Δ that its moves from rest to rest may have; no law has 4."
    )
    most_acceleration: Annotated[float, Field(gt=0, le=1e9), Unit("rad/s^2")] | None = Field(
        None, description="Greatest angular acceleration that its output may have."
    )
    most_jerk: Annotated[float, Field(gt=0, le=1e12), Unit("rad/s^3")] | None = Field(
        None, description="Greatest angular jerk that its output may have."
    )
    parameters: SerializeAsAny[InstanceOf[Parameters]] = Field(description="Of its family.")


class ChainParams(Parameters):
    """A chain of mechanisms; the first one begins and turns as it does alone."""

    stage: Annotated[tuple[StageTable, ...], Field(min_length=2, max_length=MOST_STAGES)] = Field(
        description="The stages from the input to the output."
    )
