"""Into the narrow ends of a recess that the cutter just does not pass through.

A finishing path keeps a small distance δ off the wall, since its arcs are only so exact. Where two walls meet
the cutter, each at an angle α to their bisector, δ holds the cutter back by δ / sin α along the bisector: a
multiple of δ in a slender wedge. A straight move to the very end of the wedge is exact, so it may go nearer.
"""

import numpy as np
import shapely

from mechwright.arrays import Array
from mechwright.tolerances import TOLERANCES
from mechwright_plane.offsets import FINE
from mechwright_plane.runs import CORNER

TOUCH = TOLERANCES.flatten + FINE / 2
"""A straight move keeps this distance off the wall, mm: what the flattened outline and the last decimal of
the program can be wrong."""
HELD_BACK = TOLERANCES.leftover / 2
"""A cutter that is held back by less than this, mm, leaves nothing worth a move."""
TRIALS = 6
"""Halvings of a move that comes too near: curved walls end sooner than their tangents."""


def into_wedges(ring: Array, keep: shapely.Geometry, radius: float, bias: float) -> Array:
    """The closed ring (n + 1, 2), mm, with a move to the end of each slender wedge and back.

    It runs at ``radius + bias`` from what must stay: the cutter's radius, and the path's distance, mm.
    """
    if bias <= TOUCH:
        return ring
    corner = ring[:-1]
    back, ahead = np.roll(corner, 1, axis=0) - corner, np.roll(corner, -1, axis=0) - corner
    back /= np.linalg.norm(back, axis=1, keepdims=True)
    ahead /= np.linalg.norm(ahead, axis=1, keepdims=True)
    middle = back + ahead
    opening = np.linalg.norm(middle, axis=1) / 2  # the cosine of α
    slope = np.sqrt(np.maximum(1 - opening**2, np.finfo(float).eps))
    held = bias / slope
    sharp = np.flatnonzero((2 * np.arcsin(np.minimum(slope, 1)) < np.pi - CORNER) & (held > HELD_BACK))
    if not sharp.size:
        return ring
    way = -middle[sharp] / (2 * opening[sharp, None])
    length = held[sharp] * (1 - TOUCH / bias)
    for _ in range(TRIALS):
        end = corner[sharp] + length[:, None] * way
        near = shapely.distance(keep, shapely.points(end)) < radius + TOLERANCES.flatten
        if not near.any():
            break
        length[near] /= 2
    else:
        sharp, end = sharp[~near], end[~near]
    there_and_back = np.stack((end, corner[sharp]), axis=1).reshape(-1, 2)
    return np.asarray(np.insert(ring, np.repeat(sharp + 1, 2), there_and_back, axis=0))
