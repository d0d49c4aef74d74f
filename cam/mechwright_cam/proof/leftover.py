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
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
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
from mechwright_cam.proof.sweep import Sweep, Sweeps
from mechwright_cam.proof.wall import Wall
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.settings import PathSettings
from mechwright_cam.shop.tool import Tool

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
    worst, at, bore = uncut_bores(sweeps, job)
    if not sweeps.paths.mills:
        return Remains(worst, at, (), bore)
    wanted = _Wanted(job, sweeps.paths.mills)
    lowest: dict[int, _Foot] = {}
    left_out: dict[int, Shape] = {}
    for place, band in reversed(list(enumerate(wanted.bands))):
        level, groups = sweeps.foot(band.bottom, job.thickness)
        below = lowest.get(band.section)
        reached = below.rest if below and wanted.alike else wanted.rest(place, level)
        lowest.setdefault(band.section, _Foot(band, groups, reached))
        aside = wanted.beside_tabs(place)
        if aside is not None:
            reached = wanted.rest(place, level, held=True)
        # Of one cross-section the lowest band is swept least: higher up only what it left out is looked at.
        within = left_out.get(band.section) if wanted.alike else None
        left_out[band.section] = shapely.Polygon() if aside is None else aside
        found = [_on_floors(reached, band, job, groups)]
        if within is None or not within.is_empty:
            within = _both(within, wanted.drawn)
            thick, spot = _on_walls(reached, within, aside, job, groups, wanted.narrowest(band))
            found.insert(0, (min(thick, 2 * wanted.smallest), spot))
        for depth, spot in found:
            if spot is not None and depth > worst:
                worst, at, bore = depth, (*spot, band.bottom), None
    beyond = [spot for foot in lowest.values() for spot in _beyond(foot, wanted, job)]
    return Remains(worst, at, tuple(sorted(beyond, key=lambda spot: -spot[3])), bore)


@dataclass(frozen=True)
class _Foot:
    """The lowest band of a cross-section: what is cut there, and what has to stay there at least."""

    band: Band
    groups: list[Sweep]
    rest: Shape


class _Wanted:
    """What the mills of a program have to leave, band by band."""

    def __init__(self, job: Job, mills: Sequence[Tool]) -> None:
        self.job, self.mills = job, mills
        air = play(job) + job.wear_margin
        self.reach = Reach(mills, air, -job.floor)
        self.fillets = fillets(job)
        self.smallest = min(tool.radius for tool in mills) + air
        self.slack = max(TAB_SLACK, *self.reach.noses) if self.reach.noses else TAB_SLACK
        extra = [z for fillet in self.fillets for z in fillet.heights] + _above_floors(job, self.reach)
        self.bands = bands(job, (*(tab.top + self.slack for tab in job.tabs), *extra))
        self.drawn = asked(job)

    @property
    def alike(self) -> bool:
        """Whether one cross-section asks but once.

        With round or short cutters, or round floors, every height is another question.
        """
        return self.reach.plain and not self.fillets

    def narrowest(self, band: Band) -> float:
        """Radius of the narrowest mill where a band is measured, mm."""
        underside = band.bottom <= -self.job.thickness + NEAR
        if underside or not self.reach.noses:
            return self.smallest
        return self.reach.least(TOLERANCES.leftover)

    def rest(self, place: int, level: float, *, held: bool = False) -> Shape:
        """What has to stay at a height in the band of an index; with ``held`` the tabs as well."""
        rest = self.reach.rest(self._held if held else self._free, place, level)
        if not self.reach.noses:
            return rest
        return along(rest, play(self.job), self.job, self.bands[place], self.mills, level)

    def beside_tabs(self, place: int) -> Shape | None:
        """Where the cutter lifts beside the tabs that a band touches, if any: what stays goes with the tab."""
        tabs, widest = self._tabs[place], max(tool.diameter for tool in self.mills)
        return shapely.union_all([grow(tab, widest, COARSE) for tab in tabs]) if tabs else None

    @cached_property
    def _tabs(self) -> list[list[Shape]]:
        """The tabs that each band touches."""
        tabs = self.job.tabs
        return [[t.shape for t in tabs if t.top + self.slack >= band.top - NEAR] for band in self.bands]

    @cached_property
    def _free(self) -> Surroundings:
        """What has to stay, without tabs."""
        job, floors = self.job, []
        if not self.reach.plain:
            floors = [(-(one.top + one.depth), floor_of(one, job)) for one in _recesses(job)]
        layers = [(band.top, self._entered(band, band.keep)) for band in self.bands]
        return Surroundings(layers, -job.thickness, floors, self.fillets)

    @cached_property
    def _held(self) -> Surroundings:
        """What has to stay, with the tabs."""
        layers = [
            (band.top, self._entered(band, shapely.union_all([band.keep, *tabs])))
            for band, tabs in zip(self.bands, self._tabs, strict=True)
        ]
        return replace(self._free, layers=layers)

    def _entered(self, band: Band, keep: Shape) -> Shape:
        return entered(keep, self.smallest, play(self.job), self.job, band)


def _both(one: Shape | None, two: Shape | None) -> Shape | None:
    """Where two regions are both; None is everywhere."""
    if one is None or two is None:
        return two if one is None else one
    both: Shape = shapely.intersection(one, two)
    return both


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


def _beyond(foot: _Foot, wanted: _Wanted, job: Job) -> list[tuple[float, float, float, float, float]]:
    """The places between the part and its closing that nothing has cut."""
    band, groups, keep = foot.band, foot.groups, foot.band.keep
    if wanted.fillets:
        solid = [fillet.solid(band.bottom + TOLERANCES.leftover) for fillet in wanted.fillets]
        keep = shapely.union_all([keep, *solid])
    rest = shapely.difference(foot.rest, grow(keep, VISIBLE / 2))
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
    points, depth = _deepest_points(parts, Boundary(keep))
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
