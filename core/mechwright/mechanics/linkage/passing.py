"""How the input of a linkage comes through positions in their order (rectification)."""

import math
from collections.abc import Iterable

import numpy as np

from mechwright.arrays import Array

EDGE = 1e-9
"""rad. Positions may stand so far beyond a toggle: rounding."""


def passing(angles: Array, ranges: Iterable[tuple[float, float]] | None, ordered: bool = True) -> Array | str:
    """Input angles (n,), rad, one way from the first position to the last; else the defect.

    Parameters
    ----------
    angles
        (n,) input angles of the positions, rad, each up to whole turns.
    ranges
        Where the linkage can be assembled, from and to, rad; None for an input that turns fully.
    ordered
        Whether the positions have to be passed in their order.

    Returns
    -------
    Array or str
        ``circuit`` where the positions lie in ranges that are not connected, ``order`` where the input passes
        them in another order.

    >>> passing(np.array([0.0, 2.0, -2.0]), None).tolist() == [0.0, 2.0, math.tau - 2.0]
    True
    >>> passing(np.array([0.0, 2.0, 1.0]), [(-1.0, 3.0)]), passing(np.array([0.0, 2.0]), [(-1.0, 1.0)])
    ('order', 'circuit')
    """
    if ranges is None:
        return _turning(angles, ordered)
    for low, high in ranges:
        middle = (low + high) / 2
        inside = middle + np.array([math.remainder(x - middle, math.tau) for x in angles])
        if (inside >= low - EDGE).all() and (inside <= high + EDGE).all():
            steps = np.diff(inside)
            if ordered and not ((steps > 0).all() or (steps < 0).all()):
                return "order"
            return "order" if np.ptp(inside) == 0 else inside
    return "circuit"


def _turning(angles: Array, ordered: bool) -> Array | str:
    for sense in (1, -1):
        steps = np.mod(sense * np.diff(angles), math.tau)
        if not ordered or steps.sum() < math.tau:
            turned: Array = angles[0] + sense * np.concatenate(([0.0], np.cumsum(steps)))
            return turned
    return "order"
