"""The stock while the program runs, on a grid of heights: what each piece of path takes, and the picture.

What is cut of the part is proven exactly, without a grid. This is for what cutter and spindle ask: how hard
each tool has to work (:mod:`mechwright_cam.proof.loads`), how much of the feed is in air, and a picture.
"""

import math
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.errors import ProgramError
from mechwright.geometry.prepared import gridded
from mechwright_cam.controls.reading import Run
from mechwright_cam.controls.reading.run import Ints
from mechwright_cam.proof.bands import bands
from mechwright_cam.proof.fillets import fillets
from mechwright_cam.proof.loads import Loads, Taken, Work, loads_of, works_of
from mechwright_cam.proof.lowering import FEW_CELLS, lowered
from mechwright_cam.proof.paths import NEAR, Paths
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.cutter import cutter
from mechwright_cam.shop.tool import Tool

CELLS = 1_000_000
"""Cells of the grid: on a plate of a hand's size they are a tenth of a millimetre wide."""
MOST_CELLS = 36_000_000
"""Cells of the grid of a large plate that is cut with fine cutters."""
ROWS = 256
"""So many rows of the grid are looked at together."""
FINEST = 0.05
"""Smallest cell, mm: finer shows nothing more."""
MOST_PLACES = 40_000
"""Places along the path at which the cutter is set onto the grid, about 50 µs each: where there would be
more, the cells are wider, up to a share of the finest cutter's radius."""
MOST_LOWERED = 100_000_000
"""Cells under the cutter at all of these places, about 10 ns each: the same holds."""
MOST_TRIED = 200_000
"""Places at which a cutter may take something, beyond which a program is refused: two seconds."""
FINER = 3.0
"""So many times as many where a large plate has finer cells for its cutters."""
COARSEST = 1 / 3
"""That share: with wider cells a cutter has no shape."""


Bounds = tuple[float, float, float, float]
"""Least x and y, greatest x and y, mm."""


@dataclass(frozen=True)
class Simulation:
    """What the grid has seen."""

    air_mm: float
    feed_mm: float
    """Length of feed moves that took nothing, and of all, mm; moves above the stock count."""
    works: tuple[Work, ...]
    """One for each operation that cut, in the program's order."""
    loads: Loads
    """What each short piece of path asks of tool and spindle."""
    heights: NDArray[np.float32]
    """(ny, nx) float32, mm: the stock at last, seen from above; rows from the lower edge."""
    cell: float
    """Width of a cell, mm."""

    def as_dict(self) -> dict[str, Any]:
        """Plain data for ``proof.json``."""
        works = [
            {
                key: round(value, 4) if isinstance(value, float) else value
                for key, value in asdict(work).items()
            }
            for work in self.works
        ]
        return {"air_mm": round(self.air_mm, 1), "feed_mm": round(self.feed_mm, 1), "tools": works}


def simulate(paths: Paths, job: Job) -> Simulation:
    """Cut the stock on a grid, place by place along the path, in the order of the program."""
    run, tools, steps = paths.run, paths.tools, paths.cuts
    grid = _Grid.of(job, job.stock, max(FINEST, _cell_of(paths, job), _cell_for(paths, steps)))
    heights, floors, cell = grid.heights, grid.floors, grid.cell
    length, idle = paths.length, 0.0
    taken = []
    for number, mine in _runs_of_one_tool(run, steps):
        taken.append(_cut(paths, tools[number], mine, grid))
        idle += float(length[mine[taken[-1].of_steps(mine) <= cell**2 * NEAR]].sum())
    for first in range(0, len(heights), ROWS):
        rows = heights[first : first + ROWS]
        cut = rows <= floors[first : first + ROWS] + NEAR  # into what was open from below as well
        if cut.any():
            rows[cut] = -job.thickness
    loads = loads_of(taken, paths, job.part.material)
    works = works_of(loads, run, job.settings.machine)
    return Simulation(idle, float(length[steps].sum()), works, loads, heights, cell)


def loads_in(paths: Paths, job: Job, box: Bounds, cell: float) -> Loads:
    """What the tools take in a small part of the plate, on a grid of its own: cells of ``cell`` mm."""
    (x0, y0, x1, y1), stock = box, job.stock
    box = max(x0, stock[0]), max(y0, stock[1]), min(x1, stock[2]), min(y1, stock[3])  # beside it is air
    if box[0] >= box[2] or box[1] >= box[3]:
        return loads_of([], paths, job.part.material)
    least, most = paths.extent(paths.cuts)
    reach = paths.radius[paths.cuts][:, None]
    near = paths.cuts[((most + reach >= box[:2]) & (least - reach <= box[2:])).all(axis=1)]
    grid = _Grid.of(job, box, cell)
    every = [_cut(paths, paths.tools[n], mine, grid) for n, mine in _runs_of_one_tool(paths.run, near)]
    return loads_of(every, paths, job.part.material)


@dataclass(frozen=True)
class _Grid:
    """The stock on a grid, while it is cut."""

    x: float
    y: float
    """The lower left corner, mm."""
    cell: float
    """Width of a cell, mm."""
    heights: NDArray[np.float32]
    floors: NDArray[np.float32]
    """(ny, nx) mm: what is there, and below which nothing is."""

    @classmethod
    def of(cls, job: Job, box: Bounds, cell: float) -> "_Grid":
        """The stock of a job before any cut, or the part of it in a box."""
        x0, y0, x1, y1 = box
        shape = math.ceil((y1 - y0) / cell), math.ceil((x1 - x0) / cell)
        heights = np.zeros(shape, dtype=np.float32)  # what is not cut of a large plate takes no memory
        floors = np.broadcast_to(np.float32(-job.thickness), shape)
        if job.gone:
            floors = floors.copy()
            for air in sorted(job.gone, key=lambda air: air.top):
                floors[_inside(air.shape, (x0, y0), shape, cell)] = air.top
            heights[floors >= -NEAR] = -job.thickness
        return cls(x0, y0, cell, heights, floors)


def _cell_of(paths: Paths, job: Job) -> float:
    """Cell, mm, for the size of the plate: on a large one no wider than the finest cutter needs."""
    x0, y0, x1, y1 = job.stock
    area = (x1 - x0) * (y1 - y0)
    finest = COARSEST * float(paths.radius[paths.cuts].min(initial=math.inf))
    return min(math.sqrt(area / CELLS), max(finest, math.sqrt(area / MOST_CELLS)))


def _spacing(tool: Tool, cell: float) -> float:
    """Distance of places along a path, mm, between which a cutter leaves no cusp that a cell would show."""
    return 2 * math.sqrt(2 * tool.radius * cell)


def _cell_for(paths: Paths, steps: Ints) -> float:
    """Cell, mm, with which a path has so many places as there may be; 0 without a path."""
    radius, length = paths.radius[steps], paths.length[steps]
    if not steps.size:
        return 0.0
    wanted = length / np.sqrt(8 * radius)  # places are this over the root of a cell
    under = wanted * 4 * radius**2  # and cells this over its square, and that root
    cell = max((float(wanted.sum()) / MOST_PLACES) ** 2, (float(under.sum()) / MOST_LOWERED) ** 0.4)
    return float(min(cell, COARSEST * float(radius.min())))


def _runs_of_one_tool(run: Run, steps: Ints) -> list[tuple[int, Ints]]:
    edges = np.flatnonzero(np.diff(run.tool[steps])) + 1
    return [(int(run.tool[part[0]]), part) for part in np.split(steps, edges) if part.size]


def _cut(paths: Paths, tool: Tool, steps: Ints, grid: _Grid) -> Taken:
    """Lower the grid at places along the path; what was there before is what they take."""
    heights, floors, cell = grid.heights, grid.floors, grid.cell
    taken = Taken.along(paths, steps, _spacing(tool, cell))
    disc = _disc(tool, cell)
    half = disc.shape[0] // 2
    columns = np.floor((taken.places[:, 0] - grid.x) / cell).astype(np.int64)
    rows = np.floor((taken.places[:, 1] - grid.y) / cell).astype(np.int64)
    ny, nx = heights.shape
    met = (rows >= -half) & (rows < ny + half) & (columns >= -half) & (columns < nx + half)
    low = np.flatnonzero((taken.z < -NEAR) & met)
    low = low[_deeper(rows[low] * (nx + 2 * half) + columns[low], taken.z[low])]
    usual = math.sqrt(ny * nx * cell**2 / CELLS)  # the cell of so large a plate, were its cutters wide
    cells = int(np.count_nonzero(np.isfinite(disc)))
    at_once = FEW_CELLS // cells  # a cutter with few cells takes its time for cells, not for places
    most_tried = int(MOST_TRIED * min(max(usual / cell, 1.0), FINER)) * max(at_once, 1)
    if low.size > most_tried:
        line = int(paths.run.line[taken.step[low[most_tried]]])
        raise ProgramError(
            f"line {line}: so long a path in material, each time deeper, is set onto the stock at more than "
            f"{most_tried:,} places; split the program"
        )
    if at_once:
        tip = taken.z[low].astype(np.float32)
        found = lowered(heights, floors, disc, rows[low], columns[low], tip)
        taken.depth[low], taken.volume[low] = found.depth, found.sums[:, 0] * cell**2
        taken.moment[low] = found.sums[:, 1:] * cell**3
        return taken
    at = (np.arange(-half, half + 1) * cell).astype(np.float32)
    weights = np.column_stack((np.ones_like(at), at))  # products of matrices are the quickest sums
    area = cell * cell
    z = taken.z[low].astype(np.float32)
    # Of a flat end in an even floor the deepest place is known; else every cell is asked.
    one_floor = not any(floors.strides) or bool((floors == floors.flat[0]).all())
    even = one_floor and bool(np.isin(disc, (0.0, disc.max())).all())
    if even:
        z = np.maximum(z, floors.flat[0])
    y, x = rows[low] - half, columns[low] - half
    a, c = np.maximum(y, 0), np.maximum(x, 0)
    b, d = np.minimum(y + len(at), ny), np.minimum(x + len(at), nx)
    # A loop, place by place: each cut depends on what the one before has left.
    for index, height, a0, b0, c0, d0, i, k, j, n in zip(
        low.tolist(), z, *(one.tolist() for one in (a, b, c, d, a - y, b - y, c - x, d - x)), strict=True
    ):
        stock = heights[a0:b0, c0:d0]
        tip = disc[i:k, j:n] + height
        if not even:
            np.maximum(tip, floors[a0:b0, c0:d0], out=tip)
        more = np.maximum(stock - tip, 0)
        most = more.max()
        if most > 0:
            sums = more @ weights[j:n]
            (volume, along), (across, _) = (weights[i:k].T @ sums).T.tolist()
            taken.volume[index], taken.depth[index] = volume * area, most
            taken.moment[index] = across * area, along * area
            np.minimum(stock, tip, out=stock)
    return taken


def _deeper(cell: Ints, z: Array) -> Ints:
    """Those of the places (n,) in whose cell the tool has not been as deep before: others take nothing."""
    order = np.argsort(cell, kind="stable")
    z = z[order]
    group = np.concatenate(([0], np.cumsum(np.diff(cell[order]) != 0)))[: z.size]
    drop = float(z.max() - z.min()) + 1.0 if z.size else 0.0
    least = np.minimum.accumulate(z - drop * group)  # every group begins below all that come before it
    fresh = np.append(True, least[1:] < least[:-1])[: z.size]
    return np.sort(order[fresh])


def _disc(tool: Tool, cell: float) -> NDArray[np.float32]:
    """Height of the tool's end above its tip, cell by cell; far up where the tool is not."""
    half = math.ceil(tool.radius / cell)
    at = np.arange(-half, half + 1) * cell
    return cutter(tool).height_at(np.hypot(*np.meshgrid(at, at))).astype(np.float32)


def _inside(
    shape: shapely.Geometry, corner: tuple[float, float], grid: tuple[int, int], cell: float
) -> NDArray[np.bool_]:
    """(ny, nx) whether the middle of each cell is in a shape; the first is at the lower left corner, mm."""
    x0, y0 = corner
    x = np.asarray(x0 + (np.arange(grid[1]) + 0.5) * cell, dtype=np.float64)
    y = np.asarray(y0 + (np.arange(grid[0]) + 0.5) * cell, dtype=np.float64)
    inside = np.zeros(grid, dtype=bool)
    if not shape.is_empty:
        west, south, east, north = shape.bounds
        i, k = np.searchsorted(y, south), np.searchsorted(y, north, side="right")
        j, n = np.searchsorted(x, west), np.searchsorted(x, east, side="right")
        inside[i:k, j:n] = gridded(shape, x[j:n], y[i:k])
    return inside


def blank(job: Job, cell: float) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """The stock of a job before any cut, (ny, nx) mm: what is there, and below which nothing is."""
    grid = _Grid.of(job, job.stock, cell)
    return grid.heights, grid.floors


def deviation(simulation: Simulation, job: Job, coarser: int) -> NDArray[np.float32]:
    """(my, mx) height of the stock over the finished part, mm; NaN beside the part and next to its walls.

    ``coarser`` cells of the grid are one here. Walls are left to the proof: on a grid they have steps.
    """
    seen = simulation.heights[::coarser, ::coarser]
    return seen - target_heights(job, (seen.shape[0], seen.shape[1]), simulation.cell * coarser)


def target_heights(job: Job, shape: tuple[int, int], cell: float) -> NDArray[np.float32]:
    """(ny, nx) height of the finished part, mm, on a grid; NaN beside the part and next to its walls."""
    wanted = np.full(shape, np.nan, dtype=np.float32)
    for band in reversed(bands(job)):
        flat = shapely.buffer(band.keep, -1.5 * cell, quad_segs=2)
        wanted[_inside(flat, job.stock[:2], shape, cell)] = band.top
    for band in bands(job):  # nothing is told of a floor beside a wall above it
        near = shapely.buffer(shapely.boundary(band.keep), 1.5 * cell, quad_segs=2)
        wanted[_inside(near, job.stock[:2], shape, cell)] = np.nan
    for fillet in fillets(job):
        rows, columns = np.nonzero(_inside(fillet.foot, job.stock[:2], shape, cell))
        x, y = job.stock[0] + (columns + 0.5) * cell, job.stock[1] + (rows + 0.5) * cell
        wanted[rows, columns] += fillet.rise(shapely.distance(fillet.walls, shapely.points(x, y)))
    return wanted
