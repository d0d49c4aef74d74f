"""The plate seen from above on a grid: by which step each cell of it is cut through.

The proof of walls is exact and has no grid. This is for what hangs together: a bridge that is too narrow to
be found here is too narrow to hold. Whatever is uncertain counts as cut, so two cells side by side that are
not cut are joined by material. What the program may not cut, the finished part and its tabs, is known without
a grid to hang together, however thin it is.

A plate that has been turned over begins with what the setup before has left, and a cut is through as soon as
it meets the air below. Air that is near a cell counts as if it were there.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.geometry.prepared import prepared
from mechwright_cam.controls.reading.run import Ints
from mechwright_cam.proof.finished import finished_bodies
from mechwright_cam.proof.paths import NEAR, Paths
from mechwright_cam.proof.plane import Shape, grow
from mechwright_cam.setup.job import Job

CELL = 0.4
"""Width of a cell, mm: bridges of :data:`BRIDGE` are found."""
MOST_CELLS = 4_000_000
"""Of a larger plate cells are wider: memory has a bound."""
SKIN = 0.2
"""What stands no higher over the underside, mm, holds nothing; nor does the lower half of a tab."""
NEVER = np.iinfo(np.int32).max
"""Stands for the step that cuts a cell which no step cuts."""
BEFORE = -1
"""Stands for the step that cuts a cell which the setup before has cut through."""
UNSURE = 0.5 + math.sqrt(0.5) + 0.25
"""A cutter counts so many cells wider: half of one between two neighbours, half the diagonal of the cell that
its place is in, and what is left between two places."""
BRIDGE = 2 * UNSURE * CELL + math.sqrt(2) * CELL
"""A bridge so wide is found on the usual grid, mm, whichever way it lies."""

CHUNK = 20_000
"""So many moves are laid on the grid at a time: memory does not go with the program."""

Steps = NDArray[np.int32]
Mask = NDArray[np.bool_]
Bounds = tuple[float, float, float, float]
"""Least x and y, greatest x and y, mm."""


@dataclass(frozen=True)
class Grid:
    """Cells (ny, nx) of a plate; rows from the lower edge."""

    x: float
    y: float
    """The lower left corner, mm."""
    cell: float
    """Width of a cell, mm."""
    cut: Steps
    """(ny, nx) the step that cuts a cell, :data:`NEVER` where none does."""

    def cells(self, places: Array, border: int = 0) -> tuple[Ints, Ints, Mask]:
        """Row and column (k,) of places (k, 2), mm, and which of them are on the grid with a border."""
        ny, nx = self.cut.shape
        column = np.floor((places[:, 0] - self.x) / self.cell).astype(np.int64) + border
        row = np.floor((places[:, 1] - self.y) / self.cell).astype(np.int64) + border
        inside = (column >= 0) & (column < nx + 2 * border) & (row >= 0) & (row < ny + 2 * border)
        return row, column, inside

    def lower(self, paths: Paths, steps: Ints, radius: float, level: float, wider: float) -> None:
        """Cut with one radius, mm: the first step that comes within it of a cell cuts that.

        What counts is the part of each step at ``level`` or below; the radius counts ``wider`` cells wider.
        """
        reach = radius / self.cell + wider
        if reach < 0:
            return
        h, (ny, nx) = int(reach), self.cut.shape
        centres = np.full((ny + 2 * h, nx + 2 * h), NEVER, dtype=np.int32)
        for first in range(0, steps.size, CHUNK):
            # Two places are so near that between them a quarter of a cell is left at most.
            places, z, owner = paths.samples(steps[first : first + CHUNK], math.sqrt(2 * radius * self.cell))
            row, column, inside = self.cells(places, h)
            inside &= z <= level + NEAR
            np.minimum.at(centres, (row[inside], column[inside]), owner[inside].astype(np.int32))
        np.minimum(self.cut, earliest(centres, reach), out=self.cut)


@dataclass(frozen=True)
class Footprint(Grid):
    """A grid by which step each cell of the plate is cut through, :data:`BEFORE` by the setup before."""

    body: Steps
    """(ny, nx) above 0 where a cell is near enough to a cut to count as cut, and lies in the finished part or
    in a planned tab: it counts as never cut, and those of one number hang together. 0 elsewhere."""
    part: Shape
    """The finished part."""

    def place(self, mask: Mask) -> tuple[float, float]:
        """The middle of a cell that is nearest to the middle of some, mm."""
        rows, columns = np.nonzero(mask)
        best = int(np.argmin((rows - rows.mean()) ** 2 + (columns - columns.mean()) ** 2))
        x, y = self.x + (columns[best] + 0.5) * self.cell, self.y + (rows[best] + 0.5) * self.cell
        return float(x), float(y)

    def inside(self, shape: Shape, where: Mask | None = None) -> Mask:
        """(ny, nx) whether the middle of a cell, of those asked for, is in a shape."""
        found = np.zeros(self.cut.shape, dtype=bool)
        x0, y0, x1, y1 = (np.array(shape.bounds) - (self.x, self.y, self.x, self.y)) / self.cell
        some = np.zeros_like(found)
        some[max(int(y0), 0) : int(y1 + 1), max(int(x0), 0) : int(x1 + 1)] = True
        rows, columns = np.nonzero(some if where is None else some & where)
        x, y = self.x + (columns + 0.5) * self.cell, self.y + (rows + 0.5) * self.cell
        found[rows, columns] = shapely.contains_xy(prepared(shape), x, y)
        return found

    def within(self, mask: Mask, distance: float) -> Mask:
        """(ny + 2 h, nx + 2 h) the cells within a distance of some, mm, with a border h cells wide."""
        reach = distance / self.cell
        h = math.ceil(reach)
        found = np.zeros((mask.shape[0] + 2 * h, mask.shape[1] + 2 * h), dtype=np.bool_)
        rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
        if rows.size:  # a small piece of a large plate takes no more than its own surroundings
            low, high, left, right = rows[0], rows[-1] + 1, columns[0], columns[-1] + 1
            seeds = np.where(np.pad(mask[low:high, left:right], h + int(reach)), 0, NEVER).astype(np.int32)
            found[low : high + 2 * h, left : right + 2 * h] = earliest(seeds, reach) < NEVER
        return found


def footprint(paths: Paths, job: Job, window: Bounds | None = None) -> Footprint:
    """Cut the plate through, move by move; time goes with the length of path and the size of the plate.

    With a window, least and greatest x and y in mm, it is that part of the plate alone, as if its edges were
    the plate's. A small window has the usual cells where those of the whole plate are wider.
    """
    x0, y0, x1, y1 = job.stock if window is None else window
    cell = cell_for((x0, y0, x1, y1))
    shape = max(math.ceil((y1 - y0) / cell), 1), max(math.ceil((x1 - x0) / cell), 1)
    cut = np.full(shape, NEVER, dtype=np.int32)
    bodies = finished_bodies(job)
    found = Footprint(x0, y0, cell, cut, np.zeros(shape, dtype=np.int32), shapely.union_all(bodies))
    cuts = paths.cuts if window is None else _near(paths, window, cell)
    for level, there in _openings(found, job):
        pieces = paths.below(level, steps=cuts)
        radii = np.round(paths.radius_at(pieces, level), 3)
        one = replace(found, cut=np.full(shape, NEVER, dtype=np.int32))
        for radius in np.unique(radii[radii > NEAR]).tolist():
            one.lower(paths, pieces.step[radii == radius], radius, level, UNSURE)
        np.minimum(cut, one.cut, out=cut, where=there)
    for number, body in enumerate(_kept(bodies, job, cell), start=1):
        mine = found.inside(body, cut < NEVER)
        cut[mine], found.body[mine] = NEVER, number
    return found


def cell_for(bounds: Bounds) -> float:
    """Width of the cells of a plate or of a part of it, mm."""
    x0, y0, x1, y1 = bounds
    return max(CELL, math.sqrt((x1 - x0) * (y1 - y0) / MOST_CELLS))


def _near(paths: Paths, window: Bounds, cell: float) -> Ints:
    """The cuts that may come into a window."""
    least, most = paths.extent(paths.cuts)
    reach = (paths.radius[paths.cuts] + UNSURE * cell)[:, None]
    inside = (most + reach >= window[:2]) & (least - reach <= window[2:])
    near: Ints = paths.cuts[inside.all(axis=1)]
    return near


def _openings(found: Footprint, job: Job) -> Iterator[tuple[float, Mask]]:
    """Heights z, mm, and the cells (ny, nx) that a cut down to there opens; tells what is open before."""
    lowest = min((tab.top + job.thickness for tab in job.tabs), default=np.inf)
    skin = min(SKIN, lowest / 2)
    top = np.full(found.cut.shape, -job.thickness)
    for air in sorted(job.gone, key=lambda air: air.top):
        near = grow(air.shape, UNSURE * found.cell, found.cell / 100)
        top[found.inside(near)] = air.top
    found.cut[top >= -skin] = BEFORE
    for height in np.unique(top[top < -skin]).tolist():
        yield height + skin, top == height


def _kept(bodies: list[Shape], job: Job, cell: float) -> NDArray[Any]:
    """Plan views of what the program may not cut, and what hangs together of it.

    A part that the setups cut apart is not known to hang together: what cuts it is found on the grid.
    """
    holds = [tab.shape for tab in job.tabs]
    if job.frame is not None:
        bodies, holds = bodies if len(bodies) == 1 else [], [job.frame.holds]
    kept: NDArray[Any] = shapely.get_parts(
        shapely.union_all([*bodies, *(shapely.buffer(one, cell) for one in holds)])
    )
    return kept


def earliest(centres: Steps, reach: float) -> Steps:
    """(m - 2 h, n - 2 h) least of (m, n) numbers within ``reach`` cells of each, h of them at most.

    Each row of the disc is the least over two stretches whose length is a power of two.
    """
    h = int(reach)
    ny, nx = centres.shape[0] - 2 * h, centres.shape[1] - 2 * h
    powers = [centres]
    while 2 ** len(powers) <= 2 * h + 1:
        half, last = 2 ** (len(powers) - 1), powers[-1]
        powers.append(np.minimum(last[:, :-half], last[:, half:]))
    found = np.full((ny, nx), NEVER, dtype=np.int32)
    for up in range(h + 1):
        w = int(math.sqrt(reach * reach - up * up))
        k = (2 * w + 1).bit_length() - 1
        left, right = h - w, h + w + 1 - 2**k
        row = np.minimum(powers[k][:, left : left + nx], powers[k][:, right : right + nx])
        np.minimum(found, row[h + up : h + up + ny], out=found)
        np.minimum(found, row[h - up : h - up + ny], out=found)
    return found
