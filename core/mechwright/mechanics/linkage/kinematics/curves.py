"""A number over the input between its samples: values, roots and extremes to rounding.

Between two samples the curve is the polynomial of the seventh degree with the value and three derivatives of
both ends (Hermite). Its error is h⁸ f⁽⁸⁾/(8! 2⁸) with the distance h of the samples: below 1e-12 of the size
with a sample for each degree. Near a dead point the derivatives grow without bound. An interval in which the
third one does not agree with the others is a straight line.
"""

from dataclasses import dataclass
from functools import cached_property
from math import tau
from typing import Any

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.planar.rigid import PointMotion, Turning

DEGREE = 7
PARTS = 4
"""Parts of an interval in which a change of sign is looked for: two roots in one part are overlooked."""
HALVINGS = 52
"""From a part to the last bit of an angle."""
ROUNDING = 1e-12
"""Of the greatest value: what is smaller has no sign."""
AGREES = 1e-3
"""Greatest part of the change over an interval by which the third derivatives may shift its middle."""
WHOLE = 1e-9
"""rad. A range this near to whole turns closes."""


def _right_end() -> Array:
    """The inverse of value and derivatives at the right end of the upper four coefficients."""
    orders = np.ones((4, 4))
    for order in range(1, 4):
        orders[order] = orders[order - 1] * (np.arange(4, 8) - order + 1)
    return np.asarray(np.linalg.inv(orders))


_UPPER = _right_end()


@dataclass(frozen=True)
class Curve:
    """A number over the input.

    Parameters
    ----------
    at
        Inputs (n,) in rising order, rad; over whole turns the first position is there again at the end.
    value, first, second, third
        The number and its derivatives by the input (..., n); leading axes are designs.
    """

    at: Array
    value: Array
    first: Array
    second: Array
    third: Array

    @classmethod
    def of_point(cls, at: Array, point: PointMotion, direction: Any = 0.0) -> "Curve":
        """The coordinate of a point along a direction, rad; its rates are those per unit of the input.

        >>> turning = np.linspace(0.0, 1.0, 3)
        >>> z = np.exp(1j * turning)
        >>> circle = Curve.of_point(turning, PointMotion(z, 1j * z, -z, -1j * z))
        >>> bool(abs(circle.at_input(0.3) - np.cos(0.3)) < 1e-9)
        True
        """
        turn = np.exp(-1j * direction)
        rates = (point.position, point.velocity, point.acceleration, point.jerk)
        return cls(at, *((one * turn).real for one in rates))

    @classmethod
    def of_turning(cls, at: Array, turning: Turning) -> "Curve":
        """The angle of a link, rad; its rates are those per unit of the input."""
        return cls(at, turning.theta, turning.omega, turning.alpha, turning.jerk)

    @property
    def closed(self) -> bool:
        """Whether the input goes through whole turns."""
        turns = (self.at[-1] - self.at[0]) / tau
        return bool(round(turns) >= 1 and abs(turns - round(turns)) * tau < WHOLE)

    @property
    def span(self) -> float:
        """The range of the input, rad."""
        return float(self.at[-1] - self.at[0])

    @cached_property
    def coefficients(self) -> Array:
        """Of powers of the share s of an interval that has been gone: (..., n - 1, 8), the constant first."""
        h = np.diff(self.at)
        scaled = [self.value, self.first * 1.0, self.second / 2, self.third / 6]
        powers = [h**order for order in range(4)]
        lower = [one[..., :-1] * power for one, power in zip(scaled, powers, strict=True)]
        ends = [self.value, self.first, self.second, self.third]
        left: list[Any] = []
        for order in range(4):
            reached = sum(_factor(power, order) * lower[power] for power in range(order, 4))
            left.append(ends[order][..., 1:] * powers[order] - reached)
        upper = np.einsum("kr,...r->...k", _UPPER, np.stack(left, axis=-1))
        found = np.concatenate([np.stack(lower, axis=-1), upper], axis=-1)
        return np.where(self._agrees(found)[..., None], found, self._straight())

    def _agrees(self, coefficients: Array) -> Array:
        """Whether the polynomial of the fifth degree, without the third derivative, has the same middle."""
        h = np.diff(self.at)
        (f, g), (f1, g1), (f2, g2) = (
            (one[..., :-1], one[..., 1:]) for one in (self.value, self.first, self.second)
        )
        fifth = (f + g) / 2 + 5 / 32 * h * (f1 - g1) + h**2 / 64 * (f2 + g2)
        change = np.max([np.abs(g - f), h * np.abs(f1), h * np.abs(g1)], axis=0)
        off = _horner(coefficients, np.asarray(0.5)) - fifth
        return np.asarray(np.abs(off) <= AGREES * change)

    def _straight(self) -> Array:
        """Coefficients of a straight line in each interval."""
        line = np.zeros((*np.diff(self.value).shape, DEGREE + 1))
        line[..., 0], line[..., 1] = self.value[..., :-1], np.diff(self.value)
        return line

    def derived(self, order: int) -> Array:
        """Coefficients (..., n - 1, 8 - order) of a derivative by the input."""
        h = np.diff(self.at)[:, None]
        powers = range(order, DEGREE + 1)
        factors = np.array([_factor(power, order) for power in powers], float)
        return np.asarray(self.coefficients[..., order:] * factors / h**order)

    def at_input(self, angle: Any, order: int = 0) -> Array:
        """The value, or a derivative, at inputs (..., k) or at one; over whole turns at any angle."""
        angle = np.asarray(angle, float)
        shape = np.broadcast_shapes((*self.value.shape[:-1], 1), angle.shape or (1,))
        inputs = np.broadcast_to(angle, shape)
        if self.closed:
            inputs = self.at[0] + np.mod(inputs - self.at[0], self.span)
        place = np.clip(np.searchsorted(self.at, inputs, side="right") - 1, 0, len(self.at) - 2)
        s = (inputs - self.at[place]) / np.diff(self.at)[place]
        table = self.derived(order)
        table = np.broadcast_to(table, (*shape[:-1], *table.shape[-2:]))
        found = _horner(np.take_along_axis(table, place[..., None], axis=-2), s)
        return found if angle.ndim else np.asarray(found[..., 0])

    def roots(self, order: int = 0, level: Any = 0.0) -> tuple[Array, Array]:
        """Where the value, or a derivative, goes through a level.

        Parameters
        ----------
        order
            Of the derivative.
        level
            A number, or one for each design (...,).

        Returns
        -------
        inputs, signs
            Both (..., k) in rising order, rad: +1 where the value rises through the level, -1 where it falls.
            NaN and 0 at the end of designs that have fewer.
        """
        table = self.derived(order)
        table[..., 0] -= np.asarray(level, float)[..., None] if np.ndim(level) else level
        shares = np.arange(PARTS) / PARTS
        inner = _horner(table[..., None, :], shares).reshape(*table.shape[:-2], -1)
        values = np.concatenate([inner, _horner(table[..., -1:, :], np.ones(1))], axis=-1)
        signs = self._signs(values)
        change = signs[..., 1:] * signs[..., :-1] < 0
        where = np.nonzero(change)
        interval, part = np.divmod(where[-1], PARTS)
        own = table[(*where[:-1], interval)]
        s = _bisected(own, part / PARTS, signs[where])
        inputs = self.at[interval] + s * np.diff(self.at)[interval]
        found = np.full(change.shape, np.nan)
        found[where] = inputs
        rises = np.where(change, signs[..., 1:], 0.0)
        return _gathered(found, rises)

    def _signs(self, values: Array) -> Array:
        """Signs (..., m); a zero has that of the value before it, a first one that of the end or the next."""
        values = np.where(np.isfinite(values), values, 0.0)
        size = np.max(np.abs(values), axis=-1, keepdims=True)
        signs = np.where(np.abs(values) > ROUNDING * size, np.sign(values), 0.0)
        indices = np.arange(signs.shape[-1])
        last = np.maximum.accumulate(np.where(signs != 0, indices, -1), axis=-1)
        known = np.take_along_axis(signs, np.maximum(last, 0), axis=-1)
        first = np.argmax(signs != 0, axis=-1)[..., None]
        begin = known[..., -1:] if self.closed else np.take_along_axis(signs, first, axis=-1)
        return np.asarray(np.where(last < 0, begin, known))


def _factor(power: int, order: int) -> float:
    """The factor of s^power after so many derivatives."""
    factor = 1.0
    for one in range(order):
        factor *= power - one
    return factor


def _horner(coefficients: Array, s: Array) -> Array:
    """Polynomials (..., k) at shares (...)."""
    found = coefficients[..., -1] * np.ones_like(s)
    for power in range(coefficients.shape[-1] - 2, -1, -1):
        found = found * s + coefficients[..., power]
    return np.asarray(found)


def _bisected(coefficients: Array, begin: Array, sign: Array) -> Array:
    """The share at which polynomials (m, k) lose the sign that they have at ``begin`` of a part."""
    low, high = np.asarray(begin, float), begin + 1 / PARTS
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        same = _horner(coefficients, middle) * sign > 0
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    return np.asarray((low + high) / 2)


def _gathered(found: Array, signs: Array) -> tuple[Array, Array]:
    """Roots (..., k) and their signs in rising order, without the places that no design needs."""
    count = int(np.isfinite(found).sum(axis=-1).max(initial=0))
    order = np.argsort(np.where(np.isnan(found), np.inf, found), axis=-1, kind="stable")[..., :count]
    return np.take_along_axis(found, order, axis=-1), np.take_along_axis(signs, order, axis=-1)
