"""What a fault changes in what a program cuts."""

import numpy as np

from mechwright_cam.controls.reading import Kind, Run


def trace(run: Run) -> np.ndarray:
    """(n, 20) what happens, step by step: nothing but the lines' numbers is left out, and no step that does nothing."""
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
    return np.round(np.nan_to_num(rows[~still], nan=-1e6, posinf=1e6), 5)


def differences(one: np.ndarray, two: np.ndarray) -> set[str]:
    """In what two traces differ: ``path``, or of the same path ``feed``, ``speed``, ``coolant`` and so on."""
    if one.shape != two.shape or (one[:, :10] != two[:, :10]).any():
        return {"path"}
    names = ("feed", "dwell", "tool", "H", "length", "work offset", "spindle", "rpm", "coolant", "side")
    return {name for k, name in enumerate(names, 10) if (one[:, k] != two[:, k]).any()}
