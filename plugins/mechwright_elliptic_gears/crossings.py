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
from numpy.typing import NDArray

from mechwright.motion import Array

Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class Free:
    """For each query (n,) the turn, rad, to the nearest edge of each kind, inf where there is none, and its
    normal distance, mm, to that edge.
    """

    leaving_behind: Array
    entering_behind: Array
    leaving_ahead: Array
    entering_ahead: Array
    distance_behind: Array
    distance_ahead: Array


def turns_to_edges(
    queries: Array, query_group: Ints, starts: Array, ends: Array, edge_group: Ints, ring: float
) -> Free:
    """Measure every query against every edge of its group that its circle cuts.

    Parameters
    ----------
    queries
        (n, 2), mm, from the axis.
    query_group, edge_group
        Groups (n,) and (m,), 0 and up.
    starts, ends
        End points (m, 2), mm, of the edges.
    ring
        Height, mm, of the rings in which edges are looked up: about one edge.
    """
    n = len(queries)
    radius = np.hypot(*queries.T)
    inner, outer = np.hypot(*starts.T), np.hypot(*ends.T)
    query, edge = _candidates(radius, query_group, inner, outer, edge_group, ring)
    a, d, r = starts[edge], ends[edge] - starts[edge], radius[query]
    # |a + t d| = r; the root between 0 and 1, starting from the secant, two Newton steps.
    t = (r - inner[edge]) / (outer[edge] - inner[edge])
    dd, ad, aa = np.einsum("ni,ni->n", d, d), np.einsum("ni,ni->n", a, d), inner[edge] ** 2
    for _ in range(2):
        rate = ad + t * dd
        t = t - (aa + t * (2 * ad + t * dd) - r * r) / (2 * np.where(rate == 0, np.inf, rate))
    met = a + t[:, None] * d
    q = queries[query]
    turn = np.arctan2(q[:, 0] * met[:, 1] - q[:, 1] * met[:, 0], np.einsum("ni,ni->n", q, met))
    # Normal distance of a short arc to an edge: its length times the radial share of the edge's direction.
    normal = np.abs(turn) * np.abs(np.einsum("ni,ni->n", met, d)) / np.sqrt(dd)
    leaves, ahead = outer[edge] < inner[edge], turn > 0

    def least(values: Array, chosen: NDArray[np.bool_]) -> Array:
        result = np.full(n, np.inf)
        np.minimum.at(result, query[chosen], values[chosen])
        return result

    size = np.abs(turn)
    return Free(
        least(size, leaves & ~ahead),
        least(size, ~leaves & ~ahead),
        least(size, leaves & ahead),
        least(size, ~leaves & ahead),
        least(normal, ~ahead),
        least(normal, ahead),
    )


def _candidates(
    radius: Array, query_group: Ints, inner: Array, outer: Array, edge_group: Ints, ring: float
) -> tuple[Ints, Ints]:
    """Pairs of query and edge of one group where the query's radius lies on the edge."""
    low, high = np.minimum(inner, outer), np.maximum(inner, outer)
    base = min(radius.min(initial=np.inf), low.min(initial=np.inf))
    top = max(radius.max(initial=base), high.max(initial=base))
    rings = int((top - base) / ring) + 1
    first, last = ((low - base) / ring).astype(np.int64), ((high - base) / ring).astype(np.int64)
    spans = last - first + 1
    edge = np.repeat(np.arange(low.size), spans)
    key = edge_group[edge] * rings + first[edge] + _count_up(spans)
    order = np.argsort(key, kind="stable")
    key, edge = key[order], edge[order]
    wanted = query_group * rings + ((radius - base) / ring).astype(np.int64)
    begin = np.searchsorted(key, wanted, "left")
    counts = np.searchsorted(key, wanted, "right") - begin
    query = np.repeat(np.arange(radius.size), counts)
    edge = edge[begin[query] + _count_up(counts)]
    # Half open, so that a corner belongs to one edge only.
    cut = (low[edge] <= radius[query]) & (radius[query] < high[edge])
    return query[cut], edge[cut]


def _count_up(counts: Ints) -> Ints:
    """0, 1, … counts[0] - 1, 0, 1, … counts[1] - 1, and so on."""
    ends = np.cumsum(counts)
    numbers: Ints = np.arange(ends[-1] if ends.size else 0) - np.repeat(ends - counts, counts)
    return numbers
