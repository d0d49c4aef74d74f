"""Polynomial laws."""

from collections.abc import Sequence
from functools import cache

import numpy as np
from numpy.polynomial import Polynomial as Poly

from mechwright.arrays import Array
from mechwright.mechanics.laws.law import UnbrokenLaw

_REAL = 1e-7
"""Imaginary part below which a root of a polynomial is a real one; double roots come out 1e-8 apart."""


class Polynomial(UnbrokenLaw):
    """s = c0 + c1 u + c2 u² + ….

    Parameters
    ----------
    coefficients
        c0, c1, …; at least two.

    Examples
    --------
    >>> Polynomial([0, 0, 3, -2]).peaks.v
    1.5
    """

    def __init__(self, coefficients: Sequence[float], name: str = "polynomial") -> None:
        self.name = name
        self.coefficients = tuple(float(c) for c in coefficients)
        s = Poly(self.coefficients)
        self._orders = [s, *(s.deriv(order) for order in range(1, 5))]

    def _turning(self, order: int) -> Array:
        """Values of a derivative at the ends and where it turns."""
        roots = self._orders[order + 1].trim().roots()
        inner = roots.real[np.abs(roots.imag) <= _REAL]
        inner = inner[(inner > 0) & (inner < 1)]
        values: Array = self._orders[order](np.concatenate(([0.0, 1.0], inner)))
        return values


@cache
def poly345() -> Polynomial:
    """S = 10u³ - 15u⁴ + 6u⁵: velocity and acceleration are 0 at both ends."""
    return Polynomial((0, 0, 0, 10, -15, 6), "3-4-5")


@cache
def poly4567() -> Polynomial:
    """S = 35u⁴ - 84u⁵ + 70u⁶ - 20u⁷: the jerk is 0 at both ends as well."""
    return Polynomial((0, 0, 0, 0, 35, -84, 70, -20), "4-5-6-7")
