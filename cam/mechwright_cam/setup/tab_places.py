"""Where tabs stand along a wall, and how wide they are where the design leaves it open."""

from collections.abc import Sequence

import numpy as np
import shapely

from mechwright.contracts.part import Feature, Profile
from mechwright.contracts.sections import plan_view
from mechwright.errors import DesignError
from mechwright.geometry.prepared import prepared

TAB_WIDTH = 2.0
"""Width of a tab, mm, where the design file says nothing: four, 1 mm high, hold a plate of a hand's size."""

LEAST_TAB_WIDTH = 0.5
"""A tab chosen by the program is at least so wide, mm: a thinner one breaks under the finishing cut."""

SHIFTS = 8
"""So many places between two tabs are tried where not all of the wall takes one."""

MOVED = 0.75
"""A tab that leads to no frame is moved by so much of the way to the middle between two tabs at most."""
TRIED = 4
"""So many places are tried on the width of a tab: at the point of a star there is one that leads out."""

HOLDS = 0.5
"""Tabs are on this share of the wall at least: on less they leave much of the part without a neighbour."""

Row = list[float]
"""Distances along the wall at which all tabs of an outside stand, mm."""


def led_out(ring: shapely.LinearRing, row: Row, width: float, reach: float, away: float) -> Row:
    """The places of a row, each moved along its wall to the nearest from which a tab leads to the frame.

    A tab goes ``reach`` mm straight out of the wall. Deep between two points of a part it ends before the
    other wall, or in what is cut off from the frame: it leads out if it ends ``away`` mm off the part, behind
    the widest cut around it. A place stays as it is where that holds, and where there is no better one within
    :data:`MOVED` of the way to the middle between two tabs.
    """
    part = prepared(shapely.Polygon(ring))
    half = ring.length / len(row) / 2
    apart = width / TRIED
    count = int(half * MOVED / apart)
    off = np.arange(-count, count + 1) * apart
    off = off[np.argsort(np.abs(off), kind="stable")]
    step = min(width / 2, ring.length / 100)
    moved = []
    for wish in row:
        at = (wish + off) % ring.length
        middle, before, after = (
            shapely.get_coordinates(shapely.line_interpolate_point(ring, (at + way) % ring.length))
            for way in (0.0, -step, step)
        )
        along = (after - before) / np.hypot(*(after - before).T)[:, None]
        end = shapely.points(middle + reach * np.column_stack((along[:, 1], -along[:, 0])))
        good = np.flatnonzero(shapely.distance(part, end) >= away)
        moved.append(float(at[good[0]]) if good.size else wish)
    return moved


def rows(
    feature: Profile,
    ring: shapely.LinearRing,
    count: int,
    width: float,
    slopes: float,
    barred: Sequence[Feature],
) -> tuple[list[Row], list[Row]]:
    """Rows of places to try: in even steps, moved on together, and in uneven ones clear of what is barred.

    Of an outside and its polygon, for ``count`` tabs that are ``width`` mm wide on top and have both their
    ``slopes``, mm, beside that. Raises DesignError where the outside says where tabs may stand, and there is
    too little room.
    """
    places = _places(feature, ring, count, width, slopes)
    if feature.tab_sites or not (slopes or barred):
        return [places], []
    step = ring.length / len(places)
    even = [[(at + shift / SHIFTS * step) % ring.length for at in places] for shift in range(SHIFTS)]
    return even, _between(ring, count, width + slopes, barred)


def tab_width(feature: Profile, count: int, slopes: float) -> float:
    """The width of tabs that the design leaves open: the usual one, or the widest that all sites take."""
    widest = sorted((longest - slopes for _, longest in feature.tab_sites), reverse=True)
    if not widest:
        return TAB_WIDTH
    if len(widest) < count or widest[count - 1] < LEAST_TAB_WIDTH:
        fit = sum(longest >= LEAST_TAB_WIDTH for longest in widest)
        ramps = f" and two slopes of {slopes / 2:.1f} mm" if slopes else ""
        instead = 'tab_shape = "rectangular" or ' if slopes else ""
        raise DesignError(
            f"cam.hold.tabs: {feature.name} has room for {fit} tabs of at least {LEAST_TAB_WIDTH:g} mm{ramps}"
            f', not for {count}; use {instead}method = "bore"'
        )
    return min(TAB_WIDTH, widest[count - 1])


def _places(
    feature: Profile, ring: shapely.LinearRing, count: int, width: float, slopes: float
) -> list[float]:
    """Distances along the ring at which the tabs stand: near equal steps, on the sites if there are any."""
    even = [ring.length * i / count for i in range(count)]
    if not feature.tab_sites:
        return even
    fit = [
        ring.project(shapely.Point(site)) for site, longest in feature.tab_sites if longest >= width + slopes
    ]
    if len(fit) < count:
        widest = sorted((longest for _, longest in feature.tab_sites), reverse=True)
        at_most = widest[min(count, len(widest)) - 1] - slopes
        if at_most <= 0:
            raise DesignError(
                f"cam.hold.tab_shape: {feature.name} has no room for two slopes of {slopes / 2:.1f} mm at "
                f'each of {count} tabs; use "rectangular"'
            )
        raise DesignError(
            f"cam.hold.tab_width: {count} tabs of {width:g} mm do not fit on {feature.name}; "
            f"use at most {at_most:.2f} mm, or fewer than {count} of cam.hold.tabs"
        )
    chosen: list[float] = []
    for wish in even:
        free = [at for at in fit if at not in chosen]
        chosen.append(
            min(free, key=lambda at: abs((at - wish + ring.length / 2) % ring.length - ring.length / 2))
        )
    return sorted(chosen)


def _between(
    ring: shapely.LinearRing, count: int, base: float, barred: Sequence[Feature]
) -> list[list[float]]:
    """Rows of places along a wall, in equal steps over all stretches that are clear of features.

    None if these are so short that the tabs would hold the part on one side only.
    """
    if not barred:
        return []
    shut = shapely.buffer(shapely.union_all([plan_view(feature) for feature in barred]), base)
    free = [line for line in shapely.get_parts(shapely.difference(ring, shut)) if line.length > 0]
    total = sum(line.length for line in free)
    if total < max(HOLDS * ring.length, 2 * count * base):
        return []
    starts = [ring.project(shapely.Point(line.coords[0])) for line in free]
    ends = np.cumsum([line.length for line in free])
    rows = []
    for shift in range(SHIFTS):
        row = []
        for wish in (np.arange(count) + (shift + 0.5) / SHIFTS) * total / count:
            at = int(np.searchsorted(ends, wish))
            along = wish - (ends[at] - free[at].length)
            row.append(float((starts[at] + along) % ring.length))
        rows.append(sorted(row))
    return rows
