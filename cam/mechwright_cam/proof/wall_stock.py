"""Stock on walls, at samples along them."""

import math

import numpy as np
import shapely

from mechwright.arrays import Array
from mechwright.geometry.prepared import prepared
from mechwright.tolerances import TOLERANCES
from mechwright_cam.proof.plane import Shape
from mechwright_cam.proof.sweep import Sweep
from mechwright_cam.proof.wall import Wall
from mechwright_cam.setup.job import Job

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
        distance = group.chords.distance_beside(points[open_], beside, HINTED) - group.radius
        thick[open_] = np.minimum(thick[open_], distance)
    for group in groups:
        open_ = np.flatnonzero(thick > TOLERANCES.leftover)
        if open_.size == 0:
            break
        thick[open_] = np.minimum(thick[open_], group.chords.distance(points[open_]) - group.radius)
    return thick
