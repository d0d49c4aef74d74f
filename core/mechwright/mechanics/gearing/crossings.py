"""Where circles about an axis cut polylines: how far a point may turn before it meets an edge.

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

from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.gearing.candidates import Ints, Seen, candidates


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
