"""Stock that no cutter of the program reaches: where it is, how deep and how large."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely

from mechwright.arrays import Array
from mechwright.tolerances import TOLERANCES
from mechwright_cam.proof.bands import Band, stock_shape
from mechwright_cam.proof.paths import NEAR
from mechwright_cam.proof.plane import Boundary, Shape, grow
from mechwright_cam.proof.sweep import Sweep
from mechwright_cam.proof.target_shape import TargetShape
from mechwright_cam.setup.job import Job

VISIBLE = 0.001
"""Unreachable stock thinner than this is not told from the outline's own deviation, mm."""
SPOTS = 40
"""So many places of unreachable stock are listed, deepest first; a gear has two per tooth."""
EDGE = 9
"""Trial points on an edge beside the deepest corner of a remainder."""


@dataclass(frozen=True)
class Foot:
    """The lowest band of a cross-section: what is cut there, and what has to stay there at least."""

    band: Band
    groups: list[Sweep]
    rest: Shape


def unreachable_stock(
    foot: Foot, target: TargetShape, job: Job
) -> list[tuple[float, float, float, float, float]]:
    """The places between the part and its closing that nothing has cut."""
    band, groups, keep = foot.band, foot.groups, foot.band.keep
    if target.fillets:
        solid = [fillet.solid(band.bottom + TOLERANCES.leftover) for fillet in target.fillets]
        keep = shapely.union_all([keep, *solid])
    rest = shapely.difference(foot.rest, grow(keep, VISIBLE / 2))
    inside = stock_shape(job) if job.frame is None else job.frame.body
    parts = shapely.get_parts(shapely.intersection(rest, inside))
    if parts.size == 0:
        return []
    drills = [shapely.union_all(grow(g.chains, g.radius)) for g in groups if _round_ended(g, job)]
    if drills:
        parts = shapely.get_parts(shapely.difference(parts, shapely.union_all(drills)))
    parts = parts[~shapely.is_empty(parts)]
    if parts.size == 0:
        return []
    points, depth = _deepest_points(parts, Boundary(keep))
    told = depth > VISIBLE
    return [
        (x, y, band.bottom, d, a)
        for (x, y), d, a in zip(
            points[told].tolist(), depth[told].tolist(), shapely.area(parts)[told].tolist(), strict=True
        )
    ]


def _deepest_points(parts: Any, edge: Boundary) -> tuple[Array, Array]:
    """The point (n, 2) of each part that is furthest from the edge, and its distance (n,)."""
    points, owner = shapely.get_coordinates(parts, return_index=True)
    distance = edge.distance(shapely.points(points))
    order = np.lexsort((-distance, owner))
    best = order[np.unique(owner[order], return_index=True)[1]]
    seen = distance[best] > VISIBLE / 2
    if not seen.any():
        return points[best], distance[best]
    told, best = best, best[seen]
    # The furthest point may lie between two corners: look along both edges that meet in the furthest corner.
    last = len(points) - 1
    before, after = np.maximum(best - 1, 0), np.minimum(best + 1, last)
    before = np.where(owner[before] == owner[best], before, best)
    after = np.where(owner[after] == owner[best], after, best)
    t = np.linspace(0.0, 1.0, EDGE)[None, :, None]
    here = points[best][:, None]
    trial = np.concatenate(
        (here + (points[before][:, None] - here) * t, here + (points[after][:, None] - here) * t), axis=1
    )
    found = edge.distance(shapely.points(trial.reshape(-1, 2))).reshape(len(best), -1)
    column, rows = np.argmax(found, axis=1), np.arange(len(best))
    place, depth = points[told], distance[told]
    place[seen], depth[seen] = trial[rows, column], found[rows, column]
    return place, depth


def _round_ended(group: Sweep, job: Job) -> bool:
    """Whether the sweep is a drill's: only those get into corners of the closing (a hole of their size)."""
    return all(abs(group.radius - mill.radius) > NEAR for mill in job.mills)
