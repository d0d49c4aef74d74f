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

from dataclasses import dataclass, replace

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.gearing.candidates import Ints, candidates


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
    inner, outer, radius = (np.hypot(*points.T) for points in (starts, ends, queries))
    query, edge = candidates(queries, query_group, starts, ends, edge_group, ring, sight)
    ax, ay = starts[edge].T
    qx, qy = queries[query].T
    dx, dy = (ends - starts)[edge].T
    from_inner, to_outer, r = inner[edge], outer[edge], radius[query]
    # |a + t d| = r has one root on an edge that only rises or only falls. Rising, a·d is not below 0 and r is
    # not below |a|, falling it is the other way round: this form then has no difference of near numbers.
    dd, ad, rest = dx * dx + dy * dy, ax * dx + ay * dy, (from_inner - r) * (from_inner + r)
    root = np.abs(ad) + np.sqrt(np.maximum(ad * ad - dd * rest, 0.0))
    t = np.minimum(np.abs(rest) / np.where(root == 0, np.inf, root), 1.0)
    mx, my = ax + t * dx, ay + t * dy
    turn = np.arctan2(qx * my - qy * mx, qx * mx + qy * my)
    # A short arc's normal distance to an edge: its length times the radial share of the edge's direction.
    normal = np.abs(turn * (mx * dx + my * dy)) / np.sqrt(dd)
    size, leaves, ahead = np.abs(turn), to_outer < from_inner, turn > 0
    groups = _Groups.of(query, len(queries))
    free = Free(
        groups.least(np.where(leaves & ~ahead, size, np.inf)),
        groups.least(np.where(leaves | ahead, np.inf, size)),
        groups.least(np.where(leaves & ahead, size, np.inf)),
        groups.least(np.where(ahead & ~leaves, size, np.inf)),
        np.empty(0),
    )
    nearest = np.minimum(
        np.minimum(free.leaving_behind, free.entering_behind),
        np.minimum(free.leaving_ahead, free.entering_ahead),
    )
    return replace(free, distance=groups.least(np.where(size <= nearest[query], normal, np.inf)))


@dataclass(frozen=True, slots=True)
class _Groups:
    """Runs of equal numbers in a sorted array: the pairs of each query."""

    first: Ints
    number: Ints
    count: int

    @classmethod
    def of(cls, sorted_numbers: Ints, count: int) -> "_Groups":
        starts = np.flatnonzero(np.diff(sorted_numbers, prepend=-1))
        return cls(starts, sorted_numbers[starts], count)

    def least(self, values: Array) -> Array:
        """Least value of each run, inf for a number without one: (count,)."""
        result = np.full(self.count, np.inf)
        if self.first.size:
            result[self.number] = np.minimum.reduceat(values, self.first)
        return result


def _monotone(starts: Array, ends: Array, group: Ints) -> tuple[Array, Array, Ints]:
    """Cut edges that come nearest to the axis between their ends there, so that a circle cuts each once."""
    along = ends - starts
    at, square = -(starts * along).sum(axis=1), (along * along).sum(axis=1)
    two = np.flatnonzero((at > 0) & (at < square))
    foot = starts[two] + (at[two] / square[two])[:, None] * along[two]
    first = ends.copy()
    first[two] = foot
    return np.concatenate((starts, foot)), np.concatenate((first, ends[two])), np.append(group, group[two])
