"""A program for several plates, each at a work offset of its own: what it does at one of them.

The plates know nothing of each other: a tool that leaves one goes to the machine's upper end, and where it
comes from is unknown to the next. So the proof of all is the proof of each, without the steps that are made
at the others, and the rule of :mod:`mechwright_cam.proof.neighbours`.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from mechwright_cam.controls.reading import Kind, Run
from mechwright_cam.controls.reading.run import COLUMNS, Ints, TableWrite
from mechwright_cam.proof.report import OperationTime

SHARED = (Kind.TOOL, Kind.END, Kind.TABLE, Kind.MAYBE)
"""Steps that belong to all plates, whatever work offset happens to be in force."""
ALIKE = tuple(name for name in COLUMNS if name not in {"state", "line"})


def at_offset(run: Run, others: Sequence[str], places: Sequence[tuple[int, int]]) -> Run:
    """The run without what is done at other work offsets.

    Parameters
    ----------
    run
        The whole program.
    others
        The work offsets of the other plates; moves in any offset that is none of the job's stay, for the
        rules to refuse.
    places
        L and P of the G10 that set them.
    """
    foreign = run.of_states(lambda state: state.work_offset in others)
    shared = np.isin(run.kind, SHARED)
    kept: Ints = np.flatnonzero(~foreign | shared)
    after = np.searchsorted(kept, np.arange(len(run) + 1))
    """How many of the kept steps are before each."""
    # A comment, or a start of the spindle, is of the step behind it; what is behind all is everybody's.
    mine = np.append(~foreign | shared, True)
    new = run.only(kept)
    for ends in (new.start, new.end):
        away = foreign[kept]
        ends[away, :2] = np.nan
        ends[away & ~np.isposinf(ends[:, 2]), 2] = np.nan
    writes = [write for write in run.writes if (write.table, write.number) not in places]
    return replace(
        new,
        remarks=tuple(replace(one, step=int(after[one.step])) for one in run.remarks if mine[one.step]),
        writes=tuple(_moved(write, int(after[write.step])) for write in writes),
        spindle_changes=tuple(
            replace(one, step=int(after[one.step])) for one in run.spindle_changes if mine[one.step]
        ),
    )


def _moved(write: TableWrite, step: int) -> TableWrite:
    return replace(write, step=step)


def alike(one: Run, other: Run) -> bool:
    """Whether two runs are the same but for the work offsets that they are made in."""
    return (
        len(one) == len(other)
        and all(np.array_equal(getattr(one, name), getattr(other, name), equal_nan=True) for name in ALIKE)
        and _states(one) == _states(other)
    )


def _states(run: Run) -> list[object]:
    """The states of the steps one after the other, each change once."""
    plain = [replace(state, work_offset=None) for state in run.states]
    number = {state: place for place, state in enumerate(dict.fromkeys(plain))}
    numbers = np.array([number[state] for state in plain])[run.state]
    first = np.flatnonzero(np.diff(numbers, prepend=-1))
    return [*zip(first.tolist(), (plain[run.state[step]] for step in first), strict=True)]


def combined_times(times: Sequence[Sequence[OperationTime]]) -> tuple[OperationTime, ...]:
    """Times by operation over all plates: summed where each has the same operations."""
    first = times[0]
    names = [[(one.name, one.tool) for one in own] for own in times]
    if any(own != names[0] for own in names):
        return tuple(one for own in times for one in own)
    return tuple(
        replace(
            one,
            time_s=sum(own[place].time_s for own in times),
            cutting_mm=sum(own[place].cutting_mm for own in times),
            cutting_s=sum(own[place].cutting_s for own in times),
        )
        for place, one in enumerate(first)
    )
