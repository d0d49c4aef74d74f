"""Stock that stays where none should be.

The cutters of the program sweep, at the bottom of each band, the discs around the part of their path that
reaches it; higher up they sweep at least that. Above a floor the bottom is taken as high as stock may be
left: so the cusps between the cuts of a ball count as they should. What the cutters could reach is everything
outside the closing of the finished part by the radius of the smallest, or less with round ones
(``reachable``). The stock on a wall is, at samples of the reachable wall, the distance to the nearest path
less that cutter's radius. Where it is nothing a disc touches the wall, and the band of one diameter along the
wall is clear; so walls need no areas. Floors do, and get them.

What is between the part and its closing no cutter of the program can remove: it is measured and located.
A bore has no such corners: it is cut to its wall (``bores``), or the program is not that of the part.
"""

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import shapely

from mechwright.arrays import Array
from mechwright.contracts.part import Bore, Feature, Profile
from mechwright.geometry.prepared import prepared
from mechwright.tolerances import TOLERANCES
from mechwright_cam.proof.bands import Band, asked, bands, floor_of, stock_shape
from mechwright_cam.proof.bores import uncut_bores
from mechwright_cam.proof.fillets import fillets
from mechwright_cam.proof.grooves import along, entered
from mechwright_cam.proof.paths import NEAR
from mechwright_cam.proof.plane import Boundary, Shape, grow, swept
from mechwright_cam.proof.reachable import Reach, Surroundings
from mechwright_cam.proof.sweep import ROUNDING, Sweep, Sweeps
from mechwright_cam.proof.wall import Wall
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.settings import PathSettings
from mechwright_cam.shop.tool import MILLS

VISIBLE = 0.001
"""Unreachable stock thinner than this is not told from the outline's own deviation, mm."""
SPOTS = 40
"""So many places of unreachable stock are listed, deepest first; a gear has two per tooth."""
PLAY = PathSettings().bias
"""A cutter reaches what it enters with this much air on either side, mm.

Paths and polygons are no better, and may be a micron too deep as outlines may: a path in the middle of a
narrower slot would cut more off both walls. Without it a slot up to 3 µm wider than the cutter would count as
left over; with ``flatten`` alone the narrow ends of recesses would still prove, but such slots would not.
"""
TAB_SLACK = 0.5
"""A tab may come out this much higher than planned, mm: the cutter is lifted over it with room to spare, and
the tab is cut off by hand."""
CLEARED = TOLERANCES.arc_fit
"""A wall with no more stock than this is as clean as a path can make it, mm."""
CLEAN = TOLERANCES.leftover / 2
"""A wall with no more stock than this passes whatever the other cutters did there, mm."""
REFINED = 64
"""So many of the worst wall samples are looked at closely."""
EDGE = 9
"""Trial points on an edge beside the deepest corner of a remainder."""
REFINE = 33
"""Trial points beside a place that is looked at closely: a wall sample is searched every 10 µm or less."""
BESIDE = 0.1
"""How far from its expected place a finishing path is looked for first, mm; found or not, the proof holds."""
COARSE = 0.002
"""Accuracy of areas that are not reported, mm: a fifth of the leftover limit."""


def play(job: Job) -> float:
    """Air on either side of a cutter where it can enter, mm: more where paths keep farther off the walls."""
    return max(PLAY, job.settings.path.bias)


@dataclass(frozen=True, slots=True)
class Remains:
    """What stays: the thickest reachable stock and its place, mm, and all that is out of reach."""

    reachable: float
    at: tuple[float, float, float] | None
    beyond: tuple[tuple[float, float, float, float, float], ...]
    """x, y, z, depth, area of each unreachable place, mm, deepest first."""
    bore: Bore | None = None
    """The bore in which the thickest stock stays, if it does in one."""


def remains(sweeps: Sweeps, job: Job) -> Remains:
    """Measure the stock that the program leaves around the part."""
    paths = sweeps.paths
    used = set(paths.run.tool[paths.steps].tolist())
    mills = [t for n, t in paths.tools.items() if n in used and t.kind in MILLS]
    worst, at, bore = uncut_bores(sweeps, job)
    if not mills:
        return Remains(worst, at, (), bore)
    air = play(job) + job.wear_margin
    reach, round_floors = Reach(mills, air, -job.floor), fillets(job)
    smallest, widest = min(t.radius for t in mills) + air, max(t.diameter for t in mills)
    slack = max(TAB_SLACK, *reach.noses) if reach.noses else TAB_SLACK
    extra = [z for fillet in round_floors for z in fillet.heights] + _above_floors(job, reach)
    every = bands(job, (*(tab.top + slack for tab in job.tabs), *extra))
    # With round or short cutters, or round floors, every height is another question, else one cross-section
    # asks but once.
    alike = reach.plain and not round_floors
    floors = []
    if not reach.plain:
        floors = [(-(one.top + one.depth), floor_of(one, job)) for one in _recesses(job)]
    free = Surroundings(
        [(band.top, entered(band.keep, smallest, play(job), job, band)) for band in every],
        -job.thickness,
        floors,
        round_floors,
    )
    beside = [_tabs_at(job, one, slack) for one in every]
    held = free
    if any(beside):
        layers = [
            (b.top, entered(shapely.union_all([b.keep, *t]), smallest, play(job), job, b))
            for b, t in zip(every, beside, strict=True)
        ]
        held = replace(free, layers=layers)
    rests: dict[int, Shape] = {}
    lowest: dict[int, tuple[Band, list[Sweep]]] = {}
    unseen: dict[int, Shape | None] = {}
    drawn = asked(job)
    for place, band in reversed(list(enumerate(every))):
        underside = band.bottom <= -job.thickness + NEAR
        height = band.bottom + (ROUNDING if underside else TOLERANCES.leftover)
        level = band.bottom + (0.0 if underside else TOLERANCES.leftover)
        groups = sweeps.at(height, level)
        key = id(band.keep)
        reached = rests[key] if alike and key in rests else reach.rest(free, place, level)
        if reach.noses:
            reached = along(reached, play(job), job, band, mills, level)
        if key not in lowest:
            rests[key], lowest[key] = reached, (band, groups)
        aside = None
        if beside[place]:
            reached = reach.rest(held, place, level)
            if reach.noses:
                reached = along(reached, play(job), job, band, mills, level)
            # Beside a tab the cutter lifts, and what it leaves there goes with the tab.
            aside = shapely.union_all([grow(tab, widest, COARSE) for tab in beside[place]])
        # Of one cross-section the lowest band is swept least: higher up only what it left out is looked at.
        narrow = smallest if underside or not reach.noses else reach.least(TOLERANCES.leftover)
        thick, where = 0.0, None
        if not alike or key not in unseen or unseen[key] is not None:
            within = unseen.get(key) if alike else None
            if drawn is not None:
                within = drawn if within is None else shapely.intersection(within, drawn)
            thick, where = _on_walls(reached, within, aside, job, groups, narrow)
        unseen[key] = aside
        uncut = _on_floors(reached, band, job, groups)
        for depth, spot in ((min(thick, 2 * smallest), where), uncut):
            if spot is not None and depth > worst:
                worst, at, bore = depth, (*spot, band.bottom), None
    beyond = []
    for key, (band, groups) in lowest.items():
        solid = [fillet.solid(band.bottom + TOLERANCES.leftover) for fillet in round_floors]
        keep = shapely.union_all([band.keep, *solid]) if solid else band.keep
        beyond += _beyond(rests[key], Band(band.top, band.bottom, keep), job, groups)
    beyond.sort(key=lambda spot: -spot[3])
    return Remains(worst, at, tuple(beyond), bore)


def _recesses(job: Job) -> list[Feature]:
    """The features that end in the plate: each has a floor."""
    return [
        feature
        for feature in job.features
        if feature.top + feature.depth < job.thickness - NEAR
        and not (isinstance(feature, Profile) and feature.side == "outside")
    ]


def _above_floors(job: Job, reach: Reach) -> list[float]:
    """Heights from which on round mills are as wide as they get above the floors."""
    floors = {feature.top + feature.depth for feature in _recesses(job)}
    return [nose - floor for nose in reach.noses for floor in floors]


def _tabs_at(job: Job, band: Band, slack: float) -> list[Shape]:
    """The tabs that a band touches."""
    return [tab.shape for tab in job.tabs if tab.top + slack >= band.top - NEAR]


def _on_walls(
    reached: Shape,
    within: Shape | None,
    aside: Shape | None,
    job: Job,
    groups: list[Sweep],
    smallest: float,
) -> tuple[float, tuple[float, float] | None]:
    """Thickest stock on the wall that can be reached, and its place; inf where no cutter went.

    If ``within`` is given only the wall in there counts, and never the wall in ``aside``.
    """
    # Between two discs that stand apart a cusp stays; one of the leftover limit is wider than this where it
    # is CLEARED thick, so a sample meets it, and the refinement finds its peak.
    limit = TOLERANCES.leftover
    spacing = 2 * (limit - CLEARED) / math.sqrt(2 * limit / smallest)
    wall = Wall(reached)
    if wall.length == 0:
        return 0.0, None
    within, aside = (region if region is None else prepared(region) for region in (within, aside))
    stations = wall.stations(spacing)
    _, thick, stations = _measured(wall, stations, within, aside, job, groups)
    if thick.size == 0:
        return 0.0, None
    worst = stations[np.argsort(thick)[-REFINED:]]
    finer = (worst[:, None] + np.linspace(-spacing, spacing, REFINE)).ravel()
    points, thick, _ = _measured(wall, np.clip(finer, 0.0, wall.length), within, aside, job, groups)
    best = int(np.argmax(thick))
    return float(max(thick[best], 0.0)), (float(points[best, 0]), float(points[best, 1]))


def _measured(
    wall: Wall, stations: Array, within: Shape | None, aside: Shape | None, job: Job, groups: list[Sweep]
) -> tuple[Array, Array, Array]:
    """Points (k, 2), thickness (k,) and stations (k,) where the wall is to be cut at all."""
    points, outward = wall.at(stations)
    x0, y0, x1, y1 = job.stock
    x, y = points.T
    # Where the part's edge is the stock's edge there is nothing to cut, nothing above the limit at least.
    edge = TOLERANCES.leftover
    asked = (x > x0 + edge) & (x < x1 - edge) & (y > y0 + edge) & (y < y1 - edge)
    if within is not None:
        asked &= shapely.intersects_xy(within, x, y)
    if aside is not None:
        asked &= ~shapely.contains_xy(aside, x, y)
    return points[asked], _thickness(points[asked], outward[asked], groups), stations[asked]


def _thickness(points: Array, outward: Array, groups: list[Sweep]) -> Array:
    """Distance (k,) from each point to the nearest swept disc, mm; inf where there is none.

    A path that finishes a wall runs one radius off it, so the nearest piece of path is looked for there
    first: its distance from the point is an upper bound, and where that is within the limit it will do.
    """
    thick = np.full(len(points), np.inf)
    for group in groups:
        # A point that one cutter has cleared needs no other, which could only have left less; the smallest,
        # which comes first, clears most.
        open_ = np.flatnonzero(thick > CLEAN)
        if open_.size == 0:
            break
        beside = points[open_] + group.radius * outward[open_]
        distance = group.chords.distance_beside(points[open_], beside, BESIDE) - group.radius
        thick[open_] = np.minimum(thick[open_], distance)
    for group in groups:
        open_ = np.flatnonzero(thick > TOLERANCES.leftover)
        if open_.size == 0:
            break
        thick[open_] = np.minimum(thick[open_], group.chords.distance(points[open_]) - group.radius)
    return thick


def _on_floors(
    reached: Shape, band: Band, job: Job, groups: list[Sweep]
) -> tuple[float, tuple[float, float] | None]:
    """Greatest distance from the reachable wall to stock that stands on a floor, and the place."""
    # A floor has to be cleared all over; the waste of a through opening drops out.
    floors = [
        floor_of(feature, job)
        for feature in _recesses(job)
        if -feature.top >= band.top - NEAR and -(feature.top + feature.depth) <= band.bottom + NEAR
    ]
    if not floors:
        return 0.0, None
    slack = TOLERANCES.leftover
    gone = shapely.union_all([swept(g.chains, g.radius + slack / 2, COARSE) for g in groups])
    region = shapely.intersection(shapely.union_all(floors), stock_shape(job))
    if job.gone:  # where earlier setups have been there is no floor
        region = shapely.difference(region, grow(job.air_below(band.bottom), slack, COARSE))
    rest = shapely.difference(shapely.difference(region, gone), grow(reached, slack, COARSE))
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
    inside = stock_shape(job) if job.frame is None else job.frame.body
    parts = shapely.get_parts(shapely.intersection(rest, inside))
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
    seen = distance[best] > VISIBLE / 2
    if not seen.any():
        return points[best], distance[best]
    told, best = best, best[seen]
    # The furthest point may lie between two corners: look along both edges that meet in the furthest corner.
    last = len(points) - 1
    before, after = np.maximum(best - 1, 0), np.minimum(best + 1, last)
    before = np.where(owner[before] == owner[best], before, best)
    after = np.where(owner[after] == owner[best], after, best)
    t = np.linspace(0.0, 1.0, EDGE)[None, :, None]
    here = points[best][:, None]
    trial = np.concatenate(
        (here + (points[before][:, None] - here) * t, here + (points[after][:, None] - here) * t), axis=1
    )
    found = edge.distance(shapely.points(trial.reshape(-1, 2))).reshape(len(best), -1)
    column, rows = np.argmax(found, axis=1), np.arange(len(best))
    place, depth = points[told], distance[told]
    place[seen], depth[seen] = trial[rows, column], found[rows, column]
    return place, depth


def _round_ended(group: Sweep, job: Job) -> bool:
    """Whether the sweep is a drill's: only those get into corners of the closing (a hole of their size)."""
    return all(abs(group.radius - mill.radius) > NEAR for mill in job.mills)
