"""The steps of a run as arrays of a page: places, times, feeds, engagement, operations."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright_cad.viewer.packed import packed
from mechwright_cam.controls.reading import Kind
from mechwright_cam.proof.scene import Scene
from mechwright_cam.proof.timing import operation_steps, step_times

MICRON = 1000
"""Steps of a coordinate in a mm."""

TICK = 10_000
"""Steps of a time in a second."""

TURN = 1_000_000
"""Steps of a sweep in a radian."""

MOST = 2_000_000_000
"""What a page holds of anything, in its steps: 2 km, 55 h, 318 turns."""

UPPER = 50.0
"""So far above the clearance plane the machine's upper end is drawn, mm."""

SAME = 1e-6
"""A step that begins so near to the end of the one before goes on from it, mm."""


def places(scene: Scene) -> tuple[Array, Array]:
    """Start and end (n, 3) of each step, mm: where the text does not say one, where the tool was before.

    The machine's upper end stands ``UPPER`` above the clearance plane.
    """
    run = scene.run
    ways = np.stack((run.start, run.end), axis=1).reshape(-1, 3)
    ways[np.isposinf(ways)] = scene.job.settings.clearance + UPPER
    ways[~np.isfinite(ways)] = np.nan
    for axis, default in zip(ways.T, (0.0, 0.0, scene.job.settings.clearance + UPPER), strict=True):
        known = np.flatnonzero(np.isfinite(axis))
        if not known.size:
            axis[:] = default
            continue
        last = np.searchsorted(known, np.arange(axis.size), side="right") - 1
        axis[:] = axis[known[np.maximum(last, 0)]]
    both = ways.reshape(-1, 2, 3)
    return both[:, 0], both[:, 1]


def end_times(scene: Scene) -> Array:
    """Time (n,) at which each step ends, s; stops for the operator take none."""
    seconds = step_times(scene.run, scene.job.settings.machine, scene.motion)
    times: Array = np.cumsum(np.nan_to_num(seconds, posinf=0.0))
    return times


def engagement(scene: Scene) -> NDArray[np.int64]:
    """Angle (n,) of the cutter's circumference that is in material in each step, whole degrees; 0 in air."""
    loads, found = scene.simulation.loads, np.zeros(len(scene.run), dtype=np.int64)
    degrees = np.rint(np.degrees(loads.engagement)).astype(np.int64)
    for first, last, angle in zip(loads.first.tolist(), loads.last.tolist(), degrees.tolist(), strict=True):
        found[first : last + 1] = np.maximum(found[first : last + 1], angle)
    found[~scene.run.cutting] = 0
    return found


def line_numbers(scene: Scene) -> NDArray[np.int64]:
    """Line (n,) of each step in all files one after the other, from 0."""
    run = scene.run
    if not run.files:
        return run.line - 1
    counts = np.cumsum([0, *(len(text.splitlines()) for text in texts(scene)[:-1])])
    numbers: NDArray[np.int64] = run.line - 1 + counts[run.file]
    return numbers


def texts(scene: Scene) -> list[str]:
    """The texts of all files, in the order in which they are run."""
    return [scene.text] if isinstance(scene.text, str) else list(scene.text.values())


NO_STEPS: dict[str, Any] = {
    "count": 0,
    "seconds": 0,
    "tools": [],
    "operations": [],
    **dict.fromkeys(("kind", "line", "end", "jump", "from", "arc", "centre", "sweep", "time"), ""),
    **dict.fromkeys(("feed", "engaged"), ""),
}
"""What stands in the place of the steps of a program that is too long to be played."""


def steps_of(scene: Scene) -> dict[str, Any]:
    """All steps of the run as a page holds them."""
    run = scene.run
    start, end = places(scene)
    before = np.vstack((start[:1], end[:-1])) if len(run) else start
    jumps = np.flatnonzero((np.abs(start - before) > SAME).any(axis=1) | (np.arange(len(run)) == 0))
    arcs = np.flatnonzero(run.kind == Kind.ARC)
    times = end_times(scene)
    return {
        "count": len(run),
        "seconds": round(float(times[-1]), 4) if len(run) else 0,
        "kind": packed(run.kind, "u1"),
        "line": packed(line_numbers(scene), "u4"),
        "end": _held(end * MICRON),
        "jump": packed(jumps, "u4"),
        "from": _held(start[jumps] * MICRON),
        "arc": packed(arcs, "u4"),
        "centre": _held(run.centre[arcs] * MICRON),
        "sweep": _held(run.sweep[arcs] * TURN),
        "time": _held(times * TICK),
        "feed": _held(run.feed),
        "engaged": packed(engagement(scene), "u1"),
        "tools": _changes(run.tool),
        "operations": [
            [name, first, last, int(run.tool[last - 1])] for name, first, last in operation_steps(run)
        ],
    }


def _held(values: Array) -> str:
    """Whole steps within ``MOST``, and 0 of what is no number."""
    return packed(np.clip(np.nan_to_num(values), -MOST, MOST).ravel(), "i4")


def _changes(tool: NDArray[np.int64]) -> list[list[int]]:
    """First step and number of each tool."""
    first = np.flatnonzero(np.diff(tool, prepend=-1))
    return [[int(step), int(tool[step])] for step in first]
