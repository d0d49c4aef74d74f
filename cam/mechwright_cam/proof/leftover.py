"""Stock that stays where none should be.

The cutters of the program sweep, at the bottom of each band, the discs around the part of their path that
reaches it; higher up they sweep at least that. What the smallest of them could reach is everything outside
the closing of the finished part by its radius. Two questions follow. How thick is the stock on the wall:
at every corner of the reachable wall, the distance to the nearest path less that cutter's radius. Is there
stock further out, up to one diameter of the smallest cutter from the part: an area.

What is between the part and its closing no cutter of the program can remove: it is measured and located.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely

from mechwright.motion import Array
from mechwright.part import Profile
from mechwright.tolerances import TOLERANCES
from mechwright.tooling import ToolKind
from mechwright_cam.interpreter import Kind
from mechwright_cam.job import Job
from mechwright_cam.proof.bands import Band, bands, inside_of, stock_shape
from mechwright_cam.proof.paths import NEAR, Paths
from mechwright_cam.proof.plane import Boundary, Shape, closing, grow

ROUNDING = 1e-4
"""A path that should reach the underside may be short by the last decimal of the program, mm."""
VISIBLE = 0.001
"""Unreachable stock thinner than this is not told from the outline's own deviation, mm."""
SPOTS = 40
"""So many places of unreachable stock are listed, deepest first; a gear has two per tooth."""
TAB_SLACK = 0.5
"""A tab may come out this much higher than planned, mm: the cutter is lifted over it with room to spare, and
the tab is cut off by hand."""
CLEARED = TOLERANCES.arc_fit
"""A wall with no more stock than this is as clean as a path can make it, mm."""
REFINE = 17
"""Trial points on each edge beside the deepest corner: an edge of 0.05 mm is searched every 3 µm."""
COARSE = 0.002
"""Accuracy of the area of stock away from walls, mm: a fifth of the leftover limit."""


@dataclass(frozen=True, slots=True)
class Remains:
    """What stays: the thickest reachable stock and its place, mm, and all that is out of reach."""

    reachable: float
    at: tuple[float, float, float] | None
    beyond: tuple[tuple[float, float, float, float, float], ...]
    """x, y, z, depth, area of each unreachable place, mm, deepest first."""


@dataclass(frozen=True, slots=True)
class Sweep:
    """Paths that reach a height, of one effective radius: chains for areas, chords for distances."""

    radius: float
    chains: Any

    def chords(self) -> Any:
        """The straight pieces of all chains: short ones make a tree of them quick to ask."""
        points, owner = shapely.get_coordinates(self.chains, return_index=True)
        same = owner[:-1] == owner[1:]
        return shapely.linestrings(np.stack((points[:-1][same], points[1:][same]), axis=1))


def sweeps(paths: Paths, height: float, bottom: float) -> list[Sweep]:
    """What is cut at ``bottom`` by the feed moves that go down to ``height``."""
    cutting = paths.steps[np.isin(paths.run.kind[paths.steps], (Kind.FEED, Kind.ARC))]
    pieces = paths.below(height, steps=cutting)
    radius = np.round(paths.radius_at(pieces, max(bottom, height)), 6)
    groups = []
    for one in np.unique(radius[radius > NEAR]):
        group = pieces.only(radius == one)
        groups.append(Sweep(float(one), paths.chains(group)))
    return groups


def remains(paths: Paths, job: Job) -> Remains:
    """Measure the stock that the program leaves around the part."""
    used = set(paths.run.tool[paths.steps].tolist())
    mills = [t for n, t in paths.tools.items() if n in used and t.kind is ToolKind.END_MILL]
    if not mills:
        return Remains(0.0, None, ())
    smallest, widest = min(t.radius for t in mills), max(t.diameter for t in mills)
    worst, at = 0.0, None
    closings: dict[int, Shape] = {}
    lowest: dict[int, tuple[Band, list[Sweep]]] = {}
    for band in bands(job, tuple(tab.top + TAB_SLACK for tab in job.tabs)):
        underside = band.bottom <= -job.thickness + NEAR
        height = band.bottom + (ROUNDING if underside else TOLERANCES.leftover)
        groups = sweeps(paths, height, band.bottom)
        if id(band.keep) not in closings:
            closings[id(band.keep)] = closing(band.keep, smallest)
        lowest[id(band.keep)] = band, groups  # of one cross-section the lowest band is swept least
        tabs = [tab.shape for tab in job.tabs if tab.top + TAB_SLACK >= band.top - NEAR]
        reached = closings[id(band.keep)]
        aside = None
        if tabs:
            reached = closing(shapely.union_all([band.keep, *tabs]), smallest)
            # Beside a tab the cutter lifts, and what it leaves there goes with the tab.
            aside = shapely.union_all([grow(tab, widest, COARSE) for tab in tabs])
        thick, place = _on_walls(reached, aside, job, groups)
        for depth, where in ((thick, place), _away(reached, aside, band, job, groups, 2 * smallest)):
            if where is not None and depth > worst:
                worst, at = depth, (*where, band.bottom)
    beyond = [
        spot for key, (band, groups) in lowest.items() for spot in _beyond(closings[key], band, job, groups)
    ]
    beyond.sort(key=lambda spot: -spot[3])
    return Remains(worst, at, tuple(beyond))


def _on_walls(
    reached: Shape, aside: Shape | None, job: Job, groups: list[Sweep]
) -> tuple[float, tuple[float, float] | None]:
    """Thickest stock on the wall that can be reached, and its place."""
    points = shapely.get_coordinates(reached)
    x0, y0, x1, y1 = job.stock
    x, y = points.T
    # Where the part's edge is the stock's edge there is nothing to cut.
    points = points[(x > x0 + NEAR) & (x < x1 - NEAR) & (y > y0 + NEAR) & (y < y1 - NEAR)]
    if aside is not None and len(points):
        shapely.prepare(aside)
        points = points[~shapely.contains_xy(aside, points[:, 0], points[:, 1])]
    if len(points) == 0:
        return 0.0, None
    thick = _thickness(points, groups)
    worst = int(np.argmax(thick))
    return float(max(thick[worst], 0.0)), (float(points[worst, 0]), float(points[worst, 1]))


def _thickness(points: Array, groups: list[Sweep]) -> Array:
    """Distance (k,) from each point to the nearest swept disc, mm; inf where there is none."""
    spots = shapely.points(points)
    thick = np.full(len(points), np.inf)
    for group in groups:
        # A point that one cutter has cleared needs no other; the smallest, which comes first, clears most.
        open_ = np.flatnonzero(thick > CLEARED)
        if open_.size == 0:
            break
        most = float(thick[open_].max()) + group.radius
        (index, _), distance = shapely.STRtree(group.chords()).query_nearest(
            spots[open_],
            max_distance=most if np.isfinite(most) else None,
            return_distance=True,
            all_matches=False,
        )
        found = open_[index]
        thick[found] = np.minimum(thick[found], distance - group.radius)
    return thick


def _away(
    reached: Shape, aside: Shape | None, band: Band, job: Job, groups: list[Sweep], reach: float
) -> tuple[float, tuple[float, float] | None]:
    """Greatest distance from the reachable wall to stock that stands off it, and the place."""
    slack = TOLERANCES.leftover
    zone = [grow(band.keep, reach, COARSE)]
    for feature in job.features:
        # A floor has to be cleared all over; the waste of a through opening may drop out.
        blind = feature.top + feature.depth < job.thickness - NEAR
        outside = isinstance(feature, Profile) and feature.side == "outside"
        if blind and not outside and -feature.top >= band.top - NEAR >= -(feature.top + feature.depth):
            zone.append(inside_of(feature))
    region = shapely.intersection(shapely.union_all(zone) if len(zone) > 1 else zone[0], stock_shape(job))
    cleared = [grow(g.chains, g.radius + slack / 2, COARSE) for g in groups]
    gone = shapely.union_all([shape for group in cleared for shape in np.atleast_1d(group)])
    rest = shapely.difference(region, gone)
    rest = shapely.difference(rest, grow(reached, slack, COARSE))
    if aside is not None:
        rest = shapely.difference(rest, aside)
    if rest.is_empty:
        return 0.0, None
    corners = shapely.get_coordinates(rest)
    distance = Boundary(reached).distance(shapely.points(corners))
    worst = int(np.argmax(distance))
    return float(distance[worst]), (float(corners[worst, 0]), float(corners[worst, 1]))


def _beyond(
    reached: Shape, band: Band, job: Job, groups: list[Sweep]
) -> list[tuple[float, float, float, float, float]]:
    """The places between the part and its closing that nothing has cut."""
    rest = shapely.difference(reached, grow(band.keep, VISIBLE / 2))
    parts = shapely.get_parts(shapely.intersection(rest, stock_shape(job)))
    if parts.size == 0:
        return []
    drills = [shapely.union_all(grow(g.chains, g.radius)) for g in groups if _round_ended(g, job)]
    if drills:
        parts = shapely.get_parts(shapely.difference(parts, shapely.union_all(drills)))
    parts = parts[~shapely.is_empty(parts)]
    if parts.size == 0:
        return []
    points, depth = _deepest_points(parts, Boundary(band.keep))
    told = depth > VISIBLE
    return [
        (x, y, band.bottom, d, a)
        for (x, y), d, a in zip(
            points[told].tolist(), depth[told].tolist(), shapely.area(parts)[told].tolist(), strict=True
        )
    ]


def _deepest_points(parts: Any, edge: Boundary) -> tuple[Array, Array]:
    """The point (n, 2) of each part that is furthest from the edge, and its distance (n,)."""
    points, owner = shapely.get_coordinates(parts, return_index=True)
    distance = edge.distance(shapely.points(points))
    order = np.lexsort((-distance, owner))
    best = order[np.unique(owner[order], return_index=True)[1]]
    # The furthest point may lie between two corners: look along both edges that meet in the furthest corner.
    before = points[np.where(owner[best - 1] == owner[best], best - 1, best)]
    after_index = np.minimum(best + 1, len(points) - 1)
    after = points[np.where(owner[after_index] == owner[best], after_index, best)]
    t = np.linspace(0.0, 1.0, REFINE)[None, :, None]
    here = points[best][:, None]
    trial = np.concatenate((here + (before[:, None] - here) * t, here + (after[:, None] - here) * t), axis=1)
    found = edge.distance(shapely.points(trial.reshape(-1, 2))).reshape(len(best), -1)
    column = np.argmax(found, axis=1)
    rows = np.arange(len(best))
    return trial[rows, column], found[rows, column]


def _round_ended(group: Sweep, job: Job) -> bool:
    """Whether the sweep is a drill's: only those get into corners of the closing (a hole of their size)."""
    return all(abs(group.radius - mill.radius) > NEAR for mill in job.end_mills)
