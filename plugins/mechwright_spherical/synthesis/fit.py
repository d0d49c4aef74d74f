"""Least squares from one start, for residuals that are computed for many designs at once."""

from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.optimize import least_squares

from mechwright import Array

SLOPE = 1e-6
"""Step of central differences, rad: their error is 1e-10, and Newton's steps converge all the same."""

ABSURD = 10.0
"""Residual of a design that cannot be assembled: five diameters of the sphere, so that no step there is
taken."""


def assembled(residuals: Array) -> Array:
    """The residuals, with ``ABSURD`` for those of a design that cannot be assembled."""
    return np.where(np.isfinite(residuals), residuals, ABSURD)


def fitted(residuals: Callable[[Array], Array], x: Array, precision: float, most: int, **how: Any) -> Array:
    """The unknowns (k,) with the least sum of squares near the start ``x``.

    Parameters
    ----------
    residuals
        Unknowns (k, designs) to residuals (designs, m).
    precision
        All tolerances of the solver.
    most
        Evaluations, at most.
    how
        Method or bounds of the solver.
    """
    steps = SLOPE * np.concatenate([np.eye(x.size), -np.eye(x.size)], axis=1)

    def jacobian(at: Array) -> Array:
        values = residuals(at[:, None] + steps)
        return np.asarray((values[: x.size] - values[x.size :]).T / (2 * SLOPE))

    found = least_squares(
        lambda at: residuals(at[:, None])[0],
        x,
        jac=jacobian,
        xtol=precision,
        ftol=precision,
        gtol=precision,
        max_nfev=most,
        **how,
    )
    return np.asarray(found.x)
