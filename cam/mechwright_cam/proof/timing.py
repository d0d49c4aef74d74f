"""How long a program takes.

Each move is a speed trapezoid: the machine speeds up and slows down with the acceleration of an axis along
the path, and passes from one move to the next at the speed that the corner allows. Along an arc the speed is
also limited by the centripetal acceleration. Two things are estimates: a move to the machine's upper end,
whose height the program does not know, is taken as half the travel of Z, and the time of a corner is that of
an axis which may jump by CORNER_JUMP. Stops for the operator are not counted.
"""

import numpy as np

from mechwright.arrays import Array
from mechwright_cam.controls.reading import Kind, Run
from mechwright_cam.program.moves import OPERATION_COMMENT
from mechwright_cam.proof.report import OperationTime
from mechwright_cam.shop.machine import Machine

CORNER_JUMP = 100.0
"""Change of velocity at a corner that a machine takes without slowing down, mm/min: a common jerk setting."""
NO_LENGTH = 1e-6
"""A move shorter than this takes no time, mm."""


def step_times(run: Run, machine: Machine) -> Array:
    r"""Time (n,) of each step, s.

    Examples
    --------
    100 mm at 50 mm/s with 1 m/s²: two seconds of travel, and 0.05 s for speeding up and slowing down.

    >>> from mechwright_cam.controls.linuxcnc import LinuxCnc
    >>> run = LinuxCnc().read("G21 G90\nG0 X0 Y0 Z0\nG1 X100 F3000\nM2")
    >>> round(float(step_times(run, Machine(acceleration=1.0))[1]), 2)
    2.05
    """
    moving = run.moving | (run.kind == Kind.HOME)
    rapid = np.isin(run.kind, (Kind.RAPID, Kind.HOME))
    length = np.where(moving, run.length, 0.0)
    unknown = moving & ~np.isfinite(length)
    length[unknown] = machine.travel_z / 2
    acceleration = machine.acceleration * 1000.0
    speed = np.where(rapid, _rapids(run, machine), np.minimum(run.feed, machine.max_feed)) / 60
    arc = run.kind == Kind.ARC
    speed[arc] = np.minimum(speed[arc], np.sqrt(acceleration * run.radius[arc]))
    speed = np.where(moving & (length > NO_LENGTH), np.maximum(speed, NO_LENGTH), 0.0)
    into, out_of = _junctions(run, length, speed, acceleration)
    peak = np.minimum(speed, np.sqrt((into**2 + out_of**2) / 2 + acceleration * length))
    ramps = (2 * peak**2 - into**2 - out_of**2) / (2 * acceleration)
    cruise = np.divide(np.maximum(length - ramps, 0.0), peak, out=np.zeros_like(peak), where=peak > 0)
    seconds: Array = np.where(peak > 0, (2 * peak - into - out_of) / acceleration + cruise, 0.0)
    seconds += run.seconds
    seconds[run.kind == Kind.TOOL] += machine.tool_change
    return seconds


def stretches(run: Run) -> list[tuple[str, int, int]]:
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
    """Times by operation, see :func:`stretches`."""
    path = np.where(run.cutting, np.nan_to_num(run.length), 0.0)
    out = []
    for name, first, last in stretches(run):
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


def _rapids(run: Run, machine: Machine) -> Array:
    """Speed (n,) of each rapid, mm/min: as fast along its line as Z allows, where Z is slower."""
    if machine.rapid_z is None or len(run) == 0:
        return np.full(len(run), machine.rapid)
    _, along = _directions(run)
    upright = np.maximum(np.abs(along[:, 2]), NO_LENGTH)
    flat = np.maximum(np.hypot(along[:, 0], along[:, 1]), NO_LENGTH)
    return np.minimum(np.minimum(machine.rapid / flat, machine.rapid_z / upright), machine.rapid)


def _junctions(run: Run, length: Array, speed: Array, acceleration: float) -> tuple[Array, Array]:
    """Speeds (n,) at the start and the end of each step, mm/s: corners, then what acceleration permits."""
    if len(run) == 0:
        return speed, speed
    leaving, entering = _directions(run)
    turn = np.sqrt(np.maximum(((entering[1:] - leaving[:-1]) ** 2).sum(axis=1), 1e-12))
    corner = np.minimum(np.minimum(speed[:-1], speed[1:]), CORNER_JUMP / 60 / turn)
    square = np.concatenate(([0.0], corner, [0.0])) ** 2
    # v² may grow by 2aL along each move: a running minimum forwards, and another one backwards.
    gain = np.concatenate(([0.0], np.cumsum(2 * acceleration * length)))
    square = np.minimum.accumulate(square - gain) + gain
    back = gain[-1] - gain[::-1]
    square = (np.minimum.accumulate(square[::-1] - back) + back)[::-1]
    junction = np.sqrt(np.maximum(square, 0.0))
    return junction[:-1], junction[1:]


def _directions(run: Run) -> tuple[Array, Array]:
    """Unit vectors (n, 3) of the path at the end and at the start of each step; 0 where unknown."""
    with np.errstate(invalid="ignore"):
        chord = run.end - run.start
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
    return last, first
