"""Closed walls as places that lie close enough for a polygon through them to be the wall."""

import math
from dataclasses import dataclass

import numpy as np
import shapely

from mechwright.arrays import Array
from mechwright.geometry.segments import Point
from mechwright_cam.proof.plane import Shape

SPACING = 0.05
"""Places are no farther apart, mm: on a bend of 3 mm a chord then misses the wall by a tenth of a µm."""
LEAST_PLACES = 128
"""Places on the wall of a bore, at least."""
SHARP = math.cos(math.radians(15))
"""Cosine of the turn from which on two edges meet in a corner, and no longer follow one curve."""


@dataclass(frozen=True, eq=False)
class Ring:
    """Places (n, 2), mm, in order with material on the left, and unit vectors (n, 2) off the material."""

    points: Array
    outward: Array


def rings_of(shape: Shape) -> list[Ring]:
    """All rings of a shape.

    Places stand in the middle of pieces of its edges, where the edge has a direction, and at both sides of
    every sharp corner.

    Examples
    --------
    >>> (ring,) = rings_of(shapely.box(0, 0, 1, 1))
    >>> middle = np.array([0.5, 0.5])
    >>> len(ring.points), bool((((ring.points - middle) * ring.outward).sum(axis=1) == 0.5).all())
    (88, True)
    """
    found = []
    for part in shapely.get_parts(shape).tolist():
        for line, ccw in [(part.exterior, True), *((hole, False) for hole in part.interiors)]:
            points = shapely.get_coordinates(line)
            found.append(_ring(points if shapely.is_ccw(line) == ccw else points[::-1]))
    return found


def _ring(corners: Array) -> Ring:
    """The places of one ring (n + 1, 2), closed."""
    step = np.diff(corners, axis=0)
    length = np.hypot(*step.T)
    real = length > 0
    start, step, length = corners[:-1][real], step[real], length[real]
    along = step / length[:, None]
    sharp = (along * np.roll(along, 1, axis=0)).sum(axis=1) < SHARP
    first, last = sharp.astype(np.int64), np.roll(sharp, -1).astype(np.int64)
    pieces = np.ceil(length / SPACING).astype(np.int64)
    count = pieces + first + last
    owner = np.repeat(np.arange(len(length)), count)
    place = np.arange(owner.size) - np.repeat(np.cumsum(count) - count, count)
    share = np.clip((place - first[owner] + 0.5) / pieces[owner], 0.0, 1.0)
    points = start[owner] + share[:, None] * step[owner]
    outward = np.column_stack((along[:, 1], -along[:, 0]))[owner]
    return Ring(points, outward)


def circle_ring(centre: Point, radius: float) -> Ring:
    """The wall of a round bore, clockwise, so that the material is on the left."""
    count = max(LEAST_PLACES, math.ceil(math.tau * radius / SPACING))
    turn = -math.tau * np.arange(count) / count
    ray = np.column_stack((np.cos(turn), np.sin(turn)))
    return Ring(np.array(centre) + radius * ray, -ray)
