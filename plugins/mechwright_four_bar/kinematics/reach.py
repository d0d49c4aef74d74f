"""How far the crank of a four-bar can go, and how it goes over one period; of one, or of a table of them.

Numbers of a four-bar may be columns (n, 1); NaN stands for a way that a four-bar has not.
"""

import math
from typing import Any, NamedTuple

import numpy as np

from mechwright.contracts.design_table import number
from mechwright.mechanics.planar import swing
from mechwright.mechanics.planar.course import Ways
from mechwright.mechanics.planar.swing import TURN_BACK
from mechwright_four_bar.kinematics.change_point import turns_to_close
from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.parameters import FourBarParams

Interval = tuple[float, float]
"""Crank angles, rad."""


class Reach(NamedTuple):
    """First and second way of the crank from the ground line, rad, whether it has none, whether it turns."""

    ways: list[swing.Ways]
    empty: Any
    turns: Any


def reach_of(bar: FourBar, least: float = 0.0) -> Reach:
    """Crank angles between which the transmission angle is at least ``least``, rad: a whole turn is 0 to 2π.

    D² = a² + f² - 2 a f cos x lies between b² + c² ∓ 2 b c cos μ. Two ways are mirror images in the ground
    line.
    """
    a, c, b, f = bar.lengths
    less = 4 * b * c * math.sin(least / 2) ** 2
    near, far = (
        np.asarray((a * a + f * f - square) / (2 * a * f))
        for square in ((b - c) ** 2 + less, (b + c) ** 2 - less)
    )
    empty = (near <= -1) | (far >= 1) | (far >= near)
    low, high = np.arccos(np.clip(near, -1.0, 1.0)), np.arccos(np.clip(far, -1.0, 1.0))
    begin = np.where(near >= 1, -high, low)
    end = np.where((near < 1) & (far <= -1), math.tau - low, high)
    turns = (near >= 1) & (far <= -1)
    first = np.where(turns, 0.0, begin), np.where(turns, math.tau, end)
    two = (near < 1) & (far > -1)
    second = np.where(two, -high, math.nan), np.where(two, -low, math.nan)
    ways = [(np.where(empty, math.nan, one), np.where(empty, math.nan, two)) for one, two in (first, second)]
    return Reach(ways, empty, turns)


def reach(bar: FourBar, least: float = 0.0) -> tuple[Interval, ...]:
    """The ways of one four-bar from the ground line, rad; none where its links cannot be joined so.

    Examples
    --------
    >>> [[round(math.degrees(x), 6) for x in one] for one in reach(FourBar(70, 60, 75, 110))]
    [[-94.562439, 94.562439]]
    >>> reach(FourBar(30, 80, 70, 90)) == ((0.0, math.tau),)
    True
    """
    return tuple(
        (float(low), float(high)) for low, high in reach_of(bar, least).ways if not math.isnan(float(low))
    )


def bar_of(params: FourBarParams) -> FourBar:
    """The dimensions."""
    return FourBar(
        params.crank,
        params.coupler,
        params.follower,
        params.ground,
        number(np.radians(params.ground_angle)),
        1 if params.branch == "open" else -1,
    )


def ways_of(bar: FourBar, requested: Interval | None, sense: float, ratio: float) -> Ways:
    """One period of the crank: its turns, or as a lever the way there of which it comes back.

    Parameters
    ----------
    requested
        The ends of the swing that a design states, rad from X; None for a crank that turns, or a lever that
        goes as far as it can, on the left of the ground line where there are two ways.
    sense
        +1 counter-clockwise, -1 clockwise.
    ratio
        Acceleration ratio of a crank that turns.

    Start and travel of a lever are NaN where its links cannot reach what is requested.
    """
    tight = np.asarray(bar.rocks) | np.asarray(bar.lines_up)
    close = reach_of(bar, TURN_BACK).ways
    both = zip(close, close if requested is None else reach_of(bar).ways, strict=True)
    ways = [_turned(bar, *(np.where(tight, *ends) for ends in zip(*one, strict=True))) for one in both]
    rocks = np.asarray(bar.rocks) if requested is None else np.ones(tight.shape, bool)
    begin, end = ways[0] if sense > 0 else ways[0][::-1]
    if requested is not None:
        begin, end = swing.within_many(ways, *(np.asarray(one) for one in requested))
        rocks = np.ones(np.broadcast_shapes(begin.shape, rocks.shape), bool)
    turns = np.ones(rocks.shape)
    for place in np.argwhere(np.broadcast_to(tight, rocks.shape) & ~rocks):
        at = tuple(place)
        turns[at] = turns_to_close(_at(bar, rocks.shape, at))
    return Ways(
        np.where(rocks, begin, 0.0), np.where(rocks, end - begin, sense * math.tau * turns), rocks, ratio
    )


def toggles(bar: FourBar, ways: Ways) -> swing.Ways:
    """Crank angles, rad from X, at which coupler and follower are in line, about the swing; NaN for none."""
    rocks = np.asarray(bar.rocks)
    found = [_turned(bar, *(np.where(rocks, end, math.nan) for end in way)) for way in reach_of(bar).ways]
    return swing.nearest_many(found, ways.start + ways.travel / 2, math.tau)


def _at(bar: FourBar, shape: tuple[int, ...], place: tuple[int, ...]) -> FourBar:
    """One of some four-bars, with plain numbers."""
    a, c, b, f, angle = (
        float(np.broadcast_to(one, shape)[place]) for one in (*bar.lengths, bar.ground_angle)
    )
    return FourBar(a, c, b, f, angle, bar.branch)


def _turned(bar: FourBar, low: Any, high: Any) -> swing.Ways:
    """Angles from the ground line as angles from X."""
    return low + bar.ground_angle, high + bar.ground_angle
