"""Where the pillars stand, and how large the plates are: a rectangle, its corners clear of all that moves.

The rectangle is the smallest, to a millimetre, that has all bearings within and a pillar in each corner
outside of whatever the mechanism sweeps.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from mechwright.arrays import Array
from mechwright.errors import DesignError
from mechwright.geometry.segments import Point

CLEARANCE = 3.0
"""Between what moves and what stands beside it, mm."""

SLENDER, NARROW = 0.5, 10.0
"""A plate narrower than this share of its length stands badly: it counts for so many times its area."""

STEPS = 48
"""Heights of a corner that are looked at, below and above."""


@dataclass(frozen=True)
class Disc:
    """What a plate has to hold: a place, and the radius about it, mm."""

    point: Point
    radius: float


@dataclass(frozen=True)
class Standing:
    """Corners of the rectangle of pillars: from (left, below) to (right, above), mm."""

    left: float
    below: float
    right: float
    above: float

    @property
    def corners(self) -> tuple[Point, Point, Point, Point]:
        """Counter-clockwise, from the left one below."""
        return (
            (self.left, self.below),
            (self.right, self.below),
            (self.right, self.above),
            (self.left, self.above),
        )

    @property
    def size(self) -> Point:
        """Width and height, mm."""
        return self.right - self.left, self.above - self.below

    @property
    def longer(self) -> float:
        """The longer side, mm."""
        return max(self.size)


def stand(swept: shapely.Geometry, held: Sequence[Disc], pillar: float, edge: float) -> Standing:
    """The smallest rectangle of pillars.

    Parameters
    ----------
    swept
        The region that the mechanism takes at any height.
    held
        What has to lie within the plate, whose rim goes ``edge`` beyond the pillars' axes, mm.
    pillar
        Greatest radius of a pillar, mm.

    Raises
    ------
    DesignError
        Nothing is held.
    """
    if not held:
        raise DesignError("a plate that holds nothing has no size")
    points = np.array([one.point for one in held])
    radii = np.array([one.radius for one in held])
    low, high = (points - radii[:, None]).min(axis=0) + edge, (points + radii[:, None]).max(axis=0) - edge
    around = shapely.union_all(
        [
            swept.buffer(CLEARANCE + pillar),
            *(shapely.Point(one.point).buffer(one.radius + pillar) for one in held),
        ]
    )
    shapely.prepare(around)
    x0, y0, x1, y1 = around.bounds
    below, above = -_heights(-low[1], -y0)[::-1], _heights(high[1], y1)
    left, right = _outwards(low[0], x0), _outwards(high[0], x1)
    lefts, rights = (
        (_first_clear(around, xs, below), _first_clear(around, xs, above)) for xs in (left, right)
    )
    # Of each pair of heights, the two corners of a side take the farther of their first clear places.
    widths = np.maximum(rights[0][:, None], rights[1][None]) - np.minimum(lefts[0][:, None], lefts[1][None])
    widths, heights = widths + 2 * edge, above[None] - below[:, None] + 2 * edge
    slim = np.minimum(widths, heights) < SLENDER * np.maximum(widths, heights)
    row, column = np.unravel_index(int(np.argmin(widths * heights * np.where(slim, NARROW, 1.0))), slim.shape)
    return Standing(
        float(min(lefts[0][row], lefts[1][column])),
        float(below[row]),
        float(max(rights[0][row], rights[1][column])),
        float(above[column]),
    )


def _heights(start: float, end: float) -> Array:
    """Whole millimetres from the least upwards, at most so many as are looked at."""
    low = math.ceil(start)
    return np.unique(np.round(np.linspace(low, max(math.ceil(end), low), STEPS)))


def _outwards(start: float, end: float) -> Array:
    """Whole millimetres from within outwards, a little beyond the end."""
    if end < start:
        return np.arange(np.floor(start), np.floor(min(end, start)) - 2, -1.0)
    return np.arange(np.ceil(start), np.ceil(max(end, start)) + 2, 1.0)


def _first_clear(around: shapely.Geometry, xs: Array, ys: Array) -> Array:
    """For each y the first of ``xs`` from which on all are clear; the last one where none is."""
    taken = shapely.contains_xy(around, *np.meshgrid(xs, ys))
    last = np.where(taken.any(axis=1), taken.shape[1] - np.argmax(taken[:, ::-1], axis=1), 0)
    found: Array = xs[np.minimum(last, xs.size - 1)]
    return found
