"""How the cranks of many four-bars go: full turns, swings as far as they can, and swings that are given."""

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mechwright import Array
from mechwright.contracts.by_arrays import Answer, Designs
from mechwright.mechanics.planar import swing
from mechwright.mechanics.planar.swing import TURN_BACK
from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.kinematics.reach import reach_cosines
from mechwright_four_bar.period import Period

Ways = list[swing.Ways]
"""First and second way of each; NaN where there is none."""


class Reach(NamedTuple):
    """Ways of the cranks from the ground line, rad, which of them have none, and which turn fully."""

    ways: Ways
    empty: NDArray[np.bool_]
    turns: NDArray[np.bool_]


def reach_of(bar: FourBar, least: float = 0.0) -> Reach:
    """What :func:`mechwright_four_bar.kinematics.reach.reach` says of each, and which of them turn fully."""
    near, far = map(np.asarray, reach_cosines(bar, least))
    empty = (near <= -1) | (far >= 1) | (far >= near)
    low, high = np.arccos(np.minimum(near, 1.0)), np.arccos(np.maximum(far, -1.0))
    begin = np.where(near >= 1, -high, low)
    end = np.where(near < 1, np.where(far <= -1, math.tau - low, high), high)
    turns = (near >= 1) & (far <= -1)
    first = np.where(turns, 0.0, begin), np.where(turns, math.tau, end)
    two = (near < 1) & (far > -1)
    second = np.where(two, -high, math.nan), np.where(two, -low, math.nan)
    ways = [
        (np.where(empty, math.nan, low), np.where(empty, math.nan, high)) for low, high in (first, second)
    ]
    return Reach(ways, empty, turns)


def courses(found: Answer, designs: Designs, bar: FourBar) -> Period:
    """The period of each crank, and errors of the motion."""
    ratio, rocks = designs.full("acceleration_ratio"), np.asarray(bar.rocks)
    given = designs["swing_from"] is not None
    reach = reach_of(bar, TURN_BACK)
    found.forbid("four-bar.closure", ~np.asarray(bar.closes))
    found.doubt(np.asarray(bar.lines_up))
    found.forbid("four-bar.rotation", rocks & reach.empty)
    found.doubt(rocks & reach.turns)  # at the edge of what turns, by rounding alone
    sense = np.where(designs.full("direction") == "ccw", 1.0, -1.0)
    if given:
        begin, end = _given(found, designs, bar, rocks, reach)
        rocks = np.ones_like(rocks)
    else:
        low, high = (one + bar.ground_angle for one in reach.ways[0])
        begin, end = np.where(sense > 0, low, high), np.where(sense > 0, high, low)
    found.forbid("four-bar.acceleration", rocks & (ratio != 0))
    return Period(
        np.where(rocks, begin, 0.0),
        np.where(rocks, end - begin, sense * math.tau),
        rocks,
        ratio,
        designs.full("speed") * math.tau / 60,
    )


def _given(
    found: Answer, designs: Designs, bar: FourBar, rocks: NDArray[np.bool_], reach: Reach
) -> tuple[Array, Array]:
    """First and last angle of the swings that are given, rad from X."""
    whole = reach_of(bar)
    found.doubt(~rocks & ~whole.turns)
    ways = [
        _turned(bar, *(np.where(rocks, a, b) for a, b in zip(*both, strict=True)))
        for both in zip(reach.ways, whole.ways, strict=True)
    ]
    one, two = np.radians(designs.full("swing_from")), np.radians(designs.full("swing_to"))
    begin, end = swing.within_many(ways, one, two)
    found.forbid("four-bar.swing", np.isnan(begin))
    return begin, end


def transmission(bar: FourBar, course: Period) -> tuple[Array, Array]:
    """Least and greatest transmission angle over each period, rad: see :meth:`FourBar.transmission_range`."""
    a, f = bar.crank, bar.ground
    ends: list[Any] = [course.start - bar.ground_angle, course.start + course.travel - bar.ground_angle]
    ends = [np.where(course.rocks, one, whole) for one, whole in zip(ends, (0.0, math.tau), strict=True)]
    low, high = np.minimum(*ends), np.maximum(*ends)
    cosines = [np.asarray(bar.cosine_over(a * a + f * f - 2 * a * f * np.cos(x))) for x in (low, high)]
    for off, square in ((0.0, (f - a) ** 2), (math.pi, (f + a) ** 2)):
        passed = np.ceil((low - off) / math.tau) <= np.floor((high - off) / math.tau)
        cosines.append(np.where(passed, bar.cosine_over(square), cosines[0]))
    angles = [np.arccos(np.minimum(1.0, np.abs(value))) for value in cosines]
    square = np.minimum.reduce(cosines) * np.maximum.reduce(cosines) <= 0
    return np.minimum.reduce(angles), np.where(square, math.pi / 2, np.maximum.reduce(angles))


def toggles(bar: FourBar, course: Period) -> tuple[Array, Array]:
    """Crank angles, rad from X, at which coupler and follower are in line, about the swing; NaN for none."""
    rocks = np.asarray(bar.rocks)
    ways = [_turned(bar, *(np.where(rocks, end, math.nan) for end in way)) for way in reach_of(bar).ways]
    return swing.nearest_many(ways, course.start + course.travel / 2, math.tau)


def _turned(bar: FourBar, low: Array, high: Array) -> swing.Ways:
    """Angles from the ground line as angles from X."""
    return low + bar.ground_angle, high + bar.ground_angle
