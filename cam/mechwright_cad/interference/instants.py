"""Poses at the start, in the middle and at the end of many intervals at once, and what may lie between them.

Within an interval a point leaves the chords of its path by no more than a bound: that of its second
difference, which has a direction, and that of how the second difference changes, which is small and has none.
Arrays have the intervals, or the pairs of pieces that are looked at in them, on their last axis.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright_cad.interference.path import Path

SAG = 0.25
"""Sag of a corner's path under its chords, per second difference: twice that of a parabola (1/8), so that it
covers what the third derivative adds."""

Ints = NDArray[np.int64]


@dataclass(frozen=True)
class Poses:
    """Three poses for each of n intervals, or for each of n pairs.

    Parameters
    ----------
    rotation, position
        (3, d, d, n) and (3, d, n), mm.
    change
        (2, n): how much the sag changes over the interval, per mm of a point's distance from the moving
        origin, and of that origin itself, mm.
    """

    rotation: Array
    position: Array
    change: Array

    @classmethod
    def of(cls, path: Path, start: Array, step: float) -> "Poses":
        """The poses of intervals that begin at ``start`` (n,) and last ``step``, in samples."""
        parts = [path.at(start + part * step) for part in (0.0, 0.25, 0.5, 0.75, 1.0)]
        turn = np.stack([np.moveaxis(rotation, 0, -1) for rotation, _ in parts])
        place = np.stack([position.T for _, position in parts])
        # Of the two halves: their second differences, which differ by a third one.
        bent = turn[4] - 2 * turn[3] + 2 * turn[1] - turn[0]
        off = place[4] - 2 * place[3] + 2 * place[1] - place[0]
        change = np.stack((np.sqrt((bent**2).sum(axis=(0, 1))), np.sqrt((off**2).sum(axis=0))))
        return cls(np.ascontiguousarray(turn[::2]), np.ascontiguousarray(place[::2]), change)

    def take(self, when: Ints) -> "Poses":
        """The poses of some intervals, by number."""
        return Poses(*(np.take(part, when, axis=-1) for part in (self.rotation, self.position, self.change)))

    def move(self, points: Array) -> Array:
        """Points (d, n) at the three poses: (3, d, n)."""
        moved: Array = self.rotation[:, :, 0] * points[0]
        for axis in range(1, len(points)):
            moved += self.rotation[:, :, axis] * points[axis]
        moved += self.position
        return moved

    def turn(self, vectors: Array) -> Array:
        """Directions (d, n) in the middle of the intervals: (d, n)."""
        middle = self.rotation[1]
        turned: Array = middle[:, 0] * vectors[0]
        for axis in range(1, len(vectors)):
            turned += middle[:, axis] * vectors[axis]
        return turned

    def back(self, vectors: Array) -> Array:
        """Directions (d, n) that stay, as the moving body sees them at the three poses: (3, d, n)."""
        seen: Array = self.rotation[:, 0] * vectors[0]
        for axis in range(1, len(vectors)):
            seen += self.rotation[:, axis] * vectors[axis]
        return seen

    def wander(self, reach: Array) -> Array:
        """Bound (n,), mm, of how the sag changes of points up to ``reach`` (n,) from their origin."""
        wandered: Array = self.change[0] * reach + self.change[1]
        return wandered


def second(path: Array) -> Array:
    """Second difference (..., d, n) of three points (3, ..., d, n)."""
    difference: Array = path[0] - 2 * path[1] + path[2]
    return difference
