"""The swing that a design asks of a lever, and the ways on which its links can be joined.

Glossary
--------
way
    Angles of the input, the lower one first, between which the links reach; one of a whole turn has no ends.
"""

import math
from collections.abc import Sequence
from typing import Any, TypeVar

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.finding import Change, Finding

TURN_BACK = math.radians(1.0)
"""Transmission angle at which a lever turns back before its toggle, and a crank that cannot turn fully before
the rod is along the normal of its slide: 57 times the force or torque of the output would have to come from
the input there, friction blocks it long before, and beyond it play decides how the mechanism goes on."""

LEAST_TRANSMISSION = math.degrees(TURN_BACK)
"""Degrees below which play and bending let the linkage change its branch."""

SLACK = 1e-9
"""rad. A lever that shall go this much beyond its way goes to the end of it: rounding of degrees."""

Way = tuple[float, float]
Ways = tuple[Array, Array]
"""A way of each of many levers: lower and upper angles (n,)."""

N = TypeVar("N", float, Array)

LEAST = 1.0
"""Degrees. A swing that is shorter is not proposed."""
_KEYS = ("parameters.swing_from", "parameters.swing_to")

LEFT_OUT: Change = dict.fromkeys(_KEYS)
"""The change to a lever that goes as far as it can."""


def within(ways: Sequence[Way], one: float, two: float) -> Way | None:
    """The swing from ``one`` to ``two`` on the way that has room for it; None where none has. All in rad.

    Angles that differ by turns are the same.

    Examples
    --------
    >>> within([(-1.0, 1.0), (2.0, 4.0)], 3.5, 2.5)
    (3.5, 2.5)
    >>> within([(-1.0, 1.0)], 0.5, 1.5)
    """
    begin, end = within_many([_each(way) for way in ways], np.asarray(one), np.asarray(two))
    return None if np.isnan(begin) else (float(begin), float(end))


def within_many(ways: Sequence[Ways], one: Array, two: Array) -> Ways:
    """The same of many levers: first and last angles (n,), rad; NaN where no way has room.

    Of ``ways`` the first is taken that has room; a lever that has fewer has NaN for those it has not.
    """
    begin, end = np.full(np.shape(one), math.nan), np.full(np.shape(one), math.nan)
    for way in ways:
        whole = way[1] - way[0] >= math.tau - SLACK
        low, high = beside(way, (one + two) / 2, math.tau)
        fits = (low - SLACK <= np.minimum(one, two)) & (np.maximum(one, two) <= high + SLACK)
        free = np.isnan(begin) & (whole | fits)
        begin = np.where(free, np.where(whole, one, np.clip(one, low, high)), begin)
        end = np.where(free, np.where(whole, two, np.clip(two, low, high)), end)
    return begin, end


def beside(way: tuple[N, N], angle: N, turn: float) -> tuple[N, N]:
    """The same way, or ways (n,), by whole turns as near to an angle as it can be."""
    low, high = way
    off: Any = turn * np.round((angle - (low + high) / 2) / turn)
    return low + off, high + off


def nearest(ways: Sequence[Way], angle: float, turn: float) -> Way:
    """Of some ways the one whose middle is nearest to an angle, with the turns of that."""
    low, high = nearest_many([_each(way) for way in ways], np.asarray(angle), turn)
    return float(low), float(high)


def nearest_many(ways: Sequence[Ways], angle: Array, turn: float) -> Ways:
    """The same of many levers, (n,); NaN where a lever has no way."""
    found = np.full(np.shape(angle), math.nan), np.full(np.shape(angle), math.nan)
    least = np.full(np.shape(angle), math.inf)
    for way in ways:
        here = beside(way, angle, turn)
        away = abs((here[0] + here[1]) / 2 - angle)
        nearer = away < least
        found = np.where(nearer, here[0], found[0]), np.where(nearer, here[1], found[1])
        least = np.where(nearer, away, least)
    return found


def _each(way: Way) -> Ways:
    return np.asarray(way[0]), np.asarray(way[1])


def past(ways: Sequence[Way], one: float, two: float) -> tuple[str, float, float]:
    """Which end of a swing lies further out of its way, the angle it has, and the last it may have; degrees.

    Examples
    --------
    >>> past([(-60.0, 60.0)], -50.0, 100.0)
    ('swing_to', 100.0, 60.0)
    """
    low, high = nearest(ways, (one + two) / 2, 360.0)
    over = {"swing_from": max(one - high, low - one), "swing_to": max(two - high, low - two)}
    name = max(over, key=lambda end: over[end])
    value = one if name == "swing_from" else two
    return name, value, high if value > (low + high) / 2 else low


def shortened(ways: Sequence[Way], one: float, two: float) -> tuple[Change, ...]:
    """The change to as much of a swing as one of the ways has room for, degrees; empty where none has any.

    Examples
    --------
    >>> shortened([(-60.123, 60.123)], 100.0, -50.0)
    ({'parameters.swing_from': 60.1, 'parameters.swing_to': -50.0},)
    """
    if not ways:
        return ()
    low, high = nearest(ways, (one + two) / 2, 360.0)
    low, high = math.ceil(low * 10) / 10, math.floor(high * 10) / 10
    ends = [min(max(end, low), high) for end in (one, two)]
    fits = abs(ends[0] - ends[1]) >= LEAST and all(-360 <= end <= 360 for end in ends)
    return (dict(zip(_KEYS, ends, strict=True)),) if fits else ()


def out_of_reach(code: str, ways: Sequence[Way], one: float, two: float, back: float) -> Finding:
    """The error of a swing that no way has room for, with as much of it as there is room for.

    All in degrees; ``back`` is the transmission angle at which a way ends. There is a way.
    """
    said = " or ".join(f"{low:.3f} to {high:.3f}" for low, high in ways)
    key, value, limit = past(ways, one, two)
    return Finding.error(
        code,
        key,
        f"the crank cannot swing from {one:g} to {two:g} degrees: it reaches {said} degrees, "
        f"{back:g} degree of transmission angle before its toggles",
        value,
        limit,
        "deg",
        f"keep swing_from and swing_to within {said}",
        proposed=(*shortened(ways, one, two), LEFT_OUT),
    )
