"""The moves of a run as LinuxCNC's planner gets them: one segment each, in queues that end where it waits.

Glossary
--------
queue
    Segments between which the planner may go on without a stop. Whatever waits for the end of motion begins a
    new one: a change of tool, spindle, coolant or offsets, a dwell, a stop.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright_cam.controls.lookahead.geometry import directions, moved
from mechwright_cam.controls.lookahead.speeds import NO_LENGTH
from mechwright_cam.controls.reading.run import Ints, Kind, Run, State
from mechwright_cam.shop.machine import Machine

NORMAL = np.sqrt(0.75)
"""Share of an axis' acceleration that an arc may take across its path."""
EXACT_PATH, EXACT_STOP = 610, 611
"""G61 and G61.1, in tenths."""


@dataclass(frozen=True)
class Segments:
    """Segments, m of them.

    Parameters
    ----------
    step
        (m,) of the run.
    length, radius, signed
        (m,) mm, mm and rad; radius inf and angle 0 of lines, positive counter-clockwise.
    first, last
        (m, 3) unit vectors of the path at the start and at the end.
    rapid
        (m,) bool.
    queue
        (m,) int: a number for each queue.
    exact, stop
        (m,) bool: the segment's end is exact (G61, and in drilling cycles), or a stop (G61.1).
    blend
        (m,) P of G64 in force, mm; 0 without a bound.
    asked, most
        (m,) speed that is asked for, and the greatest that the axes and an arc's radius allow, mm/s.
    acceleration
        (m,) along the path, mm/s², if nothing else takes any.
    """

    step: Ints
    length: Array
    radius: Array
    signed: Array
    first: Array
    last: Array
    rapid: NDArray[np.bool_]
    queue: Ints
    exact: NDArray[np.bool_]
    stop: NDArray[np.bool_]
    blend: Array
    asked: Array
    most: Array
    acceleration: Array

    @property
    def arc(self) -> NDArray[np.bool_]:
        """(m,) whether a segment is an arc."""
        return np.isfinite(self.radius)

    @property
    def sweep(self) -> Array:
        """(m,) angle of an arc, rad."""
        return np.abs(self.signed)

    @property
    def speed(self) -> Array:
        """(m,) the smaller of ``asked`` and ``most``, mm/s."""
        return np.minimum(self.asked, self.most)


def segments(run: Run, machine: Machine, cycle: float) -> Segments:
    """The segments of a run on a machine whose servo period is ``cycle``, s."""
    length, rapid = moved(run, machine)
    step = np.flatnonzero(length > NO_LENGTH)
    first, last = (vectors[step] for vectors in directions(run))
    length, rapid = length[step], rapid[step]
    arc = run.kind[step] == Kind.ARC
    radius = np.where(arc, run.radius[step], np.inf)
    signed = np.where(arc, run.sweep[step], 0.0)
    highest = machine.acceleration * 1000.0
    z = machine.rapid if machine.rapid_z is None else machine.rapid_z
    axes = np.array((machine.rapid, machine.rapid, z)) / 60
    chord = np.where(arc[:, None], _chords(run, step), first * length[:, None])
    nowhere = ~chord.any(axis=1) & ~arc
    chord[nowhere, 0] = length[nowhere]  # from an unknown place: along some axis
    # As a straight move the axes would take so long; an arc takes what its plane needs, too.
    time, ramp = (np.abs(chord) / axes).max(axis=1), np.abs(chord).max(axis=1) / highest
    round_ = np.abs(signed) * np.where(arc, radius, 0.0)
    flat = np.minimum(np.sqrt(NORMAL * highest * radius), axes[:2].min())
    time, ramp = np.maximum(time, round_ / flat), np.maximum(ramp, round_ / highest)
    most = np.minimum(np.minimum(length / np.maximum(time, 1e-12), axes.max()), length / cycle)
    feed = np.minimum(run.feed[step], machine.max_feed) / 60
    modes = run.of_states(lambda state: state.path_mode)[step]
    cycles = _in_cycle(run, step, rapid)
    return Segments(
        step=step,
        length=length,
        radius=radius,
        signed=signed,
        first=first,
        last=last,
        rapid=rapid,
        queue=_queues(run)[step],
        exact=(modes == EXACT_PATH) | cycles,
        stop=modes == EXACT_STOP,
        blend=run.of_states(lambda state: state.blend)[step],
        asked=np.where(rapid, most, np.maximum(feed, NO_LENGTH)),
        most=most,
        acceleration=length / np.maximum(ramp, 1e-12),
    )


def _chords(run: Run, step: Ints) -> Array:
    with np.errstate(invalid="ignore"):
        return np.nan_to_num(run.end[step] - run.start[step], posinf=0.0, neginf=0.0)


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
