"""What a user asks of a Geneva mechanism that is still to be found."""

import math
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from mechwright import FIRST, MaterialName, Parameters
from mechwright.units import Millimetres, RevPerMin, Seconds, Unit

SmoothLaw = Literal["cycloidal", "modified-sine", "modified-trapezoid", "3-4-5", "4-5-6-7"]

LENGTH = 300.0
"""Overall length, mm, where nothing is said of the size."""


class IndexingRequirement(Parameters):
    """A wheel with a number of stops that has to move within a time, in a given space, under a given load.

    Examples
    --------
    >>> IndexingRequirement(slots=6, index_time="300 ms").index_time
    0.3
    """

    slots: int = Field(4, ge=3, le=12, description="Number of stops n.", json_schema_extra=FIRST)
    speed: RevPerMin = Field(
        60.0, ge=0.001, le=20000, description="Speed of the driver, one roller.", json_schema_extra=FIRST
    )
    index_time: Seconds = Field(
        0.3,
        gt=0,
        le=1e5,
        description="Longest time that a movement may take; the rest of the turn is dwell.",
        json_schema_extra=FIRST,
    )
    wheel_diameter: Annotated[float, Field(ge=10, le=2000), Unit("mm")] | None = Field(
        None,
        description="Diameter of the wheel. Default: as large as the rest allows.",
        json_schema_extra=FIRST,
    )
    centre_distance: Annotated[float, Field(ge=5, le=3000), Unit("mm")] | None = Field(
        None,
        description="Distance of the axes, instead of wheel_diameter. Default: any.",
        json_schema_extra=FIRST,
    )
    overall_length: Annotated[float, Field(ge=20, le=5000), Unit("mm")] | None = Field(
        None,
        description=(
            "Longest side of the mechanism: wheel and crank along their axes. Default: 300, or any if wheel "
            "or centre distance is given."
        ),
        json_schema_extra=FIRST,
    )
    load_inertia: Annotated[float, Field(ge=0, le=1e4), Unit("kg*m^2")] = Field(
        0.01, description="Moment of inertia that turns with the wheel.", json_schema_extra=FIRST
    )
    load_torque: Annotated[float, Field(ge=0, le=1e6), Unit("N*m")] = Field(
        0.0, description="Constant torque against the wheel's turning.", json_schema_extra=FIRST
    )
    pressure_limit: Annotated[float, Field(gt=0, le=1e5), Unit("MPa")] | None = Field(
        None, description="Greatest Hertz pressure. Default: the one at which the softer material yields."
    )
    acceleration_limit: Annotated[float, Field(gt=0, le=1e9), Unit("rad/s^2")] | None = Field(
        None, description="Greatest acceleration of the wheel. Default: any."
    )
    laws: tuple[SmoothLaw, ...] = Field(
        ("cycloidal", "modified-sine", "modified-trapezoid", "3-4-5", "4-5-6-7"),
        min_length=1,
        description="Laws that come into question.",
        json_schema_extra=FIRST,
    )
    least_wall: Millimetres = Field(2.0, ge=0.2, le=50, description="Thinnest wall that may stay anywhere.")
    thickness: Millimetres = Field(
        12.0, ge=1, le=200, description="Thickness of the wheel, floor included.", json_schema_extra=FIRST
    )
    floor: Millimetres = Field(3.0, ge=0.2, le=100, description="Thickness of the floor under the grooves.")
    bore: Millimetres = Field(
        12.0, ge=0, le=300, description="Shaft bore of the wheel; 0 for none.", json_schema_extra=FIRST
    )
    driver_bore: Millimetres = Field(12.0, ge=0, le=300, description="Shaft bore of the driver; 0 for none.")
    material: MaterialName = Field("steel", description="Material of the plates.")
    roller_material: MaterialName = Field("steel", description="Material of rollers and pins.")
    designs: int = Field(5, ge=1, le=50, description="Number of designs wanted.")

    @property
    def longest(self) -> float:
        """The overall length that is allowed, mm; inf if any."""
        if self.overall_length is not None:
            return self.overall_length
        return math.inf if self.wheel_diameter or self.centre_distance else LENGTH

    @model_validator(mode="after")
    def _one_size(self) -> Self:
        if self.wheel_diameter is not None and self.centre_distance is not None:
            raise ValueError("wheel_diameter and centre_distance are both given; leave one of them out")
        return self
