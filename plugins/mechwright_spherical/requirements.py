"""The tables ``[requirement]``: what a linkage shall do."""

from typing import Annotated, Literal, Self

import numpy as np
from pydantic import Field, model_validator

from mechwright import Array, GeometryError, Parameters
from mechwright.mechanics.tracing.requirement import MOST_POINTS, check_one_way
from mechwright.units import Degrees, Millimetres, Ratio, RevPerMin, Unit
from mechwright_spherical.defaults import published_example
from mechwright_spherical.kinematics.vectors import rotation_about, vector
from mechwright_spherical.parameters import MOST_POSITIONS, Direction, Pin, Point, Turn, same_length

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
    """An adjustable linkage, from poses of its coupler in the plane or from a path per phase."""

    phases: tuple[Annotated[tuple[Pin, ...], Field(min_length=3, max_length=MOST_POSITIONS)], ...] = Field(
        (),
        max_length=8,
        description="Points of each phase in order, beginning with that in which the machine is set, "
        "the same in all: x, y, or directions x, y, z. In place of path, turns, path_n and turns_n.",
    )
    linkage: Literal["five-bar", "four-bar"] = Field("five-bar", description="With phases: what is sought.")
    moves: Literal["moving", "fixed", "both"] = Field(
        "moving", description="With phases: pins that are set, on the coupler, in the ground, or both."
    )
    search: Literal["auto", "plane", "sphere"] = Field(
        "auto",
        description="With phases: where the search takes place; auto where the points are given.",
    )
    full_turn: bool = Field(
        False, description="With phases: whether the crank of a four-bar turns fully in each."
    )
    least_arc: Degrees = Field(
        12.0, ge=1, le=80, description="With phases: shortest arc of a link, the ground included."
    )
    greatest_arc: Degrees = Field(90.0, ge=10, le=170, description="With phases: greatest arc of a link.")
    tried: int = Field(
        2000, ge=100, le=100_000, description="With phases: random linkages of the first phase."
    )
    designs: int = Field(2, ge=1, le=20, description="With phases: most machines to give.")

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
    arm_axis: Point = Field(published_example.PINS["b0"], description="Axis b0 of the arm.")
    arm_length: Ratio = Field(1.0, gt=0, le=100, description="Length R4 of the arm.")
    arm_angle: Degrees = Field(
        45.0, ge=-360, le=360, description="Angle of the arm in the position of adjustment."
    )
    ratio: Ratio = Field(
        published_example.RATIO, ge=-10, le=10, description="Turns of the arm per turn of the crank."
    )
    crank_guess: Guess = Field(published_example.CRANK_GUESS, description="First guess of a0y, a1, a1n.")
    rocker_guess: Guess = Field(published_example.DRIVEN_GUESS, description="First guess of c1, c1n, R3.")
    equations: Literal["seven", "five"] = Field(
        "seven",
        description="seven counts the positions of adjustment, five leaves them out as the source does.",
    )
    projection_length: Ratio = Field(
        published_example.LENGTH,
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
        if self.phases:
            self._phased()
        elif changed := [name for name in _PHASED if getattr(self, name) != _default(self, name)]:
            raise ValueError(f"{changed[0]} is for phases; give phases, or leave it out")
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

    def _phased(self) -> None:
        """Refuse what does not go with phases."""
        for name in _POSED:
            if getattr(self, name) != _default(self, name):
                raise ValueError(f"{name} is for poses of one five-bar; leave it out, or phases")
        first = self.phases[0][0]
        for number, points in enumerate(self.phases, start=1):
            apart = [abs(x - y) for x, y in zip(points[0], first, strict=False)]
            if len(points[0]) != len(first) or max(apart) > SAME_PLACE:
                raise ValueError(
                    f"phases begin at different points: phase {number} at {points[0]}, phase 1 at {first}; "
                    "all begin where the machine is set"
                )
            if len(set(points)) < len(points):
                raise ValueError(f"phases: phase {number} holds a point twice; leave one out")
        if self.linkage == "five-bar":
            if self.moves != "moving":
                raise ValueError('moves is "moving" with a five-bar: its ground carries the gears')
            if len(self.phases) < 2:
                raise ValueError('phases: a five-bar has two at least; use linkage = "four-bar"')
            if self.full_turn:
                raise ValueError("full_turn is for a four-bar; leave it out")
        elif self.ratio != _default(self, "ratio"):
            raise ValueError("ratio is for a five-bar; leave it out")
        if self.least_arc >= self.greatest_arc:
            raise ValueError("least_arc must be below greatest_arc")

    @property
    def on_plane(self) -> bool:
        """Whether linkages are sought in the plane."""
        if self.search == "auto":
            return all(len(pin) == 2 for points in self.phases for pin in points)
        return self.search == "plane"


def _default(requirement: Parameters, name: str) -> object:
    return type(requirement).model_fields[name].default


_PHASED = ("linkage", "moves", "search", "full_turn", "least_arc", "greatest_arc", "tried", "designs")
"""Fields that count with phases alone."""

_POSED = (
    "path", "turns", "path_n", "turns_n", "crank_axis_x", "crank_length", "arm_axis", "arm_length",
    "arm_angle", "crank_guess", "rocker_guess", "equations", "unknowns", "starts",
)  # fmt: skip
"""Fields that count with poses alone."""

WHOLE = 1e-9
"""By how much a quotient may miss a whole number: rounding."""

SAME_PLACE = 1e-9
"""Points nearer to each other than this, in the plane's unit, are one."""


class FourBarPathRequirement(Parameters):
    """A spherical four-bar whose coupler point follows points of the sphere."""

    points: tuple[Direction, ...] = Field(
        _OVAL,
        min_length=FEWEST_POINTS,
        max_length=MOST_POINTS,
        description="The path as directions x, y, z, in the order of the motion; closed if the first comes "
        "again at the end.",
    )
    closed: bool = Field(
        True, description="Whether the path closes, so that the input turns all the way round."
    )
    angles: tuple[Turn, ...] = Field(
        (),
        max_length=MOST_POINTS,
        description="Input angles of the points from the first one; none if the input may choose.",
    )
    atlas: int = Field(
        3000,
        ge=50,
        le=20000,
        description="Random linkages of each side and sense that are compared with the path in a round.",
    )
    starts: int = Field(
        6,
        ge=1,
        le=100,
        description="Most rounds; the search ends when three have found the same best.",
    )
    designs: int = Field(3, ge=1, le=20, description="Designs that are given at most.")
    seed: int = Field(1, ge=0, le=2**31, description="Of the random linkages.")
    least_transmission: Degrees = Field(30.0, ge=0, le=80, description="Bound of the transmission angle.")
    least_arc: Degrees = Field(
        12.0, ge=5, le=90, description="Least arc; a shorter one has no room for two pins."
    )
    greatest_arc: Degrees = Field(168.0, ge=20, le=175, description="Greatest arc.")
    arc_step: Degrees = Field(
        0.0,
        ge=0,
        le=10,
        description="Arcs and the place of the path point on the coupler are multiples of it, the rest "
        "fitted again; 0 for any arcs.",
    )
    radius: Millimetres = Field(100.0, ge=5, le=2000, description="Radius of the sphere.")
    speed: RevPerMin = Field(10.0, ge=0.001, le=3000, description="Speed of the input.")

    @model_validator(mode="after")
    def _together(self) -> Self:
        if self.arc_step and abs(180 / self.arc_step - round(180 / self.arc_step)) > WHOLE:
            raise ValueError(
                f"arc_step = {self.arc_step:g} does not divide 180 degrees, and an arc and its supplement "
                f"are one link; give {180 / round(180 / self.arc_step):.6g}"
            )
        if self.least_arc >= self.greatest_arc:
            raise ValueError(
                f"least_arc must be below greatest_arc: {self.least_arc:g} and {self.greatest_arc:g} degrees"
            )
        if all(one == self.points[0] for one in self.points):
            raise ValueError(f"points: all {len(self.points)} are the same; a path needs two places at least")
        if self.angles:
            same_length("points", self.points, "angles", self.angles)
            check_one_way("angles", self.angles)
        return self

    @property
    def closes(self) -> bool:
        """Whether the path closes: as it says, or because the first point comes again at the end."""
        return self.closed or (not self.angles and self.comes_again)

    @property
    def comes_again(self) -> bool:
        """Whether the last point is the first one."""
        return len(self.points) > FEWEST_POINTS and self.points[0] == self.points[-1]


class FiveBarPathRequirement(FourBarPathRequirement):
    """A spherical five-bar, its arm geared to the crank, whose coupler point follows points of the sphere."""

    closed: bool = Field(
        True,
        description="Whether the path closes; the crank then turns once, and ratio is a whole number.",
    )
    angles: tuple[Turn, ...] = Field(
        (),
        max_length=MOST_POINTS,
        description="Crank angles of the points from the first one; none if the crank may choose.",
    )
    ratio: Ratio = Field(1.0, ge=-10, le=10, description="Turns of the arm per turn of the crank.")

    @model_validator(mode="after")
    def _geared(self) -> Self:
        if self.ratio == 0:
            raise ValueError('ratio is 0, so the arm stands still; use kind = "four-bar-path"')
        if self.closes and self.ratio != round(self.ratio):
            raise ValueError(
                f"closed and ratio = {self.ratio:g} contradict: after one turn of the crank the arm is not "
                "where it was; give a whole number, or closed = false"
            )
        return self


FIVE = 5
"""Poses of which finitely many dyads go through all."""

Turned = tuple[
    Annotated[float, Field(ge=-1e6, le=1e6), Unit("")],
    Annotated[float, Field(ge=-1e6, le=1e6), Unit("")],
    Annotated[float, Field(ge=-1e6, le=1e6), Unit("")],
    Annotated[float, Field(ge=-3600, le=3600), Unit("deg")],
]
"""Axis x, y, z and the angle by which a body is turned about it, counter-clockwise seen from its tip."""


class PosesRequirement(Parameters):
    """A spherical four-bar whose coupler carries a body through five orientations in their order."""

    poses: tuple[Turned, ...] = Field(
        (
            (0.0, 0.0, 1.0, 0.0), (-0.906, -0.423, -0.022, 27.74), (-0.546, -0.78, 0.305, 48.36),
            (0.083, -0.945, 0.318, 63.35), (0.706, -0.706, 0.059, 45.47),
        ),
        min_length=FIVE,
        max_length=FIVE,
        description="Five orientations of the body [x, y, z, angle]: turned by the angle about the axis, "
        "each from the same orientation.",
    )  # fmt: skip
    point: Direction = Field(
        (0.0, 0.0, 1.0),
        description="Direction of the body, before it is turned, that the design shows as its path.",
    )
    drive: Literal["crank", "lever", "any"] = Field(
        "any", description="An input that turns fully, one that swings through the poses, or either."
    )
    designs: int = Field(5, ge=1, le=30, description="Designs that are given at most.")
    least_transmission: Degrees = Field(20.0, ge=1, le=80, description="Bound of the transmission angle.")
    radius: Millimetres = Field(100.0, ge=5, le=2000, description="Radius of the sphere.")
    speed: RevPerMin = Field(10.0, ge=0.001, le=3000, description="Speed of the input.")

    @model_validator(mode="after")
    def _apart(self) -> Self:
        turned: list[Array] = []
        for number, (x, y, z, angle) in enumerate(self.poses, start=1):
            try:
                turned.append(rotation_about(vector((x, y, z)), np.radians(angle)))
            except GeometryError as error:
                raise ValueError(f"poses: axis of pose {number}: {error}") from None
            for other, one in enumerate(turned[:-1], start=1):
                if np.abs(one - turned[-1]).max() < SAME_POSE:
                    raise ValueError(f"poses {other} and {number} are the same; move one of them")
        return self

    @property
    def rotations(self) -> Array:
        """(5, 3, 3) orientations."""
        return np.array([rotation_about(vector(one[:3]), np.radians(one[3])) for one in self.poses])


SAME_POSE = 1e-9
"""Orientations whose directions differ by less are one."""
