"""How far the crank of a five-bar can go, and how it goes over one period.

The squared distance D² of A and B1 is a sum of cosines; between two places where its derivative vanishes it
goes one way, so that a root of D² = c² + r3² ∓ 2 c r3 cos μ is found by halving, and none is missed.
"""

import math
from collections.abc import Callable

import numpy as np

from mechwright import Array, kept
from mechwright.mechanics.planar import Course, swing
from mechwright.mechanics.planar.swing import TURN_BACK
from mechwright_five_bar.loop import FiveBar
from mechwright_five_bar.params import FiveBarParams

Interval = tuple[float, float]
"""Crank angles, rad."""

PER_TURN = 360
"""Places per turn of the faster of crank and arm between which D² has no two extremes."""

HALVINGS = 60
"""Down to rounding."""

_HAIR = 1e-9
"""Share of a square within which whether the links can be joined is not told from lengths alone."""

ROUGH = 30
"""Halvings of a place whose D² hardly changes beside it, or that only divides: 1e-11 rad."""


def bar_of(params: FiveBarParams) -> FiveBar:
    """The dimensions."""
    return FiveBar(
        params.crank,
        params.coupler,
        params.rocker,
        params.arm,
        params.ground,
        math.radians(params.ground_angle),
        math.radians(params.arm_angle),
        (params.crank_teeth, params.arm_teeth),
        1 if params.idler_teeth else -1,
        1 if params.branch == "open" else -1,
    )


def square(bar: FiveBar, theta: Array) -> Array:
    """D² (...), mm²."""
    return np.abs(bar.gap_and_rates(theta, 0)[0]) ** 2


def _slope(bar: FiveBar, theta: Array) -> Array:
    """Half the derivative of D² (...) by the crank's angle.

    D² = f² + r1² + r4² + 2 (f r4 cos(φ - γ) - f r1 cos(θ - γ) - r1 r4 cos(φ - θ)).
    """
    f, r1, r4, ratio = bar.ground, bar.crank, bar.arm, bar.ratio
    one = theta - bar.ground_angle
    two = ratio * theta + (bar.offset - bar.ground_angle)
    slope: Array = (f * r1) * np.sin(one) - (f * r4 * ratio) * np.sin(two)
    slope += (r1 * r4 * (ratio - 1)) * np.sin(two - one)
    return slope


def _limits(bar: FiveBar) -> Interval:
    """Squares of distances, mm², between which D² is at any angles of crank and arm."""
    lengths = (bar.ground, bar.crank, bar.arm)
    total = sum(lengths)
    return max(0.0, 2 * max(lengths) - total) ** 2, total**2


def turning_points(bar: FiveBar, one: float, two: float) -> Array:
    """Crank angles (k,) from ``one`` to ``two``, both included, between which D² goes one way."""
    low, high = min(one, two), max(one, two)
    fast = max(1.0, abs(bar.ratio))
    count = max(8, math.ceil((high - low) / math.tau * PER_TURN * fast))
    theta = np.linspace(low, high, count + 1)
    rising = _slope(bar, theta) > 0
    at = np.flatnonzero(rising[1:] != rising[:-1])
    inside = _halved(lambda x: _slope(bar, x), theta[at], theta[at + 1], ROUGH)
    return np.concatenate([[low], inside, [high]])


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
    c, l, period = bar.coupler, bar.rocker, math.tau * bar.turns
    less = 4 * c * l * math.sin(least / 2) ** 2
    near, far = (c - l) ** 2 + less, (c + l) ** 2 - less

    def room(theta: Array) -> Array:
        at = square(bar, theta)
        return np.minimum(at - near, far - at)

    low, high = _limits(bar)
    if low > near + _HAIR * far and high < far * (1 - _HAIR):
        return ((0.0, period),)
    if high < near * (1 - _HAIR) or low > far * (1 + _HAIR):
        return ()
    points = turning_points(bar, 0.0, period)
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
    values = square(bar, points) - level
    at = np.flatnonzero((values[1:] > 0) != (values[:-1] > 0))
    return _halved(lambda x: square(bar, x) - level, points[at], points[at + 1], ROUGH)


def turns_fully(bar: FiveBar, least: float = TURN_BACK) -> bool:
    """Whether the crank turns on and on."""
    return reach(bar, least) == ((0.0, math.tau * bar.turns),)


def is_lever(params: FiveBarParams) -> bool:
    """Whether the crank swings, because it cannot turn fully or because the design says between where."""
    return params.swing_from is not None or not turns_fully(bar_of(params))


def within(params: FiveBarParams) -> Interval | None:
    """The swing of a lever, rad from X, its first end first; None where the links cannot reach it.

    Left to itself a lever goes as far as it can on the widest of its ways.
    """
    bar = bar_of(params)
    ways = reach(bar, TURN_BACK)
    if params.swing_from is None or params.swing_to is None:
        return max(ways, key=lambda way: way[1] - way[0], default=None)
    one, two = math.radians(params.swing_from), math.radians(params.swing_to)
    if ways == ((0.0, math.tau * bar.turns),):
        return one, two
    low, high = min(one, two), max(one, two)
    for way in ways:
        start, end = swing.beside(way, (one + two) / 2, math.tau * bar.turns)
        if start - swing.SLACK <= low and high <= end + swing.SLACK:
            return min(max(one, start), end), min(max(two, start), end)
    return None


def ways_about(params: FiveBarParams) -> list[Interval]:
    """All ways in degrees, by whole periods as near to the swing that is asked for as they can be."""
    bar = bar_of(params)
    middle = 0.0
    if params.swing_from is not None and params.swing_to is not None:
        middle = math.radians((params.swing_from + params.swing_to) / 2)
    found = (swing.beside(way, middle, math.tau * bar.turns) for way in reach(bar, TURN_BACK))
    return sorted((math.degrees(low), math.degrees(high)) for low, high in found)


@kept
def transmission_range(bar: FiveBar, one: float, two: float) -> Interval:
    """Smallest and largest acute transmission angle, rad, while the crank goes from one angle to another."""
    squares = square(bar, turning_points(bar, one, two))
    c, l = bar.coupler, bar.rocker
    cosines = (c * c + l * l - squares) / (2 * c * l)
    angles = np.arccos(np.minimum(1.0, np.abs(cosines)))
    through = cosines.min() * cosines.max() <= 0
    return float(angles.min()), math.pi / 2 if through else float(angles.max())


def transmission_of(params: FiveBarParams) -> Interval:
    """Smallest and largest acute transmission angle over a period, rad."""
    way = course_of(params)
    return transmission_range(bar_of(params), way.start, way.start + way.travel)


@kept
def course_of(params: FiveBarParams) -> Course:
    """One period of the crank; its links can be joined, and reach what the design says."""
    bar = bar_of(params)
    sense = 1.0 if params.direction == "ccw" else -1.0
    if is_lever(params):
        ends = within(params)
        assert ends is not None  # noqa: S101 - the checks come first
        return Course.between(*(ends if params.swing_from is not None or sense > 0 else ends[::-1]))
    return Course(0.0, sense * bar.turns * math.tau)
