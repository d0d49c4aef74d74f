"""Polynomial laws."""

from collections.abc import Sequence
from functools import cache, cached_property

import numpy as np
from numpy.polynomial import Polynomial as Poly
from numpy.typing import ArrayLike

from mechwright.arrays import Array
from mechwright.mechanics.laws.law import Law, Peaks, Rates, largest

_REAL = 1e-7
"""Imaginary part below which a root of a polynomial is a real one; double roots come out 1e-8 apart."""


class Polynomial(Law):
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
        self._orders = [Poly(self.coefficients)]
        for _ in range(4):
            self._orders.append(self._orders[-1].deriv())

    @property
    def breaks(self) -> tuple[float, ...]:
        """None: a polynomial is smooth throughout."""
        return ()

    def at(self, u: ArrayLike) -> Rates:
        """The rates at u (...)."""
        u = np.asarray(u, dtype=float)
        return Rates(*(order(u) for order in self._orders[:4]))

    def _turning(self, order: int) -> Array:
        """Values of a derivative at the ends and where it turns."""
        roots = self._orders[order + 1].trim().roots()
        inner = roots.real[np.abs(roots.imag) <= _REAL]
        inner = inner[(inner > 0) & (inner < 1)]
        values: Array = self._orders[order](np.concatenate(([0.0, 1.0], inner)))
        return values

    @cached_property
    def peaks(self) -> Peaks:
        """Largest velocity, acceleration and jerk, from the roots of the next derivative."""
        return Peaks(*(largest(self._turning(order)) for order in (1, 2, 3)))

    @cached_property
    def least_velocity(self) -> float:
        """The least ds/du."""
        return float(self._turning(1).min())


@cache
def poly345() -> Polynomial:
    """S = 10u³ - 15u⁴ + 6u⁵: velocity and acceleration are 0 at both ends."""
    return Polynomial((0, 0, 0, 10, -15, 6), "3-4-5")


@cache
def poly4567() -> Polynomial:
    """S = 35u⁴ - 84u⁵ + 70u⁶ - 20u⁷: the jerk is 0 at both ends as well."""
    return Polynomial((0, 0, 0, 0, 35, -84, 70, -20), "4-5-6-7")
