"""Numbers that carry their slopes: sums, products and quotients follow the rules of differentiation."""

from typing import Any


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
