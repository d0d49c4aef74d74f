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

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array, first_of_each
from mechwright_cam.controls.lookahead.blend_arc import blend_arcs
from mechwright_cam.controls.lookahead.contract import Lookahead, Motion
from mechwright_cam.controls.lookahead.overlap import Overlaps, half_sine
from mechwright_cam.controls.lookahead.segment_geometry import segment_geometry
from mechwright_cam.controls.lookahead.segments import NORMAL, Segments, segments
from mechwright_cam.controls.lookahead.speeds import reached, seconds
from mechwright_cam.controls.reading.run import Ints, Run
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
    """How the planner goes from one segment to the next, in p kinds of junction.

    Parameters
    ----------
    speed
        (p,) greatest speed there, mm/s; 0 for a stop or an overlap.
    kink
        (p,) share of the acceleration of both segments that a kink takes.
    overlap
        (p,) bool.
    may_overlap, may_round
        (p,) bool: an overlap, or an arc, or so nearly one that the planner may decide otherwise.
    sine
        (p,) of half the turn, as overlaps see it.
    arc_length, trim
        (p,) of blend arcs, mm: how long, and what they take of either segment; else 0.
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
        return self.motions(run, machine, [machine.acceleration])[0]

    def motions(self, run: Run, machine: Machine, accelerations: Sequence[float]) -> list[Motion]:
        """The same with several accelerations, of which each is a machine of its own."""
        way = segment_geometry(run, machine)
        took = np.zeros((len(accelerations), len(run)))
        off = np.tile(_merged(run), (len(accelerations), 1))
        if way.step.size:
            going = _Going(segments(way, machine, accelerations, SERVO_S))
            took[:, way.step] = going.seconds().reshape(len(accelerations), -1)
            off[:, way.step] += going.off().reshape(len(accelerations), -1)
        return [Motion(*both) for both in zip(took, off, strict=True)]


def _merged(run: Run) -> Array:
    """How far (n,) the tool may be off because lines have been merged, mm."""
    return np.asarray(run.of_states(lambda state: state.off_path - state.blend), dtype=np.float64)


class _Going:
    """How segments follow on each other: junctions, and what of the acceleration is left along the path."""

    def __init__(self, row: Segments) -> None:
        self.row = row
        self.met = met = junctions(row)
        overlap, kink = met.overlap[row.junction], met.kink[row.junction]
        kink = np.maximum(np.append(kink, 0.0), np.append(0.0, kink))
        lagging = np.append(overlap, True) | row.at_end
        self.slowed = lagging & ~(row.exact | row.stop)[row.kind] | np.append(False, overlap)
        self.rate, self.speed = _along(row, kink, self.slowed)

    def off(self) -> Array:
        """How far (m,) the tool may be off in each segment, mm: at the worse of its two ends."""
        row, met = self.row, self.met
        rounding = np.where(row.blend > 0, row.blend, np.inf)[row.before]
        between = np.where(met.may_round, rounding, 0.0)[row.junction]
        at = np.flatnonzero(met.may_overlap[row.junction])
        if at.size:
            halved = np.where(self.slowed, self.rate, self.rate / 2)
            both = np.stack((halved[at], halved[at + 1]))
            one, alike = first_of_each(np.vstack((row.junction[at], both.view(np.int64))).T)
            wide = self._overlaps(at[one], both[:, one]).off(LATE_S)
            between[at] = np.maximum(between[at], MEASURED * wide[alike])
        worse = np.maximum(np.append(between, 0.0), np.append(0.0, between))
        chord = NORMAL * row.highest[row.kind] * SERVO_S**2 / 8  # between two samples on an arc
        return np.asarray(worse + chord + LAST_DIGIT)

    def seconds(self) -> Array:
        """Time (m,) of each segment, s; a blend arc counts with the segment before it."""
        row, met, count = self.row, self.met, self.row.step.size
        through, trim = met.speed[row.junction], met.trim[row.junction]
        # Segment, blend, segment, blend, ..., segment.
        length, rates, caps = (np.zeros(2 * count - 1) for _ in range(3))
        length[::2], rates[::2], caps[::2] = row.length[row.kind], self.rate, self.speed
        length[:-1:2] -= trim
        length[2::2] -= trim
        length[::2] = np.maximum(length[::2], 0.0)
        length[1::2], caps[1::2] = met.arc_length[row.junction], through
        rates[1::2] = TANGENTIAL * row.highest[row.kind[:-1]]
        ends = np.zeros(2 * count)
        ends[1:-1:2] = ends[2:-1:2] = np.minimum(through, np.minimum(self.speed[:-1], self.speed[1:]))
        # The last segment of a queue may still be cut short: it is entered no faster than it could be left.
        last = np.flatnonzero(row.at_end & (np.arange(count) > 0))
        shortest = np.sqrt(self.rate[last] * row.length[row.kind[last]])
        ends[2 * last] = np.minimum(ends[2 * last], shortest)
        took = seconds(length, rates, caps, reached(length, rates, ends))
        total = took[::2].copy()
        total[:-1] += took[1::2]
        overlap = met.overlap[row.junction]
        at = np.flatnonzero(overlap)
        total[at] -= self._overlaps(at, np.stack((self.rate[at], self.rate[at + 1]))).seconds
        total[np.append((through == 0) & ~overlap, True)] += STOP_CYCLES * SERVO_S
        return total

    def _overlaps(self, at: Ints, rate: Array) -> Overlaps:
        """Those between some segments (q,) and the next ones."""
        row, junction = self.row, self.row.junction[at]
        speed = np.stack((self.speed[at], self.speed[at + 1]))
        return Overlaps(row, row.kind[at], row.kind[at + 1], rate, speed, self.met.sine[junction])


def junctions(row: Segments) -> Junctions:
    """The ways that the planner chooses."""
    one, two = row.before, row.after
    before, after, fastest = row.last[one], row.first[two], row.speed
    runs_on = row.both & (row.rapid[one] == row.rapid[two]) & ~row.stop[one]
    runs_on &= np.sqrt(((before + after) ** 2).sum(axis=1)) >= SHARP
    speed = np.minimum(fastest[one], fastest[two])
    bend = np.abs(after - before).max(axis=1)
    share = bend * (speed / SERVO_S + row.acceleration[two]) / row.highest[one]
    share[row.arc[one] | row.arc[two]] /= TANGENTIAL
    tangent = runs_on & (share < KINK)
    slower = speed * np.minimum(1.0, KINK / np.maximum(share, 1e-12))
    arcs = blend_arcs(row, SERVO_S)
    sine = half_sine(row)
    either = np.stack((one, two))
    rate = (row.acceleration * 0.5 * (1 - KINK) * np.where(row.arc, TANGENTIAL, 1.0))[either]
    lapping = np.where(runs_on, Overlaps(row, one, two, rate, fastest[either], sine, 0.5).performance, 0.0)
    free = runs_on & ~tangent & ~row.exact[one]
    performance = np.stack((lapping / 2, slower, np.where(free, arcs.speed, 0.0)))
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


def _along(row: Segments, kink: Array, slowed: NDArray[np.bool_]) -> tuple[Array, Array]:
    """Acceleration (m,) along the path and speed (m,): arcs share theirs with the way round."""
    rate = row.acceleration[row.kind] * (1 - kink) * np.where(slowed, 0.5, 1.0)
    speed = np.minimum(row.asked, row.most)[row.kind]
    at = np.flatnonzero(row.arc[row.kind])
    kind, own = row.kind[at], rate[at]
    climb = np.sqrt(np.maximum(row.length**2 - (row.sweep * np.where(row.arc, row.radius, 0.0)) ** 2, 0.0))
    radius = (row.radius + climb**2 / row.radius)[kind]  # of curvature: that of a helix is larger
    across = row.most[kind] ** 2 / radius
    fast = across > NORMAL * own * (1 - 1e-9)
    speed[at] = np.where(fast, np.minimum(speed[at], np.sqrt(NORMAL * own * radius)), speed[at])
    rate[at] *= np.where(fast, TANGENTIAL, np.sqrt(np.maximum(1 - (across / own) ** 2, 0.0)))
    return rate, speed
