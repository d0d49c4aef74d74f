"""What a fault changes in what a program cuts."""

import numpy as np

from mechwright_cam.controls.reading import Kind, Run


def trace(run: Run) -> np.ndarray:
    """(n, 20) what happens, step by step, without the lines' numbers.

    Steps that do nothing are left out, and arcs that go on along one circle are one arc.
    """
    states = [
        (
            *(s.tool, -9 if s.length_offset is None else s.length_offset, s.length or 0.0),
            *(hash(s.work_offset) % 1000, s.spindle, s.rpm if s.spindle else 0.0),
            *(hash(s.coolant) % 1000, s.side),
        )
        for s in run.states
    ]
    rows = np.column_stack(
        (
            *(run.kind, run.start, run.end, run.centre, run.sweep, run.feed, run.seconds),
            np.array(states)[run.state],
        )
    )
    still = np.isin(run.kind, (Kind.RAPID, Kind.FEED)) & (run.start == run.end).all(axis=1)
    return np.round(np.nan_to_num(_whole_arcs(rows[~still]), nan=-1e6, posinf=1e6), 5)


def _whole_arcs(rows: np.ndarray) -> np.ndarray:
    """Level arcs of one circle, sense, feed and state, one behind the other, put together."""
    same = np.r_[0, 7, 8, 10 : rows.shape[1]]
    before, after = rows[:-1], rows[1:]
    on = (rows[1:, 0] == Kind.ARC) & np.isclose(before[:, same], after[:, same], rtol=0, atol=1e-6).all(
        axis=1
    )
    on &= np.isclose(before[:, 4:7], after[:, 1:4], rtol=0, atol=1e-9).all(axis=1)
    on &= (before[:, 9] * after[:, 9] > 0) & (before[:, 3] == before[:, 6]) & (after[:, 3] == after[:, 6])
    first = np.flatnonzero(np.concatenate(([True], ~on)))[: len(rows)]
    if first.size == len(rows):
        return rows
    last = np.append(first[1:], len(rows)) - 1
    whole = rows[first]
    whole[:, 4:7] = rows[last, 4:7]
    whole[:, 9] = np.add.reduceat(rows[:, 9], first)
    return whole


def differences(one: np.ndarray, two: np.ndarray) -> set[str]:
    """In what two traces differ: ``path``, or of the same path ``feed``, ``speed``, ``coolant`` and so on."""
    if one.shape != two.shape or (one[:, :10] != two[:, :10]).any():
        return {"path"}
    names = ("feed", "dwell", "tool", "H", "length", "work offset", "spindle", "rpm", "coolant", "side")
    return {name for k, name in enumerate(names, 10) if (one[:, k] != two[:, k]).any()}
