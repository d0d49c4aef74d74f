"""The wall of a shape by arc length, and the stock on it at samples along it.

Glossary
--------
station
    Distance along all rings of the shape, one after the other, mm.
"""

import math
from typing import Any

import numpy as np
import shapely

from mechwright.arrays import Array
from mechwright.geometry.prepared import prepared
from mechwright.tolerances import TOLERANCES
from mechwright_cam.proof.plane import Shape
from mechwright_cam.proof.sweep import Sweep
from mechwright_cam.setup.job import Job


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
        return (np.arange(count, dtype=np.float64) + 0.5) * (self.length / count)

    def at(self, stations: Any) -> tuple[Array, Array]:
        """Points (k, 2) on the wall, mm, and unit vectors (k, 2) out of the material."""
        index = np.minimum(np.searchsorted(self._end, stations), self._end.size - 1)
        along = self._along[index]
        ahead = stations - (self._end[index] - self._step[index])
        points: Array = self._start[index] + along * ahead[:, None]
        return points, np.column_stack((along[:, 1], -along[:, 0]))


CLEARED = TOLERANCES.arc_fit
"""A wall with no more stock than this is as clean as a path can make it, mm."""
CLEAN = TOLERANCES.leftover / 2
"""A wall with no more stock than this passes whatever the other cutters did there, mm."""
REFINED = 64
"""So many of the worst wall samples are looked at closely."""
REFINE = 33
"""Trial points beside a place that is looked at closely: a wall sample is searched every 10 µm or less."""
HINTED = 0.1
"""How far from its expected place a finishing path is looked for first, mm; found or not, the proof holds."""


def on_walls(
    reached: Shape,
    within: Shape | None,
    aside: Shape | None,
    job: Job,
    groups: list[Sweep],
    smallest: float,
) -> tuple[float, tuple[float, float] | None]:
    """Thickest stock on the wall that can be reached, and its place; inf where no cutter went.

    If ``within`` is given only the wall in there counts, and never the wall in ``aside``.
    """
    # Between two discs that stand apart a cusp stays; one of the leftover limit is wider than this where it
    # is CLEARED thick, so a sample meets it, and the refinement finds its peak.
    limit = TOLERANCES.leftover
    spacing = 2 * (limit - CLEARED) / math.sqrt(2 * limit / smallest)
    wall = Wall(reached)
    if wall.length == 0:
        return 0.0, None
    within, aside = (region if region is None else prepared(region) for region in (within, aside))
    stations = wall.stations(spacing)
    _, thick, stations = _measured(wall, stations, within, aside, job, groups)
    if thick.size == 0:
        return 0.0, None
    worst = stations[np.argsort(thick)[-REFINED:]]
    finer = (worst[:, None] + np.linspace(-spacing, spacing, REFINE)).ravel()
    points, thick, _ = _measured(wall, np.clip(finer, 0.0, wall.length), within, aside, job, groups)
    best = int(np.argmax(thick))
    return float(max(thick[best], 0.0)), (float(points[best, 0]), float(points[best, 1]))


def _measured(
    wall: Wall, stations: Array, within: Shape | None, aside: Shape | None, job: Job, groups: list[Sweep]
) -> tuple[Array, Array, Array]:
    """Points (k, 2), thickness (k,) and stations (k,) where the wall is to be cut at all."""
    points, outward = wall.at(stations)
    x0, y0, x1, y1 = job.stock
    x, y = points.T
    # Where the part's edge is the stock's edge there is nothing to cut, nothing above the limit at least.
    edge = TOLERANCES.leftover
    asked = (x > x0 + edge) & (x < x1 - edge) & (y > y0 + edge) & (y < y1 - edge)
    if within is not None:
        asked &= shapely.intersects_xy(within, x, y)
    if aside is not None:
        asked &= ~shapely.contains_xy(aside, x, y)
    return points[asked], _thickness(points[asked], outward[asked], groups), stations[asked]


def _thickness(points: Array, outward: Array, groups: list[Sweep]) -> Array:
    """Distance (k,) from each point to the nearest swept disc, mm; inf where there is none.

    A path that finishes a wall runs one radius off it, so the nearest piece of path is looked for there
    first: its distance from the point is an upper bound, and where that is within the limit it will do.
    """
    thick = np.full(len(points), np.inf)
    for group in groups:
        # A point that one cutter has cleared needs no other, which could only have left less; the smallest,
        # which comes first, clears most.
        open_ = np.flatnonzero(thick > CLEAN)
        if open_.size == 0:
            break
        beside = points[open_] + group.radius * outward[open_]
        distance = group.chords.hinted_distance(points[open_], beside, HINTED) - group.radius
        thick[open_] = np.minimum(thick[open_], distance)
    for group in groups:
        open_ = np.flatnonzero(thick > TOLERANCES.leftover)
        if open_.size == 0:
            break
        thick[open_] = np.minimum(thick[open_], group.chords.distance(points[open_]) - group.radius)
    return thick
