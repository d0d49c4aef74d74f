"""A value with its first three derivatives by one variable, carried through arithmetic exactly."""

from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array


@dataclass(frozen=True)
class Jet:
    """A value (...) and its derivatives (...) of first to third order.

    Products follow Leibniz; a function of a jet follows Faà di Bruno,
    (g∘f)''' = g''' f'³ + 3 g'' f' f'' + g' f'''.

    Examples
    --------
    >>> x = Jet.variable(np.array(2.0))
    >>> cube = x * x * x
    >>> [float(one) for one in (cube.value, cube.first, cube.second, cube.third)]
    [8.0, 12.0, 12.0, 6.0]
    """

    value: Array
    first: Array
    second: Array
    third: Array

    @staticmethod
    def variable(at: Array) -> "Jet":
        """The variable itself."""
        zero = np.zeros_like(at)
        return Jet(at, zero + 1, zero, zero)

    @staticmethod
    def constant(value: float, like: "Jet") -> "Jet":
        """A number, in the shape of another jet."""
        zero = np.zeros_like(like.value)
        return Jet(zero + value, zero, zero, zero)

    def through(self, value: Array, first: Array, second: Array, third: Array) -> "Jet":
        """A function of this, of which value and derivatives at :attr:`value` are given."""
        one, two, three = self.first, self.second, self.third
        return Jet(
            value,
            first * one,
            second * one**2 + first * two,
            third * one**3 + 3 * second * one * two + first * three,
        )

    def __neg__(self) -> "Jet":
        return Jet(-self.value, -self.first, -self.second, -self.third)

    def __add__(self, other: "Jet | float") -> "Jet":
        if not isinstance(other, Jet):
            return Jet(self.value + other, self.first, self.second, self.third)
        return Jet(
            self.value + other.value,
            self.first + other.first,
            self.second + other.second,
            self.third + other.third,
        )

    __radd__ = __add__

    def __sub__(self, other: "Jet | float") -> "Jet":
        return self + (-other)

    def __rsub__(self, other: float) -> "Jet":
        return -self + other

    def __mul__(self, other: "Jet | float") -> "Jet":
        if not isinstance(other, Jet):
            return Jet(other * self.value, other * self.first, other * self.second, other * self.third)
        f, f1, f2, f3 = self.value, self.first, self.second, self.third
        g, g1, g2, g3 = other.value, other.first, other.second, other.third
        return Jet(
            f * g,
            f1 * g + f * g1,
            f2 * g + 2 * f1 * g1 + f * g2,
            f3 * g + 3 * f2 * g1 + 3 * f1 * g2 + f * g3,
        )

    __rmul__ = __mul__

    def __truediv__(self, other: "Jet") -> "Jet":
        return self * other**-1.0

    def __pow__(self, other: "Jet | float") -> "Jet":
        if isinstance(other, Jet):
            steady = not (np.any(other.first) or np.any(other.second) or np.any(other.third))
            if not steady or np.ptp(other.value) > 0:
                return (self.log() * other).exp()
            other = float(np.ravel(other.value)[0])
        factors, found = [1.0, other, other * (other - 1), other * (other - 1) * (other - 2)], []
        for order, factor in enumerate(factors):
            # x⁰ at 0 is 1, and a derivative whose factor is 0 is 0 wherever x is.
            found.append(factor * self.value ** (other - order) if factor else np.zeros_like(self.value))
        return self.through(*found)

    def sin(self) -> "Jet":
        """Sine."""
        sin, cos = np.sin(self.value), np.cos(self.value)
        return self.through(sin, cos, -sin, -cos)

    def cos(self) -> "Jet":
        """Cosine."""
        sin, cos = np.sin(self.value), np.cos(self.value)
        return self.through(cos, -sin, -cos, sin)

    def exp(self) -> "Jet":
        """Exponential function."""
        grown = np.exp(self.value)
        return self.through(grown, grown, grown, grown)

    def log(self) -> "Jet":
        """Natural logarithm."""
        x = self.value
        return self.through(np.log(x), 1 / x, -1 / x**2, 2 / x**3)

    def tanh(self) -> "Jet":
        """Hyperbolic tangent, without the overflow of its exponentials."""
        t = np.tanh(self.value)
        return self.through(t, 1 - t * t, -2 * t * (1 - t * t), (1 - t * t) * (6 * t * t - 2))

    def asin(self) -> "Jet":
        """Inverse sine, by the derivative of which the others follow."""
        x = self.value
        q = 1 - x * x
        return self.through(np.arcsin(x), q**-0.5, x * q**-1.5, (1 + 2 * x * x) * q**-2.5)

    def atan(self) -> "Jet":
        """Inverse tangent."""
        x = self.value
        q = 1 + x * x
        return self.through(np.arctan(x), 1 / q, -2 * x / q**2, (6 * x * x - 2) / q**3)
