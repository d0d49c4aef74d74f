"""The wall of a shape by arc length: places and directions.

Glossary
--------
station
    Distance along all rings of the shape, one after the other, mm.
"""

from typing import Any

import numpy as np
import shapely

from mechwright.arrays import Array
from mechwright_cam.proof.plane import Shape


class Wall:
    """The rings of a shape, with material on the left."""

    def __init__(self, shape: Shape) -> None:
        starts, vectors = [], []
        for part in shapely.get_parts(shape):
            for ring, ccw in [(part.exterior, True), *((hole, False) for hole in part.interiors)]:
                points = shapely.get_coordinates(ring)
                if shapely.is_ccw(ring) != ccw:
                    points = points[::-1]
                starts.append(points[:-1])
                vectors.append(np.diff(points, axis=0))
        self._start = np.concatenate(starts) if starts else np.empty((0, 2))
        vector = np.concatenate(vectors) if vectors else np.empty((0, 2))
        step: Array = np.hypot(vector[:, 0], vector[:, 1])
        real = step > 0
        self._start, step = self._start[real], step[real]
        self._along: Array = vector[real] / step[:, None]
        self._end: Array = np.cumsum(step)
        self._step = step

    @property
    def length(self) -> float:
        """Length of all rings, mm."""
        return float(self._end[-1]) if self._end.size else 0.0

    def stations(self, spacing: float) -> Array:
        """Evenly spread stations, at most ``spacing`` apart."""
        count = max(int(np.ceil(self.length / spacing)), 1)
        middles: Array = (np.arange(count, dtype=np.float64) + 0.5) * (self.length / count)
        return middles

    def at(self, stations: Any) -> tuple[Array, Array]:
        """Points (k, 2) on the wall, mm, and unit vectors (k, 2) out of the material."""
        index = np.minimum(np.searchsorted(self._end, stations), self._end.size - 1)
        along = self._along[index]
        ahead = stations - (self._end[index] - self._step[index])
        points: Array = self._start[index] + along * ahead[:, None]
        return points, np.column_stack((along[:, 1], -along[:, 0]))
