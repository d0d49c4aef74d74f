"""Fields of design tables that all families of gears have."""

from typing import Annotated

from pydantic import Field

from mechwright.contracts.parameters import FIRST, FITTED
from mechwright.units import Millimetres, Unit

FaceWidth = Annotated[
    Millimetres,
    Field(
        ge=0.1,
        le=200,
        description="Face width. Default: 10, or with a module below 1.5 what fine mills reach.",
        json_schema_extra={**FIRST, **FITTED},
    ),
]
ShaftBore = Annotated[Millimetres, Field(ge=0, le=300, json_schema_extra={**FIRST, **FITTED})]
Backlash = Annotated[float, Field(ge=0, le=2), Unit("mm")]
LoadTorque = Annotated[float, Field(ge=0, le=1e5, json_schema_extra=FIRST), Unit("N*m")]
