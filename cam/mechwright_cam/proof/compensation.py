"""What cutter compensation does when D is not the planned one.

The program is read again with the largest and with the smallest D allowed. The control must take both, the
tool's centre must run beside its planned way by just the difference, and a tool of that radius must stay out
of the finished part.
"""

from copy import copy

import numpy as np
import shapely
from numpy.typing import NDArray

from mechwright.errors import ProgramError
from mechwright.tolerances import TOLERANCES
from mechwright_cam.controls.reading import Run
from mechwright_cam.controls.reading.run import Ints
from mechwright_cam.proof.bands import bands
from mechwright_cam.proof.details import heights
from mechwright_cam.proof.gouge import Gouge, deepest_cut, worst_of
from mechwright_cam.proof.paths import Paths
from mechwright_cam.proof.report import Check
from mechwright_cam.proof.scene import Scene
from mechwright_cam.setup.job import Job

SPACED = 0.05
"""Places of an arc that are compared, by the chord error between them, mm; the places are exact."""


def compensation(scene: Scene) -> Check:
    """The walls follow D, as far as it may differ from the planned one."""
    job, limit = scene.job, scene.job.settings.wear_limit
    if not _on(scene.run).any():
        return Check(True, "the program uses no cutter compensation")
    if job.settings.compensation == "computer":
        return Check(True, "D as in the tool library; the design file plans no other")
    worst = 0.0
    for more in (limit, -limit):
        words = f"with D {limit:g} mm {'larger' if more > 0 else 'smaller'}"
        try:
            run = scene.read(more)
        except ProgramError as error:
            return Check(False, f"{words}: {error}", value=more, limit=limit, unit="mm")
        tools = [tool.model_copy(update={"diameter": tool.diameter + 2 * more}) for tool in scene.job.tools]
        paths = Paths(run, tools)
        off, step = _off(scene.paths, paths, limit)
        if off > TOLERANCES.gouge:
            message = f"{words} the cutter is {off:.3f} mm from where that should bring it"
            return scene.bad(step, message, off, TOLERANCES.gouge, "mm")
        worst = max(worst, off)
        cut = _gouge(paths, job)
        if cut is not None and cut.depth > TOLERANCES.gouge:
            message = f"{words}, a cutter of that radius cuts {cut.depth:.3f} mm into the finished part"
            return scene.bad(cut.step, message, cut.depth, TOLERANCES.gouge, "mm")
    message = f"walls follow D from {limit:g} mm below to {limit:g} mm above its planned radius"
    return Check(True, message, value=worst, limit=TOLERANCES.gouge, unit="mm")


def _on(run: Run) -> NDArray[np.bool_]:
    """(n,) steps with compensation on."""
    return run.of_states(lambda state: state.side != 0)


def _contours(run: Run) -> list[Ints]:
    """The steps along each contour, between the moves that turn compensation on and off."""
    edges = np.flatnonzero(np.diff(np.concatenate(([False], _on(run), [False])).astype(int)))
    spans = [np.arange(first, last)[run.moving[first:last]] for first, last in edges.reshape(-1, 2).tolist()]
    return [span[1:] for span in spans if span.size > 1]


def _off(planned: Paths, paths: Paths, more: float) -> tuple[float, int]:
    """How far a run is from being beside the planned one at a distance, mm, and the worst step.

    Every move is compared with the planned moves of its own line of the text, and of those next to it.
    """
    before, after = _contours(planned.run), _contours(paths.run)
    if len(before) != len(after):
        return float("inf"), 0
    worst, at = 0.0, 0
    for one, two in zip(before, after, strict=True):
        lines, wanted = planned.run.line[one], paths.run.line[two]
        first = np.maximum(np.searchsorted(lines, wanted, side="left") - 1, 0)
        last = np.minimum(np.searchsorted(lines, wanted, side="right") + 1, one.size)
        count = last - first
        owner = np.repeat(np.arange(two.size), count)
        chosen = np.arange(owner.size) - np.repeat(np.cumsum(count) - count, count) + first[owner]
        ways = shapely.geometrycollections(planned.lines(planned.whole(one))[chosen], indices=owner)
        points, step = paths.points(paths.whole(two), SPACED)
        off = np.abs(shapely.distance(shapely.points(points), ways[step]) - more)
        if off.size and off.max() > worst:
            worst, at = float(off.max()), int(two[step[np.argmax(off)]])
    return worst, at


def _gouge(paths: Paths, job: Job) -> Gouge | None:
    """The deepest cut into part or tabs by the moves with compensation, leads included."""
    on = _on(paths.run)
    on[1:] |= on[:-1]  # and the move that turns it off
    some = copy(paths)
    some.steps = paths.steps[on[paths.steps]]
    cuts = [deepest_cut(some, band.keep, band.top, -job.thickness) for band in bands(job, heights(job))]
    cuts += [deepest_cut(some, tab.shape, tab.top) for tab in job.tabs]
    return worst_of(cuts)
