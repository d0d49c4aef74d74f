"""The law that moves the slider of a slider-crank at constant speed over a part of its stroke.

The crank turns with the driven gear. With crank 1 and rod l, t from the outer dead centre,

    x(t) = cos t + √(l² - sin² t),  x = x(t_a) - V (φ + β/2),  t = acos[(x² + 1 - l²)/(2 x)],

V = (x(t_a) - x(t_b))/β over the input β, the ratio is i = -V/x'(t). What remains of the turn is a polynomial
of degree six in φ that meets i, i' and i'' on both sides and closes the turn.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.optimize import brentq

from mechwright import Array
from mechwright.mechanics.gearing import RatioLaw


@dataclass(frozen=True)
class SliderLaw(RatioLaw):
    """Constant speed of a slider.

    Parameters
    ----------
    rod
        Rod over crank, above 1.
    start, end
        Angles t_a and t_b of the crank, rad from the outer dead centre, 0 < t_a < t_b < π.
    width
        β, rad of the driver, in which the crank goes from one to the other; its middle is φ = 0.
    """

    lobes: tuple[int, int]
    rod: float
    start: float
    end: float
    width: float

    def _place(self, t: "float | Array") -> tuple[Array, Array, Array, Array]:
        """X and its derivatives by t up to the third."""
        sin, cos = np.sin(t), np.cos(t)
        q = np.sqrt(self.rod**2 - sin**2)
        one, two = sin * cos, cos**2 - sin**2
        q1 = -one / q
        q2 = -(two + q1**2) / q
        q3 = -(-4 * one + 3 * q1 * q2) / q
        return cos + q, -sin + q1, -cos + q2, sin + q3

    @cached_property
    def speed(self) -> float:
        """V, cranks for each rad of the driver."""
        return float(self._place(self.start)[0] - self._place(self.end)[0]) / self.width

    @property
    def fastest(self) -> float:
        """Angle of the crank, rad, at which a crank of constant speed moves the slider fastest: x'' = 0."""
        return float(brentq(lambda t: float(self._place(t)[2]), 0.0, math.pi))

    def _crank(self, phi: Array) -> Array:
        x: Array = self._place(self.start)[0] - self.speed * (phi + self.width / 2)
        return np.asarray(np.arccos((x * x + 1 - self.rod**2) / (2 * x)))

    def _inside(self, phi: Array) -> tuple[Array, Array, Array]:
        _, first, second, third = self._place(self._crank(phi))
        i = -self.speed / first
        di = -second * i**2 / first
        return i, di, -(third * i**3 + 3 * second * i * di) / first

    @cached_property
    def _return(self) -> Array:
        """Coefficients (7,) in x = (φ - β/2)/(2π - β), the lowest first."""
        half, rest = self.width / 2, math.tau - self.width
        leave = [float(one) for one in self._inside(np.asarray(half))]
        meet = [float(one) for one in self._inside(np.asarray(-half))]
        rows = np.zeros((7, 7))
        power = np.arange(7.0)
        for order in range(3):
            factor = np.prod([power - k for k in range(order)], axis=0) if order else np.ones(7)
            rows[order, order] = factor[order]
            rows[3 + order] = factor
        rows[6] = 1 / (power + 1)
        area = (math.tau - (self.end - self.start)) / rest
        scale = [1.0, rest, rest**2]
        values = [v * s for v, s in zip(leave, scale, strict=True)]
        values += [v * s for v, s in zip(meet, scale, strict=True)]
        return np.asarray(np.linalg.solve(rows, [*values, area]), dtype=np.float64)

    @property
    def breaks(self) -> tuple[float, ...]:
        """Both ends of the stroke."""
        return (self.width / 2, math.tau - self.width / 2)

    def rates(self, phi: Array) -> tuple[Array, Array, Array]:
        """Of the stroke, or of the polynomial of the return."""
        turned = np.mod(np.asarray(phi, dtype=float) + self.width / 2, math.tau) - self.width / 2
        half, rest = self.width / 2, math.tau - self.width
        inside = turned <= half
        stroke = self._inside(np.where(inside, turned, 0.0))
        x = np.where(inside, 0.0, (turned - half) / rest)
        back = np.polynomial.Polynomial(self._return)
        found = []
        for order, one in enumerate(stroke):
            return_ = back.deriv(order)(x) / rest**order if order else back(x)
            found.append(np.where(inside, one, return_))
        return found[0], found[1], found[2]
