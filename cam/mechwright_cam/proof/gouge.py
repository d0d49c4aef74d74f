"""Cuts into what must stay.

A cutter whose tip is at z is nowhere thinner above than below. Within a band of constant cross-section the
depth of a cut is therefore its radius at the band's top less the plan-view distance from the path below it to
the cross-section; there is no height map and no grid. Into a floor the depth is how far the cutter's end
goes below it at that distance, so the smaller of the two counts.
"""

from dataclasses import dataclass

import numpy as np
import shapely

from mechwright.motion import Array
from mechwright_cam.proof.paths import NEAR, Paths, Pieces
from mechwright_cam.proof.plane import Boundary, Shape


@dataclass(frozen=True, slots=True)
class Gouge:
    """The deepest cut: its depth, mm, the step of the run, and the place."""

    depth: float
    step: int
    at: tuple[float, float, float]


def deepest_cut(paths: Paths, keep: Shape, top: float) -> Gouge | None:
    """The deepest cut of any move into ``keep`` below the height ``top``; None if nothing touches it."""
    pieces = _distinct(paths, paths.below(top - NEAR))
    if len(pieces) == 0 or keep.is_empty:
        return None
    radius = paths.radius_at(pieces, top)
    lines = paths.lines(pieces)
    edge = Boundary(keep)
    near = np.flatnonzero(shapely.dwithin(keep, lines, radius))
    gap = np.full(len(pieces), np.inf)
    gap[near] = edge.distance(lines[near], within=float(radius.max()))
    inside = edge.inside(lines)
    if inside.size:
        gap[inside] = -_depth_inside(paths, pieces.only(inside), edge)
    shape = paths.cutters(pieces.step)
    end = np.where(shape.nose > 0, shape.height_at(np.maximum(gap, 0.0)), 0.0)
    depth = np.minimum(radius - gap, top - pieces.low - end)
    if depth.max() <= 0:
        return None
    alike = np.flatnonzero(depth >= depth.max() - NEAR)
    worst = int(alike[np.argmin(pieces.step[alike])])  # of moves that cut equally deep, blame the first
    x, y = edge.nearest(lines[worst])
    return Gouge(float(depth[worst]), int(pieces.step[worst]), (x, y, float(pieces.low[worst])))


def _distinct(paths: Paths, pieces: Pieces) -> Pieces:
    """Each plan-view piece once, at its lowest: passes repeat at every depth."""
    pieces = pieces.only(np.argsort(pieces.low, kind="stable"))
    run, step = paths.run, pieces.step
    table = np.column_stack(
        (
            run.tool[step],
            paths.start[step, :2],
            paths.end[step, :2],
            np.nan_to_num(run.centre[step]),
            run.sweep[step],
            pieces.first,
            pieces.last,
        )
    )
    _, index = np.unique(np.round(table / NEAR).astype(np.int64), axis=0, return_index=True)
    return pieces.only(index)


def _depth_inside(paths: Paths, pieces: Pieces, edge: Boundary) -> Array:
    """How far each piece goes inside the shape, measured at its corners."""
    points, owner = paths.points(pieces)
    spots = shapely.points(points)
    within = shapely.intersects(edge.shape, spots)
    deep = np.where(within, edge.distance(spots), 0.0)
    out = np.zeros(len(pieces))
    np.maximum.at(out, owner, deep)
    return out
