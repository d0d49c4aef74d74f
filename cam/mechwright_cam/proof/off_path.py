"""The tool where the control really takes it: cuts are as much wider as it may leave the path.

In its corridor a tool reaches what a wider one would that kept to the path; only in plan view, since between
two moves no control goes lower than the lower of the two.
"""

from copy import copy
from dataclasses import replace
from functools import cached_property

import numpy as np
import shapely
from numpy.typing import NDArray

from mechwright.arrays import Array, first_of_each
from mechwright.geometry.prepared import prepared
from mechwright.tolerances import TOLERANCES
from mechwright_cam.controls.reading import Run
from mechwright_cam.controls.reading.run import Ints
from mechwright_cam.proof.bands import bands
from mechwright_cam.proof.details import deepest, deepest_in_fillet, heights
from mechwright_cam.proof.fillets import fillets
from mechwright_cam.proof.gouge import Gouge, kinds, lines_within_radius, lots
from mechwright_cam.proof.paths import NEAR, Paths
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.cutter import Cutter
from mechwright_cam.shop.tool import ToolKind

WAYS = ("kind", "start", "end", "centre", "sweep", "tool")
"""What of a run tells where its tools are."""
SLACK = 0.0005
"""A path that is meant to touch the part stays so near to it, mm: more than the chords of both are off."""


class WidePaths(Paths):
    """Paths whose tools are wider by what each step may be off the path."""

    def __init__(self, paths: Paths, off: Array) -> None:
        self.__dict__.update(copy(paths).__dict__)
        for name in ("radius", "cutter"):
            self.__dict__.pop(name, None)
        self.off = off.copy()
        self.off[self.steps] = alike(paths.run, off, self.steps)

    @cached_property
    def radius(self) -> Array:
        """(n,) radius of the tool in the spindle and its corridor, mm."""
        return np.asarray(self.of_tool(lambda tool: tool.radius) + self.off)

    @cached_property
    def cutter(self) -> Cutter:
        """The outlines (n,) of the tools, each as much wider."""
        own: Cutter = Paths.cutter.func(self)  # type: ignore[attr-defined]
        return replace(own, radius=own.radius + self.off)


def alike(run: Run, off: Array, steps: Ints) -> Array:
    """The greatest (m,) of all that are the same in plan view, of some steps: passes repeat at every depth.

    Rough and exact passes along one way are told apart: what is off by half as much is not alike.
    """
    size, most = np.floor(np.log2(np.maximum(off[steps], NEAR))), off[steps]
    centre, sweep = np.nan_to_num(run.centre[steps]), run.sweep[steps]
    ways = np.column_stack((run.start[steps, :2], run.end[steps, :2], centre, sweep))
    with np.errstate(invalid="ignore"):
        rows = np.rint(np.nan_to_num(ways) / NEAR).astype(np.int64)
    first, kind = first_of_each(np.column_stack((rows, run.tool[steps], size.astype(np.int64))))
    greatest = np.zeros(first.size)
    np.maximum.at(greatest, kind, most)
    return np.asarray(greatest[kind])


def deepest_off_path(paths: Paths, job: Job, off: Array) -> Gouge | None:
    """The deepest cut into the finished part if each step is off its path by ``off`` (n,), mm."""
    wide = WidePaths(paths, off)
    cuts = [
        *deepest(wide, job, bands(job, heights(job))),
        *(cut for fillet in fillets(job) for cut in deepest_in_fillet(wide, job, fillet)),
    ]
    found = [cut for cut in cuts if cut is not None]
    return max(found, key=lambda cut: cut.depth, default=None)


def too_deep(paths: Paths, job: Job, off: Array, limit: float, *, any_one: bool = False) -> NDArray[np.bool_]:
    """Which steps (n,) cut deeper than ``limit`` into the finished part if they are off their paths, mm.

    With ``any_one`` some of them are enough.

    Of round and pointed tools, whose depth is more than a question of distance, the deepest step alone is
    told.
    """
    upright = flat(paths)[paths.steps]
    own, other = copy(paths), copy(paths)
    own.steps, other.steps = paths.steps[upright], paths.steps[~upright]
    found = reaching(own, job, off - limit, limit, any_one=any_one)
    if other.steps.size:
        cut = deepest_off_path(other, job, off)
        if cut is not None and cut.depth > limit:
            found[cut.step] = True
    return found


class OffPath:
    """Which steps of a program cut too deep off their paths: what is clear with more is not asked again.

    A step of an end mill that has been found clear is clear with less off its path, and with a higher limit.
    """

    def __init__(self, paths: Paths, job: Job) -> None:
        self.paths, self.job = paths, job
        self._flat = flat(paths)
        self.clear = np.full(len(paths.run), -np.inf)
        """(n,) with so much more than its radius a tool has been found clear of the part, mm."""
        self._limit = 0.0

    def learn(self, other: "OffPath") -> None:
        """Take over what another one has found clear, if it is of the same moves around the same part."""
        mine, its = self.paths.run, other.paths.run
        if self.job is other.job and all(
            np.array_equal(getattr(mine, name), getattr(its, name), equal_nan=True) for name in WAYS
        ):
            self.clear, self._limit = other.clear.copy(), other._limit

    def too_deep(
        self, off: Array, limit: float, steps: Ints | None = None, *, any_one: bool = False
    ) -> NDArray[np.bool_]:
        """As :func:`too_deep`, of some steps or of all."""
        if limit < self._limit:
            self.clear[:] = -np.inf
        own, more = copy(self.paths), off - limit
        own.steps = own.steps if steps is None else steps
        own.steps = own.steps[more[own.steps] > self.clear[own.steps]]
        found = too_deep(own, self.job, off, limit, any_one=any_one)
        if any_one and found.any():
            return found  # not all have been asked
        clear = own.steps[(self._flat & ~found)[own.steps]]
        self.clear[clear], self._limit = more[clear], limit
        return found


def flat(paths: Paths) -> NDArray[np.bool_]:
    """Steps (n,) with an end mill in the spindle whose corners are sharp."""
    mills = [tool.number for tool in paths.mills if tool.kind is ToolKind.END_MILL]
    return np.asarray((paths.cutter.nose == 0) & np.isin(paths.run.tool, mills))


def reaching(paths: Paths, job: Job, more: Array, sunk: float, *, any_one: bool = False) -> NDArray[np.bool_]:
    """Which steps (n,) come to the finished part with tools whose radius is ``more`` (n,) larger, mm.

    Layers count from ``sunk`` below their top on, mm. Where it is enough to know of any one, no more are
    asked than it takes to find some.
    """
    found = np.zeros(len(paths.run), dtype=np.bool_)
    for band in bands(job, heights(job)):
        pieces = paths.below(band.top - sunk)
        reach = paths.radius[pieces.step] + more[pieces.step]
        least, most = paths.extent(pieces.step)
        x0, y0, x1, y1 = band.keep.bounds
        apart = (least > np.array((x1, y1)) + reach[:, None]) | (most < np.array((x0, y0)) - reach[:, None])
        near = np.flatnonzero(~apart.any(axis=1))
        if not near.size:
            continue
        pieces, reach, keep = pieces.only(near), reach[near], prepared(band.keep)
        # Passes repeat at every depth: the widest of those that are alike is asked for all of them.
        widest = np.argsort(-reach, kind="stable")
        chosen, kind = kinds(paths, pieces.only(widest))
        one, wide = pieces.only(widest[chosen]), reach[widest[chosen]]
        rough, within = (
            _roughly(paths.radius[one.step], more[one.step]),
            np.zeros(chosen.size, dtype=np.bool_),
        )
        for now in lots(paths, one):
            lines = paths.lines(one.only(now))
            close = lines_within_radius(keep, lines, rough[now])
            within[now[close]] = shapely.dwithin(keep, lines[close], wide[now[close]])
            if any_one and within.any():
                break
        met = np.flatnonzero(within[kind])
        less = reach[widest[met]] < wide[kind[met]]
        found[pieces.step[widest[met[~less]]]] = True
        if any_one and found.any():
            break
        some = pieces.only(widest[met[less]])
        for now in lots(paths, some):
            own = shapely.dwithin(keep, paths.lines(some.only(now)), reach[widest[met[less][now]]])
            found[some.step[now[own]]] = True
    return found


def _roughly(radius: Array, more: Array) -> Array:
    """Reach (m,) of tools, mm, rounded up to two of each radius: what stays inside of a path, and all."""
    reach = np.zeros(radius.size)
    for one in np.unique(radius).tolist():
        for own in ((radius == one) & (more <= -SLACK), (radius == one) & (more > -SLACK)):
            reach[own] = one + more[own].max(initial=-one)
    return reach


def corridor(paths: Paths, job: Job, off: Array) -> float:
    """How far the finished walls may be off the path, mm, where the control leaves it.

    ``off`` (n,) is of each step, mm. What comes to a wall makes it, off by as much as its step. What leaves
    more than the limit of leftover there leaves it to another pass, and cuts the wall only by what its step
    is off beyond that.
    """
    left = np.full_like(off, TOLERANCES.leftover)
    makes, cuts = (reaching(paths, job, reach, TOLERANCES.gouge) for reach in (left, np.maximum(off, left)))
    return float(np.maximum(np.where(makes, off, 0.0), np.where(cuts, off - left, 0.0)).max(initial=0.0))
