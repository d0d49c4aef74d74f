"""The moves of a run as LinuxCNC's planner gets them: one segment each, in queues that end where it waits.

Passes repeat at every depth: what the planner asks of a segment, or of one segment and the next, is asked
once for all that are alike.

Glossary
--------
queue
    Segments between which the planner may go on without a stop. Whatever waits for the end of motion begins a
    new one: a change of tool, spindle, coolant or offsets, a dwell, a stop.
kind
    Segments that have length, direction, feed and modes in common.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array, first_of_each
from mechwright_cam.controls.lookahead.geometry import directions, moved
from mechwright_cam.controls.lookahead.speeds import NO_LENGTH
from mechwright_cam.controls.reading.run import Ints, Kind, Run, State
from mechwright_cam.shop.machine import Machine

EXACT_PATH, EXACT_STOP = 610, 611
"""G61 and G61.1, in tenths."""
ALIKE = 1e-6
"""Segments are of one kind if nothing of them differs by more, mm and rad: less than the last digit of any
program."""


@dataclass(frozen=True)
class SegmentGeometry:
    """Segments, m of them of k kinds, with p kinds of junction between each two.

    Parameters
    ----------
    step, kind, queue
        (m,) int: the step of the run, the segment's kind, and a number for each queue.
    junction
        (m - 1,) int: the kind of junction to the next one.
    before, after, both
        (p,) the kinds of segment on either side, and whether both are in one queue.
    length, radius, signed
        (k,) mm, mm and rad; radius inf and angle 0 of lines, positive counter-clockwise.
    chord
        (k, 3) from start to end, mm.
    first, last
        (k, 3) unit vectors of the path at the start and at the end.
    rapid
        (k,) bool.
    exact, stop
        (k,) bool: the segment's end is exact (G61, and in drilling cycles), or a stop (G61.1).
    blend
        (k,) P of G64 in force, mm; 0 without a bound.
    feed
        (k,) as programmed, mm/s.
    """

    step: Ints
    kind: Ints
    queue: Ints
    junction: Ints
    before: Ints
    after: Ints
    both: NDArray[np.bool_]
    length: Array
    radius: Array
    signed: Array
    chord: Array
    first: Array
    last: Array
    rapid: NDArray[np.bool_]
    exact: NDArray[np.bool_]
    stop: NDArray[np.bool_]
    blend: Array
    feed: Array

    @cached_property
    def at_end(self) -> NDArray[np.bool_]:
        """(m,) whether a segment is the last one of its queue."""
        return np.append(self.queue[1:] != self.queue[:-1], True)

    @cached_property
    def arc(self) -> NDArray[np.bool_]:
        """(k,) whether a segment is an arc."""
        return np.isfinite(self.radius)

    @cached_property
    def sweep(self) -> Array:
        """(k,) angle of an arc, rad."""
        return np.abs(self.signed)

    def repeated(self, count: int) -> "SegmentGeometry":
        """All of it so many times, one after the other and each in queues of its own."""
        which, kinds, junctions = np.arange(count)[:, None], self.length.size, self.before.size
        of_kinds = ("length", "radius", "signed", "rapid", "exact", "stop", "blend", "feed")
        # From the end of one copy to the beginning of the next: a kind of junction for each.
        seams = np.column_stack((self.kind[-1:] + which[:-1] * kinds, self.kind[:1] + which[1:] * kinds))
        return SegmentGeometry(
            step=np.tile(self.step, count),
            kind=(self.kind + which * kinds).ravel(),
            queue=(self.queue + which * (int(self.queue.max(initial=0)) + 1)).ravel(),
            junction=np.hstack((self.junction + which * junctions, junctions * count + which)).ravel()[:-1],
            before=np.append(self.before + which * kinds, seams[:, 0]),
            after=np.append(self.after + which * kinds, seams[:, 1]),
            both=np.append(np.tile(self.both, count), np.zeros(count - 1, dtype=np.bool_)),
            **{name: np.tile(getattr(self, name), count) for name in of_kinds},
            **{name: np.tile(getattr(self, name), (count, 1)) for name in ("chord", "first", "last")},
        )


def segment_geometry(run: Run, machine: Machine) -> SegmentGeometry:
    """The segments of a run: what does not depend on how fast the machine is."""
    length, rapid = moved(run, machine)
    step = np.flatnonzero(length > NO_LENGTH)
    cycle = _in_cycle(run, step, rapid[step])
    one, kind = _kinds(run, step, cycle)
    own = step[one]
    some = run.only(own)
    first, last = directions(some)
    arc = some.kind == Kind.ARC
    with np.errstate(invalid="ignore"):
        chord = np.nan_to_num(some.end - some.start, posinf=0.0, neginf=0.0)
    modes, queue = some.of_states(lambda state: state.path_mode), _queues(run)[step]
    both = queue[1:] == queue[:-1]
    pairs, junction = np.unique(2 * (kind[:-1] * one.size + kind[1:]) + both, return_inverse=True)
    return SegmentGeometry(
        step=step,
        kind=kind,
        queue=queue,
        junction=junction,
        before=pairs // 2 // max(one.size, 1),
        after=pairs // 2 % max(one.size, 1),
        both=pairs % 2 == 1,
        length=length[own],
        radius=np.where(arc, some.radius, np.inf),
        signed=np.where(arc, some.sweep, 0.0),
        chord=np.where(arc[:, None], chord, first * length[own, None]),
        first=first,
        last=last,
        rapid=rapid[own],
        exact=(modes == EXACT_PATH) | cycle[one],
        stop=modes == EXACT_STOP,
        blend=some.of_states(lambda state: state.blend),
        feed=some.feed / 60,
    )


def _kinds(run: Run, step: Ints, cycle: NDArray[np.bool_]) -> tuple[Ints, Ints]:
    """The first (k,) of each kind of some steps (m,), and the kind (m,) of each."""
    modes = [(state.path_mode, state.blend) for state in run.states]
    number = {mode: k for k, mode in enumerate(dict.fromkeys(modes))}
    mode = np.array([number[mode] for mode in modes], dtype=np.int64)[run.state[step]]
    start = run.start[step]
    with np.errstate(invalid="ignore"):
        chord, centre = run.end[step] - start, run.centre[step] - start[:, :2]
    arc = run.kind[step] == Kind.ARC
    centre = np.where(arc[:, None], centre, 0.0)
    sizes = np.column_stack((chord, centre, run.sweep[step], run.feed[step]))
    known = np.asarray(np.isfinite(sizes).all(axis=1))
    # From or to an unknown place no move is like another one.
    alone = np.where(known, 0, 1 + np.arange(step.size))
    words = np.column_stack((run.kind[step], mode, cycle, alone))
    rounded = np.rint(np.where(known[:, None], sizes, 0.0) / ALIKE).astype(np.int64)
    return first_of_each(np.concatenate((rounded, words), axis=1))


def _queues(run: Run) -> Ints:
    """(n,) numbers that grow where the control waits for the end of motion."""
    kinds = [_waited_for(state) for state in run.states]
    number = {kind: k for k, kind in enumerate(dict.fromkeys(kinds))}
    state = np.array([number[kind] for kind in kinds], dtype=np.int64)[run.state]
    waits = ~(run.moving | (run.kind == Kind.HOME))
    waits[1:] |= state[1:] != state[:-1]
    queues: Ints = np.cumsum(waits)
    return queues


def _waited_for(state: State) -> tuple[object, ...]:
    """What the control changes at a standstill only."""
    return (
        *(state.tool, state.length_offset, state.length, state.work_offset),
        *(state.spindle, state.rpm, state.coolant),
    )


def _in_cycle(run: Run, step: Ints, rapid: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """(m,) whether a segment is one of a drilling cycle: of several in one line, some are rapids."""
    line = run.line[step] - int(run.line[step].min(initial=0))
    if run.files:
        line = line + run.file[step] * (int(line.max(initial=0)) + 1)
    every = np.bincount(line)
    rapids = np.bincount(line, weights=rapid)
    return ((every > 1) & (rapids > 0))[line]
