"""What every synthesis of a path in the plane is asked for: points, their order, and limits."""

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import Annotated, Literal, Self

import numpy as np
from pydantic import Field, model_validator

from mechwright.contracts.finding import Finding
from mechwright.contracts.parameters import Parameters
from mechwright.mechanics.adjustable.requirement import Coordinate, check_lengths
from mechwright.units import Degrees, Millimetres, Unit

Turn = Annotated[float, Field(ge=-3600, le=3600), Unit("deg")]

MOST_POINTS = 5000
"""More points of a path say nothing new; thin them out."""

REACH = 4.0
"""Greatest width of a path in longest links: its point is no farther from the crank's pivot than two."""

DIRECTIONS = 180
"""In which the width of a path is looked at: of the greatest, a part in ten thousand may be lost."""

MOST_STARTS = 1_000_000
"""More random starts take minutes and find nothing new."""


class PlanePath(Parameters):
    """The part of a table ``[requirement]`` that paths of planar linkages share."""

    points: tuple[tuple[Coordinate, Coordinate], ...] = Field(
        ((20.0, 20.0), (20.0, 25.0), (20.0, 30.0), (20.0, 35.0), (20.0, 40.0), (20.0, 45.0)),
        min_length=3,
        max_length=MOST_POINTS,
        description="Points [x, y] of the path, 3 or more, in the order in which they are passed; closed "
        "if the first comes again at the end.",
    )
    closed: bool = Field(
        False,
        description="Whether the first point follows on the last; the crank then turns once from it to it.",
    )
    crank_turns: tuple[Turn, ...] | None = Field(
        None,
        min_length=3,
        max_length=MOST_POINTS,
        description="Crank angle at each point from that at the first, the first 0. Default: any.",
    )
    sense: Literal["ccw", "cw", "any"] = Field(
        "any", description="Sense of the crank, where crank_turns does not say it."
    )
    order_tolerance: Degrees = Field(
        0.0,
        ge=0,
        le=45,
        description="Crank angle by which a point may be passed before the one before it; not with "
        "crank_turns.",
    )
    tolerance: Millimetres = Field(
        0.0,
        ge=0,
        le=100,
        description="Distance in the mean (root mean square) that counts as met; 0 for as near as possible.",
    )
    least_transmission_angle: Degrees = Field(
        20.0, ge=1, le=80, description="Least transmission angle of the designs."
    )
    longest_link: Millimetres = Field(
        400.0, ge=1, le=2000, description="Longest link, ground and coupler point included."
    )
    shortest_link: Millimetres = Field(10.0, ge=1, le=1000, description="Shortest link, ground included.")
    frame: tuple[Coordinate, Coordinate, Coordinate, Coordinate] | None = Field(
        None,
        description="Rectangle [least x, least y, greatest x, greatest y] in which the crank's fixed pivot "
        "stands. Default: anywhere.",
    )
    length_step: Millimetres = Field(
        0.0,
        ge=0,
        le=50,
        description="Lengths of links and the coupler point's coordinates are multiples of it, the rest "
        "fitted again; 0 for any lengths.",
    )
    starts: int = Field(
        100_000, ge=100, le=MOST_STARTS, description="Most random shapes to try for each branch and sense."
    )
    designs: int = Field(5, ge=1, le=50, description="Most designs to give.")
    seed: int = Field(0, ge=0, le=1_000_000, description="Seed of the random starts.")

    @model_validator(mode="after")
    def _together(self) -> Self:
        turns = self.crank_turns
        if turns is not None:
            if len(turns) != len(self.points):
                raise ValueError(f"crank_turns has {len(turns)} angles for {len(self.points)} points")
            if turns[0] != 0:
                raise ValueError(f"crank_turns starts with {turns[0]:g}; take it from all, the first is 0")
            check_one_way("crank_turns", turns)
            for key in ("closed", "sense", "order_tolerance"):
                if getattr(self, key) != type(self).model_fields[key].default:
                    raise ValueError(f"{key} and crank_turns contradict: leave {key} out")
        check_lengths(self.shortest_link, self.longest_link)
        if self.frame is not None and (self.frame[0] >= self.frame[2] or self.frame[1] >= self.frame[3]):
            raise ValueError(
                "frame is [least x, least y, greatest x, greatest y], the least below the greatest"
            )
        return self


def check_one_way(name: str, angles: Sequence[float]) -> None:
    """Refuse angles of a crank, degrees, that turn back, stand still, or go a turn and more.

    Raises
    ------
    ValueError
        Which angles of the key ``name`` do.

    Examples
    --------
    >>> check_one_way("angles", (0, 20, 15))
    Traceback (most recent call last):
    ...
    ValueError: angles turns back from 20 to 15 degrees, its 2nd and 3rd; the crank goes one way
    """
    way = angles[-1] - angles[0]
    for number, (one, two) in enumerate(pairwise(angles), start=1):
        if (two - one) * way <= 0:
            does = "stands at" if one == two else "turns back from"
            to = "" if one == two else f" to {two:g}"
            raise ValueError(
                f"{name} {does} {one:g}{to} degrees, its {_nth(number)} and {_nth(number + 1)}; the crank "
                "goes one way"
            )
    if abs(way) >= 360:
        raise ValueError(f"{name} goes {abs(way):g} degrees; stay within one turn, below 360")


def _nth(number: int) -> str:
    last = {1: "st", 2: "nd", 3: "rd"}.get(number % 10, "th") if number % 100 not in (11, 12, 13) else "th"
    return f"{number}{last}"


def faults(wanted: PlanePath, contradiction: str, linkage: str) -> tuple[Finding, ...]:
    """What is wrong with what is asked: errors where nothing is to be sought, a warning where points lie off.

    Parameters
    ----------
    contradiction
        What contradicts in the limits alone; empty where nothing does.
    linkage
        What is sought, in a sentence.
    """
    if said := fault_of_points(wanted.points, wanted.crank_turns is not None):
        return (Finding.error("path.points", "points", said),)
    if contradiction:
        return (
            Finding.error(
                "path.contradiction", "longest_link", f"no {linkage} keeps the limits: {contradiction}"
            ),
        )
    reach = REACH * wanted.longest_link
    one, two = farthest(wanted.points)
    apart = math.dist(wanted.points[one], wanted.points[two])
    least = (apart - reach) / math.sqrt(2 * len(wanted.points))
    if least <= max(wanted.tolerance, 0.0):
        return ()
    said = (
        f"points and longest_link contradict: points {one + 1} and {two + 1} are {apart:.4g} mm apart, and "
        f"with longest_link = {wanted.longest_link:g} mm no path is wider than {reach:g} mm; every {linkage} "
        f"misses the points by {least:.4g} mm in the mean, or more"
    )
    told = Finding.error if wanted.tolerance else Finding.warning
    fix = f"make longest_link {math.ceil(apart / REACH)} at least"
    return (told("path.contradiction", "longest_link", said, wanted.longest_link, apart / REACH, "mm", fix),)


def farthest(points: Sequence[tuple[float, float]]) -> tuple[int, int]:
    """Indices, in their order, of the two points that are farthest apart, to a part in ten thousand.

    >>> farthest([(0, 0), (3, 4), (1, 1)])
    (0, 1)
    """
    angles = np.linspace(0, math.pi, DIRECTIONS, endpoint=False)
    along = np.array(points) @ np.array([np.cos(angles), np.sin(angles)])
    widest = int(np.ptp(along, axis=0).argmax())
    one, two = sorted((int(along[:, widest].argmin()), int(along[:, widest].argmax())))
    return one, two


def fault_of_points(points: Sequence[tuple[float, ...]], timed: bool) -> str:
    """Points that no path can be sought through, and which; empty where they are sound.

    >>> fault_of_points([(1, 2), (1, 2), (3, 4)], False)[:30]
    'points 1 and 2 are both (1, 2)'
    """
    if len(set(points)) == 1:
        return f"all {len(points)} points are {_told(points[0])}: a path needs two places at least"
    if not timed:
        for number, (one, two) in enumerate(pairwise(points), start=1):
            if one == two:
                return (
                    f"points {number} and {number + 1} are both {_told(one)}; leave one out, or say how far "
                    "the crank turns while the point stands still"
                )
    return ""


def _told(point: tuple[float, ...]) -> str:
    return "(" + ", ".join(f"{one:g}" for one in point) + ")"


SENSES = {"ccw": (1,), "cw": (-1,), "any": (1, -1)}
"""Senses of the crank that each word lets be tried."""
