"""Cuts into what must stay.

A cutter whose tip is at z is nowhere thinner above than below. Within a band of constant cross-section the
depth of a cut is therefore its radius at the band's top less the plan-view distance from the path below it to
the cross-section; there is no height map and no grid. Into a floor the depth is how far the cutter's end
goes below it at that distance, so the smaller of the two counts. The upper side of a ramped tab is no level:
along the moves near it the cutter is asked, place by place, how far the highest of the tab that its disc
covers stands above its tip.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np
import shapely

from mechwright.arrays import Array, first_of_each
from mechwright.geometry.prepared import prepared
from mechwright_cam.controls.reading.run import Ints
from mechwright_cam.proof.paths import NEAR, Geometries, Paths, Pieces
from mechwright_cam.proof.plane import ROUND, Boundary, Shape, grow
from mechwright_cam.setup.holding import Tab

DEAR = 12
"""To grow a shape by one corner takes about a twelfth of the time of one question about nearness."""
FIRST_ASKED = 500
"""So many pieces are asked first, and all others if these have not settled it."""
THROUGH = 1e6
"""A cut through the plate counts as so deep, mm: only its width says how far it goes into the part."""
COARSE, FINE, FINEST = 0.5, 0.1, 0.001
"""Distance of the places along an axis inside of the part, mm: of all moves, of slices, of the deepest."""
SLICE = 0.05
"""Fall of a slice, mm: a sloping move is as deep as its lowest place all along, its slices are not."""
MOST_SLICES = 100_000
"""So many slices at most; beyond it they fall by more, and a cut is given with more than its depth."""
MOST_PLACES = 50_000
"""So many such places of one line at most."""
MOST_CORNERS = 1_000_000
"""Corners of lines that are looked at together."""


@dataclass(frozen=True, slots=True)
class Gouge:
    """The deepest cut: its depth, mm, the step of the run, and the place."""

    depth: float
    step: int
    at: tuple[float, float, float]


def worst_of(cuts: Iterable[Gouge | None]) -> Gouge | None:
    """The deepest of some cuts; None if there is none."""
    return max((cut for cut in cuts if cut is not None), key=lambda cut: cut.depth, default=None)


def deepest_cut(paths: Paths, keep: Shape, top: float, underside: float = -np.inf) -> Gouge | None:
    """The deepest cut of any move into ``keep`` below the height ``top``; None if nothing touches it.

    A cut down to ``underside`` goes through: its depth is how far it goes into the wall. No other cut is
    deeper than the tip goes below ``top``. So the lowest moves are asked first, and others only as long as
    they may be deeper: a program that gouges all over takes no longer than any. If the deepest move slopes,
    it and all others that may be deeper are looked at again, slice by slice.
    """
    if keep.is_empty:
        return None
    every, edge = _about(paths, paths.below(top - NEAR), keep), Boundary(keep)
    worst, piece = _deepest(paths, distinct(paths, every), edge, top, underside)
    if worst is None or worst.depth <= SLICE or fall(paths, piece).max() <= SLICE:
        return worst
    least = _sliced(paths, piece, edge, top, underside)
    near = lines_within_radius(keep, paths.lines(every), paths.radius_at(every, top))
    return worst_of([least, _sliced(paths, every.only(near), edge, top, underside, least)])


def _sliced(
    paths: Paths, pieces: Pieces, edge: Boundary, top: float, underside: float, least: Gouge | None = None
) -> Gouge | None:
    """The deepest cut of any piece, each taken slice by slice; what of it goes through is taken as it is.

    Pieces that cannot be deeper than a known cut, ``least``, are left out.
    """
    low = paths.below(underside + NEAR, steps=np.unique(pieces.step))
    through, _ = _deepest(paths, distinct(paths, low), edge, top, underside, FINE)
    worst, above = worst_of([least, through]), underside + 2 * NEAR
    deep = top - np.maximum(pieces.low, above)
    some = slices(paths, pieces.only(deep > (worst.depth if worst else 0.0)))
    some = Pieces(some.step, some.first, some.last, np.maximum(some.low, above))
    return worst_of([worst, _deepest(paths, distinct(paths, some), edge, top, underside, FINE)[0]])


def _deepest(
    paths: Paths, pieces: Pieces, edge: Boundary, top: float, underside: float, spacing: float = COARSE
) -> tuple[Gouge | None, Pieces]:
    """The deepest cut of any piece, each taken at its lowest all along, and the piece that makes it."""
    floor = underside + NEAR
    most = np.round(np.where(pieces.low <= floor, THROUGH, top - pieces.low) / NEAR)
    order: Ints = np.lexsort((pieces.step, -most))
    worst, deepest = -1, 0.0
    for lot in lots(paths, pieces.only(order)):
        now = order[lot]
        if worst >= 0:  # of moves that cut equally deep the first is to blame
            deeper, alike = (most[now] > deepest / NEAR + more for more in (1, -1))
            now = now[deeper | alike & (pieces.step[now] < pieces.step[worst])]
        if not now.size:
            continue
        depth = _depths(paths, pieces.only(now), edge, top, floor, spacing)
        alike = now[depth >= max(depth.max(), deepest) - NEAR]
        if depth.max() > 0 and alike.size:
            first = int(alike[np.argmin(pieces.step[alike])])  # of those that cut equally deep
            if depth.max() > deepest + NEAR or pieces.step[first] < pieces.step[worst]:
                worst = first
            deepest = max(deepest, float(depth.max()))
    if worst < 0:
        return None, pieces.only(order[:0])
    one = pieces.only(np.array([worst]))
    x, y = edge.nearest(paths.lines(one)[0])
    depth = _depths(paths, one, edge, top, floor, FINEST)
    return Gouge(float(depth[0]), int(one.step[0]), (x, y, float(one.low[0]))), one


def fall(paths: Paths, pieces: Pieces) -> Array:
    """(m,) by how much each piece rises or falls, mm."""
    height: Array = np.abs(paths.end[pieces.step, 2] - paths.start[pieces.step, 2])
    return height * (pieces.last - pieces.first)


def slices(paths: Paths, pieces: Pieces) -> Pieces:
    """The same pieces, cut where they rise or fall by :data:`SLICE`."""
    falls = fall(paths, pieces)
    count = np.maximum(np.ceil(falls / max(SLICE, float(falls.sum()) / MOST_SLICES)), 1).astype(np.int64)
    owner = np.repeat(np.arange(len(pieces)), count)
    number = np.arange(owner.size) - np.repeat(np.cumsum(count) - count, count)
    step, width = pieces.step[owner], ((pieces.last - pieces.first) / count)[owner]
    first = pieces.first[owner] + width * number
    last = np.where(number == count[owner] - 1, pieces.last[owner], first + width)
    z0, z1 = paths.start[step, 2], paths.end[step, 2]
    low = np.minimum(z0 + (z1 - z0) * first, z0 + (z1 - z0) * last)
    return Pieces(step, first, last, np.maximum(low, pieces.low[owner]))


def lots(paths: Paths, pieces: Pieces) -> Iterator[Ints]:
    """Indices of pieces, in order and in lots: a few first, then so many corners as memory is for.

    Arcs have corners, and memory must not go with their number.
    """
    lot = np.cumsum(paths.corners(pieces)) // MOST_CORNERS + (np.arange(len(pieces)) >= FIRST_ASKED)
    yield from np.split(np.arange(len(pieces)), np.flatnonzero(np.diff(lot)) + 1)


def _depths(paths: Paths, pieces: Pieces, edge: Boundary, top: float, floor: float, spacing: float) -> Array:
    """How deep each piece cuts into a shape below a height, mm; 0 or less where it does not.

    Places of an axis that goes inside of the shape are ``spacing`` mm apart.
    """
    radius, deep = paths.radius_at(pieces, top), np.where(pieces.low <= floor, THROUGH, top - pieces.low)
    lines = paths.lines(pieces)
    gap = np.full(len(pieces), np.inf)
    inside = edge.inside(lines)
    gap[inside] = 0.0
    # Where a cutter is wider than it goes deep it does not matter how far inside its axis is.
    inner = inside[radius[inside] < deep[inside]]
    if inner.size:
        some = radius[inner], deep[inner]
        gap[inner] = -_depth_inside(paths, pieces.only(inner), edge, *some, spacing)
    beside = np.setdiff1d(lines_within_radius(edge.shape, lines, radius), inside, assume_unique=True)
    if beside.size:
        gap[beside] = edge.distance(lines[beside], within=float(radius.max()))
    shape = paths.cutters(pieces.step)
    end = np.where(shape.nose > 0, shape.height_at(np.maximum(gap, 0.0)), 0.0)
    depth: Array = np.minimum(radius - gap, deep - end)
    return depth


def _about(paths: Paths, pieces: Pieces, keep: Shape) -> Pieces:
    """The pieces that the rectangle around a shape does not tell apart from it."""
    least, most = paths.extent(pieces.step)
    reach = paths.radius[pieces.step, None] + NEAR
    x0, y0, x1, y1 = keep.bounds
    apart = (least > np.array((x1, y1)) + reach) | (most < np.array((x0, y0)) - reach)
    return pieces.only(np.flatnonzero(~apart.any(axis=1)))


def lines_within_radius(keep: Shape, lines: Geometries, radius: Array) -> Ints:
    """Indices of the lines that come within their radius (m,) of a shape."""
    near = np.zeros(radius.size, dtype=np.bool_)
    for one in np.unique(radius).tolist():
        mine = np.flatnonzero(radius == one)
        if mine.size > shapely.get_num_coordinates(keep) / DEAR:
            # Whether a line meets a shape is known much sooner than whether it comes near one.
            around = prepared(grow(keep, one + 2 * ROUND))
            near[mine] = shapely.intersects(around, lines[mine])
        else:
            near[mine] = shapely.dwithin(keep, lines[mine], one)
    return np.flatnonzero(near)


def distinct(paths: Paths, pieces: Pieces) -> Pieces:
    """Each plan-view piece once, at its lowest: passes repeat at every depth."""
    pieces = pieces.only(np.argsort(pieces.low, kind="stable"))
    return pieces.only(kinds(paths, pieces)[0])


def kinds(paths: Paths, pieces: Pieces) -> tuple[Ints, Ints]:
    """The first piece (k,) of each kind in plan view, and the kind (n,) of every piece."""
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
    return first_of_each(np.round(table / NEAR).astype(np.int64))


def _depth_inside(
    paths: Paths, pieces: Pieces, edge: Boundary, radius: Array, deep: Array, spacing: float
) -> Array:
    """How far each piece goes inside the shape, mm, where it may be the deepest cut; elsewhere at least.

    Too little by at most half of ``spacing``, mm, or of a :data:`MOST_PLACES` part of a long piece. No place
    between two is deeper than half of the sum of their depths and of their distance, so halves of a line are
    left alone that cannot reach what is found already. A piece is left alone as well where its width
    ``radius`` (m,) is more than it goes ``deep`` (m,).
    """
    points, owner = paths.points(pieces)
    joined = np.flatnonzero(owner[1:] == owner[:-1])
    owner, start, end = owner[joined], points[joined], points[joined + 1]
    length = np.hypot(*(end - start).T)
    slack = np.maximum(spacing, np.bincount(owner, length, len(pieces)) / MOST_PLACES) / 2
    out = np.zeros(len(pieces))
    first, last = _signed(edge, start), _signed(edge, end)
    np.maximum.at(out, owner, np.maximum(first, last))
    while owner.size:
        most, found = (first + last + length) / 2, out[owner]
        best = np.minimum(radius + out, deep).max() - NEAR
        kept = (most > found + slack[owner]) & (radius[owner] + found < deep[owner])
        kept &= np.minimum(radius[owner] + most, deep[owner]) > best
        owner, start, end, first, last = (each[kept] for each in (owner, start, end, first, last))
        length = length[kept] / 2
        middle = (start + end) / 2
        between = _signed(edge, middle)
        np.maximum.at(out, owner, between)
        owner, length = np.tile(owner, 2), np.tile(length, 2)
        start, end = np.concatenate((start, middle)), np.concatenate((middle, end))
        first, last = np.concatenate((first, between)), np.concatenate((between, last))
    return out


def _signed(edge: Boundary, points: Array) -> Array:
    """How far places (k, 2) lie inside a shape, mm; below 0 outside of it."""
    spots = shapely.points(points)
    away = edge.distance(spots)
    depth: Array = np.where(shapely.intersects(edge.shape, spots), away, -away)
    return depth


RAMP_SPACING = 0.005
"""Distance of the places, mm: between two of them a slope of 45 degrees rises by no more than the gouge
limit."""
RAMP_MARGIN = 0.1
"""A move is looked at if its cutter comes so near to a tab, mm: more than the chords of arcs are off."""


def deepest_in_tab(paths: Paths, tab: Tab) -> Gouge | None:
    """The deepest cut of any move into a ramped tab; None if nothing touches it."""
    pieces = paths.below(tab.top - NEAR)
    radius = paths.radius[pieces.step]
    near = shapely.dwithin(tab.shape, paths.lines(pieces), radius + RAMP_MARGIN)
    worst: Gouge | None = None
    for step in np.unique(pieces.step[near]).tolist():
        points, z, _ = paths.samples(np.array([step]), RAMP_SPACING)
        depth = tab.least_z(points, float(paths.radius[step])) - z
        # The tab's strips end where its shape does: beyond, and in openings, there is nothing to cut.
        depth[~shapely.dwithin(tab.shape, shapely.points(points), float(paths.radius[step]))] = -np.inf
        deep = int(np.argmax(depth))
        if depth[deep] > (worst.depth if worst else 0.0):
            x, y = points[deep].tolist()
            worst = Gouge(float(depth[deep]), int(step), (x, y, float(z[deep])))
    return worst
