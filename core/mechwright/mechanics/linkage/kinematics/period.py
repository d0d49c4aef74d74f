"""How far the input can go, and how it goes over one period.

Glossary
--------
phase
    0 to 2π over a period: of a driver that turns its angle over the number of turns, of a lever that of the
    crank that would move it there and back.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.contracts.design_table import column
from mechwright.contracts.stretch import Samples, travelled
from mechwright.mechanics.linkage.planar_table import AnyPlanarTable
from mechwright.mechanics.planar import Course
from mechwright.mechanics.planar.course import Ways
from mechwright.mechanics.planar.input_range import InputRange, Interval, period_turns, ranges, usable
from mechwright.mechanics.planar.positions import Solution
from mechwright.mechanics.planar.rigid import Turning
from mechwright.mechanics.planar.swing import SLACK, within

SURE = 0.2
"""Sine of the least transmission angle at samples of a turn with which a driver turns fully: between two of
them it falls by far less."""

FINER = (8, 64)
"""How much finer a doubtful turn is looked at, and how much less its sines may be: the square of a sine falls
between two samples by less than their distance squared."""

TURN_SAMPLES = 181
"""Samples of a turn at which that is looked at."""


@dataclass(frozen=True)
class Period:
    """Times (..., n), s, the input, and the motion of all links."""

    time: Array
    drive: Turning
    solution: Solution


def range_of(table: AnyPlanarTable) -> InputRange:
    """Where the input of one linkage can be."""
    return table.once("range", lambda: ranges(table.machine))


def turns_fully(table: AnyPlanarTable) -> bool:
    """Whether the driver of one linkage turns all the way round, and without a change point."""
    found = range_of(table)
    return not table.driver_slides and found.turns_fully and not found.change_points


def is_lever(table: AnyPlanarTable) -> bool:
    """Whether the input of one linkage goes there and back."""
    if table.closed_ways is not None:
        return table.closed_ways.course.rocks
    return table.driver_slides or table.requested is not None or not turns_fully(table)


def interval_of(table: AnyPlanarTable) -> Interval | None:
    """Where the input goes by itself: around the drawn position, up to a degree of transmission angle."""
    ways = usable(table.machine).intervals
    turn, drawn = 0.0 if table.driver_slides else math.tau, table.drawn_at
    for way in ways:
        shift = turn * round((drawn - (way.low + way.high) / 2) / turn) if turn else 0.0
        if way.low + shift - SLACK <= drawn <= way.high + shift + SLACK:
            return Interval(way.low + shift, way.high + shift, way.low_limit, way.high_limit)
    return ways[0] if ways else None


def ends_of(table: AnyPlanarTable) -> tuple[float, float] | None:
    """The ends between which the input goes to and fro; None where it cannot reach what is requested."""
    asked = table.requested
    if asked is None:
        way = interval_of(table)
        return None if way is None else (way.low, way.high)
    ways = [(one.low, one.high) for one in range_of(table).intervals]
    if table.driver_slides:
        low, high = min(asked), max(asked)
        return asked if any(a - SLACK <= low and high <= b + SLACK for a, b in ways) else None
    return within([(-math.pi, math.pi)] if range_of(table).turns_fully else ways, *asked)


def course_of(table: AnyPlanarTable) -> Course:
    """One period of the input of one linkage that closes and reaches what is requested."""
    return table.once("course", lambda: _course(table))


def _course(table: AnyPlanarTable) -> Course:
    if table.closed_ways is not None:
        return table.closed_ways.course
    if is_lever(table):
        ends = ends_of(table)
        assert ends is not None  # noqa: S101 - the rules come first
        return Course.between(*(ends if table.requested is not None or table.sense > 0 else ends[::-1]))
    return Course(table.drawn_at, table.sense * period_turns(table.machine) * math.tau)


def period_of(table: AnyPlanarTable, samples: Samples) -> Period:
    """The motion of one linkage over one period, both ends included."""
    time, drive = course_of(table).period(samples, float(np.ravel(table.omega)[0]))
    return Period(time, drive, table.solved(drive))


def ways_of(table: AnyPlanarTable) -> Ways:
    """The way of every input of a table; of those that turn without a doubt it is found at once."""
    return table.closed_ways or table.once("ways", lambda: _ways(table))


def _ways(table: AnyPlanarTable) -> Ways:
    size = table.size
    start, travel = (
        column(table.drawn_at, size).copy(),
        column(table.sense * period_turns(table.machine) * math.tau, size).copy(),
    )
    rocks = np.zeros((size, 1), bool)
    doubtful = np.flatnonzero(~sure_to_turn(table)) if table.may_turn else np.arange(size)
    for place in doubtful.tolist():
        course = course_of(table.row(place))
        start[place], travel[place], rocks[place] = course.start, course.travel, course.rocks
    return Ways(start, travel, rocks)


def sure_to_turn(table: AnyPlanarTable) -> NDArray[np.bool_]:
    """Which drivers (n,) of a table turn all the way without a doubt."""

    def found() -> NDArray[np.bool_]:
        sure, closes = _turn_at(table, TURN_SAMPLES, SURE)
        doubtful = np.flatnonzero(closes & ~sure)
        for finer in FINER:
            if not doubtful.size:
                break
            some = _turn_at(table.rows(doubtful), finer * (TURN_SAMPLES - 1) + 1, SURE / finer)
            sure[doubtful], doubtful = some[0], doubtful[some[1] & ~some[0]]
        return sure

    return table.once("sure to turn", found)


def _turn_at(
    table: AnyPlanarTable, samples: int, least: float
) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Which drivers (n,) turn with all sines above the least at samples of a turn, and which close at all."""
    at = table.drawn_at + travelled(
        period_turns(table.machine) * math.tau, samples * period_turns(table.machine)
    )
    at, shape, chain = np.atleast_2d(at), (table.size, at.shape[-1]), table.chain
    if chain is not None and chain.dyads:
        sines = chain.values(np.broadcast_to(at, shape), [chain.least_sine()])[:, 0]
        return np.all(sines > least, axis=-1), np.all(np.isfinite(sines), axis=-1)
    solution = table.solved_at(at, 0)
    closes = np.asarray(np.broadcast_to(solution.closes, shape).all(axis=-1))
    steep = [np.broadcast_to(one > least, shape).all(axis=-1) for one in solution.sines.values()]
    return np.asarray(np.logical_and.reduce([closes, *steep])), closes


def phases_of(samples: int) -> Array:
    """Phases (samples,) over the period; of levers the way there is the way back."""
    return np.linspace(0.0, math.tau, samples)


def inputs_at(table: AnyPlanarTable, phases: Array) -> Array:
    """Inputs (n, m) at phases (m,) or (n, m)."""
    ways = ways_of(table)
    turned = np.asarray(ways.start + ways.travel * phases / math.tau)
    if not ways.rocks.any():
        return turned
    return np.where(ways.rocks, ways.start + ways.travel / 2 * (1 - np.cos(phases)), turned)


def drives_at(table: AnyPlanarTable, phases: Array) -> tuple[Array, Turning]:
    """Times (n, m), s, and inputs over time at phases (m,), as :meth:`Course.period` has them for one."""
    ways, omega = ways_of(table), column(table.omega, table.size)
    half, cos, sin = ways.travel / 2, np.cos(phases), np.sin(phases)
    theta = inputs_at(table, phases)
    turning = np.sign(ways.travel) * omega
    speed = np.where(ways.rocks, half * omega * sin, turning)
    alpha = np.where(ways.rocks, half * omega**2 * cos, 0.0)
    jerk = np.where(ways.rocks, -half * omega**3 * sin, 0.0)
    time = np.where(ways.rocks, phases, np.abs(ways.travel) * phases / math.tau) / omega
    return time, Turning.of(theta, speed, alpha, jerk)


def over_phases(table: AnyPlanarTable, samples: int) -> tuple[Array, Solution]:
    """Phases (m,) over a period, and the motion (n, m) with rates by the phase."""
    phases = phases_of(samples)
    ways = ways_of(table)
    half, cos, sin = ways.travel / 2, np.cos(phases), np.sin(phases)
    rates = [np.where(ways.rocks, lever, 0.0) for lever in (half * sin, half * cos, -half * sin)]
    first = np.where(ways.rocks, rates[0], ways.travel / math.tau)
    return phases, table.solved(Turning.of(inputs_at(table, phases), first, *rates[1:]))
