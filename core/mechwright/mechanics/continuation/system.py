"""Systems of equations with parameters, in doubles for many points at once and in balls for one.

Numbers that carry their slopes: sums, products and quotients follow the rules of differentiation.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from flint import acb, acb_mat
from numpy.typing import NDArray

from mechwright.mechanics.planar import Plane


class Slope:
    """A number and its derivatives by some variables, in doubles for many points at once or in balls for one.

    Parameters
    ----------
    value
        (n,) complex, or one ball.
    slopes
        (m, n) complex, or (m,) balls: the derivatives by each of the variables.

    Examples
    --------
    >>> import numpy as np
    >>> x = Slope(np.array([3.0 + 0j]), np.array([[1.0 + 0j]]))
    >>> y = 1 / (x * x - 5)
    >>> [float(one.real) for one in (y.value[0], y.slopes[0, 0])]
    [0.25, -0.375]
    """

    __slots__ = ("slopes", "value")
    __array_ufunc__ = None

    def __init__(self, value: Any, slopes: Any) -> None:
        self.value, self.slopes = value, slopes

    def __add__(self, other: Any) -> "Slope":
        if isinstance(other, Slope):
            return Slope(self.value + other.value, self.slopes + other.slopes)
        return Slope(self.value + other, self.slopes)

    __radd__ = __add__

    def __neg__(self) -> "Slope":
        return Slope(-self.value, -self.slopes)

    def __sub__(self, other: Any) -> "Slope":
        found: Slope = self + (-other)
        return found

    def __rsub__(self, other: Any) -> "Slope":
        found: Slope = -self + other
        return found

    def __mul__(self, other: Any) -> "Slope":
        if isinstance(other, Slope):
            return Slope(self.value * other.value, self.slopes * other.value + other.slopes * self.value)
        return Slope(self.value * other, self.slopes * other)

    __rmul__ = __mul__

    def __rtruediv__(self, other: Any) -> "Slope":
        inverse = 1 / self.value
        found: Slope = Slope(inverse, self.slopes * (-inverse * inverse)) * other
        return found

    def __truediv__(self, other: Any) -> "Slope":
        found: Slope = self * (1 / other)
        return found


Balls = NDArray[np.object_]


@dataclass(frozen=True)
class System:
    """As many equations as unknowns, rational in unknowns and parameters.

    Parameters
    ----------
    equations
        Unknowns and parameters, two sequences, to the values that are to be 0. It adds, subtracts, multiplies
        and divides alone.
    """

    equations: Callable[[Sequence[Any], Sequence[Any]], Sequence[Any]]

    def at(self, unknowns: Plane, parameters: Plane, way: Plane) -> tuple[Plane, Plane, Plane]:
        """Values, slopes and rates at many points.

        Parameters
        ----------
        unknowns
            (n, m).
        parameters
            (n, k), moving at the rates ``way`` (k,).

        Returns
        -------
        values, slopes, along
            (n, m), (n, m, m), and (n, m) the rates of the values where the unknowns stand.
        """
        n, m = unknowns.shape
        unit = np.eye(m + 1, dtype=complex)[:, :, None]
        spread = np.ones(n)
        z = [Slope(unknowns[:, i], unit[i] * spread) for i in range(m)]
        p = [Slope(parameters[:, i], unit[m] * way[i] * spread) for i in range(way.size)]
        found = self.equations(z, p)
        values = np.stack([one.value for one in found], axis=1)
        slopes = np.stack([one.slopes for one in found], axis=0).transpose(2, 0, 1)
        return values, slopes[:, :, :m], slopes[:, :, m]

    def in_balls(self, unknowns: Balls, parameters: Balls) -> tuple[Balls, acb_mat]:
        """Values (m,) and slopes at unknowns (m,) and parameters (k,)."""
        m = len(unknowns)
        z = [
            Slope(one, np.array([acb(int(i == k)) for k in range(m)], dtype=object))
            for i, one in enumerate(unknowns)
        ]
        found = self.equations(z, list(parameters))
        values = np.array([one.value for one in found], dtype=object)
        return values, acb_mat(m, m, [entry for one in found for entry in one.slopes])
