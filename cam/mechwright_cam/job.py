"""A job: one part, its stock, its holding and its cutters, in work coordinates.

Glossary
--------
work coordinates
    Those of the work offset: x and y from the origin that the design file names, z = 0 on top of the stock.
target
    The finished part seen from above.
keep
    What must stay at a height: the target, and below the top of the tabs the tabs as well.
cut
    What the cutters leave of the target's surroundings: the target with the corners filled that a round
    cutter cannot enter.

Planner and proof both start from a job and from nothing else, so that the proof does not depend on the plan.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal

import shapely

from mechwright.details import Detail, moved
from mechwright.errors import DesignError, GeometryError
from mechwright.geometry.segments import Point
from mechwright.part import Bore, Feature, Part, Profile
from mechwright.tooling import MILLS, CamSettings, Tool, ToolKind
from mechwright_cam.nest import Nest, moved_feature, outlines_of
from mechwright_cam.toolpath.offsets import filled

LEVEL = 1e-6
"""Heights nearer than this are one, mm: far below the last decimal of a program."""

TAB_REACH = 1.0
"""How far a tab reaches under the part's edge, mm, so that rounding never leaves a gap between the two."""

TAB_WIDTH = 2.0
"""Width of a tab, mm, where the design file says nothing: four, 1 mm high, hold a plate of a hand's size."""

LEAST_TAB_WIDTH = 0.5
"""A tab chosen by the program is at least so wide, mm: a thinner one breaks under the finishing cut."""


LEAST_TURN = 0.05
"""With cutter compensation the tool's centre turns on at least this radius in an inside corner, mm, however
large D is: on a smaller one rounding to three decimals would change its direction by degrees."""


@dataclass(frozen=True)
class Tab:
    """A bridge from the part to the frame: its plan view, its upper side (below 0), and its width, mm."""

    shape: shapely.Polygon
    top: float
    width: float


@dataclass(frozen=True)
class Clamp:
    """A round clamp on the part that the cutter and its holder must go around or over."""

    centre: Point
    diameter: float
    top: float


@dataclass(frozen=True)
class Air:
    """What earlier setups have cut from the other side: in ``shape`` nothing stands below ``top``.

    ``shape`` is a plan view in work coordinates, ``top`` a height z, mm: 0 where they have cut through.
    """

    shape: shapely.Geometry
    top: float


@dataclass(frozen=True)
class Job:
    """Everything that planning and proof need to know.

    Parameters
    ----------
    part
        A plate part, or a nest of several.
    settings
        The table ``[cam]``.
    tools
        The cutters that may be used.
    origin
        Where X0 Y0 lies in the part's own coordinates, mm.
    stock
        Least x, least y, greatest x, greatest y of the plate, work coordinates, mm.
    tabs
        Bridges that hold the part; empty if a clamp does.
    clamp
        The bore clamp, if that holds the part.
    side
        ``"underside"`` if the plate has been turned over.
    gone
        What of the plate earlier setups have cut away, by height; higher regions lie in lower ones.
    pick_up
        Middle of the bore by which a plate that has been turned over is picked up, work coordinates.
    """

    part: Part
    settings: CamSettings
    tools: tuple[Tool, ...]
    origin: Point
    stock: tuple[float, float, float, float]
    tabs: tuple[Tab, ...] = ()
    clamp: Clamp | None = None
    side: Literal["top", "underside"] = "top"
    gone: tuple[Air, ...] = ()
    pick_up: Point | None = None

    @property
    def thickness(self) -> float:
        """Thickness of part and stock, mm: the underside is at z = -thickness."""
        return self.part.thickness

    @property
    def floor(self) -> float:
        """Depth of through cuts, z in mm."""
        return -self.thickness - self.settings.breakthrough

    def air_below(self, z: float) -> shapely.Geometry:
        """Where earlier setups have left nothing below a height z, mm; for 0, where they have cut through."""
        found: shapely.Geometry = shapely.union_all([air.shape for air in self.gone if air.top >= z - LEVEL])
        return found

    @cached_property
    def target(self) -> shapely.Geometry:
        """The finished part seen from above; of a nest all parts."""
        plates = [outline.polygon() for outline in outlines_of(self.part)]
        whole = plates[0] if len(plates) == 1 else shapely.MultiPolygon(plates)
        return shapely.transform(whole, lambda points: points - (self.origin[0], self.origin[1]))

    @cached_property
    def features(self) -> tuple[Feature, ...]:
        """The part's features in work coordinates."""
        x, y = -self.origin[0], -self.origin[1]
        return tuple(moved_feature(feature, x, y) for feature in self.part.features)

    @cached_property
    def details(self) -> tuple[Detail, ...]:
        """The part's details in work coordinates."""
        return tuple(moved(detail, -self.origin[0], -self.origin[1]) for detail in self.part.details)

    def reach(self, tool: Tool) -> float:
        """Radius by which a finishing tool reaches into corners, mm.

        With cutter compensation that of the largest D allowed, and a little more: no inside corner of the
        contour is narrower.
        """
        return tool.radius + self.wear_margin

    @property
    def wear_margin(self) -> float:
        """By so much a cutter reaches less far into corners than its radius alone would let it, mm."""
        return 0.0 if self.settings.compensation == "computer" else self.settings.wear_limit + LEAST_TURN

    @property
    def end_mills(self) -> tuple[Tool, ...]:
        """The flat end mills, largest first."""
        return tuple(tool for tool in self.mills if tool.kind is ToolKind.END_MILL)

    @property
    def mills(self) -> tuple[Tool, ...]:
        """The end mills, bull noses and balls, largest first; of one diameter the roundest first."""
        mills = [tool for tool in self.tools if tool.kind in MILLS]
        return tuple(sorted(mills, key=lambda tool: (-tool.diameter, -tool.nose)))


def make_job(part: Part, settings: CamSettings, tools: Sequence[Tool]) -> Job:
    """Lay a plate part into its stock and decide how it is held.

    Raises
    ------
    GeometryError
        The part is no plate.
    DesignError
        The stock is too small, or the part has no bore to be held by.
    """
    if part.outline is None:
        raise GeometryError(f"part {part.name} is no plate: it has no outline to mill")
    x0, y0, x1, y1 = part.outline.bounds
    widest = max((tool.diameter for tool in tools if tool.kind in MILLS), default=0.0)
    wanted = settings.stock
    if wanted.length is not None and wanted.width is not None:
        mx, my = (wanted.length - (x1 - x0)) / 2, (wanted.width - (y1 - y0)) / 2
    else:
        # A frame has to stay around the channel that the largest cutter opens: 3 mm is stiff enough for tabs.
        mx = my = widest + 3.0 if wanted.margin is None else wanted.margin
    if min(mx, my) < 0:
        raise DesignError(
            f"cam.stock: the part {part.name} is {x1 - x0:.1f} x {y1 - y0:.1f} mm and does not fit into "
            f"{wanted.length:g} x {wanted.width:g} mm; take a larger plate"
        )
    stock = (x0 - mx, y0 - my, x1 + mx, y1 + my)
    origin = {
        "axis": (0.0, 0.0),
        "corner": (stock[0], stock[1]),
        "centre": ((stock[0] + stock[2]) / 2, (stock[1] + stock[3]) / 2),
    }[settings.origin]
    placed = Job(
        part,
        settings,
        tuple(tools),
        origin,
        (stock[0] - origin[0], stock[1] - origin[1], stock[2] - origin[0], stock[3] - origin[1]),
    )
    if settings.hold.method == "bore":
        if isinstance(part, Nest):
            raise DesignError(
                f"cam.hold.method: the {len(part.placed)} parts of {part.name} are cut in one setup and "
                'cannot be clamped one by one; use method = "tabs", or no cam.nest'
            )
        return replace(placed, clamp=_clamp(placed))
    return replace(placed, tabs=_tabs(placed, max(mx, my)))


def _clamp(job: Job) -> Clamp:
    bores = [feature for feature in job.features if isinstance(feature, Bore)]
    openings = [f for f in job.features if isinstance(f, Profile) and f.side == "inside"]
    if bores:
        centre = max(bores, key=lambda bore: bore.diameter).centre
    elif openings:
        middle = shapely.Polygon(openings[0].loop.flatten()).centroid
        centre = (middle.x, middle.y)
    else:
        raise DesignError(
            f'cam.hold.method: part {job.part.name} has no bore to be held by; use method = "tabs"'
        )
    hold = job.settings.hold
    return Clamp(centre, hold.clamp_diameter, hold.clamp_height)


def _tabs(job: Job, reach: float) -> tuple[Tab, ...]:
    hold = job.settings.hold
    if hold.tab_height >= job.thickness:
        raise DesignError(
            f"cam.hold.tab_height: {hold.tab_height:g} mm is not below the thickness of {job.thickness:g} mm"
        )
    tabs = []
    for feature in job.features:
        if isinstance(feature, Profile) and feature.side == "outside":
            ring = shapely.LinearRing(feature.loop.flatten())
            width = hold.tab_width or _tab_width(feature, hold.tabs)
            for at in _tab_places(feature, ring, hold.tabs, width):
                shape = _tab_shape(ring, at, width, _frame_at(job.part, ring, at, width, reach))
                tabs.append(Tab(shape, hold.tab_height - job.thickness, width))
    return tuple(tabs)


def _tab_width(feature: Profile, count: int) -> float:
    """The width of tabs that the design leaves open: the usual one, or the widest that all sites take."""
    widest = sorted((longest for _, longest in feature.tab_sites), reverse=True)
    if not widest:
        return TAB_WIDTH
    if len(widest) < count or widest[count - 1] < LEAST_TAB_WIDTH:
        fit = sum(longest >= LEAST_TAB_WIDTH for longest in widest)
        raise DesignError(
            f"cam.hold.tabs: {feature.name} has room for {fit} tabs of at least {LEAST_TAB_WIDTH:g} mm, "
            f"not for {count}; hold the part by its bore"
        )
    return min(TAB_WIDTH, widest[count - 1])


def _tab_places(feature: Profile, ring: shapely.LinearRing, count: int, width: float) -> list[float]:
    """Distances along the ring at which the tabs stand: near equal steps, on the sites if there are any."""
    even = [ring.length * i / count for i in range(count)]
    if not feature.tab_sites:
        return even
    fit = [ring.project(shapely.Point(site)) for site, longest in feature.tab_sites if longest >= width]
    if len(fit) < count:
        widest = sorted((longest for _, longest in feature.tab_sites), reverse=True)
        at_most = widest[min(count, len(widest)) - 1]
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


def _frame_at(part: Part, ring: shapely.LinearRing, at: float, width: float, reach: float) -> float:
    """How far a tab reaches outwards: to the stock's edge, in a nest to the middle between two parts."""
    if not isinstance(part, Nest):
        return reach
    far = float(shapely.Polygon(ring).length)
    x, y, (tx, ty) = _across(ring, at, min(width / 2, ring.length / 100))
    way = shapely.LineString([(x, y), (x + far * ty, y - far * tx)])
    halfway = filled(shapely.buffer(shapely.Polygon(ring), part.gap / 2))
    inside = shapely.get_coordinates(shapely.intersection(way, halfway))
    return float(max(math.hypot(px - x, py - y) for px, py in inside.tolist()))


def _across(ring: shapely.LinearRing, at: float, step: float) -> tuple[float, float, Point]:
    """A point of a ring, and the unit vector along it there."""
    a = ring.interpolate((at - step) % ring.length)
    b = ring.interpolate((at + step) % ring.length)
    middle = ring.interpolate(at)
    length = a.distance(b)
    return middle.x, middle.y, ((b.x - a.x) / length, (b.y - a.y) / length)


def _tab_shape(ring: shapely.LinearRing, at: float, width: float, reach: float) -> shapely.Polygon:
    """A rectangle across the wall: TAB_REACH inwards, ``reach`` outwards, ``width`` wide."""
    x, y, (tx, ty) = _across(ring, at, min(width / 2, ring.length / 100))
    nx, ny = ty, -tx  # outwards of a counter-clockwise ring
    corners = [
        (x + along * tx + out * nx, y + along * ty + out * ny)
        for along, out in (
            (-width / 2, -TAB_REACH),
            (width / 2, -TAB_REACH),
            (width / 2, reach),
            (-width / 2, reach),
        )
    ]
    return shapely.Polygon(corners)
