"""Where roughing what is left takes so little that chips are thin: there the cutter is fed faster.

In a gap that a wider mill has opened a finer one takes a full cut at the bottom, and little beside on its way
there and back. How much of it is in material follows from what still stands, which is known: at an engagement
φ no chip is thicker than f_z sin φ, so it may have 1 / sin φ times the feed of a full cut, up to :data:`AIR`.
"""

import math
from collections.abc import Sequence

import numpy as np
import shapely

from mechwright.arrays import Array
from mechwright_cam.operations.engagement import engagements
from mechwright_cam.operations.pen import AIR
from mechwright_plane.offsets import ROUGH, grow
from mechwright_plane.path import Path

SHARES = (1.25, 1.5, 2.0, AIR)
"""Feeds in those of a full cut that stretches may have; finer steps save nothing."""
ROUNDING = 1e-9
"""Rounding of engagements."""
FINELY = 0.1
"""Distance of the places at which the engagement is looked at, in radii."""
Stretch = tuple[Path, float]
"""A part of a path, and its feed in feeds of a full cut."""


def split_by_engagement(
    paths: Sequence[Path], standing: shapely.Geometry, radius: float
) -> list[tuple[Stretch, ...]]:
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
        most = np.maximum(np.maximum(engaged[:-2], engaged[2:]), engaged[1:-1])
        found.append(_divided(path, np.cumsum(ways), feed_shares(most)))
        standing = shapely.difference(standing, grow(shapely.LineString(points), radius - ROUGH, ROUGH))
    return found


def feed_shares(engaged: Array) -> Array:
    """Feeds (n,) in those of a full cut at which chips are no thicker than planned, at engagements, rad.

    >>> feed_shares(np.radians([5.0, 29.0, 40.0, 80.0, 170.0])).tolist()
    [3.0, 2.0, 1.5, 1.0, 1.0]
    """
    most = 1 / np.maximum(np.sin(np.minimum(engaged, math.pi / 2)), 1 / AIR)
    steps = np.array((1.0, *SHARES))
    found: Array = steps[np.searchsorted(steps, most + ROUNDING, side="right") - 1]
    return found


def _divided(path: Path, end: Array, share: Array) -> tuple[Stretch, ...]:
    """The path in stretches; ``end`` is the way to the end of each edge, mm, and ``share`` its feed."""
    # What is faster for one edge alone is no stretch: the least of each two, and of these the greater.
    both = np.pad(np.minimum(share[:-1], share[1:]), 1, mode="edge") if len(share) > 1 else share
    share = np.maximum(both[:-1], both[1:]) if len(share) > 1 else share
    parts: list[Stretch] = []
    rest, done = path, 0.0
    for index in np.flatnonzero(np.diff(share)).tolist():
        part, rest = rest.split(float(end[index]) - done)
        if part.cuts:
            parts.append((part, float(share[index])))
            done += part.length
    return (*parts, (rest, float(share[-1]))) if rest.cuts else tuple(parts)
