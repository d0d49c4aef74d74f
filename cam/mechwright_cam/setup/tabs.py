"""Tabs: bridges that hold the part in the frame of its stock.

Glossary
--------
along, out
    Coordinates of a tab, mm: along the wall from the tab's middle, and outwards from the wall.
base
    Extent of a tab along the wall at the underside: its width, and of a ramped one both slopes.
"""

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import shapely

from mechwright.contracts.part import Feature, Profile, is_outside
from mechwright.contracts.sections import plan_view
from mechwright.errors import DesignError
from mechwright.geometry.prepared import prepared
from mechwright.geometry.segments import Point
from mechwright.tolerances import TOLERANCES
from mechwright_cam.setup.holding import Tab, _corners, _piece_at, rectangle
from mechwright_cam.setup.tab_places import led_out, rows, tab_width
from mechwright_cam.shop.tool import MILLS, widest_mill
from mechwright_plane.nest import Nest
from mechwright_plane.offsets import filled, opened

if TYPE_CHECKING:
    from mechwright_cam.setup.job import Job

TAB_REACH = 1.0
"""How far a tab reaches under the part's edge, mm, so that rounding never leaves a gap between the two."""

DEEPER = 1.25
"""Factor between trial places of a ramped tab's ends."""


def lay_tabs(job: "Job", reach: float, below: Sequence[Feature] = ()) -> tuple[Tab, ...]:
    """Place the tabs of a job along its outsides; raises DesignError where there is no room for them.

    They reach ``reach`` mm outwards, in a nest to the middle between two parts, and stand at nothing of
    ``below``: features that are cut from the underside later, and dowels, work coordinates.
    """
    hold = job.settings.hold
    if hold.tab_height >= job.thickness:
        raise DesignError(
            f"cam.hold.tab_height: {hold.tab_height:g} mm is not below the thickness of {job.thickness:g} "
            f"mm; set it to {job.thickness / 2:.2g}, or leave it out"
        )
    slope = math.inf if hold.tab_shape == "rectangular" else _slope(job)
    outsides = filter(is_outside, job.features)
    return tuple(tab for feature in outsides for tab in _tabs_of(job, feature, slope, reach, below))


def _tabs_of(job: "Job", feature: Profile, slope: float, reach: float, below: Sequence[Feature]) -> list[Tab]:
    """The tabs of one outside.

    Ramped ones, which are long, are moved on together off the ends of walls, and all of them off recesses.
    Where no even steps are clear of those, the tabs share the stretches that are.
    """
    hold = job.settings.hold
    slopes = 2 * hold.tab_height / slope
    ring = shapely.LinearRing(feature.loop.flatten())
    width = hold.tab_width or tab_width(feature, hold.tabs, slopes)
    low = _lower_floors(job)
    even, uneven = rows(feature, ring, hold.tabs, width, slopes, [*low, *below])
    if not (slopes or low or below or feature.tab_sites or isinstance(job.part, Nest)):
        even = [led_out(ring, row, width, reach, widest_mill(job.tools)) for row in even]
    refusal: DesignError | None = None
    best: list[Tab] = []
    for number, row in enumerate([*even, *uneven]):
        if best and number >= len(even):  # no need for uneven steps
            break
        tabs: list[Tab] = []
        try:
            for at in row:
                place = _across(ring, at, min(width / 2, ring.length / 100))
                ends = (-TAB_REACH, _frame_at(job, ring, place, reach))
                shape = rectangle(place, width + slopes, ends)
                tab = Tab(shape, hold.tab_height - job.thickness, width, slope, place[:2], place[2], ends)
                tabs.append(
                    _sunk(job, feature, tab, slopes) if slopes else _beside_openings(job, feature, tab)
                )
            _check_apart(feature, tabs)
            _check_floors(job, low, tabs)
            _check_below(job, below, tabs)
        except DesignError as error:
            refusal = refusal or error
            continue
        # The straighter the wall, the less far in does a tab have to begin.
        if not best or min(tab.ends[0] for tab in tabs) > min(tab.ends[0] for tab in best):
            best = tabs
    if refusal is not None and not best:
        raise refusal
    return best


def _slope(job: "Job") -> float:
    """Tangent of the sides of ramped tabs; a cutter that cannot plunge goes down no steeper than it ramps."""
    angle, limit = job.settings.hold.tab_angle, job.settings.ramp_angle
    if angle > limit:
        for tool in job.tools:
            if tool.kind in MILLS and not tool.centre_cutting:
                raise DesignError(
                    f"cam.hold.tab_angle: {tool.name} does not cut at its centre and goes down no slope of "
                    f"{angle:g} degrees; use at most ramp_angle, {limit:g} degrees, or list another mill"
                )
    return math.tan(math.radians(angle))


def _beside_openings(job: "Job", feature: Profile, tab: Tab) -> Tab:
    """A tab as far as it lies on no opening: behind a thin wall its inner end would."""
    part = shapely.Polygon(feature.loop.flatten())
    behind = shapely.difference(shapely.intersection(tab.shape, part), job.target)
    if opened(behind, TOLERANCES.flatten).is_empty:  # outline and wall may differ by rounding
        return tab
    rest = shapely.difference(tab.shape, shapely.buffer(behind, TOLERANCES.flatten, join_style="mitre"))
    return replace(tab, shape=_piece_at(rest, (*tab.at, tab.along)))


def _sunk(job: "Job", feature: Profile, tab: Tab, slopes: float) -> Tab:
    """A ramped tab with its inner end so far inside the part that no path along the wall runs around it."""
    part = prepared(shapely.Polygon(feature.loop.flatten()))
    # Where its inner end is in the part, no cutter that keeps off the part gets around it. Through cuts go on
    # down below the underside.
    half = (tab.width + slopes) / 2 + job.settings.breakthrough / tab.slope
    place = (*tab.at, tab.along)
    x0, y0, x1, y1 = part.bounds
    depth = TAB_REACH
    while depth < math.hypot(x1 - x0, y1 - y0):
        inner = shapely.LineString(_corners(place, 2 * half, (-depth, 0.0))[:2])
        if shapely.contains_properly(part, inner):
            ends = (-depth, _outer_end(job, part, tab, 2 * half))
            shape = rectangle(place, tab.width + slopes, ends)
            # Outline and wall may differ by rounding, which makes no opening.
            openings = opened(shapely.difference(part, job.target), TOLERANCES.flatten)
            bridge = shapely.difference(shapely.intersection(shape, shapely.box(*job.stock)), openings)
            return Tab(_piece_at(bridge, place), tab.top, tab.width, tab.slope, tab.at, tab.along, ends)
        depth *= DEEPER
    raise DesignError(
        f"cam.hold.tab_shape: a ramped tab of {tab.width + slopes:.1f} mm is too long for {feature.name} of "
        f'part {job.part.name} at X{tab.at[0]:.1f} Y{tab.at[1]:.1f}; use "rectangular", or a lower tab'
    )


def _outer_end(job: "Job", part: shapely.Polygon, tab: Tab, base: float) -> float:
    """Where a ramped tab ends: in the frame, beyond all that a cutter opens around the part."""
    away, plate = 2 * widest_mill(job.tools), shapely.box(*job.stock)
    place, end = (*tab.at, tab.along), tab.ends[1]
    while not isinstance(job.part, Nest):
        outer = shapely.LineString(_corners(place, base, (0.0, end))[2:])
        if shapely.distance(outer, part) >= away or not shapely.intersects(outer, plate):
            break
        end *= DEEPER
    return end


def _check_apart(feature: Profile, tabs: list[Tab]) -> None:
    """Between two tabs the wall has to be cut down to the underside somewhere."""
    for place, one in enumerate(tabs):
        for other in tabs[:place]:
            if one.ramped and shapely.intersects(one.shape, other.shape):
                raise DesignError(
                    f"cam.hold.tabs: {len(tabs)} ramped tabs meet on {feature.name}; use fewer, steeper "
                    "(tab_angle) or lower ones (tab_height)"
                )


def _lower_floors(job: "Job") -> list[Feature]:
    """The recesses whose floors lie lower than the tops of tabs."""
    height = job.settings.hold.tab_height
    return [
        feature
        for feature in job.inner
        if TOLERANCES.noise < job.thickness - feature.top - feature.depth < height - TOLERANCES.noise
    ]


def _check_floors(job: "Job", low: list[Feature], tabs: list[Tab]) -> None:
    """No tab may stand up in a recess."""
    for feature in low:
        floor = plan_view(feature)
        for tab in tabs:
            if shapely.intersects(floor, tab.shape):
                left = job.thickness - feature.top - feature.depth
                raise DesignError(
                    f"cam.hold.tab_height: a tab of {tab.top + job.thickness:g} mm at X{tab.at[0]:.1f} "
                    f"Y{tab.at[1]:.1f} would stand up in {feature.name}, which leaves {left:g} mm of part "
                    f"{job.part.name}; use at most {left:g} mm, or another number of tabs"
                )


def _check_below(job: "Job", below: Sequence[Feature], tabs: list[Tab]) -> None:
    """Nothing on the underside may cut the tabs, by which the part still hangs in the plate."""
    for feature in below:
        floor = plan_view(feature)
        if any(shapely.intersects(floor, tab.shape) for tab in tabs):
            raise DesignError(
                f"cam.hold.tabs: {feature.name}, for the underside of part {job.part.name}, leaves too "
                f"little of the outside for {len(tabs)} tabs; take fewer or narrower ones, or draw the "
                "part the other way up"
            )


def _frame_at(job: "Job", ring: shapely.LinearRing, place: tuple[float, float, Point], reach: float) -> float:
    """How far a tab reaches outwards: to the stock's edge, in a nest to the middle between two parts.

    Beside the floor of a recess there is no middle; twice as far is frame in any case.
    """
    part = job.part
    if not isinstance(part, Nest):
        return reach
    far = float(shapely.Polygon(ring).length)
    x, y, (tx, ty) = place
    way = shapely.LineString([(x, y), (x + far * ty, y - far * tx)])
    halfway = filled(shapely.buffer(shapely.Polygon(ring), part.gap / 2))
    inside = shapely.get_parts(shapely.intersection(way, halfway))  # of a recess, both of its walls
    nearest = min(inside, key=lambda piece: float(shapely.distance(piece, shapely.Point(x, y))))
    middle = max(math.hypot(px - x, py - y) for px, py in shapely.get_coordinates(nearest).tolist())
    return float(min(middle, part.gap))


def _across(ring: shapely.LinearRing, at: float, step: float) -> tuple[float, float, Point]:
    """A point of a ring, and the unit vector along it there."""
    a = ring.interpolate((at - step) % ring.length)
    b = ring.interpolate((at + step) % ring.length)
    middle = ring.interpolate(at)
    length = a.distance(b)
    return middle.x, middle.y, ((b.x - a.x) / length, (b.y - a.y) / length)
