"""Where two gears meet in given positions: play, depth and gap, from the edges near contact.

Where circles about an axis cut polylines: how far a point may turn before it meets an edge.

Glossary
--------
query
    A point that turns about the origin.
edge
    A directed piece of a counter-clockwise outline: the material lies on its left. Where the edge runs
    outwards a turning point enters the material, where it runs inwards it leaves.
group
    Queries and edges meet only within their group (one position of the mechanism).
behind, ahead
    Found by turning clockwise, counter-clockwise, from the query.
"""

import math
from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.gearing.candidates import Ints, Seen, candidates
from mechwright.mechanics.gearing.zone import Near
from mechwright.tolerances import TOLERANCES


@dataclass(frozen=True, slots=True)
class Free:
    """What each query (n,) meets.

    Parameters
    ----------
    leaving_behind, entering_behind, leaving_ahead, entering_ahead
        Turn, rad, to the nearest edge of each kind; inf where there is none.
    distance
        Distance from the nearest edge of all along its normal, mm.
    """

    leaving_behind: Array
    entering_behind: Array
    leaving_ahead: Array
    entering_ahead: Array
    distance: Array


def turns_to_edges(
    queries: Array, query_group: Ints, starts: Array, ends: Array, edge_group: Ints, ring: float, sight: float
) -> Free:
    """Measure every query (n, 2), mm from the axis, against every edge of its group that its circle cuts.

    Groups (n,) and (m,) count from 0. ``ring`` is the height, mm, of the rings in which edges are looked up:
    about one edge. Edges nearer than ``sight``, mm along the circle, are surely found, some up to twice as
    far; edges are shorter than that.
    """
    starts, ends, edge_group = _monotone(starts, ends, edge_group)
    own, inner, outer = (
        Seen.of(*points) for points in ((queries, query_group), (starts, edge_group), (ends, edge_group))
    )
    query, edge = candidates(own, inner, outer, ring, sight)
    # What belongs to an edge alone is found once for each, not once for each pair.
    along_x, along_y = outer.x - inner.x, outer.y - inner.y
    square, product = along_x * along_x + along_y * along_y, inner.x * along_x + inner.y * along_y
    ax, ay, dx, dy, dd, ad = (
        of_edges[edge] for of_edges in (inner.x, inner.y, along_x, along_y, square, product)
    )
    qx, qy, r, from_inner = own.x[query], own.y[query], own.radius[query], inner.radius[edge]
    # |a + t d| = r has one root on an edge that only rises or only falls. Rising, a·d is not below 0 and r is
    # not below |a|, falling it is the other way round: this form then has no difference of near numbers.
    rest = (from_inner - r) * (from_inner + r)
    root = np.abs(ad) + np.sqrt(np.maximum(ad * ad - dd * rest, 0.0))
    root[root == 0] = np.inf
    t = np.minimum(np.abs(rest) / root, 1.0)
    mx, my = ax + t * dx, ay + t * dy
    turn = np.arctan2(qx * my - qy * mx, qx * mx + qy * my)
    size, leaves, ahead = np.abs(turn), (outer.radius < inner.radius)[edge], turn > 0
    # The four kinds in the order of Free: entering after leaving, ahead after behind.
    kind = 2 * ahead + ~leaves
    kinds = np.full((4, len(queries)), np.inf)
    np.minimum.at(kinds.ravel(), kind * len(queries) + query, size)
    closest = np.flatnonzero(size <= kinds.min(axis=0)[query])
    # A short arc's normal distance to an edge: its length times the radial share of the edge's direction.
    mx, my, dx, dy, dd, turn = (values[closest] for values in (mx, my, dx, dy, dd, turn))
    distance = np.full(len(queries), np.inf)
    np.minimum.at(distance, query[closest], np.abs(turn * (mx * dx + my * dy)) / np.sqrt(dd))
    return Free(kinds[0], kinds[1], kinds[2], kinds[3], distance)


def _monotone(starts: Array, ends: Array, group: Ints) -> tuple[Array, Array, Ints]:
    """Cut edges that come nearest to the axis between their ends there, so that a circle cuts each once."""
    (sx, sy), (ex, ey) = np.ascontiguousarray(starts.T), np.ascontiguousarray(ends.T)
    dx, dy = ex - sx, ey - sy
    at, square = -(sx * dx + sy * dy), dx * dx + dy * dy
    two = np.flatnonzero((at > 0) & (at < square))
    foot = starts[two] + (at[two] / square[two])[:, None] * (ends - starts)[two]
    first = ends.copy()
    first[two] = foot
    return np.concatenate((starts, foot)), np.concatenate((first, ends[two])), np.append(group, group[two])


_PAIRS = 1 << 18
"""Points and edges whose distances are found at a time: a few MB, which stay near the processor."""

_FEW_PAIRS = 1 << 20
"""Points and edges, multiplied, up to which all are compared with all."""

_CHUNK = 4096
"""Points whose nearest edges are found at a time."""

_SIGHT = 0.5
"""Pitches: half the least arc on both sides of a point in which it looks for edges."""


def contact(
    driver: Near, driven: Near, count: int, pitch: float, allowance: float
) -> tuple[Array, Array, Array, Array]:
    """Play ahead and behind, depth and gap (count,) of some positions."""
    edge = np.hypot(*(driven.ends - driven.starts).T)
    ring = float(edge.mean()) if edge.size else math.inf
    ahead, behind = np.full(count, np.inf), np.full(count, np.inf)
    depth, gap = np.zeros(count), np.full(count, np.inf)
    groups, turns, distances, blind = [], [], [], []
    for own, other, moving in ((driver, driven, False), (driven, driver, True)):
        group = own.position
        free = turns_to_edges(
            own.points, group, other.starts, other.ends, other.edge_position, ring, _SIGHT * pitch
        )
        # The driven gear turning ahead brings its leaving edges to points of the driver that lie ahead of
        # them, and its own points to entering edges of the driver.
        forward = free.entering_ahead if moving else free.leaving_behind
        backward = free.leaving_behind if moving else free.entering_ahead
        # A point stands in material if the edges on both sides say so; one side may have none in sight.
        # It is freed over the nearer edge, the driven gear turning one way for its own points and the other
        # way for points of the driver.
        over, under = free.leaving_ahead, free.entering_behind
        nearer = np.minimum(over, under)
        inside = (over <= free.entering_ahead) & (under <= free.leaving_behind)
        way = nearer * np.hypot(*own.points.T)
        inside &= np.isfinite(way)
        blind.append(~np.isfinite(np.minimum(way, free.distance)))
        # The way to the outline along the circle is no depth where the circle hardly cuts it.
        deep = np.flatnonzero(inside & (way > allowance))
        distance = np.where(inside, np.minimum(free.distance, way), free.distance)
        distance[deep] = depths(own.points[deep], group[deep], other.starts, other.ends, other.edge_position)
        inside[deep] = distance[deep] > 0
        retreats = inside & ((under <= over) if moving else (over <= under))
        advances = inside & ~retreats
        forward = np.where(retreats, -nearer, np.where(advances, np.inf, forward))
        backward = np.where(advances, -nearer, np.where(retreats, np.inf, backward))
        np.minimum.at(ahead, group, forward)
        np.minimum.at(behind, group, backward)
        np.maximum.at(depth, group[inside], distance[inside])
        groups.append(group)
        turns.append(np.minimum(forward, backward))
        distances.append(np.where(inside, 0.0, np.abs(distance)))
    # Of a tooth that reaches below the other's roots, the end sees no edge to be freed over.
    for own, other, unseen in ((driver, driven, blind[0]), (driven, driver, blind[1])):
        points = np.flatnonzero(unseen & (depth > allowance)[own.position])
        group = own.position[points]
        np.maximum.at(
            depth, group, depths(own.points[points], group, other.starts, other.ends, other.edge_position)
        )
    # The gap is where the least turn is: elsewhere the arcs are too long to be measured along a normal.
    group, turn = np.concatenate(groups), np.concatenate(turns)
    closest = turn <= np.minimum(ahead, behind)[group]
    np.minimum.at(gap, group[closest], np.concatenate(distances)[closest])
    return ahead, behind, depth, gap


def depths(points: Array, group: Ints, starts: Array, ends: Array, edge_group: Ints) -> Array:
    """Distance (n,), mm, of points from the outline's nearest edge: positive in material, negative outside.

    Parameters
    ----------
    points
        (n, 2), mm.
    group, edge_group
        Groups (n,) and (m,); points and edges meet only within their group. -inf for a point without edges.
    starts, ends
        End points (m, 2), mm, of edges of a counter-clockwise outline: material lies on their left.

    Examples
    --------
    >>> corners = np.array([[0.0, 0.0], [4.0, 0.0], [4.0, 2.0], [0.0, 2.0]])
    >>> points, one = np.array([[1.0, 0.5], [5.0, -1.0]]), np.zeros(2, dtype=np.int64)
    >>> ends, four = np.roll(corners, -1, axis=0), np.zeros(4, dtype=np.int64)
    >>> depths(points, one, corners, ends, four).round(3).tolist()
    [0.5, -1.414]
    """
    result = np.full(len(points), -np.inf)
    for number in np.unique(group):
        own, edges = np.flatnonzero(group == number), np.flatnonzero(edge_group == number)
        if not edges.size:
            continue
        if own.size * edges.size > _FEW_PAIRS:
            result[own] = _signed_near(points[own], starts[edges], ends[edges])
            continue
        for some in np.array_split(own, -(-own.size * edges.size // _PAIRS)):
            result[some] = _signed(points[some], starts[edges], ends[edges])
    return result


def _signed_near(points: Array, starts: Array, ends: Array) -> Array:
    """What ``_signed`` gives of many points and edges: only edges that may be the nearest are looked at."""
    from scipy.spatial import cKDTree

    middles, half = (starts + ends) / 2, float(np.hypot(*(ends - starts).T).max()) / 2
    tree = cKDTree(middles)
    # The nearest edge is no farther than the nearest middle, and its middle at most half an edge farther.
    reach = (tree.query(points)[0] + half) * (1 + TOLERANCES.noise) + TOLERANCES.noise
    result = np.empty(len(points))
    for some in np.array_split(np.arange(len(points)), -(-len(points) // _CHUNK)):
        near = tree.query_ball_point(points[some], reach[some], return_sorted=True)
        counts = np.array([len(one) for one in near])
        edges = np.zeros((counts.size, counts.max()), np.intp)
        there = np.arange(edges.shape[1]) < counts[:, None]
        edges[there] = np.concatenate(near)
        edges = np.where(there, edges, edges[:, :1])  # the first again, where a point has fewer
        result[some] = _signed(points[some], starts[edges], ends[edges])
    return result


def _signed(points: Array, starts: Array, ends: Array) -> Array:
    """Depths (n,) of points (n, 2) by the nearest of edges (k, 2), or of edges (n, k, 2) of their own."""
    along = ends - starts
    square = (along * along).sum(axis=-1)
    # Along and across each edge: a point's place in the edge's own frame.
    length = np.sqrt(square)
    (c, s), (x, y) = np.moveaxis(along, -1, 0) / length, points.T[..., None]
    u = c * x + s * y - (c * starts[..., 0] + s * starts[..., 1])
    left = c * y - s * x - (c * starts[..., 1] - s * starts[..., 0])
    beyond = np.maximum(np.maximum(u - length, -u), 0.0)
    distance = np.sqrt(beyond * beyond + left * left)
    # Where two edges are equally near, the point is nearest to their corner: it lies on the side of the one
    # whose line is farther from it.
    least = distance.min(axis=1, keepdims=True)
    edge = np.where(distance <= least + TOLERANCES.noise, np.abs(left), -1.0).argmax(axis=1)
    signed: Array = np.copysign(least[:, 0], left[np.arange(len(points)), edge])
    return signed
