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

import numpy as np

from mechwright import Array
from mechwright.mechanics.planar import Turning
from mechwright_spherical.kinematics.vectors import column, cross, dot

Jet = tuple[Array, ...]
"""Vectors (3, ...): value, first rate, second rate, …"""


def circle(axis: Array, start: Array, turning: Turning, order: int) -> Jet:
    """The jet of a point that turns about an axis; ``axis`` and ``start`` (3,) or (3, designs, 1).

    With w = u x X, n = u x w: X' = ω w, X'' = α w + ω² n, X''' = (j - ω³) w + 3 ω α n.
    """
    angle = turning.theta
    if axis.ndim == 1:
        axis, start = column(axis, angle[None]), column(start, angle[None])
    along = axis * dot(axis, start)
    across, swing = start - along, cross(axis, start)
    cos, sin = np.cos(angle), np.sin(angle)
    x = across * cos + swing * sin
    w = swing * cos - across * sin
    found = [x + along]
    rate, acceleration, jerk = turning.omega, turning.alpha, turning.jerk
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
