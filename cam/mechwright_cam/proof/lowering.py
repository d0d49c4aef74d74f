"""A cutter set onto a grid of heights at many places, one after the other, all worked out at once.

Each place takes what those before it have left. Cell by cell that is a running minimum over the places whose
disc covers the cell, in their order. It is worth it where a disc has few cells: numpy then takes longer to be
called for each place than to work.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright_cam.controls.reading.run import Ints

FEW_CELLS = 120
"""Cells of a disc up to which it is worth it."""
CHUNK = 100_000
"""So many cells under places are worked out at a time: what a processor keeps near."""

Heights = NDArray[np.float32]


@dataclass(frozen=True)
class Lowered:
    """What the cutter takes at m places."""

    depth: Array
    """(m,) most that is taken off any cell, mm; 0 where nothing is."""
    sums: Array
    """(m, 3) of the heights taken off all cells, and of these times x and y off the middle, in cells."""


def lowered(heights: Heights, floors: Heights, disc: Heights, row: Ints, column: Ints, z: Heights) -> Lowered:
    """Lower a grid at places, by row, column and height z (m,) of the tip.

    ``disc`` has the heights of the tool's end above the tip, inf where the tool is not; no cell is lowered
    below its floor.
    """
    y, x = np.nonzero(np.isfinite(disc))
    end, half = disc[y, x], disc.shape[0] // 2
    depth, sums = np.zeros(z.size), np.zeros((z.size, 3))
    step = max(CHUNK // max(end.size, 1), 1)
    for first in range(0, z.size, step):
        chunk = slice(first, first + step)
        place, offset, before, tip = _taken(
            heights,
            floors,
            end,
            row[chunk, None] + (y - half),
            column[chunk, None] + (x - half),
            z[chunk, None],
        )
        more = (before - tip).astype(np.float64)
        np.maximum.at(depth[chunk], place, more)
        for at, weight in enumerate((np.ones(end.size), x - half, y - half)):
            sums[chunk, at] = np.bincount(place, more * weight[offset], minlength=depth[chunk].size)
    return Lowered(depth, sums)


def _taken(
    heights: Heights, floors: Heights, end: Heights, row: Ints, column: Ints, z: Heights
) -> tuple[Ints, Ints, Heights, Heights]:
    """Where cells (m, k) of discs are lowered: place, cell of the disc, and heights before and after."""
    ny, nx = heights.shape
    cells = np.where((row >= 0) & (row < ny) & (column >= 0) & (column < nx), row * nx + column, -1).ravel()
    # One floor for all cells is one number: copies for every cell of a large plate take longer than its cuts.
    under = floors.ravel()[cells].reshape(z.size, -1) if any(floors.strides) else floors[:1, :1]
    tips = np.maximum(end + z, under).ravel()
    some = np.flatnonzero((cells >= 0) & (tips < heights.ravel()[cells]))
    # By cell, and in each cell in the order of the program.
    some = some[np.sort(cells[some] * some.size + np.arange(some.size)) % max(some.size, 1)]
    cell, tip = cells[some], tips[some]
    begins = np.append(True, cell[1:] != cell[:-1])[: cell.size]
    group = np.cumsum(begins)
    least = np.minimum.accumulate(_whole(tip) - (group << 32)) + (
        group << 32
    )  # every group begins below the last
    last = np.append(cell[1:] != cell[:-1], True)[-cell.size :] if cell.size else begins
    before = np.where(begins, heights.ravel()[cell], _single(np.append(0, least[:-1])[: cell.size]))
    heights.ravel()[cell[last]] = _single(least[last])
    lower = np.flatnonzero(tip < before)
    return *np.divmod(some[lower], end.size), before[lower], tip[lower]


def _whole(numbers: Heights) -> Ints:
    """Whole numbers in the order of some single-precision ones."""
    bits = numbers.view(np.int32).astype(np.int64)
    return np.where(bits < 0, -(2**31) - bits, bits)


def _single(whole: Ints) -> Heights:
    """The numbers that :func:`_whole` was given."""
    bits = np.where(whole < 0, -(2**31) - whole, whole)
    return bits.astype(np.int32).view(np.float32)
