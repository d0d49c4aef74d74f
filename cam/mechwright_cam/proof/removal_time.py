"""By which step a plate has been cut down to a height, never too early: cells for areas, tracks for lines."""

import math

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright_cam.controls.reading.run import Ints, Kind
from mechwright_cam.proof.footprint import NEVER, Grid
from mechwright_cam.proof.paths import NEAR, Paths, Pieces

FINEST = 0.04
"""Smallest cell, mm: a cutter that is moved next to where it has been is told by its track."""
MOST_PLACES = 1_000_000
"""Places at which the cutters are set onto the cells; of longer paths the cells are wider."""
UNSURE = -math.sqrt(2)
"""A cell is cut where all of it is: half the diagonal of the cell that a place of the path is in, and half
that of the cell cut."""
ROUNDED = 1e-4
"""Tracks that differ by less are one, mm: a hundredth of what is not met."""


def taking(paths: Paths, cuts: Ints, level: float) -> tuple[Pieces, Array]:
    """What of some steps goes down to a height, and the radius (m,) that it takes all along, mm."""
    pieces = paths.below(level + NEAR, steps=cuts)
    start, end = paths.start[pieces.step], paths.end[pieces.step]
    upright = (np.hypot(*(end - start)[:, :2].T) <= NEAR) & (paths.run.kind[pieces.step] != Kind.ARC)
    highest = np.where(upright, pieces.low, np.minimum(np.maximum(start[:, 2], end[:, 2]), level))
    radius = np.round(paths.cutters(pieces.step).radius_at(level - highest), 6)
    return pieces.only(radius > NEAR), radius[radius > NEAR]


class Cells:
    """By which step all of each cell is cut, and the latest step of any rectangle of them."""

    def __init__(
        self, paths: Paths, taken: tuple[Pieces, Array], level: float, window: Array, cells: int
    ) -> None:
        (x0, y0), (x1, y1) = window
        pieces, radius = taken
        length = float(paths.length[pieces.step].sum())
        widest = (length / MOST_PLACES) ** 2 / (2 * float(radius.min(initial=np.inf)))
        cell = max(FINEST, math.sqrt((x1 - x0) * (y1 - y0) / cells), (x1 - x0 + y1 - y0) / cells, widest)
        shape = math.ceil((y1 - y0) / cell) + 1, math.ceil((x1 - x0) / cell) + 1
        self.grid = Grid(x0, y0, cell, np.full(shape, NEVER, dtype=np.int32))
        for one in np.unique(radius).tolist():
            self.grid.lower(paths, pieces.step[radius == one], one, level, UNSURE)
        self._tables = {(0, 0): self.grid.cut}

    def _table(self, up: int, along: int) -> NDArray[np.int32]:
        """The latest step of every rectangle of 2**up by 2**along cells, by its first cell."""
        if (up, along) not in self._tables:
            if along:
                last, half = self._table(up, along - 1), 2 ** (along - 1)
                found = np.maximum(last[:, :-half], last[:, half:])
            else:
                last, half = self._table(up - 1, 0), 2 ** (up - 1)
                found = np.maximum(last[:-half], last[half:])
            self._tables[up, along] = found
        return self._tables[up, along]

    def latest(self, low: Array, high: Array) -> Ints:
        """The latest step (k,) that cuts any cell of each rectangle (k, 2), mm; -1 beside the grid."""
        grid, (ny, nx) = self.grid, self.grid.cut.shape
        origin, size = np.array((grid.x, grid.y)), np.array((nx, ny))
        first = np.clip(np.floor((low - origin) / grid.cell), 0, size).astype(np.int64)
        last = np.clip(np.floor((high - origin) / grid.cell) + 1, 0, size).astype(np.int64)
        found = np.full(len(low), -1, dtype=np.int64)
        some = np.flatnonzero((last > first).all(axis=1))
        power = np.log2((last - first)[some] + 0.5).astype(np.int64)
        kind = power[:, 0] * 64 + power[:, 1]
        for one in np.unique(kind).tolist():
            along, up = divmod(one, 64)
            table, mine = self._table(up, along), some[kind == one]
            (a, c), (b, d) = first[mine].T, last[mine].T - np.array([[2**along], [2**up]])
            found[mine] = np.maximum(
                np.maximum(table[c, a], table[c, b]), np.maximum(table[d, a], table[d, b])
            )
        return found


class Tracks:
    """Lines along one axis that the middle of a cutter has gone, and by which step."""

    def __init__(self, first: Array, last: Array, step: Ints, axis: int) -> None:
        """Lines from ``first`` to ``last`` (m, 2), mm, that are along the axis, and the ends of others."""
        along = np.abs(last - first)[:, 1 - axis] <= NEAR
        begin = _rounded(np.concatenate((first[along], first[~along], last[~along])))
        end = np.concatenate((_rounded(last[along]), begin[np.count_nonzero(along) :]))
        step = np.concatenate((step[along], step[~along], step[~along]))
        self.axis = axis
        self._beside, rank = np.unique(begin[:, 1 - axis], return_inverse=True)
        low, high = np.minimum(begin, end)[:, axis], np.maximum(begin, end)[:, axis]
        self._low, self._high = int(low.min(initial=0)), int(high.max(initial=0))
        self._row = self._high - self._low + 1
        low, high = (ends - self._low + rank.ravel() * self._row for ends in (low, high))
        self._ends = np.unique(np.concatenate((low, high)))
        """Where lines begin and end, one row of places after the other; between two of them is a gap."""
        self._tables = [self._earliest(np.stack((self._place(low), self._place(high))), step)]

    def _earliest(self, ends: Ints, step: Ints) -> Ints:
        """The first step over each end and gap in turn, of lines between two of them each (2, m)."""
        count = 2 * self._ends.size + 1
        power = np.log2(ends[1] - ends[0] + 1.5).astype(np.int64)
        found = np.full(count, NEVER, dtype=np.int64)
        for one in range(int(power.max(initial=-1)), -1, -1):
            mine = power == one
            np.minimum.at(found, ends[0, mine], step[mine])
            np.minimum.at(found, ends[1, mine] + 1 - 2**one, step[mine])
            if one:  # each stands for so many ends and gaps: now for half as many
                half = 2 ** (one - 1)
                found[half:] = np.minimum(found[half:], found[:-half].copy())
        return found

    def latest(self, low: Array, high: Array) -> Ints:
        """The latest step (k,) over each line along the axis (k, 2), mm; NEVER where there is no track."""
        found = np.full(len(low), NEVER, dtype=np.int64)
        first, last = _rounded(low), _rounded(high)
        beside, a, b = first[:, 1 - self.axis], first[:, self.axis], last[:, self.axis]
        row = np.searchsorted(self._beside, beside)
        mine = np.flatnonzero((row < self._beside.size) & (a >= self._low) & (b <= self._high))
        mine = mine[self._beside[row[mine]] == beside[mine]]
        begin, end = (self._place(ends[mine] - self._low + row[mine] * self._row) for ends in (a, b))
        power = np.log2(end - begin + 1.5).astype(np.int64)
        for one in np.unique(power).tolist():
            while len(self._tables) <= one:
                last, half = self._tables[-1], 2 ** (len(self._tables) - 1)
                self._tables.append(np.maximum(last[:-half], last[half:]))
            some, table = power == one, self._tables[one]
            found[mine[some]] = np.maximum(table[begin[some]], table[end[some] + 1 - 2**one])
        return found

    def _place(self, at: Ints) -> Ints:
        """The end (an odd number) or the gap before the next one (even) that a place is in."""
        index = np.searchsorted(self._ends, at)
        is_end = np.take(self._ends, index, mode="clip") == at
        place: Ints = 2 * index + is_end
        return place


def _rounded(places: Array) -> Ints:
    """Coordinates as whole numbers of :data:`ROUNDED`."""
    whole: Ints = np.round(places / ROUNDED).astype(np.int64)
    return whole
