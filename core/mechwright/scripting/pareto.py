"""Which designs are best where several things count: no other is as good as it in all and better in one."""

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array

_BLOCK = 512
"""Designs that are compared with all others at once, where more than three things count."""


def front_of(costs: Array) -> NDArray[np.int64]:
    """Numbers of the designs that no other dominates, in order.

    Parameters
    ----------
    costs
        (n, k): the less the better. Designs with a cost that is no number are none. Of designs with the same
        costs all are in the front.

    Up to three costs take about as long however many are in the front, as H. T. Kung, F. Luccio and F. P.
    Preparata have it in On finding the maxima of a set of vectors, 1975.
    """
    real = np.flatnonzero(np.isfinite(costs).all(axis=1))
    if not real.size:
        return np.empty(0, dtype=np.int64)
    # Whatever dominates a design comes before it in this order, so that one pass over it is enough.
    order = real[np.lexsort(costs[real].T[::-1])]
    sorted_ = costs[order]
    new = np.append(True, (sorted_[1:] != sorted_[:-1]).any(axis=1))
    different = sorted_[new]
    way = {1: _least, 2: _below, 3: _stairs}.get(costs.shape[1], _pairs)
    kept = way(different)[np.cumsum(new) - 1]
    return np.sort(order[kept]).astype(np.int64)


def _least(costs: Array) -> NDArray[np.bool_]:
    """Of different costs (n, 1) in order: the first."""
    return np.asarray(np.arange(len(costs)) == 0)


def _below(costs: Array) -> NDArray[np.bool_]:
    """Of different costs (n, 2) in order: those whose second is less than each before."""
    before = np.append(np.inf, np.minimum.accumulate(costs[:-1, 1]))
    return np.asarray(costs[:, 1] < before)


def _stairs(costs: Array) -> NDArray[np.bool_]:
    """Of different costs (n, 3) in order: those without one before that has neither second nor third greater.

    Least thirds of the first 1, 2, 4, ... seconds tell it, each of as many as the lowest bit of its number
    says (P. M. Fenwick, A new data structure for cumulative frequency tables, 1994).
    """
    _, rank = np.unique(costs[:, 1], return_inverse=True)
    size = int(rank.max()) + 1
    least = [np.inf] * (size + 1)
    kept = []
    for place, third in zip((rank.reshape(-1) + 1).tolist(), costs[:, 2].tolist(), strict=True):
        one, found = place, np.inf
        while one and found > third:
            found = min(found, least[one])
            one -= one & -one
        kept.append(found > third)
        one = place
        while found > third and one <= size and least[one] > third:
            least[one] = third
            one += one & -one
    return np.array(kept, dtype=bool)


def _pairs(costs: Array) -> NDArray[np.bool_]:
    """Of different costs (n, k) in order: each is compared with all that are kept before it."""
    kept, found = np.empty((0, costs.shape[1])), np.zeros(len(costs), dtype=bool)
    for start in range(0, len(costs), _BLOCK):
        block = np.arange(start, min(start + _BLOCK, len(costs)))
        free = block[~_dominated(costs[block], kept)]
        free = free[~_dominated(costs[free], costs[free])]
        found[free] = True
        kept = np.vstack([kept, costs[free]])
    return found


def _dominated(costs: Array, by: Array) -> NDArray[np.bool_]:
    """Which of some designs (n, k) one of others (m, k) dominates."""
    found = np.zeros(len(costs), dtype=bool)
    for start in range(0, len(by), 4 * _BLOCK):
        others = by[start : start + 4 * _BLOCK]
        as_good = np.all(others[None] <= costs[:, None], axis=2)
        better = np.any(others[None] < costs[:, None], axis=2)
        found |= np.any(as_good & better, axis=1)
    return found


def spread(costs: Array, count: int) -> list[int]:
    """Places of designs of a front that show it: the best of each cost, then those farthest from the others.

    Distances are those of ranks, so that units do not count and no gap swallows the rest.
    """
    size = len(costs)
    if size == 0 or count == 0:
        return []
    ranks = np.argsort(np.argsort(costs, axis=0, kind="stable"), axis=0, kind="stable") / max(size - 1, 1)
    chosen = list(dict.fromkeys(int(np.argmin(column)) for column in costs.T))[:count]
    far = np.full(size, np.inf)
    for one in chosen:
        far = np.minimum(far, np.linalg.norm(ranks - ranks[one], axis=1))
    while len(chosen) < min(count, size):
        far[chosen] = -1.0
        chosen.append(int(np.argmax(far)))
        far = np.minimum(far, np.linalg.norm(ranks - ranks[chosen[-1]], axis=1))
    return chosen
