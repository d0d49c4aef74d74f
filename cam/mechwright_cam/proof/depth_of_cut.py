"""Whether a mill takes more in depth than it bears: a pass that is missing leaves its work to the next one.

A finishing pass is as deep as the wall, and takes little beside; a roughing pass takes the whole width, and
is no deeper than the tool library says. So the middle of the cutter, from that depth upwards, meets no
material. Most moves follow a path that a cut before them has gone nearly down to there: that is found for all
of them at once, and only what is left is looked at closely.
"""

import math
from collections.abc import Iterator
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright_cam.controls.reading import Kind
from mechwright_cam.controls.reading.run import Ints
from mechwright_cam.proof.cutting_rules import BEYOND, cutting_data, meets_middle, middle
from mechwright_cam.proof.loads import Loads
from mechwright_cam.proof.paths import NEAR, Paths
from mechwright_cam.proof.point_segment_distance import Chords
from mechwright_cam.proof.report import Check
from mechwright_cam.proof.scene import Scene
from mechwright_cam.proof.simulation import loads_in
from mechwright_cam.shop.tool import MILLS, CuttingData, Tool

LASTING = 2.0
"""A cut that is too deep for so many diameters on end is one: in a narrow corner it is so for less."""
PLACES_APART = 1.0
"""Distance of the places of a move that are asked about, in diameters."""
MOVES_BETWEEN = 20
"""Moves shorter than that distance may have no place of their own: so many may lie between two with one."""
PIECE_CHORD = 0.1
"""Chord error of arcs here, mm: far less than the middle is narrower than the cutter."""
HASH = np.array([3, 5, 7, 11, 13, 17, 19, 23], dtype=np.int64) ** 9
"""Odd numbers, so large that rows of coordinates come out apart; rows are compared besides."""


class _Cuts:
    """All cuts of a program, straight piece by straight piece."""

    def __init__(self, paths: Paths) -> None:
        self.paths = paths
        self.steps = paths.cuts
        self.top: Array = np.maximum(paths.start[:, 2], paths.end[:, 2])

    def limit_height(self, limit: float) -> Array:
        """Height z of each step, mm, above which it may be ``limit`` deep; the upper end of a steep one."""
        return np.maximum(self.paths.low, self.top - limit)

    @cached_property
    def _repeats(self) -> tuple[Ints, Array]:
        """The cuts on whose way in plan view one of the same tool was before, and the top of that one, z."""
        steps, paths = self.steps, self.paths
        plan = [paths.start[steps, :2], paths.end[steps, :2], np.nan_to_num(paths.run.centre[steps])]
        rows = np.column_stack((*plan, paths.run.tool[steps], paths.run.sweep[steps] > 0))
        rows = np.round(rows / NEAR).astype(np.int64)
        # Stable: those of one way stay in the program's order.
        order = np.argsort(rows @ HASH[: rows.shape[1]], kind="stable")
        same = np.flatnonzero((rows[order[:-1]] == rows[order[1:]]).all(axis=1))
        one, two = steps[order[same]], steps[order[same + 1]]
        return two, self.top[one]

    def repeated(self, limit: float) -> Ints:
        """The cuts that go at most this much deeper than one before them, all along it, mm."""
        steps, before = self._repeats
        return steps[before <= self.limit_height(limit)[steps] + limit + NEAR]

    @cached_property
    def pieces(self) -> tuple[Array, Array, Ints]:
        """Start and end of each piece (m, 2), mm, and the step that it belongs to."""
        points, owner = self.paths.points(self.paths.whole(self.steps), PIECE_CHORD)
        same = np.flatnonzero(owner[:-1] == owner[1:])
        return points[same], points[same + 1], self.steps[owner[same]]


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
        for step, length in _lasting(
            *_suspects(cuts, tool, limit, middle(scene, tool)), LASTING * tool.diameter
        ):
            if not meets_middle(scene, tool, step, max(limit, float(cuts.top[step] - scene.paths.low[step]))):
                continue
            lasting, before = (lasting if step <= before + MOVES_BETWEEN else 0.0) + length, step
            if lasting >= LASTING * tool.diameter:
                low = -float(scene.paths.low[step])
                message = (
                    f"T{tool.number} ({tool.name}) cuts more than {limit:g} mm of {job.part.material} at "
                    f"once, {BEYOND:g} times its step_down; cut in passes, or set step_down in "
                    f"[cam.cutting.{tool.name}]"
                )
                return scene.bad(step, message, low, limit, "mm")
    return _sections(scene) or Check(True, "no mill takes much more at once than the tool library says")


FINE, FINEST = 1 / 40, 0.02
"""Cells with which a section is measured closely: in radii of the tool, and at least so many mm wide."""
MOST_CLOSER = 4_000_000
"""So many of them at most."""
MOST_DOUBTS = 400
"""So many places are measured closely; a program with more of them is refused by the wide cells."""
SECTIONS = 2.0
"""A mill may take so many times the section of a full slot of one step_down: deep cuts are narrow, shallow
ones wide."""


def _sections(scene: Scene) -> Check | None:
    """A cut whose depth times width is far beyond that of a planned pass, for a few diameters on end."""
    cam, every = scene.job.settings, scene.simulation.loads
    for tool, data in cutting_data(scene):
        loads = every.only((every.tool == tool.number) & ~every.down)
        if tool.kind not in MILLS or not loads.step.size:
            continue
        asked = 0.0
        if cam.adaptive:
            asked = BEYOND * cam.adaptive_depth * (1 - math.cos(math.radians(cam.engagement))) / 2
        limit = max(SECTIONS * data.step_down, asked) * tool.diameter**2
        large = loads.section > limit
        doubts = _on_end(loads, large).tolist()
        for worst in doubts:
            if len(doubts) <= MOST_DOUBTS and not _stays(scene, tool, loads, worst, limit):
                continue
            found, step = float(loads.section[worst]), int(loads.step[worst])
            message = (
                f"T{tool.number} ({tool.name}) takes {loads.depth[worst]:.1f} mm deep and "
                f"{loads.width[worst]:.1f} mm wide of {scene.job.part.material}, {found:.1f} mm² of at most "
                f"{limit:.1f}; rough before you finish, or cut in passes"
            )
            return scene.bad(step, message, found, limit, "mm²")
    return None


def _on_end(loads: Loads, large: NDArray[np.bool_]) -> Ints:
    """The windows that are large, as the one is that they follow on."""
    following = np.diff(loads.step) <= 1
    return np.flatnonzero(large[1:] & large[:-1] & following) + 1


def _stays(scene: Scene, tool: Tool, loads: Loads, window: int, limit: float) -> bool:
    """Whether such a section, mm², is found on cells as fine as the tool needs as well.

    A wide cell counts as a whole or not at all, on both sides of the cut. Where what is measured is beyond
    all that cells can make of it, nobody looks closer.
    """
    cell = max(FINEST, FINE * tool.radius)
    wide = scene.simulation.cell
    if loads.section[window] > limit + 2 * loads.depth[window] * wide or cell > wide / 2:
        return True
    first, last = int(loads.first[window - 1]), int(loads.last[window])
    ends = np.column_stack((loads.x, loads.y))[window - 1 : window + 1]
    away = (1 + LASTING) * tool.diameter  # the windows begin at most a diameter before these ends
    low, high = ends.min(axis=0) - away, ends.max(axis=0) + away
    if float(np.ptp([low, high], axis=0).prod()) > MOST_CLOSER * cell**2:
        return True
    found = loads_in(scene.paths, scene.job, (*low.tolist(), *high.tolist()), cell)
    mine = found.only((found.tool == tool.number) & ~found.down)
    again = _on_end(mine, mine.section > limit)
    return bool(((mine.last[again] >= first) & (mine.first[again] <= last)).any())


def _lasting(steps: list[int], lengths: list[float], least: float) -> Iterator[tuple[int, float]]:
    """Steps with their lengths, mm, where those on end are long enough together."""
    ends = [n for n, (a, b) in enumerate(pairwise(steps), 1) if b > a + MOVES_BETWEEN]
    for a, b in pairwise([0, *ends, len(steps)]):
        if sum(lengths[a:b]) >= least:
            yield from zip(steps[a:b], lengths[a:b], strict=True)


def _deepest(scene: Scene, data: CuttingData) -> float:
    """Depth of a planned pass in diameters."""
    settings = scene.job.settings
    return max(data.step_down, settings.adaptive_depth if settings.adaptive else 0.0)


def _suspects(cuts: _Cuts, tool: Tool, limit: float, middle: float) -> tuple[list[int], list[float]]:
    """Moves of a tool deeper than the limit that do not follow a cut before them, in the program's order.

    With each the length of it, mm, that does not.
    """
    paths, low = cuts.paths, cuts.limit_height(limit)
    flat = np.hypot(*(paths.end - paths.start)[cuts.steps, :2].T) > NEAR
    arc = paths.run.kind[cuts.steps] == Kind.ARC
    mine = paths.run.tool[cuts.steps] == tool.number
    deep = cuts.steps[mine & (low[cuts.steps] < -limit - NEAR) & (flat | arc)]
    deep = np.setdiff1d(deep, cuts.repeated(limit), assume_unique=True)
    if not deep.size:
        return [], []
    first, last, before = cuts.pieces
    height = cuts.top[before]  # down to which they cut; what a rounded corner leaves is not asked
    places, owner = _places(first, last, before, deep, PLACES_APART * tool.diameter)
    covered = np.zeros(len(places), dtype=np.bool_)
    # Most follow the same way of the same cutter, which reaches least: only what is left asks wider ones.
    numbers = paths.run.tool[before]
    for number in sorted(set(numbers.tolist()), key=lambda n: (n != tool.number, -paths.tools[n].radius)):
        reach = paths.tools[number].radius - middle
        open_ = np.flatnonzero(~covered)
        if reach <= 0 or not open_.size:
            continue
        lowest = low[deep].max() + limit + NEAR
        useful = np.flatnonzero((numbers == number) & (height <= lowest))
        if not useful.size:
            continue
        chords = Chords(first[useful], last[useful])
        index, place = chords.pairs(places[open_], reach)
        step, piece = owner[open_][place], useful[index]
        good = np.flatnonzero((before[piece] < step) & (height[piece] <= low[step] + limit + NEAR))
        index, place = index[good], place[good]
        close = chords.distances(places[open_], place, index) <= reach
        covered[open_[place[close]]] = True
    steps, count = np.unique(owner[~covered], return_counts=True)
    return steps.tolist(), (count * PLACES_APART * tool.diameter).tolist()


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
