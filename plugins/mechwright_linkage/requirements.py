"""What the synthesis of a linkage can be asked for."""

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from mechwright import FIRST, Parameters
from mechwright.units import Degrees, Millimetres, Unit

TurningName = Literal[
    "watt-1", "watt-2", "stephenson-1", "stephenson-3", "whitworth", "crank-shaper", "toggle-press",
    "hoecken", "klann",
]  # fmt: skip
"""Linkages of the catalogue whose driver turns and whose dimensions are free."""

MOST_STARTS = 200_000

Input = Annotated[float, Field(ge=-720, le=720), Unit("deg")]
Output = Annotated[float, Field(ge=-1000, le=1000), Unit("")]
Coordinate = Annotated[float, Field(ge=-5000, le=5000), Unit("mm")]


class LinkageSearch(Parameters):
    """The part of a table ``[requirement]`` that all kinds share."""

    linkages: tuple[TurningName, ...] = Field(
        ("stephenson-3", "watt-2"),
        min_length=1,
        max_length=9,
        description="Linkages of the catalogue that are tried.",
        json_schema_extra=FIRST,
    )
    least_transmission_angle: Degrees = Field(
        25.0,
        ge=1,
        le=80,
        description="Least transmission angle over the whole turn.",
        json_schema_extra=FIRST,
    )
    shortest_link: Millimetres = Field(15.0, ge=0.5, le=1000, description="Shortest distance of two joints.")
    longest_link: Millimetres = Field(300.0, ge=1, le=5000, description="Longest distance of two joints.")
    starts: int = Field(
        20_000, ge=100, le=MOST_STARTS, description="Most random linkages to try of each kind."
    )
    designs: int = Field(5, ge=1, le=50, description="Most designs to give.")
    seed: int = Field(0, ge=0, le=1_000_000, description="Seed of the random linkages.")

    @model_validator(mode="after")
    def _lengths(self) -> Self:
        if self.shortest_link >= self.longest_link:
            raise ValueError("shortest_link is not below longest_link; give it less")
        return self


class FunctionRequirement(LinkageSearch):
    """The table ``[requirement]`` of the kind ``function``: the output answers angles of the input.

    Examples
    --------
    >>> len(FunctionRequirement().input_angles)
    7
    """

    input_angles: tuple[Input, ...] = Field(
        (0.0, 30.0, 60.0, 90.0, 120.0, 150.0, 180.0),
        min_length=3,
        max_length=200,
        description="Angles of the input from the first, which is 0, in rising order.",
        json_schema_extra=FIRST,
    )
    outputs: tuple[Output, ...] = Field(
        (0.0, 2.0, 8.0, 17.0, 27.0, 35.0, 40.0),
        min_length=3,
        max_length=200,
        description="The output at each of them from its first place, degrees, or mm of one that slides.",
        json_schema_extra=FIRST,
    )
    tolerance: Annotated[float, Field(ge=0, le=100), Unit("")] = Field(
        0.5, description="Greatest error of the output that counts as met, degrees or mm."
    )

    @model_validator(mode="after")
    def _pairs(self) -> Self:
        if len(self.outputs) != len(self.input_angles):
            raise ValueError(
                f"outputs has {len(self.outputs)} entries for {len(self.input_angles)} input_angles"
            )
        if self.input_angles[0] != 0 or self.outputs[0] != 0:
            raise ValueError("input_angles and outputs begin with 0; count them from the first position")
        if any(b <= a for a, b in zip(self.input_angles[:-1], self.input_angles[1:], strict=True)):
            raise ValueError("input_angles do not rise all along; put them in order")
        if self.input_angles[-1] > 360:
            raise ValueError("input_angles go beyond a turn; the limit is 360")
        return self


class DwellRequirement(LinkageSearch):
    """The table ``[requirement]`` of the kind ``dwell``: the output stands still for a part of the turn.

    Examples
    --------
    >>> DwellRequirement().dwell
    60.0
    """

    dwell: Annotated[float, Field(ge=5, le=200), Unit("deg")] = Field(
        60.0, description="Angle of the input over which the output stands.", json_schema_extra=FIRST
    )
    stroke: Annotated[float, Field(gt=0, le=1000), Unit("")] = Field(
        40.0,
        description="How far the output goes, degrees, or mm of one that slides.",
        json_schema_extra=FIRST,
    )
    tolerance: Annotated[float, Field(gt=0, le=0.2), Unit("")] = Field(
        0.01, description="Greatest movement in the dwell, as a share of the stroke.", json_schema_extra=FIRST
    )


class PathRequirement(LinkageSearch):
    """The table ``[requirement]`` of the kind ``path``: a point of the linkage goes through points.

    Examples
    --------
    >>> len(PathRequirement().points)
    8
    """

    linkages: tuple[TurningName, ...] = Field(
        ("klann", "stephenson-3", "watt-1"),
        min_length=1,
        max_length=9,
        description="Linkages of the catalogue that are tried.",
        json_schema_extra=FIRST,
    )
    points: tuple[tuple[Coordinate, Coordinate], ...] = Field(
        (
            (0.0, 0.0), (25.0, 0.0), (50.0, 0.0), (75.0, 0.0), (100.0, 0.0), (88.0, 24.0), (50.0, 38.0),
            (12.0, 24.0),
        ),
        min_length=4,
        max_length=60,
        description="Points [x, y] in the order in which they are passed.",
        json_schema_extra=FIRST,
    )  # fmt: skip
    input_angles: tuple[Input, ...] | None = Field(
        None,
        max_length=60,
        description="Angle of the input at each point from the first. Default: any, within a turn.",
    )
    tolerance: Millimetres = Field(
        0.5, ge=0, le=100, description="Distance in the mean (root mean square) that counts as met."
    )

    @model_validator(mode="after")
    def _angles(self) -> Self:
        angles = self.input_angles
        if angles is not None and len(angles) != len(self.points):
            raise ValueError(f"input_angles has {len(angles)} entries for {len(self.points)} points")
        if angles is not None and angles[0] != 0:
            raise ValueError("input_angles begins with 0; count them from the first point")
        return self
