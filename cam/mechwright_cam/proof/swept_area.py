"""Which moves go through nothing but what earlier cuts have cleared: quickly told of many, and never wrongly.

A cylinder that is moved along a line fills a capsule, and in a rectangle the rectangle itself and a capsule
along each side. A capsule is clear where every cell that it touches has been cut before, or where a cutter at
least as wide has gone along its middle. A line that is neither is halved, until its pieces are as short as a
cell. Where its end is a place that such a cutter has been at, the half disc around that is clear.
"""

from itertools import pairwise
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright_cam.controls.reading.run import Ints, Kind
from mechwright_cam.proof.paths import NEAR, Geometries, Paths
from mechwright_cam.proof.removal_time import Cells, Tracks, taking

FEW = 64
"""Moves that are asked about one by one sooner than all together."""
MOST_LEVELS = 64
"""Heights that are looked at; of more, each move counts as deep as the next lower one of these, among which
those stay at which many of the moves are."""
LEAST_LEVELS, MOST_TAKEN = 8, 1_000_000
"""Of more heights than these so many at least, and so many cuts at most, counted anew at each of them."""
MOST_CELLS, LEAST_CELLS, ALL_CELLS = 250_000, 30_000, 2_500_000
"""Cells of one height, and of all."""
MOST_LINES = 300_000
"""Pieces of lines that are looked at; what is not known then is asked one by one."""
CHORD = 0.01
"""Chord error of arcs, mm: the cylinder counts so much wider."""
STRIPS = np.sin(np.linspace(0.0, np.pi / 2, 9))
"""The ends of a capsule are in strips: from each of these shares of the radius to the next."""
_SHARES = np.array([(sign, *pair) for pair in pairwise(STRIPS.tolist()) for sign in (-1, 1)])
"""Those of the lower and of the upper end in turn (16, 3): its sign, and both shares."""
TOGETHER = 20_000
"""So many strips are asked about together."""

Mask = NDArray[np.bool_]
Geometry = Any


def left(
    paths: Paths, cuts: Ints, plate: Array, steps: Ints, lift: Array, radius: Array
) -> tuple[Mask, dict[int, Geometry]]:
    """Which moves may take a cylinder through something that is left of a plate, and where.

    Parameters
    ----------
    cuts
        All steps that cut.
    plate
        ``((x0, y0), (x1, y1))`` of a rectangle that all of the plate is in, mm.
    steps, lift, radius
        (n,) of each move, how far the cylinder begins above the cutter's tip, and its radius, mm.

    Returns
    -------
    suspect, where
        (n,); and of some of these, by index, the lines along which the middle of the cylinder may be when it
        meets something, where that is not all of the move.
    """
    suspect = np.ones(steps.size, dtype=np.bool_)
    where: dict[int, Geometry] = {}
    if steps.size < FEW or not cuts.size:
        return suspect, where
    bottom = paths.low[steps] + lift
    levels = _levels(bottom, cuts.size)
    level = np.searchsorted(levels, bottom + NEAR / 4, side="right") - 1
    cells = int(np.clip(ALL_CELLS // levels.size, LEAST_CELLS, MOST_CELLS))
    for index, height in enumerate(levels.tolist()):
        mine = np.flatnonzero(level == index)
        if mine.size:
            one = _Level(paths, cuts[cuts < steps[mine].max()], height, plate, cells)
            one.most_lines = MOST_LINES // levels.size
            suspect[mine], some = one.left(steps[mine], lift[mine], radius[mine])
            where |= {int(mine[at]): lines for at, lines in some.items()}
    return suspect, where


def _levels(bottom: Array, cuts: int) -> Array:
    """Heights at which moves are looked at that go down to ``bottom`` (n,), just below these."""
    heights = np.sort(np.round(bottom / NEAR)) * NEAR
    levels = np.unique(heights)
    if levels.size > MOST_LEVELS:
        most = int(np.clip(MOST_TAKEN // cuts, LEAST_LEVELS, MOST_LEVELS))
        levels = np.unique(heights[:: -(-heights.size // most)])
    return levels - NEAR / 2


class _Level:
    """The plate at one height."""

    most_lines = MOST_LINES

    def __init__(self, paths: Paths, cuts: Ints, height: float, plate: Array, cells: int) -> None:
        self.paths, self.height, self.plate, self.cells = paths, height, plate, cells
        self.pieces, self.radius = self.taken = taking(paths, cuts, height)
        self._tracks: dict[float, tuple[Tracks, Tracks]] = {}

    def left(self, steps: Ints, lift: Array, radius: Array) -> tuple[Mask, dict[int, Geometry]]:
        """Which moves (n,) of cylinders are not clear at this height, and some of the places."""
        suspect = np.ones(steps.size, dtype=np.bool_)
        if not self.radius.size:
            return suspect, {}
        low, high = self.paths.extent(steps)
        around = np.stack(((low - radius[:, None]).min(axis=0), (high + radius[:, None]).max(axis=0)))
        window = np.clip(around, *self.plate)
        self.area = Cells(self.paths, self.taken, self.height, window, self.cells)
        suspect = self._boxes(low, high, radius) >= steps
        some = np.flatnonzero(suspect)
        some = some[~self._wide(steps[some]) | (self.area.latest(low[some], high[some]) < steps[some])]
        lines, owner = self._along(steps[some], lift[some], radius[some])
        suspect[some] = False
        suspect[some[owner]] = True
        order = np.argsort(owner, kind="stable")
        which, first = np.unique(owner[order], return_index=True)
        pieces = np.repeat(np.arange(which.size), np.diff(np.append(first, owner.size)))
        found = shapely.line_merge(shapely.multilinestrings(lines[order], indices=pieces))
        return suspect, dict(zip(some[which].tolist(), shapely.simplify(found, 0.0).tolist(), strict=True))

    def _wide(self, steps: Ints) -> Mask:
        """Which moves (n,) are rapids whose middle may be anywhere in a rectangle."""
        way = np.abs(self.paths.end - self.paths.start)[steps, :2]
        wide: Mask = (self.paths.run.kind[steps] == Kind.RAPID) & (way > NEAR).all(axis=1)
        return wide

    def _lines(self, steps: Ints, lift: Array) -> tuple[Array, Array, Ints]:
        """First and last (k, 2) of the lines that the middle goes, and the move (k,) of each, by index."""
        paths, wide = self.paths, self._wide(steps)
        low, high = paths.extent(steps)
        (x0, y0), (x1, y1) = low[wide].T, high[wide].T
        corners = [np.column_stack(corner) for corner in ((x0, y0), (x1, y0), (x1, y1), (x0, y1))]
        rapid = paths.run.kind[steps] == Kind.RAPID
        others = paths.below(np.where(rapid, np.inf, -NEAR - lift)[~wide], steps=steps[~wide])
        points, owner = paths.points(others, CHORD)
        on = owner[1:] == owner[:-1]
        return (
            np.concatenate((*corners, points[:-1][on])),
            np.concatenate((*corners[1:], corners[0], points[1:][on])),
            np.concatenate((np.tile(np.flatnonzero(wide), 4), np.flatnonzero(~wide)[owner[:-1][on]])),
        )

    def _along(self, steps: Ints, lift: Array, radius: Array) -> tuple[Geometries, Ints]:
        """Lines (k,) that the middle goes and that are not clear, and the move (k,) of each, by index."""
        first, last, owner = self._lines(steps, lift)
        arc = self.paths.run.kind[steps] == Kind.ARC
        reach, count = np.where(arc, radius + CHORD, radius), 0
        found: list[tuple[Array, Ints]] = []
        while owner.size:
            count += owner.size
            rest = ~self._is_clear(first, last, reach[owner], steps[owner])
            first, last, owner = first[rest], last[rest], owner[rest]
            middle = (first + last) / 2
            done = (np.hypot(*(last - first).T) <= self.area.grid.cell) | (count > self.most_lines)
            done[~done] = ~self._may_be_clear(
                first[~done], last[~done], middle[~done], reach[owner[~done]], steps[owner[~done]]
            )
            found.append((np.stack((first, last), axis=1)[done], owner[done]))
            first, last = (
                np.concatenate((first[~done], middle[~done])),
                np.concatenate((middle[~done], last[~done])),
            )
            owner = np.tile(owner[~done], 2)
        if not found:
            return np.empty(0, dtype=object), owner
        lines, owner = (np.concatenate(column) for column in zip(*found, strict=True))
        return shapely.linestrings(lines), owner

    def _is_clear(self, first: Array, last: Array, radius: Array, before: Ints) -> Mask:
        """Which capsules (k,) around lines are clear before a step each."""
        low, high = np.minimum(first, last), np.maximum(first, last)
        found = self._boxes(low, high, radius) < before
        for axis in (0, 1):
            some = np.flatnonzero(~found & ((high - low)[:, 1 - axis] <= NEAR))
            found[some] = self._tracked(axis, low[some], high[some], radius[some]) < before[some]
            some = some[~found[some]]
            ends = [self._been_at(at[some], radius[some]) < before[some] for at in (low, high)]
            found[some] = self._in_strips(axis, low[some], high[some], radius[some], before[some], *ends)
        some = np.flatnonzero(~found & ((high - low) > NEAR).all(axis=1))
        none = np.zeros(some.size, dtype=np.bool_)
        found[some] = self._in_strips(0, low[some], high[some], radius[some], before[some], none, none)
        return found

    def _been_at(self, places: Array, radius: Array) -> Ints:
        """A step (k,) by which a cutter of a radius or wider has been at each place."""
        return np.minimum(*(self._tracked(axis, places, places, radius) for axis in (0, 1)))

    def _may_be_clear(self, first: Array, last: Array, middle: Array, radius: Array, before: Ints) -> Mask:
        """Which lines (k,) may yet be found clear piece by piece: around their middle they are."""
        found = np.zeros(radius.size, dtype=np.bool_)
        for axis in (0, 1):
            mine = np.flatnonzero(~found & (np.abs(last - first)[:, 1 - axis] <= NEAR))
            aside = np.outer(radius[mine], (axis, 1 - axis))
            area = self.area.latest(middle[mine] - aside, middle[mine] + aside)
            track = self._been_at(middle[mine], radius[mine])
            found[mine] = np.minimum(area, track) < before[mine]
        mine = np.flatnonzero((np.abs(last - first) > NEAR).all(axis=1))
        found[mine] = self._is_clear(middle[mine], middle[mine], radius[mine], before[mine])
        return found

    def _in_strips(
        self, axis: int, low: Array, high: Array, radius: Array, before: Ints, at_low: Mask, at_high: Mask
    ) -> Mask:
        """Which capsules (k,) around lines are clear, but for half discs that are, strip by strip."""
        rest, first = np.arange(radius.size), 0
        while first < len(_SHARES) and rest.size:
            # Few capsules are asked about many strips at once, many about one strip after the other.
            some = slice(first, first + max(TOGETHER // rest.size, 1))
            sign, y0, y1 = _SHARES[some].T[:, :, None]
            known = np.where(sign < 0, at_low[rest], at_high[rest])
            up = np.where(known, 0.0, sign * y1)
            ask, strip = np.broadcast_to(rest, up.shape).ravel(), np.broadcast_to(y0, up.shape).ravel()
            latest = self._strips(axis, low[ask], high[ask], radius[ask], strip, up.ravel())
            clear = (latest < before[ask]).reshape(up.shape) | (known & (y0 > 0))
            rest, first = rest[clear.all(axis=0)], some.stop
        found = np.zeros(radius.size, dtype=np.bool_)
        found[rest] = True
        return found

    def _boxes(self, low: Array, high: Array, radius: Array) -> Ints:
        """The latest step in rectangles that are wider by a radius all around."""
        return self.area.latest(low - radius[:, None], high + radius[:, None])

    def _strips(self, axis: int, low: Array, high: Array, radius: Array, y0: Array, y1: Array) -> Ints:
        """The latest step along an axis, as wide as the disc is at one share of its radius, up to another.

        That is before the lower end of the line if it is negative.
        """
        wide, up = radius * np.sqrt(1 - y0 * y0), radius * y1
        before, after = [wide, wide], [wide, wide]
        before[axis], after[axis] = -np.minimum(up, 0.0), np.maximum(up, 0.0)
        return self.area.latest(low - np.column_stack(before), high + np.column_stack(after))

    def _tracked(self, axis: int, low: Array, high: Array, radius: Array) -> Ints:
        """The latest step along the lines (k, 2) along an axis, of cutters that are as wide or wider."""
        out = np.full(radius.size, np.iinfo(np.int64).max)
        widths = np.unique(self.radius)
        width = np.searchsorted(widths, np.round(radius, 6))
        for one in np.unique(width[width < widths.size]).tolist():
            if one not in self._tracks:
                self._tracks[one] = self._of_width(float(widths[one]))
            mine = width == one
            out[mine] = self._tracks[one][axis].latest(low[mine], high[mine])
        return out

    def _of_width(self, least: float) -> tuple[Tracks, Tracks]:
        paths, pieces = self.paths, self.pieces.only(self.radius >= least)
        step = pieces.step
        arc = paths.run.kind[step] == Kind.ARC
        start, end = paths.start[step, :2], paths.end[step, :2]
        first, last = (start + (end - start) * share[:, None] for share in (pieces.first, pieces.last))
        # Of arcs the ends alone, and those of which all is deep enough.
        bent = arc & (pieces.first == 0) & (pieces.last == 1)
        first, last = (np.concatenate((ends[~arc], start[bent], end[bent])) for ends in (first, last))
        step = np.concatenate((step[~arc], step[bent], step[bent]))
        return Tracks(first, last, step, 0), Tracks(first, last, step, 1)
