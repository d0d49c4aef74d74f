"""Stock that stays where none should be.

The cutters of the program sweep, at the bottom of each band, the discs around the part of their path that
reaches it; higher up they sweep at least that. Above a floor the bottom is taken as high as stock may be
left: so the cusps between the cuts of a ball count as they should. What the cutters could reach is everything
outside the closing of the finished part by the radius of the smallest, or less with round ones
(``reachable``). The stock on a wall is, at samples of the reachable wall, the distance to the nearest path
less that cutter's radius. Where it is nothing a disc touches the wall, and the band of one diameter along the
wall is clear; so walls need no areas. Floors do, and get them.

What is between the part and its closing no cutter of the program can remove: it is measured and located.
A bore has no such corners: it is cut to its wall, whichever the cutters are, or the program is not that of
the part.
"""

import math
from dataclasses import dataclass

import numpy as np
import shapely

from mechwright.contracts.part import Bore
from mechwright.tolerances import TOLERANCES
from mechwright_cam.proof.bands import Band, bands, floor_of, stock_shape
from mechwright_cam.proof.paths import NEAR
from mechwright_cam.proof.plane import Boundary, Shape, grow, swept, without_specks
from mechwright_cam.proof.sweep import Sweep, Sweeps
from mechwright_cam.proof.target_shape import COARSE, TargetShape, drilled_floors, recesses
from mechwright_cam.proof.unreachable_stock import Foot, unreachable_stock
from mechwright_cam.proof.wall import on_walls
from mechwright_cam.setup.job import Job


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
    target = TargetShape(job, sweeps.paths.mills)
    lowest: dict[int, Foot] = {}
    left_out: dict[int, Shape] = {}
    for place, band in reversed(list(enumerate(target.bands))):
        level, groups = sweeps.foot(band.bottom, job.thickness)
        below = lowest.get(band.section)
        reached = below.rest if below and target.alike else target.rest(place, level)
        lowest.setdefault(band.section, Foot(band, groups, reached))
        aside = target.tab_lift_area(place)
        if aside is not None:
            reached = target.rest(place, level, held=True)
        # Of one cross-section the lowest band is swept least: higher up only what it left out is looked at.
        within = left_out.get(band.section) if target.alike else None
        left_out[band.section] = shapely.Polygon() if aside is None else aside
        found = [_on_floors(reached, band, job, groups)]
        if within is None or not within.is_empty:
            within = _both(within, target.drawn)
            thick, spot = on_walls(reached, within, aside, job, groups, target.narrowest(band))
            found.insert(0, (min(thick, 2 * target.smallest), spot))
        for depth, spot in found:
            if spot is not None and depth > worst:
                worst, at, bore = depth, (*spot, band.bottom), None
    beyond = [spot for foot in lowest.values() for spot in unreachable_stock(foot, target, job)]
    return Remains(worst, at, tuple(sorted(beyond, key=lambda spot: -spot[3])), bore)


def _both(one: Shape | None, two: Shape | None) -> Shape | None:
    """Where two regions are both; None is everywhere."""
    if one is None or two is None:
        return two if one is None else one
    return shapely.intersection(one, two)


def _on_floors(
    reached: Shape, band: Band, job: Job, groups: list[Sweep]
) -> tuple[float, tuple[float, float] | None]:
    """Greatest distance from the reachable wall to stock that stands on a floor, and the place."""
    # A floor has to be cleared all over; the waste of a through opening drops out.
    pointed = [bore for bore, _ in drilled_floors(job)]
    floors = [
        floor_of(feature, job)
        for feature in recesses(job)
        if feature not in pointed
        and -feature.top >= band.top - NEAR
        and -(feature.top + feature.depth) <= band.bottom + NEAR
    ]
    if not floors:
        return 0.0, None
    slack = TOLERANCES.leftover
    gone = shapely.union_all([swept(g.chains, g.radius + slack / 2, COARSE) for g in groups])
    region = shapely.intersection(shapely.union_all(floors), stock_shape(job))
    if job.gone:  # where earlier setups have been there is no floor
        region = shapely.difference(region, grow(job.air_below(band.bottom), slack, COARSE))
    rest = without_specks(shapely.difference(shapely.difference(region, gone), grow(reached, slack, COARSE)))
    if rest.is_empty:
        return 0.0, None
    corners = shapely.get_coordinates(rest)
    distance = Boundary(reached).distance(shapely.points(corners))
    worst = int(np.argmax(distance))
    return float(distance[worst]), (float(corners[worst, 0]), float(corners[worst, 1]))


AROUND = 64
"""So many places on the wall of a bore are looked at: it is a circle, and so is the path that makes it."""


def uncut_bores(sweeps: Sweeps, job: Job) -> tuple[float, tuple[float, float, float] | None, Bore | None]:
    """Thickest stock on a bore's wall, mm, its place and the bore; the diameter where nothing has cut."""
    worst, at, uncut = 0.0, None, None
    bores = [feature for feature in job.features if isinstance(feature, Bore)]
    turn = np.linspace(0.0, math.tau, AROUND, endpoint=False)
    ray = np.column_stack((np.cos(turn), np.sin(turn)))
    pointed = drilled_floors(job)
    for band in bands(job, tuple(-depth for _, depth in pointed)) if bores else ():
        here = [
            bore
            for bore in bores
            if -bore.top >= band.top - NEAR
            and -(bore.top + bore.depth) <= band.bottom + NEAR
            and not any(bore is one and band.top <= NEAR - depth for one, depth in pointed)
        ]
        if not here:
            continue
        wall = np.concatenate([bore.centre + bore.diameter / 2 * ray for bore in here])
        most = np.repeat([bore.diameter for bore in here], AROUND)
        places = shapely.points(wall)
        # Where it opens into something else, or beyond the stock, there is no wall.
        walled = shapely.dwithin(band.keep, places, TOLERANCES.leftover)
        thick = np.where(walled, most, 0.0)
        for group in sweeps.foot(band.bottom, job.thickness)[1]:
            thick = np.minimum(thick, group.chords.distance(wall) - group.radius)
        best = int(np.argmax(thick))
        if thick[best] > worst:
            worst, at = float(thick[best]), (float(wall[best, 0]), float(wall[best, 1]), band.bottom)
            uncut = here[best // AROUND]
    return worst, at, uncut
