"""A quantity and its rates over time, carried through sums, products and rotations.

Glossary
--------
jet
    A vector with its first, second, third rate: position, velocity, acceleration, jerk, as far as wanted.
order
    Number of rates that a jet holds.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from mechwright import Array
from mechwright_spherical.vectors import column, cross, dot

Jet = tuple[Array, ...]
"""Vectors (3, ...): value, first rate, second rate, …"""


@dataclass(frozen=True, slots=True)
class Turning:
    """An angle and its rates: (...) float in rad, rad/s, rad/s², rad/s³."""

    angle: Array
    rate: Array
    acceleration: Array
    jerk: Array

    @classmethod
    def of(
        cls, angle: ArrayLike, rate: ArrayLike = 1.0, acceleration: ArrayLike = 0.0, jerk: ArrayLike = 0.0
    ) -> "Turning":
        """From an angle and its rates, broadcast to one shape."""
        shaped = np.broadcast_arrays(*(np.asarray(x, dtype=float) for x in (angle, rate, acceleration, jerk)))
        return cls(*shaped)

    def part(self, start: int, stop: int) -> "Turning":
        """The samples from ``start`` to before ``stop``."""
        values = (self.angle, self.rate, self.acceleration, self.jerk)
        return Turning(*(value[start:stop] for value in values))

    def scaled(self, ratio: float) -> "Turning":
        """The turning of a shaft that is geared to this one."""
        return Turning(ratio * self.angle, ratio * self.rate, ratio * self.acceleration, ratio * self.jerk)


def circle(axis: Array, start: Array, turning: Turning, order: int) -> Jet:
    """The jet of a point that turns about an axis; ``axis`` and ``start`` (3,) or (3, designs, 1).

    With w = u x X, n = u x w: X' = ω w, X'' = α w + ω² n, X''' = (j - ω³) w + 3 ω α n.
    """
    angle = turning.angle
    if axis.ndim == 1:
        axis, start = column(axis, angle[None]), column(start, angle[None])
    along = axis * dot(axis, start)
    across, swing = start - along, cross(axis, start)
    cos, sin = np.cos(angle), np.sin(angle)
    x = across * cos + swing * sin
    w = swing * cos - across * sin
    found = [x + along]
    rate, acceleration, jerk = turning.rate, turning.acceleration, turning.jerk
    if order > 0:
        found.append(rate * w)
    if order > 1:
        found.append(acceleration * w - rate**2 * x)
    if order > 2:
        found.append((jerk - rate**3) * w - 3 * rate * acceleration * x)
    return tuple(found)


def product(a: Jet, b: Jet) -> Jet:
    """The jet of a vector product, by Leibniz' rule."""
    return tuple(
        total([math.comb(n, k) * cross(a[k], b[n - k]) for k in range(n + 1)])
        for n in range(min(len(a), len(b)))
    )


def combination(terms: Sequence[tuple[Array | float, Jet]]) -> Jet:
    """The jet of a sum of jets with constant factors (...)."""
    return tuple(total([factor * jet[n] for factor, jet in terms]) for n in range(len(terms[0][1])))


def total(terms: Sequence[Array]) -> Array:
    """The sum of arrays, at least one."""
    found = terms[0]
    for term in terms[1:]:
        found = found + term
    return found


def turning_about(axis: Array, point: Jet) -> Turning:
    """Rates of a point's turning about a fixed axis; the angle is left at 0.

    With w = u x X: ψ' = w.X'/w², ψ'' = w.X''/w², ψ''' = w.X'''/w² + ψ'³. Rates beyond the jet's order are 0.
    """
    w = cross(column(axis, point[0]), point[0])
    square = dot(w, w)
    rates = [dot(w, x) / square for x in point[1:]]
    rates += [np.zeros_like(square)] * (3 - len(rates))
    if len(point) > 3:
        rates[2] = rates[2] + rates[0] ** 3
    return Turning(np.zeros_like(square), *rates)
