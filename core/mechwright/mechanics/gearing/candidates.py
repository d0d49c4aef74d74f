"""Which edges a turning point can meet: those of its ring and its sector about the axis, in an index."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array

Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class Seen:
    """Points as seen from the axis: columns (n,), mm, and the group of each."""

    x: Array
    y: Array
    radius: Array
    group: Ints

    @classmethod
    def of(cls, points: Array, group: Ints) -> "Seen":
        """Points (n, 2), mm."""
        x, y = np.ascontiguousarray(points.T)
        return cls(x, y, np.hypot(x, y), group)


def candidates(queries: Seen, starts: Seen, ends: Seen, ring: float, sight: float) -> tuple[Ints, Ints]:
    """Pairs of query and edge of one group where the query's radius lies on the edge, in order of queries."""
    nothing = np.empty(0, dtype=np.int64)
    if not (queries.x.size and starts.x.size):
        return nothing, nothing
    radius = queries.radius
    low, high = np.minimum(starts.radius, ends.radius), np.maximum(starts.radius, ends.radius)
    base = min(radius.min(), low.min())
    rings = int((max(radius.max(), high.max()) - base) / ring) + 1
    # Sectors about the mean direction of each group, each as wide as the sight at its least radius.
    groups = int(max(queries.group.max(), starts.group.max())) + 1
    towards = [np.bincount(queries.group, values, groups) for values in (queries.x, queries.y)]
    centre = np.arctan2(towards[1], towards[0])
    nearest = np.full(groups, np.inf)
    np.minimum.at(nearest, queries.group, radius)
    width = np.minimum(sight / np.maximum(nearest, sight), 1.0)
    width[np.isinf(nearest)] = 1.0
    sectors = 2 * int(np.pi / width.min()) + 5

    def sector(x: Array, y: Array, group: Ints) -> Ints:
        turn = np.arctan2(y, x) - centre[group] + math.pi
        turn += math.tau * ((turn < 0).astype(float) - (turn >= math.tau))
        numbers: Ints = np.floor((turn - math.pi) / width[group]).astype(np.int64) + sectors // 2
        return numbers

    first, last = ((low - base) / ring).astype(np.int64), ((high - base) / ring).astype(np.int64)
    spans = last - first + 1
    edge = np.repeat(np.arange(low.size), spans)
    key = (starts.group * rings + first)[edge] + count_up(spans)
    key = key * sectors + sector((starts.x + ends.x) / 2, (starts.y + ends.y) / 2, starts.group)[edge]
    order = np.argsort(key, kind="stable")
    key, edge = key[order], edge[order]
    wanted = queries.group * rings + ((radius - base) / ring).astype(np.int64)
    wanted = wanted * sectors + sector(queries.x, queries.y, queries.group)
    begin = np.searchsorted(key, wanted - 2, "left")
    counts = np.searchsorted(key, wanted + 2, "right") - begin
    query = np.repeat(np.arange(radius.size), counts)
    edge = edge[np.repeat(begin - (np.cumsum(counts) - counts), counts) + np.arange(query.size)]
    # Half open, so that a corner belongs to one edge only.
    at = radius[query]
    cut = np.flatnonzero((low[edge] <= at) & (at < high[edge]))
    return query[cut], edge[cut]


def count_up(counts: Ints) -> Ints:
    """0, 1, … counts[0] - 1, 0, 1, … counts[1] - 1, and so on."""
    ends = np.cumsum(counts)
    numbers: Ints = np.arange(ends[-1] if ends.size else 0) - np.repeat(ends - counts, counts)
    return numbers
