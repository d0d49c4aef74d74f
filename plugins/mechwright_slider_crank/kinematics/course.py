"""How the crank goes over one period, and where the slider comes to: of one design, or of a table."""

import math
from functools import partial
from typing import Any

import numpy as np

from mechwright import Array
from mechwright.contracts.design_table import Rows, column, number
from mechwright.mechanics.planar import Course, Turning, swing
from mechwright.mechanics.planar.course import counted_from
from mechwright.mechanics.planar.swing import TURN_BACK
from mechwright_slider_crank.kinematics.limit_motion import turns_to_close
from mechwright_slider_crank.kinematics.limits import (
    Limits,
    crank_turns,
    least_transmission_angle,
    limits_of_turns,
    reach,
    transmission_angle,
)
from mechwright_slider_crank.kinematics.mechanism import Mechanism
from mechwright_slider_crank.kinematics.slider_crank import Bodies

LEVER_SAMPLES = 1441
"""Positions among which the ends of a slider's way are sought where there is no formula: four a degree."""


def turns(table: Mechanism) -> Any:
    """Whether the crank can go all the way round, if only just."""
    link = table.closed
    return crank_turns(link.crank, link.rod, link.offset) | link.at_limit


def is_lever(table: Mechanism) -> Any:
    """Whether the crank swings, because it cannot turn fully or because the design says between where."""
    return np.asarray(table.requested is not None) | ~np.asarray(turns(table))


def ways(table: Mechanism, least: Any = 0.0) -> list[swing.Ways]:
    """Crank angles, rad from X, between which the rod keeps ``least``, rad, from the normal of the slide.

    Of two ways the one with the crank along the slide comes first; NaN where there is none.
    """
    link = table.closed
    low, high = reach(link.crank, link.rod, link.offset, least)
    second = (-math.pi / 2 < low) & (high < math.pi / 2)
    other = (np.where(second, math.pi - end, math.nan) for end in (high, low))
    both = [(low, high), tuple(other)]
    return [(one + link.direction, two + link.direction) for one, two in both]


def ways_in_degrees(table: Mechanism, least: float = 0.0) -> list[swing.Way]:
    """The same of one design, without those that are none."""
    found = [(float(low), float(high)) for low, high in ways(table, least)]
    return [(math.degrees(low), math.degrees(high)) for low, high in found if low == low]


def swings(table: Mechanism) -> swing.Ways:
    """The swing of a lever, rad from X, its first end first; NaN where the links cannot reach it.

    Left to itself a lever goes as far as it can.
    """

    def found() -> swing.Ways:
        link = table.closed
        whole = crank_turns(link.crank, link.rod, link.offset) & ~np.asarray(link.at_limit)
        both = ways(table, np.where(whole, 0.0, TURN_BACK))
        if table.requested is None:
            return both[0][::-1] if table.given.clockwise else both[0]
        one, two, _ = np.broadcast_arrays(*table.requested, both[0][0])
        return swing.within_many(both, one, two)

    return table.once("swings", found)


def toggles(table: Mechanism) -> swing.Ways:
    """Crank angles, rad from X, at which the rod stands across the slide, about the swing; NaN for none."""
    start, travel = drives(table)
    low, high = swing.nearest_many(ways(table), np.asarray(start + travel / 2), math.tau)
    return np.where(turns(table), math.nan, low), np.where(turns(table), math.nan, high)


def drives(table: Mechanism) -> tuple[Any, Any]:
    """Start and travel of the crank over one period, rad; below 0 it turns clockwise."""

    def found() -> tuple[Any, Any]:
        one, two = swings(table)
        link, lever = table.closed, is_lever(table)
        count = np.where(link.at_limit, turns_to_close(link.offset), 1)
        start, travel = np.where(lever, one, 0.0), np.where(lever, two - one, table.sense * math.tau * count)
        return number(start), number(travel)

    return table.once("drives", found)


def course_of(table: Mechanism) -> Course:
    """One period of the crank of one design that can be put together."""
    rocks = bool(is_lever(table))
    return Course(*drives(table), rocks, 0.0 if rocks else table.given.acceleration_ratio)


def drive_at(table: Mechanism, share: Array) -> tuple[Array, Turning]:
    """Times, s, and the crank (n, m) at shares (m,) of a period, as :meth:`Course.period` has them."""
    (start, travel), speed = drives(table), table.omega
    k = table.given.acceleration_ratio
    cos, sin, half = np.cos(math.tau * share), np.sin(math.tau * share), travel / 2
    angle = travel * share
    omega = np.copysign(speed, travel) * np.exp(k * angle)
    lever = start + half * (1 - cos), half * speed * sin, half * speed**2 * cos, -half * speed**3 * sin
    crank = angle, omega, k * omega**2, 2 * k**2 * omega**3
    rocks = is_lever(table)
    with np.errstate(invalid="ignore", divide="ignore"):
        spent = np.abs(np.where(k == 0, angle, -np.expm1(-k * angle) / k))
    time = np.where(rocks, math.tau * share, spent) / speed
    return time, Turning(
        *(np.where(rocks, one, two) + 0 * time for one, two in zip(lever, crank, strict=True))
    )


def period_of(table: Mechanism, samples: int = LEVER_SAMPLES) -> tuple[Array, Array, Bodies]:
    """Times (n,), s, crank angles (n,), rad, and the bodies over one period of one design."""
    time, drive = course_of(table).period(samples, table.omega)
    return time, drive.theta, table.closed.bodies(drive.theta, drive)


def ends_of(table: Mechanism) -> Limits:
    """The ends of the slider's way, in closed form for a crank that turns; angles as the channel ``phi``."""
    return table.once("ends", partial(_ends, table))


def _ends(table: Mechanism) -> Limits:
    found, (start, travel) = limits_of_turns(table.closed), drives(table)
    values = {name: number(value) for name, value in vars(found).items()}
    for name in ("far", "near"):
        values[name] = number(counted_from(start, travel, values[name]))
    sampled = np.flatnonzero(column(is_lever(table) | np.asarray(table.closed.at_limit), table.size))
    if not sampled.size:
        return Limits(**values)
    swept = _swept(table.rows(sampled))
    if table.single:
        return swept
    full = {name: column(value, table.size).copy() for name, value in values.items()}
    for name, value in vars(swept).items():
        full[name][sampled] = value
    return Limits(**full)


def _swept(table: Mechanism) -> Limits:
    """Ends of the ways of levers, and of linkages at their limits, from samples."""
    (start, travel), share = drives(table), np.linspace(0.0, 1.0, LEVER_SAMPLES)
    swung = start + travel / 2 * (1 - np.cos(math.tau * share))
    phi = np.atleast_2d(np.where(is_lever(table), swung, travel * share))
    s = np.atleast_2d(table.closed.course(phi))
    each = np.arange(len(s))[:, None]
    least, most = s.argmin(axis=-1)[:, None], s.argmax(axis=-1)[:, None]
    out = np.abs(s[each, least]) >= np.abs(s[each, most])
    far, near = np.where(out, least, most), np.where(out, most, least)
    found = Limits(phi[each, far], phi[each, near], s[each, far], s[each, near], 1.0, False)
    return Limits(*(np.asarray(one).item() for one in vars(found).values())) if table.single else found


def least_of(table: Mechanism) -> Any:
    """The least angle of the rod to the normal of the slide over a period, rad."""
    link, (start, travel) = table.closed, drives(table)
    begin = start - link.direction
    low, high = np.minimum(begin, begin + travel), np.maximum(begin, begin + travel)
    # Of a lever beside its ends, with the crank across the slide.
    angles = [low, high, *(np.ceil((low - x) / math.tau) * math.tau + x for x in (math.pi / 2, -math.pi / 2))]
    found = [transmission_angle(link, np.where(one <= high, one, low) + link.direction) for one in angles]
    turned = least_transmission_angle(link.crank, link.rod, link.offset)
    return number(np.where(is_lever(table), np.minimum.reduce(np.broadcast_arrays(*found)), turned))


def some(table: Mechanism, which: Any) -> Rows:
    """Places of the designs of a table of which something is true."""
    return np.flatnonzero(column(which, table.size))
