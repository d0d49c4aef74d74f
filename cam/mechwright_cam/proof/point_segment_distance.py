"""Distances from many places to many short lines, where most of the places are close to one of them."""

import math
from functools import cached_property
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright_cam.controls.reading.run import Ints

CELL = 0.3
"""Width of a cell of the grid, mm, if there are not too many."""
CROWD = 100.0
"""If a place lies in the rectangles around more lines than this in the mean, a tree of those tells little."""
FEW = 2000
"""Of such lines so many are asked first: the nearest of them is no nearer than the nearest of all."""
ALIKE = 16.0
"""Places of which that is known up to this factor are asked together."""
MOST_PAIRS = 2_000_000
"""Pairs of place and line, as they are to be expected, that are looked at together."""
DIVIDED = 4
"""A long line is divided into so many pieces at a time."""
TOGETHER = 20_000
"""So many lines are sorted into cells at a time: memory does not go with their number."""
MOST_CELLS = 1_000_000
"""Cells of a grid, of which the memory has to hold a number each."""


class Chords:
    """Straight lines from ``first`` (m, 2) to ``last`` (m, 2), mm; a line may have no length."""

    def __init__(self, first: Array, last: Array) -> None:
        self.first, self.last = first, last

    @classmethod
    def along(cls, points: Array, owner: Ints) -> "Chords":
        """Those between points (k, 2) that follow on each other and belong to one thing (k,)."""
        same = owner[:-1] == owner[1:]
        return cls(points[:-1][same], points[1:][same])

    @cached_property
    def tree(self) -> shapely.STRtree:
        """For questions without a hint; a line without length is a point there, as GEOS wants it."""
        lines = shapely.linestrings(np.stack((self.first, self.last), axis=1))
        still = np.flatnonzero((self.first == self.last).all(axis=1))
        lines[still] = shapely.points(self.first[still])
        return shapely.STRtree(lines)

    @cached_property
    def _crowded(self) -> bool:
        """Whether long lines cross each other all over."""
        if len(self.first) <= FEW:
            return False
        size = np.abs(self.last - self.first)
        spread = np.ptp(np.concatenate((self.first, self.last)), axis=0).prod()
        return bool(size.prod(axis=1).sum() > CROWD * max(float(spread), CELL**2))

    @cached_property
    def _few(self) -> "Chords":
        """Some of many lines."""
        every = -(-len(self.first) // FEW)
        return Chords(self.first[::every], self.last[::every])

    def distance(self, places: Array) -> Array:
        """Distance (k,) from each place (k, 2) to the nearest line, mm; inf if there is no line."""
        if not self._crowded:
            return self.nearest(shapely.points(places))
        out = self._few.nearest(shapely.points(places))
        order = np.argsort(out, kind="stable")
        most = max(MOST_PAIRS * FEW // len(self.first), 1)
        while order.size:
            alike = np.searchsorted(out[order], max(ALIKE * out[order[0]], CELL), side="right")
            now, order = np.split(order, [min(int(alike), most)])
            line, place = self.pairs(places[now], float(out[now[-1]]))
            np.minimum.at(out, now[place], self.distances(places[now], place, line))
        return out

    def nearest(self, shapes: NDArray[Any], within: float | None = None) -> Array:
        """Distance (k,) of each shape to the nearest line, mm; inf where it is beyond ``within``."""
        out = np.full(len(shapes), np.inf)
        if len(self.first) and len(shapes):
            (at, _), found = self.tree.query_nearest(
                shapes, max_distance=within, return_distance=True, all_matches=False
            )
            out[at] = found
        return out

    def hinted_distance(self, places: Array, hints: Array, reach: float) -> Array:
        """Distance (k,) from each place to the nearest of the lines that pass its hint.

        Parameters
        ----------
        places
            (k, 2), mm.
        hints
            (k, 2), where the nearest line is expected, mm.
        reach
            All lines within this distance of the hint are looked at, mm, and perhaps some more.

        Returns
        -------
        distance
            mm; never less than the true one, and inf where no line is near the hint.

        Examples
        --------
        >>> chords = Chords(np.array([[0.0, 0.0]]), np.array([[9.0, 0.0]]))
        >>> chords.hinted_distance(np.array([[3.0, 2.0], [3.0, 5.0]]), np.array([[3.0, 0.1], [3, 3]]), 0.2)
        array([ 2., inf])
        """
        out = np.full(len(places), np.inf)
        if not len(self.first) or not len(places):
            return out
        line, hint = _Grid(hints).pairs(self.first, self.last, reach)
        np.minimum.at(out, hint, self.distances(places, hint, line))
        return out

    def pairs(self, places: Array, reach: float) -> tuple[Ints, Ints]:
        """Line and place, by index, of all pairs within ``reach`` mm of each other, and some more."""
        return _Grid(places, max(CELL, reach / 2)).pairs(self.first, self.last, reach)

    def distances(self, places: Array, place: Ints, line: Ints) -> Array:
        """Distance (k,) of each place from its line, both given by index."""
        (x, y), (x0, y0), (wx, wy) = (
            np.ascontiguousarray(a.T) for a in (places, self.first, self.last - self.first)
        )
        square = wx * wx + wy * wy
        square[square == 0] = 1.0
        px, py = x[place] - x0[line], y[place] - y0[line]
        wx, wy = wx[line], wy[line]
        t = (px * wx + py * wy) / square[line]
        np.clip(t, 0.0, 1.0, out=t)
        px -= t * wx
        py -= t * wy
        away: Array = np.sqrt(px * px + py * py)
        return away


class _Grid:
    """Places (k, 2) sorted into square cells."""

    def __init__(self, places: Array, cell: float = CELL) -> None:
        self.least = places.min(axis=0)
        size = places.max(axis=0) - self.least
        self.cell = max(cell, math.sqrt(float(size.prod()) / MOST_CELLS), float(size.max()) / MOST_CELLS)
        self.columns, self.rows = (np.floor(size / self.cell).astype(np.int64) + 1).tolist()
        column, row = np.floor((places - self.least) / self.cell).astype(np.int64).T
        cell = row * self.columns + column
        self.order = np.argsort(cell, kind="stable")
        self.start = np.zeros(self.columns * self.rows + 1, dtype=np.int64)
        filled = np.bincount(cell, minlength=self.columns * self.rows)
        np.cumsum(filled, out=self.start[1:])
        self.lower_left = np.zeros((self.rows + 1, self.columns + 1), dtype=np.int64)
        """Number of places in all cells below and to the left."""
        np.cumsum(filled.reshape(self.rows, self.columns), axis=0, out=self.lower_left[1:, 1:])
        np.cumsum(self.lower_left, axis=1, out=self.lower_left)

    def pairs(self, first: Array, last: Array, reach: float) -> tuple[Ints, Ints]:
        """Line and place, by index, of all pairs within ``reach`` of each other, and some more."""
        begin = range(0, len(first), TOGETHER) or (0,)
        some = [self._pairs(first[k : k + TOGETHER], last[k : k + TOGETHER], reach) for k in begin]
        line = np.concatenate([line + k for k, (line, _) in zip(begin, some, strict=True)])
        return line, np.concatenate([place for _, place in some])

    def _pairs(self, first: Array, last: Array, reach: float) -> tuple[Ints, Ints]:
        line, longest = np.arange(len(first)), max(float(np.abs(last - first).max(initial=0.0)), self.cell)
        while (
            True
        ):  # a long line would fill a wide rectangle of cells: pieces that pass no place are left out
            some = self._filled(*self._cells(first, last, reach))
            line, first, last = line[some], first[some], last[some]
            if longest <= self.cell:
                break
            longest = max(longest / DIVIDED, self.cell)
            piece, first, last = _divided(first, last, longest)
            line = line[piece]
        x0, y0, x1, y1 = self._cells(first, last, reach)
        # The cells of one row follow on each other, and so do the places in them.
        rows = np.where(x1 > x0, np.maximum(y1 - y0, 0), 0)
        owner = np.repeat(np.arange(line.size), rows)
        base = (y0[owner] + _counted(rows)) * self.columns
        begin, end = self.start[base + x0[owner]], self.start[base + x1[owner]]
        count = end - begin
        place = self.order[np.repeat(begin, count) + _counted(count)]
        return np.repeat(line[owner], count), place

    def _cells(self, first: Array, last: Array, reach: float) -> tuple[Ints, Ints, Ints, Ints]:
        """First column and row (k,) of the cells near each line, and the column and row after the last."""
        low = np.floor((np.minimum(first, last) - (self.least + reach)) / self.cell).astype(np.int64)
        high = np.floor((np.maximum(first, last) + (reach - self.least)) / self.cell).astype(np.int64) + 1
        size = (self.columns, self.rows)
        (x0, y0), (x1, y1) = np.clip(low, 0, size).T, np.clip(high, 0, size).T
        return x0, y0, x1, y1

    def _filled(self, x0: Ints, y0: Ints, x1: Ints, y1: Ints) -> Ints:
        """Indices of the rectangles of cells that have any place in them."""
        below = self.lower_left
        return np.flatnonzero(below[y1, x1] - below[y1, x0] - below[y0, x1] + below[y0, x0])


def _divided(first: Array, last: Array, longest: float) -> tuple[Ints, Array, Array]:
    """Index of a line, start and end of each piece: a long line would fill a wide rectangle of cells."""
    line = np.arange(len(first))
    count = np.ceil(np.abs(last - first).max(axis=1) / longest).astype(np.int64)
    if not len(first) or count.max() <= 1:
        return line, first, last
    count = np.maximum(count, 1)
    line = np.repeat(line, count)
    step = ((last - first) / count[:, None])[line]
    begin = first[line] + step * _counted(count)[:, None]
    return line, begin, begin + step


def _counted(lengths: Ints) -> Ints:
    """0, 1, ... for each of several lengths, one after the other."""
    ends = np.cumsum(lengths)
    return np.arange(int(ends[-1]) if ends.size else 0) - np.repeat(ends - lengths, lengths)
