"""Least squares from many starts at once: Levenberg and Marquardt's method on a whole batch.

All starts take their steps together in one numpy call each, so that a start costs microseconds; those that
have arrived or given up leave the batch.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array

Residual = Callable[[Array], Array]
"""Unknowns (n, m) to residuals (n, k); not finite where the unknowns mean nothing."""

Slopes = Callable[[Array], Array]
"""Unknowns (n, m) to the derivatives (n, k, m) of the residuals."""

DIFFERENCE = 1e-7
"""Step of the forward differences, for unknowns of the order of one: half the digits of a double."""

FIRST_DAMPING = 1e-2
"""Marquardt's λ at the start, relative to the diagonal: there, Newton's step would lie."""

MOST_DAMPING = 1e9
"""λ at which a start has given up: its steps no longer move."""

LONGEST_STEP = 1.0
"""Most that an unknown may change in a step: a radian, or a factor e of a length."""

HOPELESS_AFTER, HOPELESS = 25, 1e-2
"""Steps after which a start whose residuals still add up to this much is dropped: a thousand times cheaper
than to follow it into a far local minimum."""


def least_squares(
    residual: Residual,
    starts: Array,
    steps: int,
    arrived: float,
    alive: Callable[[float], None] | None = None,
    slopes: Slopes | None = None,
) -> tuple[Array, Array]:
    """Minimise the sum of squares from each start.

    Parameters
    ----------
    residual
        The residuals, dimensionless and of the order of one or less.
    starts
        (n, m) unknowns.
    steps
        Most steps to take.
    arrived
        Sum of squares at which a start is done.
    alive
        Told now and then how much of the work is done, 0 to 1.
    slopes
        The residuals' derivatives; without them they are forward differences, which stall at half the digits
        where the solution is badly conditioned.

    Returns
    -------
    unknowns
        (n', m): of the starts that mean something, in no order.
    costs
        (n',): their sums of squares.

    Examples
    --------
    >>> x, cost = least_squares(lambda x: x**2 - 2, np.array([[1.0], [-3.0]]), 30, 1e-28)
    >>> sorted(x.round(12).ravel().tolist())
    [-1.414213562373, 1.414213562373]
    """
    with np.errstate(all="ignore"):
        return _minimise(residual, slopes, starts, steps, arrived, alive)


def _minimise(
    residual: Residual,
    slopes: Slopes | None,
    x: Array,
    steps: int,
    arrived: float,
    alive: Callable[[float], None] | None,
) -> tuple[Array, Array]:
    r, cost = _costs(residual, x)
    good = np.isfinite(cost)
    x, r, cost = x[good], r[good], cost[good]
    damping = np.full(len(x), FIRST_DAMPING)
    finished = []
    for step in range(steps):
        slope = slopes(x) if slopes else _differences(residual, x, r)
        lost = ~np.isfinite(slope).all(axis=(1, 2))
        slope[lost] = 0
        change = _step(slope, r, damping)
        r_next, cost_next = _costs(residual, x + change)
        better = cost_next < cost
        x = np.where(better[:, None], x + change, x)
        r = np.where(better[:, None], r_next, r)
        cost = np.where(better, cost_next, cost)
        damping = np.where(better, damping / 5, damping * 4)
        done = (cost <= arrived) | lost | (damping > MOST_DAMPING)
        if step == HOPELESS_AFTER:
            done |= cost > HOPELESS
        if done.any():
            finished.append((x[done], cost[done]))
            x, r, cost, damping = (values[~done] for values in (x, r, cost, damping))
        if alive:
            alive((step + 1) / steps)
        if not len(x):
            break
    finished.append((x, cost))
    return np.concatenate([one for one, _ in finished]), np.concatenate([one for _, one in finished])


def _differences(residual: Residual, x: Array, r: Array) -> Array:
    shifts = DIFFERENCE * np.eye(x.shape[1])
    return np.stack([(residual(x + shift) - r) / DIFFERENCE for shift in shifts], axis=-1)


def _costs(residual: Residual, x: Array) -> tuple[Array, Array]:
    r = residual(x)
    cost = np.einsum("nk,nk->n", r, r)
    return r, np.where(np.isfinite(cost), cost, np.inf)


def _step(slope: Array, r: Array, damping: Array) -> Array:
    normal = slope.transpose(0, 2, 1) @ slope
    diagonal = np.einsum("nii->ni", normal)
    # What the residuals do not depend on still needs a pivot; it then stays where it is.
    ridge = damping[:, None] * diagonal + np.finfo(float).tiny + 1e-15 * diagonal.max(axis=1, keepdims=True)
    gradient = (r[:, None, :] @ slope)[:, 0]
    normal = normal + ridge[:, :, None] * np.eye(slope.shape[2])
    change = -np.linalg.solve(normal, gradient[:, :, None])[:, :, 0]
    length = np.abs(change).max(axis=1, keepdims=True)
    limited: Array = change * np.minimum(1.0, LONGEST_STEP / np.maximum(length, LONGEST_STEP))
    return limited


def distinct(rows: Array, tolerance: float) -> NDArray[np.intp]:
    """Indices of rows (n, m) of which no earlier kept one is within ``tolerance`` in every column.

    >>> distinct(np.array([[1.0, 2.0], [1.0, 2.0000001], [1.0, 3.0]]), 1e-5).tolist()
    [0, 2]
    """
    kept: list[int] = []
    for index, row in enumerate(rows):
        if not kept or np.abs(rows[kept] - row).max(axis=1).min() > tolerance:
            kept.append(index)
    return np.array(kept, dtype=np.intp)
