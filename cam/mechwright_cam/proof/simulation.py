"""The stock while the program runs, on a grid of heights: what each move takes, and the picture at last.

The proof itself is exact and has no grid. This is for what the eye and the cutter ask: how much of the feed
is in air, how hard each tool has to work, and a picture.

Glossary
--------
window
    A stretch of path, a cutter radius long at least, over which engagement is measured.
engagement
    Angle of the cutter's circumference that is in material; 180 degrees is a full slot.
"""

import math
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.geometry.prepared import prepared
from mechwright_cam.controls.reading import Kind, Run
from mechwright_cam.controls.reading.run import Ints
from mechwright_cam.proof.bands import bands
from mechwright_cam.proof.fillets import fillets
from mechwright_cam.proof.paths import NEAR, Paths
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.cutter import approach, cutter
from mechwright_cam.shop.tool import Tool

CELLS = 1_000_000
"""Cells of the grid: on a plate of a hand's size they are a tenth of a millimetre wide."""
FINEST = 0.05
"""Smallest cell, mm: finer shows nothing more."""


@dataclass(frozen=True, slots=True)
class Work:
    """How hard a tool works."""

    tool: int
    """T number."""
    feed_per_tooth: float
    """Greatest feed per tooth in material, mm."""
    chip: float
    """Greatest thickness of a chip, mm: feed per tooth times the sine of the engagement, 90 degrees at most;
    less where only the rounded corner of a cutter is in the cut."""
    engagement: float
    """Greatest engagement in a window, degrees."""
    removal: float
    """Greatest rate of removal in a window, cm³/min."""
    line: int
    """Line of the program where that is."""


@dataclass(frozen=True)
class Simulation:
    """What the grid has seen."""

    air_mm: float
    feed_mm: float
    """Length of feed moves that took nothing, and of all, mm; moves above the stock count."""
    works: tuple[Work, ...]
    """One for each tool that cut."""
    heights: NDArray[np.float32]
    """(ny, nx) float32, mm: the stock at last, seen from above; rows from the lower edge."""
    cell: float
    """Width of a cell, mm."""

    def as_dict(self) -> dict[str, Any]:
        """Plain data for ``proof.json``."""
        works = [{key: round(value, 4) for key, value in asdict(work).items()} for work in self.works]
        return {"air_mm": round(self.air_mm, 1), "feed_mm": round(self.feed_mm, 1), "tools": works}


def simulate(paths: Paths, job: Job) -> Simulation:
    """Cut the stock on a grid, move by move, in the order of the program."""
    run, tools, steps = paths.run, paths.tools, paths.cuts
    x0, y0, x1, y1 = job.stock
    cell = max(FINEST, math.sqrt((x1 - x0) * (y1 - y0) / CELLS))
    shape = math.ceil((y1 - y0) / cell), math.ceil((x1 - x0) / cell)
    heights = np.zeros(shape, dtype=np.float32)
    floors = np.full(shape, -job.thickness, dtype=np.float32)
    for air in sorted(job.gone, key=lambda air: air.top):
        floors[_inside(air.shape, job, shape, cell)] = air.top
    through = floors >= -NEAR
    heights[through] = -job.thickness
    volume, depth = np.zeros(len(run)), np.zeros(len(run))
    for number, mine in _runs_of_one_tool(run, steps):
        _cut(paths, job, tools[number], mine, heights, floors, cell, volume, depth)
    heights[heights <= floors + NEAR] = -job.thickness  # cut into what was open from below
    length = np.nan_to_num(run.length)
    idle = steps[volume[steps] <= cell**2 * NEAR]
    used = dict.fromkeys(run.tool[steps].tolist())
    works = [_work(run, tools[n], steps[run.tool[steps] == n], volume, depth) for n in used]
    did = tuple(work for work in works if work is not None)
    return Simulation(float(length[idle].sum()), float(length[steps].sum()), did, heights, cell)


def _runs_of_one_tool(run: Run, steps: Ints) -> list[tuple[int, Ints]]:
    edges = np.flatnonzero(np.diff(run.tool[steps])) + 1
    return [(int(run.tool[part[0]]), part) for part in np.split(steps, edges) if part.size]


def _cut(
    paths: Paths,
    job: Job,
    tool: Tool,
    steps: Ints,
    heights: NDArray[np.float32],
    floors: NDArray[np.float32],
    cell: float,
    volume: Array,
    depth: Array,
) -> None:
    """Lower the grid under each sample of the path; what was there before is what the move takes."""
    places, z, owner = paths.samples(steps, 2 * math.sqrt(2 * tool.radius * cell))
    low = z < -NEAR
    places, z, owner = places[low], z[low], owner[low]
    disc = _disc(tool, cell)
    half = disc.shape[0] // 2
    x0, y0, _, _ = job.stock
    columns = np.floor((places[:, 0] - x0) / cell).astype(np.int64)
    rows = np.floor((places[:, 1] - y0) / cell).astype(np.int64)
    ny, nx = heights.shape
    # A loop, sample by sample: each cut depends on what the one before has left.
    for row, column, height, step in zip(
        rows.tolist(), columns.tolist(), z.tolist(), owner.tolist(), strict=True
    ):
        a, b, c, d = (
            max(row - half, 0),
            min(row + half + 1, ny),
            max(column - half, 0),
            min(column + half + 1, nx),
        )
        if a >= b or c >= d:
            continue
        stock = heights[a:b, c:d]
        tip = disc[a - row + half : b - row + half, c - column + half : d - column + half] + np.float32(
            height
        )
        np.maximum(tip, floors[a:b, c:d], out=tip)
        taken = stock - tip
        np.maximum(taken, 0, out=taken)
        most = float(taken.max())
        if most > 0:
            volume[step] += float(taken.sum()) * cell * cell
            depth[step] = max(depth[step], most)
            np.minimum(stock, tip, out=stock)


def _disc(tool: Tool, cell: float) -> NDArray[np.float32]:
    """Height of the tool's end above its tip, cell by cell; far up where the tool is not."""
    half = math.ceil(tool.radius / cell)
    at = np.arange(-half, half + 1) * cell
    return cutter(tool).height_at(np.hypot(*np.meshgrid(at, at))).astype(np.float32)


def _work(run: Run, tool: Tool, steps: Ints, volume: Array, depth: Array) -> Work | None:
    """The greatest loads of one tool, in windows along its path."""
    sideways = np.hypot(*(run.end[steps] - run.start[steps])[:, :2].T) > NEAR
    steps = steps[(sideways | (run.kind[steps] == Kind.ARC)) & (volume[steps] > 0)]
    if steps.size == 0:
        return None
    length = run.length[steps]
    # A window ends where it is long enough, or where the cutter has left the material or moved on.
    window = np.zeros(steps.size, dtype=np.int64)
    place, so_far = 0, 0.0
    for k, (one, before) in enumerate(
        zip(length.tolist(), [steps[0] - 1, *steps[:-1].tolist()], strict=True)
    ):
        if so_far >= tool.diameter or steps[k] != before + 1:
            place, so_far = place + 1, 0.0
        window[k] = place
        so_far += one
    path = np.bincount(window, length)
    long = path >= tool.radius
    if not long.any():
        return None
    taken = np.bincount(window, volume[steps])
    deep = np.zeros(place + 1)
    np.maximum.at(deep, window, depth[steps])
    feed = np.zeros(place + 1)
    np.maximum.at(feed, window, run.feed[steps])
    width = np.clip(taken / np.maximum(path * deep, NEAR), 0.0, tool.diameter)
    angle = np.arccos(np.clip(1 - width / tool.radius, -1.0, 1.0))
    rpm = run.states[run.state[steps[0]]].rpm
    tooth = feed / max(rpm * tool.flutes, NEAR)
    chip = tooth * np.sin(np.minimum(angle, np.pi / 2)) * approach(tool, deep)
    removal = taken / path * feed / 1000
    removal[~long], chip[~long], angle[~long] = 0.0, 0.0, 0.0
    worst = int(np.argmax(removal))
    return Work(
        tool.number,
        float(tooth.max()),
        float(chip.max()),
        float(np.degrees(angle.max())),
        float(removal.max()),
        int(run.line[steps[np.argmax(window == worst)]]),
    )


def _inside(shape: shapely.Geometry, job: Job, grid: tuple[int, int], cell: float) -> NDArray[np.bool_]:
    """(ny, nx) whether the middle of each cell is in a shape."""
    x0, y0, _, _ = job.stock
    x = x0 + (np.arange(grid[1]) + 0.5) * cell
    y = y0 + (np.arange(grid[0]) + 0.5) * cell
    shape = prepared(shape)
    inside: NDArray[np.bool_] = shapely.contains_xy(shape, *np.meshgrid(x, y))
    return inside


def deviation(simulation: Simulation, job: Job, coarser: int) -> NDArray[np.float32]:
    """(my, mx) height of the stock over the finished part, mm; NaN beside the part and next to its walls.

    ``coarser`` cells of the grid are one here. Walls are left to the proof: on a grid they have steps.
    """
    seen = simulation.heights[::coarser, ::coarser]
    cell = simulation.cell * coarser
    wanted = np.full(seen.shape, np.nan, dtype=np.float32)
    for band in reversed(bands(job)):
        flat = shapely.buffer(band.keep, -1.5 * cell, quad_segs=2)
        wanted[_inside(flat, job, seen.shape, cell)] = band.top
    for band in bands(job):  # nothing is told of a floor beside a wall above it
        near = shapely.buffer(shapely.boundary(band.keep), 1.5 * cell, quad_segs=2)
        wanted[_inside(near, job, seen.shape, cell)] = np.nan
    for fillet in fillets(job):
        rows, columns = np.nonzero(_inside(fillet.foot, job, seen.shape, cell))
        x, y = job.stock[0] + (columns + 0.5) * cell, job.stock[1] + (rows + 0.5) * cell
        wanted[rows, columns] += fillet.rise(shapely.distance(fillet.walls, shapely.points(x, y)))
    return seen - wanted
