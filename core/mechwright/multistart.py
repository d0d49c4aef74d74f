"""Systems of equations from very many starting points at once.

A synthesis has many solutions and no good first guess. Here all starts go through the steps of a damped
least-squares method (Levenberg and Marquardt) together, as rows of arrays, so that a thousand starts take
little longer than one.
"""

from collections.abc import Callable

import numpy as np

from mechwright.motion import Array

Equations = Callable[[Array], Array]
"""Residuals (n, m) of rows of unknowns (n, k); NaN where there are none."""

_DIFFERENCE = 6e-6
"""Relative step of central differences: the cube root of a double's rounding, where both errors balance."""

_DONE = 1e-26
"""A sum of squares below this is rounding: residuals of 1e-13 and smaller."""


def solve_all(equations: Equations, starts: Array, rounds: int = 60) -> tuple[Array, Array]:
    """Bring every start to a minimum of the sum of squares.

    Parameters
    ----------
    equations
        The residuals, of size about 1 where they are bad.
    starts
        (n, k).
    rounds
        Most steps of a start.

    Returns
    -------
    found, error
        Unknowns (n, k), and the largest residual of each (n,), infinite where a start had none.

    Examples
    --------
    >>> found, error = solve_all(lambda x: x**2 - 2, np.array([[1.0], [-5.0]]))
    >>> found.round(9).ravel().tolist(), bool((error < 1e-12).all())
    ([1.414213562, -1.414213562], True)
    """
    x = np.array(starts, dtype=float)
    f = equations(x)
    cost, damping = _cost(f), np.full(len(x), 1e-2)
    for _ in range(rounds):
        # Damping beyond all measure means that the start is stuck.
        rows = np.flatnonzero((cost > _DONE) & np.isfinite(cost) & (damping < 1e12))
        if rows.size == 0:
            break
        step = _step(equations, x[rows], f[rows], damping[rows])
        trial = x[rows] + step
        value = equations(trial)
        better = _cost(value) < cost[rows]
        taken, kept = rows[better], rows[~better]
        x[taken], f[taken], cost[taken] = trial[better], value[better], _cost(value[better])
        damping[taken] /= 5
        damping[kept] *= 4
    return x, np.where(np.isfinite(cost), np.abs(f).max(axis=1), np.inf)


def _cost(f: Array) -> Array:
    cost: Array = np.einsum("nm,nm->n", f, f)
    return np.where(np.isfinite(cost), cost, np.inf)


def _step(equations: Equations, x: Array, f: Array, damping: Array) -> Array:
    """The damped step of every row; none where a derivative is missing."""
    n, k = x.shape
    h = _DIFFERENCE * (1 + np.abs(x))
    moved = x[:, None, :] + np.concatenate((np.eye(k), -np.eye(k)))[None] * h[:, None, :]
    values = equations(moved.reshape(-1, k)).reshape(n, 2, k, -1)
    slope = (values[:, 0] - values[:, 1]) / (2 * h[:, :, None])
    slope = np.where(np.isfinite(slope).all(axis=(1, 2), keepdims=True), slope, 0.0)
    normal = np.einsum("nim,njm->nij", slope, slope)
    scale = np.einsum("nii->ni", normal)
    # A direction without any effect gets a step of 0, not a division by it.
    added = damping[:, None] * scale + np.finfo(float).tiny + 1e-300
    matrix = normal + np.eye(k) * np.where(scale > 0, added, 1.0)[:, None, :]
    right = -np.einsum("nim,nm->ni", slope, f)
    try:
        return np.asarray(np.linalg.solve(matrix, right[:, :, None])[:, :, 0], dtype=np.float64)
    except np.linalg.LinAlgError:
        inverse = np.linalg.pinv(matrix)
        return np.asarray(np.einsum("nij,nj->ni", inverse, right), dtype=np.float64)


def distinct(rows: Array, tolerance: float) -> Array:
    """Indices (m,) of rows (n, k) that differ from all earlier ones by more than ``tolerance`` relative.

    >>> distinct(np.array([[1.0, 2.0], [1.0, 2.0 + 1e-12], [1.0, 3.0]]), 1e-9).tolist()
    [0, 2]
    """
    kept: list[int] = []
    for number, row in enumerate(rows):
        scale = tolerance * (1 + np.abs(row).max())
        if all(np.abs(rows[other] - row).max() > scale for other in kept):
            kept.append(number)
    return np.array(kept, dtype=int)
