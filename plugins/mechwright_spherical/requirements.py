"""The tables ``[requirement]``: what a linkage shall do."""

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from mechwright import Parameters
from mechwright.units import Degrees, Millimetres, Ratio, RevPerMin, Unit
from mechwright_spherical import printed
from mechwright_spherical.params import MOST_POSITIONS, Direction, Pin, Point, Turn, same_length

Guess = tuple[
    Annotated[float, Field(ge=-100, le=100), Unit("")],
    Annotated[float, Field(ge=-100, le=100), Unit("")],
    Annotated[float, Field(ge=-100, le=100), Unit("")],
    Annotated[float, Field(ge=-100, le=100), Unit("")],
    Annotated[float, Field(ge=-100, le=100), Unit("")],
]
"""Starting values of a dyad's five unknowns, in the plane's unit."""

FEWEST_POINTS = 3
"""Points of a path: through two there is no shape to follow."""

# The published poses with more digits than printed: points of four decimals move the solution by 0.004.
_PATH = ((0.1816, 1.8993), (0.275703803, 1.864862941), (0.357404873, 1.794555644), (0.420821618, 1.689103786))
_TURNS = (0.0, 4.822766357, 9.876178938, 15.266704249)
_PATH_N = ((0.1816, 1.8993), (0.356471847, 1.907318759), (0.523629022, 1.887228156))
_TURNS_N = (0.0, -0.048091902, 0.314200663)

# A lopsided oval of some 30 by 20 degrees, no four-bar's own.
_OVAL = (
    (0.26, 0.0, 0.9656),
    (0.235, 0.115, 0.9652),
    (0.13, 0.195, 0.9721),
    (-0.01, 0.205, 0.9787),
    (-0.135, 0.155, 0.9787),
    (-0.205, 0.05, 0.9775),
    (-0.2, -0.07, 0.9773),
    (-0.115, -0.15, 0.982),
    (0.025, -0.175, 0.9843),
    (0.175, -0.13, 0.9759),
)


class AdjustablePathRequirement(Parameters):
    """An adjustable five-bar, from poses of its coupler in the plane."""

    path: tuple[Pin, ...] = Field(
        _PATH,
        min_length=2,
        max_length=MOST_POSITIONS,
        description="Path points of phase 1, that of the adjustment first: x, y, or a direction x, y, z.",
    )
    turns: tuple[Turn, ...] = Field(
        _TURNS, max_length=MOST_POSITIONS, description="Coupler angles at these points; the first is 0."
    )
    path_n: tuple[Pin, ...] = Field(
        _PATH_N,
        min_length=2,
        max_length=MOST_POSITIONS,
        description="Path points of phase 2, the same one first.",
    )
    turns_n: tuple[Turn, ...] = Field(
        _TURNS_N, max_length=MOST_POSITIONS, description="Coupler angles at these points; the first is 0."
    )
    crank_axis_x: Ratio = Field(0.0, ge=-100, le=100, description="x of the crank's axis a0.")
    crank_length: Ratio = Field(1.0, gt=0, le=100, description="Length R1 of the crank.")
    arm_axis: Point = Field(printed.PINS["b0"], description="Axis b0 of the arm.")
    arm_length: Ratio = Field(1.0, gt=0, le=100, description="Length R4 of the arm.")
    arm_angle: Degrees = Field(
        45.0, ge=-360, le=360, description="Angle of the arm in the position of adjustment."
    )
    ratio: Ratio = Field(printed.RATIO, ge=-10, le=10, description="Turns of the arm per turn of the crank.")
    crank_guess: Guess = Field(printed.CRANK_GUESS, description="First guess of a0y, a1, a1n.")
    rocker_guess: Guess = Field(printed.DRIVEN_GUESS, description="First guess of c1, c1n, R3.")
    equations: Literal["seven", "five"] = Field(
        "seven",
        description="seven counts the positions of adjustment, five leaves them out as the source does.",
    )
    projection_length: Ratio = Field(
        printed.LENGTH,
        gt=0,
        le=1000,
        description="Distance of the plane from the centre, in the plane's unit.",
    )
    projection_tolerance: Annotated[float, Field(gt=0, le=10), Unit("")] | None = Field(
        None, description="Take the smallest projection_length whose error stays below this; plane's unit."
    )
    projection_centre: Literal["origin", "best"] = Field(
        "origin", description="Where the z axis meets the plane: in its origin, or where the error is least."
    )
    unknowns: Literal["none", "six", "eight", "twelve"] = Field(
        "twelve", description="Unknowns of the fit on the sphere; fits with fewer of them are given as well."
    )
    starts: int = Field(4, ge=1, le=200, description="Starts of each fit; all but the first are random.")
    seed: int = Field(1, ge=0, le=2**31, description="Of the random starts.")
    least_transmission: Degrees = Field(40.0, ge=0, le=80, description="Bound of the transmission angle.")
    radius: Millimetres = Field(100.0, ge=5, le=2000, description="Radius of the sphere.")
    speed: RevPerMin = Field(10.0, ge=0.001, le=3000, description="Speed of the crank.")

    @model_validator(mode="after")
    def _together(self) -> Self:
        same_length("path", self.path, "turns", self.turns)
        same_length("path_n", self.path_n, "turns_n", self.turns_n)
        if self.path[0] != self.path_n[0]:
            raise ValueError(
                "path and path_n begin at different points; both begin where the machine is adjusted"
            )
        if self.ratio == 0:
            raise ValueError(
                "ratio is 0, so the arm stands still; give the turns of the arm per turn of the crank"
            )
        return self


class FourBarPathRequirement(Parameters):
    """A spherical four-bar whose coupler point follows points of the sphere."""

    points: tuple[Direction, ...] = Field(
        _OVAL,
        min_length=FEWEST_POINTS,
        max_length=MOST_POSITIONS,
        description="The path as directions x, y, z, in the order of the motion.",
    )
    closed: bool = Field(
        True, description="Whether the path closes, so that the input turns all the way round."
    )
    angles: tuple[Turn, ...] = Field(
        (),
        max_length=MOST_POSITIONS,
        description="Input angles of the points from the first one; none if the input may choose.",
    )
    atlas: int = Field(
        1500, ge=50, le=20000, description="Random linkages that are compared with the path first."
    )
    starts: int = Field(8, ge=1, le=100, description="How many of them are fitted.")
    designs: int = Field(3, ge=1, le=20, description="Designs that are given at most.")
    seed: int = Field(1, ge=0, le=2**31, description="Of the random linkages.")
    least_transmission: Degrees = Field(30.0, ge=0, le=80, description="Bound of the transmission angle.")
    radius: Millimetres = Field(100.0, ge=5, le=2000, description="Radius of the sphere.")
    speed: RevPerMin = Field(10.0, ge=0.001, le=3000, description="Speed of the input.")

    @model_validator(mode="after")
    def _together(self) -> Self:
        if self.angles:
            same_length("points", self.points, "angles", self.angles)
        return self
