"""How the crank of a slider-crank goes over one period, and where the slider comes to."""

import math
from dataclasses import replace

import numpy as np

from mechwright import Array, kept
from mechwright.mechanics.planar import Course, swing
from mechwright.mechanics.planar.swing import TURN_BACK
from mechwright_slider_crank.figures import (
    Limits,
    crank_turns,
    least_transmission_angle,
    limits,
    transmission_angle,
)
from mechwright_slider_crank.kinematics import Bodies
from mechwright_slider_crank.limit_motion import turns_to_close
from mechwright_slider_crank.params import SliderCrankParams

_SAMPLES = 1441
"""Positions among which the ends of a slider's way are sought where there is no formula: four a degree."""


def reach(crank: float, rod: float, offset: float, least: float = 0.0) -> tuple[float, float] | None:
    """Crank angles from the slide, rad, between which the rod keeps ``least``, rad, from its normal.

    A whole turn is from 0 to 2π; None where crank and rod do not meet. Of two such ways it is the one with
    the crank along the slide. With φ' the angle and c cos μ ≥ |e - a sin φ'|.

    Examples
    --------
    >>> [round(math.degrees(x), 6) for x in reach(30, 35, 10)]
    [-56.44269, 236.44269]
    """
    most = rod * math.cos(least)
    low, high = (offset - most) / crank, (offset + most) / crank
    if low >= 1 or high <= -1:
        return None
    if low <= -1 and high >= 1:
        return 0.0, math.tau
    if low <= -1:
        return -math.pi - math.asin(high), math.asin(high)
    if high >= 1:
        return math.asin(low), math.pi - math.asin(low)
    return math.asin(low), math.asin(high)


def turns(params: SliderCrankParams) -> bool:
    """Whether the crank can go all the way round, if only just."""
    return crank_turns(params.crank, params.rod, params.offset) or params.linkage.at_limit


def is_lever(params: SliderCrankParams) -> bool:
    """Whether the crank swings, because it cannot turn fully or because the design says between where."""
    return params.swing_from is not None or not turns(params)


def ways(params: SliderCrankParams, least: float = 0.0) -> list[swing.Way]:
    """Crank angles, rad from X, between which the rod keeps ``least``, rad, from the normal of the slide.

    Of two ways the one with the crank along the slide comes first; there is none where crank and rod do not
    meet so.
    """
    found = reach(params.crank, params.rod, params.offset, least)
    if found is None:
        return []
    low, high = found
    both = [found]
    if -math.pi / 2 < low < high < math.pi / 2:
        both.append((math.pi - high, math.pi - low))
    direction = params.linkage.direction
    return [(low + direction, high + direction) for low, high in both]


def within(params: SliderCrankParams) -> swing.Way | None:
    """The swing of a lever, rad from X, its first end first; None where the links cannot reach it.

    Left to itself a lever goes as far as it can.
    """
    whole = crank_turns(params.crank, params.rod, params.offset) and not params.linkage.at_limit
    found = ways(params, 0.0 if whole else TURN_BACK)
    if params.swing_from is None or params.swing_to is None:
        return (found[0][::-1] if params.clockwise else found[0]) if found else None
    return swing.within(found, math.radians(params.swing_from), math.radians(params.swing_to))


def toggles(params: SliderCrankParams) -> swing.Way | None:
    """Crank angles, rad from X, at which the rod stands across the slide, about the swing; None for none."""
    found, course = ways(params), course_of(params)
    if turns(params) or not found:
        return None
    return swing.nearest(found, course.start + course.travel / 2, math.tau)


@kept
def course_of(params: SliderCrankParams) -> Course:
    """One period of the crank of a design that can be put together."""
    if is_lever(params):
        ends = within(params)
        assert ends is not None  # noqa: S101 - the checks come first
        return Course(ends[0], ends[1] - ends[0], rocks=True)
    sense = -1.0 if params.clockwise else 1.0
    count = turns_to_close(params.offset) if params.linkage.at_limit else 1
    return Course(0.0, sense * count * math.tau, acceleration_ratio=params.acceleration_ratio)


def period_of(params: SliderCrankParams, samples: int = _SAMPLES) -> tuple[Array, Array, Bodies]:
    """Times (n,), s, crank angles (n,), rad, and the bodies over one period."""
    time, drive = course_of(params).period(samples, abs(params.omega))
    return time, drive.theta, params.linkage.bodies(drive.theta, drive)


@kept
def ends_of(params: SliderCrankParams) -> Limits:
    """The ends of the slider's way, in closed form for a crank that turns; angles as the channel ``phi``."""
    if not is_lever(params) and not params.linkage.at_limit:
        found, course = limits(params.linkage), course_of(params)
        return replace(found, far=float(course.counted(found.far)), near=float(course.counted(found.near)))
    _, phi, bodies = period_of(params)
    positions = bodies.position
    far, near = sorted(
        (int(np.argmin(positions)), int(np.argmax(positions))), key=lambda k: -abs(positions[k])
    )
    return Limits(
        float(phi[far]),
        float(phi[near]),
        float(positions[far]),
        float(positions[near]),
        1.0,
        False,
    )


def least_of(params: SliderCrankParams) -> float:
    """The least angle of the rod to the normal of the slide over a period, rad."""
    if not is_lever(params):
        return least_transmission_angle(params.crank, params.rod, params.offset)
    course, direction = course_of(params), params.linkage.direction
    low, high = sorted((course.start - direction, course.start + course.travel - direction))
    # Beside its ends, with the crank across the slide.
    first = math.ceil((low - math.pi / 2) / math.pi)
    across = math.pi / 2 + math.pi * np.arange(first, math.floor((high - math.pi / 2) / math.pi) + 1)
    angles = np.concatenate(([low, high], across)) + direction
    return float(transmission_angle(params.linkage, angles).min())
