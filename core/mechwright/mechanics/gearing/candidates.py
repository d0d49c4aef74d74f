"""Which edges a turning point can meet: those of its ring and its sector about the axis, in an index."""

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array

Ints = NDArray[np.int64]


def candidates(
    queries: Array,
    query_group: Ints,
    starts: Array,
    ends: Array,
    edge_group: Ints,
    ring: float,
    sight: float,
) -> tuple[Ints, Ints]:
    """Pairs of query and edge of one group where the query's radius lies on the edge, in order of queries."""
    nothing = np.empty(0, dtype=np.int64)
    if not (len(queries) and len(starts)):
        return nothing, nothing
    radius, inner, outer = (np.hypot(*points.T) for points in (queries, starts, ends))
    low, high = np.minimum(inner, outer), np.maximum(inner, outer)
    base = min(radius.min(), low.min())
    rings = int((max(radius.max(), high.max()) - base) / ring) + 1
    # Sectors about the mean direction of each group, each as wide as the sight at its least radius.
    groups = int(max(query_group.max(), edge_group.max())) + 1
    towards = [np.bincount(query_group, values, groups) for values in queries.T]
    centre = np.arctan2(towards[1], towards[0])
    nearest = np.full(groups, np.inf)
    np.minimum.at(nearest, query_group, radius)
    width = np.minimum(sight / np.maximum(nearest, sight), 1.0)
    width[np.isinf(nearest)] = 1.0
    sectors = 2 * int(np.pi / width.min()) + 5

    def sector(points: Array, group: Ints) -> Ints:
        turn = np.arctan2(points[:, 1], points[:, 0]) - centre[group]
        turn = (turn + np.pi) % (2 * np.pi) - np.pi
        numbers: Ints = np.floor(turn / width[group]).astype(np.int64) + sectors // 2
        return numbers

    first, last = ((low - base) / ring).astype(np.int64), ((high - base) / ring).astype(np.int64)
    spans = last - first + 1
    edge = np.repeat(np.arange(low.size), spans)
    key = (edge_group * rings + first)[edge] + count_up(spans)
    key = key * sectors + sector((starts + ends) / 2, edge_group)[edge]
    order = np.argsort(key, kind="stable")
    key, edge = key[order], edge[order]
    wanted = query_group * rings + ((radius - base) / ring).astype(np.int64)
    wanted = wanted * sectors + sector(queries, query_group)
    begin = np.searchsorted(key, wanted - 2, "left")
    counts = np.searchsorted(key, wanted + 2, "right") - begin
    query = np.repeat(np.arange(radius.size), counts)
    edge = edge[begin[query] + count_up(counts)]
    # Half open, so that a corner belongs to one edge only.
    cut = (low[edge] <= radius[query]) & (radius[query] < high[edge])
    return query[cut], edge[cut]


def count_up(counts: Ints) -> Ints:
    """0, 1, … counts[0] - 1, 0, 1, … counts[1] - 1, and so on."""
    ends = np.cumsum(counts)
    numbers: Ints = np.arange(ends[-1] if ends.size else 0) - np.repeat(ends - counts, counts)
    return numbers
