"""LinuxCNC's trajectory planner (2.9), by the rules of its sources.

From one segment to the next it goes in one of four ways:

stop
    Between rapids and feeds, at turns of more than 178 degrees, and as G61 and G61.1 ask.
tangent
    Straight on, where the kink asks for little acceleration within a servo cycle; where it asks for more,
    slower.
arc
    Round the corner on an arc within P, where both segments lie in one plane.
overlap
    The one slows down to a stop while the next already speeds up, each with half the acceleration.

Of tangent, arc and overlap it takes the fastest, an overlap counting half. Segments look ahead to each other
over any length here, the control's fifty. It merges lines that a line within Q replaces before that; their
number is not followed here.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright_cam.controls.lookahead.blend_arc import blend_arcs
from mechwright_cam.controls.lookahead.contract import Lookahead, Motion
from mechwright_cam.controls.lookahead.overlap import Overlaps, half_sine, overlaps
from mechwright_cam.controls.lookahead.segments import NORMAL, Segments, segments
from mechwright_cam.controls.lookahead.speeds import reached, seconds
from mechwright_cam.controls.reading.run import Run
from mechwright_cam.shop.machine import Machine

SERVO_S = 1e-3
"""Servo period, s: LinuxCNC's default."""
KINK = 0.1
"""Share of an axis' acceleration that a kink may take (``ARC_BLEND_KINK_RATIO``)."""
TANGENTIAL = 0.5
"""Share of it that stays along an arc which is run as fast as its radius allows."""
SHARP = np.radians(2.0)
"""Directions that are so near to opposite ones are a stop, rad."""
NEARLY = 0.6
"""Ways of which one is nearly as fast as another, by so much, may be taken either way."""
LATE_S = 2 * SERVO_S
"""An overlap may last so much longer than it should, s: it begins with a servo period, and ends with one."""
MEASURED = 1.05
"""Overlaps are this much wider than their rule has them, where three moves follow on each other closely: 1.02
is the most that has been seen, in one of ten million samples."""
LAST_DIGIT = 1e-4
"""Of what a program states, mm: ends and centre of an arc never agree better."""
STOP_CYCLES = 1.0
"""Servo periods that a stop takes besides."""


@dataclass(frozen=True)
class Junctions:
    """How the planner goes from each of m segments to the next; the last has none.

    Parameters
    ----------
    speed
        (m - 1,) greatest speed there, mm/s; 0 for a stop or an overlap.
    kink
        (m - 1,) share of the acceleration of both segments that a kink takes.
    overlap
        (m - 1,) bool.
    may_overlap, may_round
        (m - 1,) bool: an overlap, or an arc, or so nearly one that the planner may decide otherwise.
    sine
        (m - 1,) of half the turn, as overlaps see it.
    arc_length, trim
        (m - 1,) of blend arcs, mm: how long, and what they take of either segment; else 0.
    """

    speed: Array
    kink: Array
    overlap: NDArray[np.bool_]
    may_overlap: NDArray[np.bool_]
    may_round: NDArray[np.bool_]
    sine: Array
    arc_length: Array
    trim: Array


class Planner(Lookahead):
    """LinuxCNC's planner with its defaults, every axis with the acceleration of the machine."""

    def motion(self, run: Run, machine: Machine) -> Motion:
        """Times and deviations by the rules."""
        row = segments(run, machine, SERVO_S)
        if not row.step.size:
            return Motion(np.zeros(len(run)), run.of_states(lambda state: state.off_path))
        took, highest = np.zeros(len(run)), machine.acceleration * 1000.0
        going = _Going(row, highest)
        over = overlaps(row, going.rate, going.met.overlap, going.speed, sine=going.met.sine)
        took[row.step] = _times(row, going.met, over, going.rate, going.speed, highest)
        return Motion(took, going.deviations(run))

    def off(self, run: Run, machine: Machine) -> Array:
        """Deviations alone."""
        row = segments(run, machine, SERVO_S)
        if not row.step.size:
            return np.asarray(run.of_states(lambda state: state.off_path))
        return _Going(row, machine.acceleration * 1000.0).deviations(run)


class _Going:
    """How segments follow on each other: junctions, and what of the acceleration is left along the path."""

    def __init__(self, row: Segments, highest: float) -> None:
        self.row, self.highest = row, highest
        self.met = met = junctions(row, highest)
        lagging = np.concatenate((met.overlap | _at_end(row)[:-1], [True]))
        follows = np.concatenate(([False], met.overlap))
        kink = np.maximum(np.append(met.kink, 0.0), np.append(0.0, met.kink))
        self.slowed = lagging & ~row.exact & ~row.stop | follows
        rate = row.acceleration * (1 - kink) * np.where(self.slowed, 0.5, 1.0)
        fastest, self.rate = _on_arcs(row, rate)
        self.speed = np.minimum(row.asked, fastest)

    def deviations(self, run: Run) -> Array:
        """How far (n,) the tool may be off in each step, mm."""
        met, halved = self.met, np.where(self.slowed, self.rate, self.rate / 2)
        wide = overlaps(self.row, halved, met.may_overlap, self.speed, late=LATE_S, sine=met.sine).off
        return _deviations(run, self.row, met, wide, self.highest)


def junctions(row: Segments, highest: float) -> Junctions:
    """The ways that the planner chooses; ``highest``: acceleration of an axis, mm/s²."""
    before, after = row.last[:-1], row.first[1:]
    both = row.queue[1:] == row.queue[:-1]
    runs_on = both & (row.rapid[1:] == row.rapid[:-1]) & ~row.stop[:-1]
    runs_on &= np.sqrt(((before + after) ** 2).sum(axis=1)) >= SHARP
    speed = np.minimum(row.speed[:-1], row.speed[1:])
    bend = np.abs(after - before).max(axis=1)
    share = bend * (speed / SERVO_S + row.acceleration[1:]) / highest
    share[row.arc[:-1] | row.arc[1:]] /= TANGENTIAL
    tangent = runs_on & (share < KINK)
    slower = speed * np.minimum(1.0, KINK / np.maximum(share, 1e-12))
    arcs = blend_arcs(row, highest, SERVO_S)
    sine = half_sine(row)
    lapping = overlaps(
        row,
        row.acceleration * 0.5 * (1 - KINK) * np.where(row.arc, TANGENTIAL, 1.0),
        runs_on,
        row.speed,
        planned=True,
        sine=sine,
    )
    free = runs_on & ~tangent & ~row.exact[:-1]
    performance = np.stack((lapping.performance / 2, slower, np.where(free, arcs.speed, 0.0)))
    best, nearly = np.argmax(performance, axis=0), NEARLY * performance.max(axis=0)
    overlap, kinked, arc = (free & (best == k) for k in range(3))
    return Junctions(
        speed=np.select((tangent | kinked, arc), (slower, arcs.speed), 0.0),
        kink=np.select((tangent, kinked, runs_on & ~free), (share, KINK, KINK), 0.0),
        overlap=overlap,
        may_overlap=free & (performance[0] >= nearly),
        may_round=free & (performance[2] >= nearly),
        sine=sine,
        arc_length=np.where(arc, arcs.length, 0.0),
        trim=np.where(arc, arcs.trim, 0.0),
    )


def _at_end(row: Segments) -> NDArray[np.bool_]:
    """(m,) whether a segment is the last one of its queue."""
    return np.append(row.queue[1:] != row.queue[:-1], True)


def _on_arcs(row: Segments, rate: Array) -> tuple[Array, Array]:
    """Greatest speed (m,) and acceleration along the path (m,): arcs share theirs with the way round."""
    radius = np.where(row.arc, _effective(row), np.inf)
    across = row.most**2 / radius
    fast = across > NORMAL * rate * (1 - 1e-9)
    most = np.where(
        row.arc & fast,
        np.minimum(row.most, np.sqrt(NORMAL * rate * np.where(row.arc, radius, 0.0))),
        row.most,
    )
    share = np.where(fast, TANGENTIAL, np.sqrt(np.maximum(1 - (across / rate) ** 2, 0.0)))
    return most, np.where(row.arc, rate * share, rate)


def _effective(row: Segments) -> Array:
    """Radius of curvature (m,) of helices, mm."""
    climb = np.sqrt(np.maximum(row.length**2 - (row.sweep * np.where(row.arc, row.radius, 0.0)) ** 2, 0.0))
    return np.asarray(row.radius + climb**2 / row.radius)


def _times(row: Segments, met: Junctions, over: Overlaps, rate: Array, speed: Array, highest: float) -> Array:
    """Time (m,) of each segment, s; a blend arc counts with the segment before it."""
    count = row.step.size
    # Segment, blend, segment, blend, ..., segment.
    length, rates, caps = (
        np.zeros(2 * count - 1),
        np.full(2 * count - 1, TANGENTIAL * highest),
        np.zeros(2 * count - 1),
    )
    length[::2], rates[::2], caps[::2] = row.length, rate, speed
    length[:-1:2] -= met.trim
    length[2::2] -= met.trim
    length[::2] = np.maximum(length[::2], 0.0)
    length[1::2], caps[1::2] = met.arc_length, met.speed
    ends = np.zeros(2 * count)
    ends[1:-1:2] = ends[2:-1:2] = np.minimum(met.speed, np.minimum(speed[:-1], speed[1:]))
    # The last segment of a queue may still be cut short: it is entered no faster than it could be left.
    last = np.flatnonzero(_at_end(row) & (np.arange(count) > 0))
    ends[2 * last] = np.minimum(ends[2 * last], np.sqrt(rate[last] * row.length[last]))
    took = seconds(length, rates, caps, reached(length, rates, ends))
    total = took[::2].copy()
    total[:-1] += took[1::2]
    total[:-1] -= over.seconds
    stands = np.append(met.speed == 0, True) & ~np.append(met.overlap, False)
    return np.asarray(total + stands * STOP_CYCLES * SERVO_S)


def _deviations(run: Run, row: Segments, met: Junctions, overlapping: Array, highest: float) -> Array:
    """How far (n,) the tool may be off in each step, mm: by merging, and at the worse of its two ends."""
    merged = run.of_states(lambda state: state.off_path - state.blend)
    rounding = np.where(row.blend[:-1] > 0, row.blend[:-1], np.inf)
    between = np.maximum(np.where(met.may_round, rounding, 0.0), MEASURED * overlapping)
    worse = np.maximum(np.append(between, 0.0), np.append(0.0, between))
    off = np.array(merged)
    chord = NORMAL * highest * SERVO_S**2 / 8  # between two samples on an arc
    off[row.step] += worse + chord + LAST_DIGIT
    return off
