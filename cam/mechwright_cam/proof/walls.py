"""How far the cut is off along every wall: for the picture, and for the list of the worst places.

The proof's own figures are exact and come first. Here walls are sampled: each at the lowest height at which
it has to be cut, where it is swept least.

Glossary
--------
off
    Signed distance of the cut from the wall, mm: positive where stock was left, negative in the part.
corner
    A place that no mill of the program can reach.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.geometry.prepared import prepared
from mechwright.tolerances import TOLERANCES
from mechwright_cam.controls.reading.run import Ints
from mechwright_cam.proof.bands import Band, bands, wall_region
from mechwright_cam.proof.paths import NEAR
from mechwright_cam.proof.plane import Shape, closing, grow
from mechwright_cam.proof.sweep import ROUNDING, Sweep, Sweeps
from mechwright_cam.proof.target_shape import TAB_SLACK, play
from mechwright_cam.proof.unreachable_stock import VISIBLE
from mechwright_cam.proof.wall import HINTED, Wall
from mechwright_cam.setup.job import Job

MOST_SAMPLES = 6000
"""Places along all walls of one height, at most."""
WALL_SPACING = 0.05
"""They are no nearer to each other, mm: nothing on a wall is finer than the cutters."""
LISTED = 5
"""So many of the worst places of each kind are listed."""
LISTED_APART = 0.1
"""Listed places are so far from each other, as a share of the plate's larger side."""
SEEN = 0.002
"""A wall of a higher layer that is so near to a measured one is the same, mm."""


@dataclass(frozen=True)
class Place:
    """A place on a wall and what the cut is off there, mm."""

    x: float
    y: float
    z: float
    off: float


@dataclass(frozen=True)
class Walls:
    """What was found along the walls."""

    points: Array
    outward: Array
    """(n, 2) float, mm: places in work coordinates, in order along each wall, and unit vectors off the
    part."""
    z: Array
    off: Array
    """(n,) float, mm."""
    corner: NDArray[np.bool_]
    """(n,) bool."""
    run: Ints
    """(n,) int: places of one number follow on each other along a wall."""
    left: tuple[Place, ...]
    cut: tuple[Place, ...]
    corners: tuple[Place, ...]
    """The worst places: stock left within reach, cuts into the part, and corners."""

    def as_dict(self) -> dict[str, Any]:
        """Plain data for ``proof.json``, mm to a tenth of a micrometre."""

        def rows(places: tuple[Place, ...]) -> list[dict[str, float]]:
            names = {"x": "x", "y": "y", "z": "z", "off": "off_mm"}
            return [{key: round(getattr(one, name), 4) for name, key in names.items()} for one in places]

        worst = {"left": self.left, "cut": self.cut, "corners": self.corners}
        return {"places": len(self.off), **{kind: rows(places) for kind, places in worst.items()}}


def wall_deviation(sweeps: Sweeps, job: Job) -> Walls:
    """Measure the cut along every wall of a job."""
    mills = sweeps.paths.mills
    smallest = min((tool.radius for tool in mills), default=0.0)
    widest = max((tool.diameter for tool in mills), default=0.0)
    nose = max((tool.nose for tool in mills), default=0.0)
    drawn = wall_region(job)
    seen: list[Shape] = []
    found: list[tuple[Array, ...]] = []
    for band in reversed(bands(job, tuple(tab.top + TAB_SLACK for tab in job.tabs))):
        tabs = [tab.shape for tab in job.tabs if tab.top + TAB_SLACK >= band.top - NEAR]
        aside = [grow(tab, widest, SEEN) for tab in tabs]
        wall = Wall(band.keep)
        if wall.length == 0:
            continue
        points, outward = wall.at(wall.stations(max(WALL_SPACING, wall.length / MOST_SAMPLES)))
        told = _in_stock(points, job) & ~_within([*aside, *seen], points)
        if drawn is not None:
            told &= _within([drawn], points)
        points, outward = points[told], outward[told]
        edge = shapely.boundary(band.keep)
        seen.append(grow(shapely.difference(edge, shapely.union_all(aside)) if aside else edge, SEEN, SEEN))
        if not len(points):
            continue
        off = _off(points, outward, _groups(sweeps, band, job, nose))
        corner = np.zeros(len(points), dtype=bool)
        if mills:
            reached = shapely.boundary(closing(band.keep, smallest + play(job)))
            reached = prepared(reached)
            corner = (off > VISIBLE) & ~shapely.dwithin(reached, shapely.points(points), VISIBLE)
        height = np.full(len(points), band.bottom)
        found.append((points, outward, height, np.minimum(off, max(widest, NEAR)), corner))
    if not found:
        none = np.empty((0, 2))
        flags, numbers = np.empty(0, dtype=bool), np.empty(0, dtype=np.int64)
        return Walls(none, none, none[:, 0], none[:, 0], flags, numbers, (), (), ())
    points, outward, z, off, corner = (np.concatenate(rows) for rows in zip(*found, strict=True))
    x0, y0, x1, y1 = job.stock
    apart = LISTED_APART * max(x1 - x0, y1 - y0)
    worst = [
        _worst(points, z, off, chosen, sign, apart)
        for chosen, sign in ((~corner & (off > 0), 1), (off < 0, -1), (corner, 1))
    ]
    return Walls(points, outward, z, off, corner, _runs(points, z), *worst)


def _groups(sweeps: Sweeps, band: Band, job: Job, nose: float) -> list[Sweep]:
    """What is cut at the lowest place of a band where round mills are as wide as they get."""
    if nose > 0 and band.bottom > -job.thickness + NEAR:
        level = min(band.bottom + nose, (band.top + band.bottom) / 2)
        return sweeps.at(level, level)
    underside = band.bottom <= -job.thickness + NEAR
    return sweeps.at(band.bottom + (ROUNDING if underside else TOLERANCES.leftover), band.bottom)


def _in_stock(points: Array, job: Job) -> NDArray[np.bool_]:
    x0, y0, x1, y1 = job.stock
    least, most = (x0 + SEEN, y0 + SEEN), (x1 - SEEN, y1 - SEEN)
    return np.asarray(((points > least) & (points < most)).all(axis=1), dtype=np.bool_)


def _within(shapes: list[Shape], points: Array) -> NDArray[np.bool_]:
    found: NDArray[np.bool_] = np.zeros(len(points), dtype=np.bool_)
    for shape in shapes:
        shape = prepared(shape)
        found[shapely.contains_xy(shape, points[:, 0], points[:, 1])] = True
    return found


def _off(points: Array, outward: Array, groups: list[Sweep]) -> Array:
    """Distance (k,) of each place from the nearest swept disc, negative inside of one, mm."""
    off = np.full(len(points), np.inf)
    for group in groups:
        # The path of every cutter that came to the wall counts: one of them may have cut too deep.
        beside = points + group.radius * outward
        off = np.minimum(off, group.chords.hinted_distance(points, beside, HINTED) - group.radius)
    open_ = np.flatnonzero(off > TOLERANCES.leftover)
    for group in groups:
        if open_.size:
            far = group.chords.distance(points[open_]) - group.radius
            off[open_] = np.minimum(off[open_], far)
    return off


def _worst(
    points: Array, z: Array, off: Array, chosen: NDArray[np.bool_], sign: int, apart: float
) -> tuple[Place, ...]:
    """The places that are off most, each the worst of its surroundings."""
    left = np.flatnonzero(chosen)
    left = left[np.argsort(-sign * off[left], kind="stable")]
    places: list[Place] = []
    while left.size and len(places) < LISTED:
        best = left[0]
        (x, y), height, value = points[best].tolist(), float(z[best]), float(off[best])
        places.append(Place(x, y, height, value))
        left = left[np.hypot(*(points[left] - points[best]).T) > apart]
    return tuple(places)


def _runs(points: Array, z: Array) -> Ints:
    """Numbers of the stretches between which a wall is interrupted, or another begins."""
    step = np.hypot(*np.diff(points, axis=0).T)
    usual = float(np.median(step)) if step.size else 0.0
    return np.concatenate(([0], np.cumsum((step > 3 * usual) | (np.diff(z) != 0)))).astype(np.int64)
