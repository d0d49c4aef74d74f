"""Whether a mill takes more in depth than it bears: a pass that is missing leaves its work to the next one.

A finishing pass is as deep as the wall, and takes little beside; a roughing pass takes the whole width, and
is no deeper than the tool library says. So the middle of the cutter, from that depth upwards, meets no
material. Most moves follow a path that a cut before them has gone nearly down to there: that is found for all
of them at once, and only what is left is looked at closely.
"""

from functools import cached_property

import numpy as np

from mechwright.motion import Array
from mechwright.tooling import MILLS, CuttingData, Tool
from mechwright_cam.interpreter import Kind
from mechwright_cam.interpreter.run import Ints
from mechwright_cam.proof.cutting_rules import BEYOND, cutting_data, meets_middle, middle
from mechwright_cam.proof.near import Chords
from mechwright_cam.proof.paths import NEAR, Paths
from mechwright_cam.proof.report import Check
from mechwright_cam.proof.scene import Scene

LASTING = 2.0
"""A cut that is too deep for so many diameters on end is one: in a narrow corner it is so for less."""
SPACING = 1.0
"""Distance of the places of a move that are asked about, in diameters."""
APART = 20
"""Moves shorter than that distance may have no place of their own: so many may lie between two with one."""
CHORD = 0.1
"""Chord error of arcs here, mm: far less than the middle is narrower than the cutter."""


class _Cuts:
    """All cuts of a program, straight piece by straight piece."""

    def __init__(self, paths: Paths) -> None:
        self.paths = paths
        self.steps = paths.steps[paths.run.cutting[paths.steps]]
        self.low = np.minimum(paths.start[:, 2], paths.end[:, 2])

    @cached_property
    def _points(self) -> tuple[Array, Ints]:
        return self.paths.points(self.paths.below(np.inf, steps=self.steps), CHORD)

    @cached_property
    def pieces(self) -> tuple[Array, Array, Ints]:
        """Start and end of each piece (m, 2), mm, and the step that it belongs to."""
        points, owner = self._points
        same = np.flatnonzero(owner[:-1] == owner[1:])
        return points[same], points[same + 1], self.steps[owner[same]]

    @cached_property
    def height(self) -> Array:
        """(m,) height down to which a piece cuts, mm; what a rounded corner leaves is not asked."""
        step = self.pieces[2]
        top: Array = np.maximum(self.paths.start[step, 2], self.paths.end[step, 2])
        return top


def depth_of_cut(scene: Scene) -> Check:
    """No mill takes its whole width much deeper than the tool library says."""
    job, cuts = scene.job, _Cuts(scene.paths)
    for tool, data in cutting_data(scene):
        if tool.kind not in MILLS:
            continue
        if middle(scene, tool) == 0:
            continue
        limit = BEYOND * _deepest(scene, data) * tool.diameter
        lasting, before = 0.0, -1
        for step, length in zip(*_suspects(cuts, tool, limit, middle(scene, tool)), strict=True):
            if not meets_middle(scene, tool, step, limit):
                continue
            lasting, before = (lasting if step <= before + APART else 0.0) + length, step
            if lasting >= LASTING * tool.diameter:
                low = -float(min(scene.paths.start[step, 2], scene.paths.end[step, 2]))
                return scene.bad(
                    "depth-of-cut",
                    step,
                    f"T{tool.number} ({tool.name}) cuts more than {limit:g} mm of {job.part.material} at "
                    f"once, {BEYOND:g} times its step_down; cut in passes, or set step_down in "
                    f"[cam.cutting.{tool.name}]",
                    low,
                    limit,
                    "mm",
                )
    return Check("depth-of-cut", True, "no mill takes much more depth at once than the tool library says")


def _deepest(scene: Scene, data: CuttingData) -> float:
    """Depth of a planned pass in diameters."""
    settings = scene.job.settings
    return max(data.step_down, settings.adaptive_depth if settings.clearing == "adaptive" else 0.0)


def _suspects(cuts: _Cuts, tool: Tool, limit: float, middle: float) -> tuple[list[int], list[float]]:
    """Moves of a tool deeper than the limit that do not follow a cut before them, in the program's order.

    With each the length of it, mm, that does not.
    """
    paths, low = cuts.paths, cuts.low
    flat = np.hypot(*(paths.end - paths.start)[cuts.steps, :2].T) > NEAR
    arc = paths.run.kind[cuts.steps] == Kind.ARC
    mine = paths.run.tool[cuts.steps] == tool.number
    deep = cuts.steps[mine & (low[cuts.steps] < -limit - NEAR) & (flat | arc)]
    if not deep.size:
        return [], []
    first, last, before = cuts.pieces
    places, owner = _places(first, last, before, deep, SPACING * tool.diameter)
    useful = np.flatnonzero((paths.radius[before] > middle) & (cuts.height <= low[deep].max() + limit + NEAR))
    covered = np.zeros(len(places), dtype=np.bool_)
    if useful.size and len(places):
        chords, before, height = Chords(first[useful], last[useful]), before[useful], cuts.height[useful]
        reach = paths.radius[before] - middle
        index, place = chords.pairs(places, float(reach.max()))
        step = owner[place]
        good = np.flatnonzero((before[index] < step) & (height[index] <= low[step] + limit + NEAR))
        index, place = index[good], place[good]
        covered[place[chords.distances(places, place, index) <= reach[index]]] = True
    steps, count = np.unique(owner[~covered], return_counts=True)
    return steps.tolist(), (count * SPACING * tool.diameter).tolist()


def _places(first: Array, last: Array, step: Ints, some: Ints, spacing: float) -> tuple[Array, Ints]:
    """Places (k, 2) along the pieces of some steps, so far apart, and the step of each."""
    mine = np.flatnonzero(np.isin(step, some))
    start, way = first[mine], last[mine] - first[mine]
    length = np.hypot(*way.T)
    after = np.cumsum(length)
    at = np.arange(spacing / 2, after[-1], spacing)
    line = np.searchsorted(after, at)
    share = 1 - (after[line] - at) / length[line]
    return start[line] + way[line] * share[:, None], step[mine][line]
