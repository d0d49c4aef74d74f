"""Where roughing what is left takes so little that chips are thin: there the cutter is fed faster.

In a gap that a wider mill has opened a finer one takes a full cut on its way to the bottom, and little beside
on its way back. How much of it is in material follows from what still stands, which is known: at an
engagement φ no chip is thicker than f_z sin φ, so up to :data:`THIN` it may have twice the feed of a full
cut.
"""

import math
from collections.abc import Sequence
from itertools import pairwise

import numpy as np
import shapely
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright_cam.operations.engagement import engagements
from mechwright_cam.operations.pen import AIR
from mechwright_cam.plane.offsets import ROUGH, grow
from mechwright_cam.plane.path import Path

THIN = math.asin(1 / AIR)
"""Engagement, rad, up to which chips are no thicker than planned at the feed through cleared ground."""
FINELY = 0.25
"""Distance of the places at which the engagement is looked at, in radii."""
WORTHWHILE = 0.25
"""A stretch shorter than so many radii is fed like those beside it."""

Stretch = tuple[Path, bool]
"""A part of a path, and whether chips are thin all along it."""


def stretches(paths: Sequence[Path], standing: shapely.Geometry, radius: float) -> list[tuple[Stretch, ...]]:
    """Divide paths, which are cut one after the other at one height, by how thick their chips are.

    What is ``standing`` may be larger than it is, not smaller; ``radius`` is the cutter's, mm.
    """
    found = []
    for path in paths:
        points = path.points(FINELY * radius)
        (x0, y0), (x1, y1) = points.min(axis=0) - 2 * radius, points.max(axis=0) + 2 * radius
        near = shapely.clip_by_rect(standing, x0, y0, x1, y1)
        cleared = shapely.difference(shapely.box(x0, y0, x1, y1), near)
        ways = np.hypot(*np.diff(points, axis=0).T)
        engaged = np.pad(engagements(points, cleared, radius), 1, mode="edge")
        # The edges before and behind count as well: the greatest may lie between two places.
        thin = np.maximum(np.maximum(engaged[:-2], engaged[2:]), engaged[1:-1]) <= THIN
        found.append(_divided(path, np.cumsum(ways), thin, WORTHWHILE * radius))
        standing = shapely.difference(standing, grow(shapely.LineString(points), radius - ROUGH, ROUGH))
    return found


def _divided(path: Path, end: Array, thin: NDArray[np.bool_], least: float) -> tuple[Stretch, ...]:
    """The path in stretches; ``end`` is the way to the end of each edge, mm, and ``thin`` tells of it."""
    borders = np.flatnonzero(np.diff(thin)).tolist()
    for first, last in pairwise([-1, *borders, len(end) - 1]):
        if end[last] - (end[first] if first >= 0 else 0.0) < least:
            thin[first + 1 : last + 1] = False
    parts: list[Stretch] = []
    rest, done = path, 0.0
    for index in np.flatnonzero(np.diff(thin)).tolist():
        part, rest = rest.split(float(end[index]) - done)
        if part.cuts:
            parts.append((part, bool(thin[index])))
            done += part.length
    return (*parts, (rest, bool(thin[-1]))) if rest.cuts else tuple(parts)
