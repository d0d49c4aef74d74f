"""The law that gives a straight Geneva wheel behind the pair the least acceleration.

The crank of the wheel turns with the driven gear. With n slots, L = sin(π/n), x the crank's angle from mid
index, |x| ≤ π/2 - π/n, and q = L exp(-i x), the wheel stands at

    w(x) = arg(1 - q),  w' = Re(q/(1 - q)),  w'' = Im(q/(1 - q)²),  w''' = -Re(q (1 + q)/(1 - q)³).

The wheel is to accelerate by a constant, then to ramp through 0 in mid index, and to slow down by the same
constant: over the share v = φ/β of the index, -1/2 to 1/2, W'' = -Ca Δ/β² clip(v/b, -1, 1), Δ = 2π/n and

    Ca = 4/(1 - 4 b²/3),

where 4 is the least of any law. From W(φ) = w(x): i = W'/w', i' = (W'' - w'' i²)/w' and so on. At the ends of
the index both sides are 0. There the wheel has turned by Ca Δ τ²/(2 β²) at τ past the end, and x is a power
series in τ. Beyond the index a quintic leads from i, i', i'' to the constant that closes the turn.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mechwright import Array
from mechwright.mechanics.gearing import RatioLaw

_TERMS = 20
"""Of the series at the ends of the index."""

_NEAR = 0.05
"""rad of the driver from the ends of the index within which the series holds to rounding."""


@dataclass(frozen=True)
class IndexLaw(RatioLaw):
    """Least acceleration of a straight Geneva wheel.

    Parameters
    ----------
    slots
        n, 3 or more.
    ramp
        b, above 0 and below 1/2: half the share of the index over which the acceleration changes its sign.
    width
        β, rad of the driver, in which the wheel goes on by a slot; its middle is φ = 0.
    blend
        rad of the driver beyond each end of the index.
    """

    lobes: tuple[int, int]
    slots: int
    ramp: float
    width: float
    blend: float

    @property
    def constant(self) -> float:
        """Ca."""
        return 4 / (1 - 4 * self.ramp**2 / 3)

    @property
    def way(self) -> float:
        """Δ, rad."""
        return math.tau / self.slots

    @cached_property
    def _series(self) -> Array:
        """Terms (k,) of the ratio in τ past an end of the index, the lowest first."""
        entry = math.sin(math.pi / self.slots) * np.exp(1j * (math.pi / 2 - math.pi / self.slots))
        order = np.arange(_TERMS + 1)
        factorial = np.array([math.factorial(k) for k in order], dtype=float)
        q = entry * (-1j) ** order / factorial  # of q past the end
        q[0] = entry
        inverse = np.zeros(_TERMS + 1, dtype=complex)  # of 1/(1 - q)
        inverse[0] = 1 / (1 - entry)
        for k in range(1, _TERMS + 1):
            inverse[k] = inverse[0] * np.dot(q[1 : k + 1], inverse[k - 1 :: -1][:k])
        slope = inverse.real  # w' = Re(1/(1 - q)) - 1
        turned = slope[1:] / (order[1:] + 1)  # w past the end, over ξ²
        # The square root of w is as τ: √(Ca Δ/(2 β²)) τ = ξ g(ξ).
        root = np.zeros(_TERMS)
        root[0] = math.sqrt(turned[0])
        for k in range(1, _TERMS):
            root[k] = (turned[k] - np.dot(root[1:k], root[k - 1 : 0 : -1])) / (2 * root[0])
        scale = math.sqrt(self.constant * self.way / 2) / self.width
        return _inverted(root) * scale ** order[1:] * order[1:]

    def _wheel(self, v: Array) -> tuple[Array, Array, Array, Array]:
        """Angle that the wheel still has to its end, and W', W'', W''' at shares v (...) from -1/2 to 0."""
        b, most, away = self.ramp, self.constant, -v
        ramps = away < b
        before = most * (0.5 - away)
        first = np.where(ramps, most * (0.5 - b + (b * b - v * v) / (2 * b)), before)
        inside = most * ((0.5 - b) * away + (b * b * away - away**3 / 3) / (2 * b))
        left = np.where(ramps, 0.5 - inside, most * (0.5 - away) ** 2 / 2)
        second = most * np.minimum(away / b, 1.0)
        third = np.where(ramps, -most / b, 0.0)
        way, beta = self.way, self.width
        return way * left, way / beta * first, way / beta**2 * second, way / beta**3 * third

    def _entering(self, past: Array) -> tuple[Array, Array, Array]:
        """The ratio and its derivatives at angles (...), 0 to β/2, past the first end of the index."""
        left, first, second, third = self._wheel(np.minimum(past / self.width - 0.5, 0.0))
        stands = math.pi / self.slots - left
        lever = math.sin(math.pi / self.slots)
        # L² - sin² w in the form that does not cancel.
        over = 2 * np.cos((math.pi / self.slots + stands) / 2) * np.sin(left / 2) * (lever + np.sin(stands))
        turned = np.arctan2(np.sqrt(over), np.sin(stands)) - left
        q = lever * np.exp(1j * (math.pi / 2 - math.pi / self.slots - turned))
        rest = 1 - q
        w1, w2, w3 = (q / rest).real, (q / rest**2).imag, -(q * (1 + q) / rest**3).real
        with np.errstate(divide="ignore", invalid="ignore"):
            i = first / w1
            di = (second - w2 * i * i) / w1
            ddi = (third - w3 * i**3 - 3 * w2 * i * di) / w1
        near = past < min(_NEAR, (0.5 - self.ramp) * self.width)  # the wheel's acceleration is constant there
        found = []
        for order, one in enumerate((i, di, ddi)):
            terms = np.polynomial.polynomial.polyder(self._series, order)
            found.append(np.where(near, np.polynomial.polynomial.polyval(past, terms), one))
        return found[0], found[1], found[2]

    @cached_property
    def _end(self) -> tuple[float, float, float]:
        """The ratio and its derivatives at the second end of the index."""
        i, di, ddi = (float(one) for one in self._entering(np.asarray(0.0)))
        return i, -di, ddi

    @property
    def beyond(self) -> float:
        """The constant ratio: half of the rest of the crank's turn is π/2 + π/n."""
        i, di, ddi = self._end
        bl, rest = self.blend, math.pi - self.width / 2
        taken = bl * i / 2 + bl**2 * di / 10 + bl**3 * ddi / 120
        return (math.pi / 2 + math.pi / self.slots - taken) / (rest - bl / 2)

    @property
    def breaks(self) -> tuple[float, ...]:
        """Ends of the ramp, of the index and of the blends."""
        ends = (self.ramp * self.width, self.width / 2, min(self.width / 2 + self.blend, math.pi))
        return (*ends, *(math.tau - one for one in reversed(ends)))

    @cached_property
    def _blending(self) -> np.polynomial.Polynomial:
        """The quintic over the share of the blend."""
        i, di, ddi = self._end
        bl = self.blend
        start = np.array([1.0, 0, 0, -10, 15, -6])
        terms = i * start + self.beyond * (np.array([1.0, 0, 0, 0, 0, 0]) - start)
        terms += bl * di * np.array([0, 1.0, 0, -6, 8, -3])
        terms += bl**2 * ddi * np.array([0, 0, 0.5, -1.5, 1.5, -0.5])
        return np.polynomial.Polynomial(terms)

    def rates(self, phi: Array) -> tuple[Array, Array, Array]:
        """Of the index, of a blend, or constant: the same on both sides of mid index."""
        turned = np.mod(np.asarray(phi, dtype=float) + math.pi, math.tau) - math.pi
        away, side = np.abs(turned), np.where(turned < 0, -1.0, 1.0)
        half = self.width / 2
        inside = away <= half
        stroke = self._entering(np.where(inside, half - away, 0.0))
        share = np.clip((away - half) / self.blend, 0.0, 1.0)
        found = []
        for order, one in enumerate(stroke):
            curve = self._blending.deriv(order) if order else self._blending
            sign = (-1.0) ** order
            found.append(np.where(inside, sign * one, curve(share) / self.blend**order))
        return found[0], side * found[1], found[2]


def _inverted(root: Array) -> Array:
    """Terms (k,) of x = c1 y + c2 y² + ..., where y = x (r0 + r1 x + ...): by Lagrange's formula.

    >>> _inverted(np.array([1.0, 1.0, 0.0])).tolist()  # of x + x²
    [1.0, -1.0, 2.0]
    """
    count = root.size
    one = np.zeros(count)  # of 1/(r0 + r1 x + ...)
    one[0] = 1 / root[0]
    for k in range(1, count):
        one[k] = -one[0] * np.dot(root[1 : k + 1], one[k - 1 :: -1][:k])
    power, found = np.zeros(count), np.zeros(count)
    power[0] = 1.0
    for k in range(1, count + 1):
        power = np.convolve(power, one)[:count]
        found[k - 1] = power[k - 1] / k
    return found
