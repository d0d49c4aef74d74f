"""What a round cutter can reach, and what it leaves in corners and narrow places.

Glossary
--------
closing
    A shape together with all that a disc cannot touch without entering the shape: it is what a cutter leaves.
remainder
    The closing without the shape; its depth at a point of the wall is the distance to the nearest place
    that the cutter touches.
"""

import math
from functools import lru_cache
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.geometry.prepared import prepared
from mechwright.tolerances import TOLERANCES
from mechwright_plane.offsets import ROUGH, grow, polygons, thinned

SPACING = 0.1
"""Of places on walls, mm: where a cutter of 3 mm or more just does not pass between two walls, and leaves all
that the proof allows, so much of a straight wall has more than half of it."""

PRECISION = 1e-4
"""Chord error of the closing, mm: a hundredth of the leftover that the proof lets pass."""

CUT_SHORT = 2.25
"""An arc of an offset that is only one and a half steps long is one chord: its error is so many times that of
a step."""

SAFE = (1 + CUT_SHORT) * ROUGH
"""By how much a thinned shape and the chords of its offset may fall short, mm."""

ROUGHLY = SAFE + ROUGH
"""How far a first look may be off, mm: made larger to be safe, and the thinned shape may be larger itself."""


@lru_cache(maxsize=16)
def closing(keep: shapely.Geometry, radius: float) -> shapely.Geometry:
    """What a cutter of ``radius`` leaves of everything around ``keep``, mm.

    Examples
    --------
    >>> corner = shapely.Polygon([(0, 0), (20, 0), (20, 5), (5, 5), (5, 20), (0, 20)])
    >>> left = closing(corner, 3.0).area - corner.area
    >>> round(left, 2)  # a square corner keeps (1 - π/4) r²
    1.93
    """
    return grow(_swollen(keep, radius), -radius, PRECISION)


@lru_cache(maxsize=32)
def _swollen(keep: shapely.Geometry, radius: float) -> shapely.Geometry:
    """``keep`` grown by ``radius``; the choice of cutters asks for the same shapes again and again."""
    return grow(keep, radius, PRECISION)


@lru_cache(maxsize=32)
def roughly_swollen(keep: shapely.Geometry, radius: float) -> shapely.Geometry:
    """``keep`` grown by ``radius``, mm, for a first look, in a third of the time.

    It is nowhere smaller than the exact shape, and nowhere more than ROUGHLY larger.
    """
    return grow(thinned(keep), radius + SAFE, ROUGH)


@lru_cache(maxsize=32)
def _walls(keep: shapely.Geometry) -> Array:
    """Places (n, 2) on the edge of a shape: its corners, and some on long edges."""
    return np.asarray(shapely.get_coordinates(shapely.segmentize(keep, SPACING)))


@lru_cache(maxsize=32)
def _points(keep: shapely.Geometry, near: shapely.Geometry | None) -> Array:
    """Places (n, 2) on the edge of a shape, or those of them that stand on another shape."""
    points = _walls(keep)
    if near is None:
        return points
    x0, y0, x1, y1 = shapely.bounds(shapely.buffer(shapely.box(*near.bounds), 2 * TOLERANCES.flatten))
    points = points[((points >= (x0, y0)) & (points <= (x1, y1))).all(axis=1)]
    near = prepared(near)
    return np.asarray(points[shapely.dwithin(near, shapely.points(points), TOLERANCES.flatten)])


def remainder(keep: shapely.Geometry, radius: float, near: shapely.Geometry | None = None) -> float:
    """The greatest thickness that a cutter of ``radius`` leaves on the wall of ``keep``, mm.

    Thickness is the distance from a wall point to the nearest place that the cutter touches. If a shape
    ``near`` is given, only walls that stand at it count.
    """
    # Nearly every point is touched, and distances take long.
    away = _deep(grow(_swollen(keep, radius), -radius - 2 * PRECISION, PRECISION), keep, near)
    if not away.any():
        return 0.0
    edges = shapely.STRtree(_edges(shapely.boundary(closing(keep, radius))))
    points = shapely.points(_points(keep, near)[away])
    _, distance = edges.query_nearest(points, return_distance=True, all_matches=False)
    return float(distance.max())


def _edges(lines: shapely.Geometry) -> NDArray[Any]:
    edges: list[NDArray[Any]] = []
    for part in shapely.get_parts(lines):
        points = shapely.get_coordinates(part)
        edges.append(shapely.linestrings(np.stack((points[:-1], points[1:]), axis=1)))
    return np.concatenate(edges)


def leaves_at_most(
    keep: shapely.Geometry, radius: float, limit: float, near: shapely.Geometry | None = None
) -> bool:
    """Whether a cutter of ``radius`` comes within ``limit`` of all walls, or of those ``near`` a shape."""
    # A wall point has more than that in front of it if it lies that deep in the closing: a test of points
    # against one polygon, much faster than distances. What leaves much more shows on thinned shapes.
    if _deep(_much(keep, radius, limit), thinned(keep), near).any():
        return False
    return not _deep(grow(_swollen(keep, radius), -radius - limit, PRECISION), keep, near).any()


def leaves_much_more(
    keep: shapely.Geometry, radius: float, finer: float, limit: float, near: shapely.Geometry | None = None
) -> bool:
    """Whether a cutter of ``radius`` leaves more than ``limit`` on a wall that a ``finer`` one reaches.

    This is a first look: no means that it may be so all the same.
    """
    walls = thinned(keep)
    left = _deep(grow(roughly_swollen(keep, finer), -finer - ROUGHLY, ROUGH), walls, near)
    return bool((_deep(_much(keep, radius, limit + ROUGHLY), walls, near) & ~left).any())


def _much(keep: shapely.Geometry, radius: float, limit: float) -> shapely.Geometry:
    """Where a wall point has certainly more than ``limit`` in front of it; thinned shapes show it."""
    return grow(roughly_swollen(keep, radius - ROUGHLY), -radius - limit - CUT_SHORT * ROUGH, ROUGH)


def _deep(
    shape: shapely.Geometry, keep: shapely.Geometry, near: shapely.Geometry | None
) -> NDArray[np.bool_]:
    """Which places on the edge of ``keep``, or those ``near`` a shape, lie in another one."""
    shape = prepared(shape)
    x, y = _points(keep, near).T
    return np.asarray(shapely.contains_xy(shape, x, y))


def closed_area(swollen: shapely.Geometry, radius: float) -> float:
    """Area of what a cutter of ``radius`` leaves, from the shape grown by the radius, mm².

    A grown shape is a union of discs of that radius, so its inner parallel curve is regular and Steiner's
    formula A - r L + π r² χ is exact, reentrant corners included; χ is 1 for each polygon, less 1 for each
    hole.

    Examples
    --------
    >>> square = shapely.box(0, 0, 10, 10)
    >>> round(closed_area(shapely.buffer(square, 2.0, quad_segs=500), 2.0), 3)
    100.0
    """
    parts = polygons(swollen)
    euler = len(parts) - sum(len(part.interiors) for part in parts)
    return float(swollen.area - radius * swollen.length + math.pi * radius**2 * euler)


def roughly_closed_area(keep: shapely.Geometry, radius: float) -> float:
    """Area of what a cutter of ``radius`` leaves around ``keep``, mm², from a first look."""
    return closed_area(roughly_swollen(keep, radius), radius + SAFE)


def opening_keep(opening: shapely.Polygon, margin: float) -> shapely.Polygon:
    """The material around an opening: a frame ``margin`` wide."""
    x0, y0, x1, y1 = opening.bounds
    return shapely.box(x0 - margin, y0 - margin, x1 + margin, y1 + margin).difference(opening)
