"""How far the crank of a five-bar can go.

The squared distance D² of A and B1 is a sum of cosines; between two places where its derivative vanishes it
goes one way, so that a root of D² = c² + r3² ∓ 2 c r3 cos μ is found by halving, and none is missed.
"""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright import Array, kept
from mechwright.contracts.design_table import column
from mechwright.mechanics.planar.swing import TURN_BACK
from mechwright_five_bar.kinematics.dimensions import FiveBar

Interval = tuple[float, float]
"""Crank angles, rad; or the least and the greatest of a quantity."""

PER_TURN = 360
"""Places per turn of the faster of crank and arm between which D² has no two extremes."""

HALVINGS = 60
"""Down to rounding."""

ROUGH = 30
"""Halvings of a place whose D² only divides: 1e-11 rad."""

STEPS = 12
"""Of Newton's method within a bracket of a degree, halved where a step leaves it: an extreme to rounding."""


def bounds_of_distance(bar: FiveBar, least: float) -> tuple[Any, Any]:
    """D², mm², between which the transmission angle is at least ``least``, rad."""
    c, l = bar.coupler, bar.rocker
    less = 4 * c * l * math.sin(least / 2) ** 2
    return (c - l) ** 2 + less, (c + l) ** 2 - less


def _waves(bar: FiveBar) -> tuple[tuple[float, Any], ...]:
    """Half the derivative of D² by the crank's angle: the imaginary part of Σ z e^{i k θ}, as pairs k, z.

    D² = f² + r1² + r4² + 2 (f r4 cos(φ - γ) - f r1 cos(θ - γ) - r1 r4 cos(φ - θ)).
    """
    f, r1, r4, ratio = bar.ground, bar.crank, bar.arm, bar.ratio
    return (
        (1.0, f * r1 * np.exp(-1j * bar.ground_angle)),
        (ratio, -f * r4 * ratio * np.exp(1j * (bar.offset - bar.ground_angle))),
        (ratio - 1, r1 * r4 * (ratio - 1) * np.exp(1j * np.asarray(bar.offset))),
    )


def extremes_of_distance(bar: FiveBar, one: Any, two: Any, size: int = 1) -> tuple[NDArray[np.intp], Array]:
    """Where D² of so many designs turns back while the crank goes from an angle ``one`` to ``two``, rad.

    Angles and dimensions are numbers or columns (n, 1); one angle for all designs is the faster.

    Returns
    -------
    rows, angles
        The designs (k,) and the crank angles (k,), rad, of all places, by designs and from ``one`` on.
    """
    span = float(np.max(np.abs(np.asarray(two) - one)))
    count = max(8, math.ceil(span / math.tau * PER_TURN * max(1.0, abs(bar.ratio))))
    theta = np.atleast_2d(one + (np.asarray(two) - one) * np.linspace(0.0, 1.0, count + 1))
    waves = _waves(bar)
    factors = np.concatenate([np.broadcast_to(z, (size, 1)) for _, z in waves], axis=1)
    turned = np.stack([np.exp(1j * k * theta) for k, _ in waves], axis=1)
    table = np.concatenate([turned.imag, turned.real], axis=1)
    sizes = np.concatenate([factors.real, factors.imag], axis=1)
    # A product of matrices for each design: larger ones go to threads, which wait for each other.
    slope = np.matmul(sizes[:, None], table)[:, 0]
    rising = slope > 0
    rows, at = np.divmod(np.flatnonzero(rising[:, 1:] != rising[:, :-1]), count)
    theta = np.broadcast_to(theta, rising.shape)
    low, high, sign = theta[rows, at], theta[rows, at + 1], rising[rows, at]
    factors = factors[rows].T
    angle = low + (high - low) * slope[rows, at] / (slope[rows, at] - slope[rows, at + 1])
    for _ in range(STEPS if rows.size else 0):
        moved = [z * np.exp(1j * k * angle) for (k, _), z in zip(waves, factors, strict=True)]
        value = np.sum([z.imag for z in moved], axis=0)
        bend = np.sum([k * z.real for (k, _), z in zip(waves, moved, strict=True)], axis=0)
        same = (value > 0) == sign
        low, high = np.where(same, angle, low), np.where(same, high, angle)
        with np.errstate(divide="ignore", invalid="ignore"):
            step = angle - value / bend
        inside = (step - low) * (step - high) <= 0
        before, angle = angle, np.where(inside, step, (low + high) / 2)
        if np.abs(angle - before).max() < _STILL:
            break
    return rows, angle


_STILL = 1e-9
"""rad. An extreme that is off by so much is one to the last digit."""


def range_of_distance(bar: FiveBar, one: Any, two: Any, size: int = 1) -> Array:
    """Least and greatest D² (size, 2), mm², of designs while the crank goes between two angles, rad."""
    ends = np.concatenate([column(bar.squared_distance(angle), size) for angle in (one, two)], axis=1)
    found = np.sort(ends, axis=1)
    rows, angles = extremes_of_distance(bar, one, two, size)
    squares = bar.rows(rows, size).squared_distance(angles[:, None])[:, 0]
    np.minimum.at(found[:, 0], rows, squares)
    np.maximum.at(found[:, 1], rows, squares)
    return found


def angles_of_distance(bar: FiveBar, squares: Array) -> Array:
    """Smallest and largest acute transmission angle (n, 2), rad, with D² between two values (n, 2), mm²."""
    c, l = bar.coupler, bar.rocker
    cosines = (c * c + l * l - squares) / (2 * c * l)
    angles = np.sort(np.arccos(np.minimum(1.0, np.abs(cosines))), axis=1)
    angles[cosines[:, 0] * cosines[:, 1] <= 0, 1] = math.pi / 2
    return angles


def transmission_range(bar: FiveBar, one: float, two: float) -> Interval:
    """Smallest and largest acute transmission angle of one linkage between two crank angles, rad."""
    least, greatest = angles_of_distance(bar, range_of_distance(bar, one, two))[0].tolist()
    return least, greatest


def _halved(function: Callable[[Array], Array], low: Array, high: Array, halvings: int = HALVINGS) -> Array:
    """Roots (k,) of a function between two sides on which it has not the same sign."""
    low, high = low.copy(), high.copy()
    sign = function(low) > 0
    for _ in range(halvings if low.size else 0):
        middle = (low + high) / 2
        if not np.any((low < middle) & (middle < high)):
            break  # down to rounding: what follows changes nothing
        same = (function(middle) > 0) == sign
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    return np.asarray((low + high) / 2)


@kept
def reach(bar: FiveBar, least: float = 0.0) -> tuple[Interval, ...]:
    """Crank angles between which the transmission angle is at least ``least``, rad, in one period from 0.

    One whole period is a single interval of that length. The last interval may go on beyond the period, into
    the first one's beginning.

    Examples
    --------
    >>> bar = FiveBar(24, 82, 82, 24, 105, 0.0, 1.0, (20, 40), 1)
    >>> reach(bar) == ((0.0, 4 * math.pi),)
    True
    """
    period, (near, far) = math.tau * bar.turns, bounds_of_distance(bar, least)

    def room(theta: Array) -> Array:
        at = bar.squared_distance(theta)
        return np.asarray(np.minimum(at - near, far - at))

    points = np.concatenate([[0.0], extremes_of_distance(bar, 0.0, period)[1], [period]])
    # D² goes one way between two points, so halfway up to the middle of the range room has one root at most.
    middle = _middles(bar, points, (near + far) / 2)
    points = np.unique(np.concatenate([points, middle]))
    good = room(points) >= 0
    if good.all():
        return ((0.0, period),)
    at = np.flatnonzero(good[1:] != good[:-1])
    edges = _halved(room, points[at], points[at + 1])
    if edges.size == 0:
        return ()
    first = 0 if not good[0] else 1
    found = [(float(a), float(b)) for a, b in zip(edges[first::2], edges[first + 1 :: 2], strict=False)]
    if good[0]:
        found.append((float(edges[-1]), float(edges[0]) + period))
    return tuple(found)


def _middles(bar: FiveBar, points: Array, level: float) -> Array:
    """Where D² passes a level between neighbouring points (k,)."""
    values = bar.squared_distance(points) - level
    at = np.flatnonzero((values[1:] > 0) != (values[:-1] > 0))
    return _halved(lambda x: bar.squared_distance(x) - level, points[at], points[at + 1], ROUGH)


def turns_fully(bar: FiveBar, least: float = TURN_BACK) -> bool:
    """Whether the crank turns on and on."""
    return reach(bar, least) == ((0.0, math.tau * bar.turns),)
