"""Lengths and directions of the moves of a run."""

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright_cam.controls.reading.run import Kind, Run
from mechwright_cam.shop.machine import Machine


def moved(run: Run, machine: Machine) -> tuple[Array, NDArray[np.bool_]]:
    """Length (n,) of each step, mm, 0 where the machine stands, and which of the moves are rapids.

    What the program does not know is taken as half of an axis' travel: the way to the machine's upper end and
    back, and the first one to a place in X and Y.
    """
    moving = run.moving | (run.kind == Kind.HOME)
    with np.errstate(invalid="ignore"):
        ways = run.end - begins(run)
    both_up = np.isposinf(run.start[:, 2]) & np.isposinf(run.end[:, 2])
    ways[both_up, 2] = 0.0
    halves = np.array((machine.travel_x, machine.travel_y, machine.travel_z)) / 2
    ways = np.where(np.isfinite(ways), ways, halves)
    straight = np.sqrt((ways**2).sum(axis=1))
    length = np.where(run.kind == Kind.ARC, run.length, straight)
    return np.where(moving, length, 0.0), np.isin(run.kind, (Kind.RAPID, Kind.HOME))


def directions(run: Run) -> tuple[Array, Array]:
    """Unit vectors (n, 3) of the path at the start and at the end of each step; 0 where unknown."""
    with np.errstate(invalid="ignore"):
        chord = run.end - begins(run)
    chord = np.where(np.isfinite(chord), chord, np.sign(np.nan_to_num(chord)))
    first, last = chord.copy(), chord.copy()
    arc = run.kind == Kind.ARC
    side = np.sign(run.sweep[arc])[:, None]
    per_radian = (chord[arc, 2] / np.maximum(np.abs(run.sweep[arc]), 1e-12))[:, None]
    for vectors, ends in ((first, run.start), (last, run.end)):
        spoke = ends[arc, :2] - run.centre[arc]
        tangent = side * np.column_stack((-spoke[:, 1], spoke[:, 0]))
        vectors[arc] = np.concatenate((tangent, per_radian), axis=1)
        vectors /= np.maximum(np.sqrt((vectors**2).sum(axis=1)), 1e-12)[:, None]
    return first, last


def begins(run: Run) -> Array:
    """Where each step (n, 3) begins, mm; behind a change of tool it is where the tool was changed.

    Where the machine goes in X and Y to change it, only the machine knows: most stay where they are.
    """
    change = run.kind == Kind.TOOL
    if not change.any():
        return run.start
    steps, start = np.arange(len(run)), run.start.copy()
    last = np.maximum.accumulate(np.where(change, steps, -1))
    offset = run.of_states(lambda state: hash(state.work_offset))
    away = (run.kind == Kind.HOME) & (run.machine_xy if run.machine_xy.size else False)
    for axis in range(2):
        known = np.isfinite(run.end[:, axis]) | away
        since = np.append(-1, np.maximum.accumulate(np.where(known, steps, -1))[:-1])
        left = (since >= 0) & (since < last) & (offset == offset[since]) & np.isnan(start[:, axis])
        start[left, axis] = run.end[since[left], axis]
    return start
