"""How far the crank of a four-bar can go, and how it goes over one period."""

import math

from mechwright import kept
from mechwright.mechanics.planar import Course, swing
from mechwright.mechanics.planar.swing import TURN_BACK
from mechwright_four_bar.kinematics.change_point import turns_to_close
from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.parameters import FourBarParams

Interval = tuple[float, float]
"""Crank angles, rad."""


def reach(bar: FourBar, least: float = 0.0) -> tuple[Interval, ...]:
    """Crank angles from the ground line between which the transmission angle is at least ``least``, rad.

    A whole turn is from 0 to 2π. With no interval the links cannot be joined so, with two they are mirror
    images in the ground line.

    D² = a² + f² - 2 a f cos x lies between b² + c² ∓ 2 b c cos μ.

    Examples
    --------
    >>> [[round(math.degrees(x), 6) for x in one] for one in reach(FourBar(70, 60, 75, 110))]
    [[-94.562439, 94.562439]]
    >>> reach(FourBar(30, 80, 70, 90)) == ((0.0, math.tau),)
    True
    """
    near, far = reach_cosines(bar, least)
    if near <= -1 or far >= 1 or far >= near:
        return ()
    low = math.acos(near) if near < 1 else 0.0
    high = math.acos(far) if far > -1 else math.pi
    if near >= 1:
        return ((0.0, math.tau),) if far <= -1 else ((-high, high),)
    return ((low, math.tau - low),) if far <= -1 else ((low, high), (-high, -low))


def reach_cosines(bar: FourBar, least: float = 0.0) -> tuple[float, float]:
    """Cosines of the crank angles at which the diagonal is as short, and as long, as :func:`reach` allows."""
    a, c, b, f = bar.lengths
    less = 4 * b * c * math.sin(least / 2) ** 2
    near = (a * a + f * f - (b - c) ** 2 - less) / (2 * a * f)
    return near, (a * a + f * f - (b + c) ** 2 + less) / (2 * a * f)


def bar_of(params: FourBarParams) -> FourBar:
    """The dimensions."""
    return FourBar(
        params.crank,
        params.coupler,
        params.follower,
        params.ground,
        math.radians(params.ground_angle),
        1 if params.branch == "open" else -1,
    )


def is_lever(params: FourBarParams) -> bool:
    """Whether the crank swings, because it cannot turn fully or because the design says between where."""
    return params.swing_from is not None or bar_of(params).rocks


def within(params: FourBarParams) -> Interval | None:
    """The swing of a lever, rad from X, its first end first; None where the links cannot reach it.

    Left to itself a lever goes as far as it can, on the left of the ground line where there are two ways.
    """
    bar = bar_of(params)
    ways = reach(bar, TURN_BACK) if bar.rocks or bar.lines_up else reach(bar)
    if params.swing_from is None or params.swing_to is None:
        return (ways[0][0] + bar.ground_angle, ways[0][1] + bar.ground_angle) if ways else None
    turned = [(low + bar.ground_angle, high + bar.ground_angle) for low, high in ways]
    return swing.within(turned, math.radians(params.swing_from), math.radians(params.swing_to))


def toggles(params: FourBarParams) -> Interval | None:
    """Crank angles, rad from X, at which coupler and follower are in line, about the swing; None for none."""
    bar, course = bar_of(params), course_of(params)
    ways = [(low + bar.ground_angle, high + bar.ground_angle) for low, high in reach(bar)]
    if not bar.rocks or not ways:
        return None
    return swing.nearest(ways, course.start + course.travel / 2, math.tau)


def transmission_of(params: FourBarParams) -> Interval:
    """Smallest and largest acute transmission angle over a period, rad."""
    bar, course = bar_of(params), course_of(params)
    one = course.start - bar.ground_angle
    return bar.transmission_range(one, one + course.travel) if course.rocks else bar.transmission_range()


@kept
def course_of(params: FourBarParams) -> Course:
    """One period of the crank; its links can be joined, and reach what the design says."""
    bar = bar_of(params)
    sense = 1.0 if params.direction == "ccw" else -1.0
    if is_lever(params):
        ends = within(params)
        assert ends is not None  # noqa: S101 - the checks come first
        return Course.between(*(ends if params.swing_from is not None or sense > 0 else ends[::-1]))
    turns = turns_to_close(bar) if bar.lines_up else 1
    return Course(0.0, sense * turns * math.tau, acceleration_ratio=params.acceleration_ratio)
