"""How long a program takes.

How the control runs through the moves is the control's to say (:mod:`mechwright_cam.controls.lookahead`);
dwells and tool changes come to that. Stops for the operator are not counted.
"""

import numpy as np

from mechwright.arrays import Array
from mechwright_cam.controls.lookahead import DEFAULT_LOOKAHEAD, Motion
from mechwright_cam.controls.reading import Kind, Run
from mechwright_cam.program.moves import OPERATION_COMMENT
from mechwright_cam.proof.report import OperationTime
from mechwright_cam.shop.machine import Machine


def step_times(run: Run, machine: Machine, motion: Motion | None = None) -> Array:
    r"""Time (n,) of each step, s, of a run in a ``motion`` of the control; the usual one unless it is given.

    Examples
    --------
    100 mm at 50 mm/s with 1 m/s²: two seconds of travel, and 0.05 s for speeding up and slowing down.

    >>> from mechwright_cam.controls.fanuc import Fanuc
    >>> run = Fanuc().read("%\nO1\nG21 G90\nG0 X0 Y0 Z0\nG1 X100. F3000.\nM30\n%")
    >>> round(float(step_times(run, Machine(acceleration=1.0))[1]), 2)
    2.05
    """
    seconds = (motion or DEFAULT_LOOKAHEAD.motion(run, machine)).seconds + run.seconds
    seconds[run.kind == Kind.TOOL] += machine.tool_change
    return seconds


def operation_steps(run: Run) -> list[tuple[str, int, int]]:
    """Name, first step and step after the last of each operation.

    They go from one operation comment to the next, or where there are none, from tool to tool.
    """
    named = [
        (remark.step, _as_planned(remark.text[len(OPERATION_COMMENT) :]))
        for remark in run.remarks
        if remark.text.lower().startswith(OPERATION_COMMENT)
    ]
    if not named:
        named = [(int(step), f"T{run.tool[step]}") for step in np.flatnonzero(run.kind == Kind.TOOL)]
    if not named or named[0][0] > 0:
        named.insert(0, (0, "start"))
    edges = [step for step, _ in named] + [len(run)]
    return [(name, first, last) for (first, name), last in zip(named, edges[1:], strict=True) if last > first]


def operations(run: Run, seconds: Array) -> tuple[OperationTime, ...]:
    """Times by operation, see :func:`operation_steps`."""
    path = np.where(run.cutting, np.nan_to_num(run.length, posinf=0.0), 0.0)
    out = []
    for name, first, last in operation_steps(run):
        # After the last cut the next file may already have named its tool.
        cuts = np.flatnonzero(run.cutting[first:last])
        tool = int(run.tool[first + cuts[-1] if cuts.size else last - 1])
        out.append(
            OperationTime(
                name,
                tool,
                float(seconds[first:last].sum()),
                float(path[first:last].sum()),
                float(seconds[first:last][run.cutting[first:last]].sum()),
            )
        )
    return tuple(out)


def _as_planned(name: str) -> str:
    """The name of an operation; a control that shows capitals only has changed it."""
    return name.lower() if name.isupper() else name
