"""Which designs are best where several things count: no other is as good in all and better in one."""

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array

_BLOCK = 512
"""Designs that are compared with all others at once."""


def front_of(costs: Array) -> NDArray[np.int64]:
    """Numbers of the designs that no other dominates, in order.

    Parameters
    ----------
    costs
        (n, k): the less the better. Designs with a cost that is no number are none. Of designs with the same
        costs all are in the front.
    """
    real = np.flatnonzero(np.isfinite(costs).all(axis=1))
    # Whatever dominates a design comes before it in this order, so that one pass over it is enough.
    order = real[np.lexsort(costs[real].T[::-1])]
    kept = np.empty((0, costs.shape[1]))
    found: list[NDArray[np.int64]] = []
    for start in range(0, order.size, _BLOCK):
        block = order[start : start + _BLOCK]
        free = block[~_dominated(costs[block], kept)]
        free = free[~_dominated(costs[free], costs[free])]
        found.append(free)
        kept = np.vstack([kept, costs[free]])
    return np.sort(np.concatenate(found)) if found else np.empty(0, dtype=np.int64)


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
    while len(chosen) < min(count, size):
        far = np.linalg.norm(ranks[:, None] - ranks[chosen][None], axis=2).min(axis=1)
        far[chosen] = -1.0
        chosen.append(int(np.argmax(far)))
    return chosen
