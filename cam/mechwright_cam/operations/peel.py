"""The channel around an outside, opened with bounded engagement where the design asks for it.

Glossary
--------
loop
    A way across the channel and back: on an arc through the stock in front, and on another through what the
    loop before has cleared.
middle
    The line in the middle of the channel, on which the centres of the loops are.

A helix opens a disc as wide as the channel. Each loop clears the next disc, ``step`` further along the
middle: of radius r + R, if the cutter's is R and that of the loop r. What a cutter meets on its loop hangs on
the step alone, however the middle bends: what of the leading half of its circle is not in the disc
before. So the step follows from the engagement that is asked for.
"""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import shapely

from mechwright.arrays import Array
from mechwright.contracts.details import Detail
from mechwright.contracts.part import Feature
from mechwright.geometry.segments import Point
from mechwright_cam.operations.clearing import COARSE_FROM
from mechwright_cam.operations.contour import Contour
from mechwright_cam.operations.contract import Task
from mechwright_cam.operations.layer import WORTH_A_TOOL, Layer
from mechwright_cam.operations.pen import Pen, levels
from mechwright_cam.operations.zone import Zone
from mechwright_cam.setup.job import PEELED, Job
from mechwright_cam.shop.tool import Tool
from mechwright_plane.offsets import ROUGH, grow, polygons
from mechwright_plane.path import Cut, Path, arc, circle, printed

BACK, AHEAD = math.radians(-120.0), math.radians(90.0)
"""A loop cuts between these directions from the way along the middle: it begins in what is clear already."""
SURE = math.radians(3.0)
"""So much less engagement than asked is planned for: decimals and the chords of the middle take some."""
HALVINGS = 40
"""Of the step, until it is known."""
CLEARANCES = 2 * ROUGH
"""The middle is off by so much at most, mm: cleared discs are taken to be that much smaller."""


def engaged(radius: float, loop: float, step: float) -> float:
    """Greatest engagement, rad, of a cutter on a loop, a step behind the one before; all lengths in mm."""
    hole, place = radius + loop, np.linspace(BACK, AHEAD, 211)
    x, y = step + loop * np.cos(place), loop * np.sin(place)
    away, towards = np.hypot(x, y), np.arctan2(y, x)
    # The cutter's circle is out of the disc as far as this to both sides of the way from its middle.
    half = np.arccos(np.clip((hole**2 - away**2 - radius**2) / (2 * away * radius), -1.0, 1.0))
    leading = np.minimum(towards + half, place + math.pi) - np.maximum(towards - half, place)
    return float(np.where(half > 0, leading, 0.0).max())


def step_of(radius: float, loop: float, engagement: float) -> float:
    """Step along the middle that engages a cutter by an angle, rad; all lengths in mm.

    >>> step = step_of(3.0, 0.9, math.pi / 3)
    >>> round(step, 3), round(math.degrees(engaged(3.0, 0.9, step)))
    (0.363, 60)
    """
    least, most = 0.0, radius
    for _ in range(HALVINGS):
        step = (least + most) / 2
        least, most = (step, most) if engaged(radius, loop, step) < engagement else (least, step)
    return least


class Peel(Contour):
    """Opens the channel in loops with bounded engagement, and goes on as along any outside."""

    name = "peel"
    wide = PEELED

    def claim(self, feature: Feature | Detail, job: Job) -> Task | None:
        """The outsides of a job with ``outsides = "adaptive"``."""
        return super().claim(feature, job) if job.settings.outsides == "adaptive" else None

    def choose(self, feature: Feature | Detail, every: Job, chosen: Sequence[Tool]) -> Sequence[Tool] | None:
        """Those of an outside whose channel leaves a frame, where it is not cut with the full width."""
        return None if every.settings.outsides == "contour" else super().choose(feature, every, chosen)

    def open_up(self, layer: Layer) -> None:
        """Loops all around; none where one pass of full width would do, or all around the part goes."""
        zone, settings, mill = layer.zone, layer.settings, layer.zone.mills[0]
        if zone.in_the_open or zone.slopes or mill.nose > 0 or zone.height <= layer.steps.step_down(mill):
            return
        allowance = zone.allowance_for(mill, max(settings.stock_to_leave, COARSE_FROM))
        loop = ((PEELED - 1) * mill.diameter - (allowance - settings.stock_to_leave)) / 2
        engagement = math.radians(settings.engagement)
        hole = loop + mill.radius
        cusp = settings.stock_to_leave / 2
        step = min(step_of(mill.radius, loop, engagement - SURE), math.sqrt(8 * hole * cusp))
        ways = middles(zone, mill, loop, allowance, step)
        if not ways:
            return
        cleared = shapely.buffer([shapely.LineString(way) for way in ways], hole - CLEARANCES, quad_segs=16)
        before, after = layer.stock.left, layer.stock.without(shapely.union_all(cleared))
        if before.area - after.left.area < WORTH_A_TOOL * before.area:
            return
        depth = layer.pass_depth(mill, min(settings.adaptive_depth * mill.diameter, mill.flute_length))
        bottom = zone.bottom_for(mill)

        def write(pen: Pen) -> None:
            for way in ways:
                write_loops(pen, way, loop, levels(zone.top, bottom, depth), zone.top, settings.climb)
            pen.retract()

        layer.add("peel", mill, write, engagement if settings.chip_thinning else math.pi / 2, depth)
        layer.stock = replace(
            after,
            begun=True,
            over=max(after.over, cusp),
            waste=zone.waste(mill, settings.stock_to_leave),
        )


def middles(zone: Zone, mill: Tool, loop: float, allowance: float, step: float) -> list[Array]:
    """Centres (n, 2) of the loops on each stretch of the middle of a channel, at most a step apart, mm."""
    around = zone.rough_keep(allowance, mill.radius + loop)
    free = zone.channel
    if zone.tabs is not None:
        free = shapely.difference(free, grow(zone.tabs, mill.radius + loop + allowance, ROUGH))
    room = grow(zone.channel, CLEARANCES - mill.radius - loop, ROUGH)
    found = []
    for part in polygons(around):
        ring = part.exterior if shapely.is_ccw(part.exterior) else shapely.reverse(part.exterior)
        line = shapely.intersection(shapely.intersection(ring, room), free)
        for piece in _joined(line):
            count = max(1, math.ceil(float(shapely.length(piece)) / step))
            places = np.linspace(0.0, float(shapely.length(piece)), count + 1)
            found.append(shapely.get_coordinates(shapely.line_interpolate_point(piece, places)))
    return [way for way in found if len(way) > 1]


def _joined(line: shapely.Geometry) -> list[shapely.LineString]:
    """The stretches of a line, those in one that the start of a ring has divided."""
    if shapely.get_type_id(line) in {5, 7}:
        line = shapely.line_merge(
            shapely.multilinestrings([p for p in shapely.get_parts(line) if p.length > 0])
        )
    return [piece for piece in shapely.get_parts(line) if shapely.length(piece) > 0]


def write_loops(pen: Pen, way: Array, loop: float, heights: list[float], top: float, climb: bool) -> None:
    """The moves of the loops around the places of a way (n, 2), at each of some heights z, mm."""
    ahead = np.diff(way, axis=0, append=2 * way[-1:] - way[-2:-1])
    heading = np.arctan2(ahead[:, 1], ahead[:, 0])
    side = 1 if climb else -1  # round to the left the stock in front is on the right
    starts, ends = (
        way + loop * np.column_stack((np.cos(heading + side * angle), np.sin(heading + side * angle)))
        for angle in (BACK, AHEAD)
    )
    centres, begins, lasts = ([(x, y) for x, y in points.tolist()] for points in (way, starts, ends))
    begins, lasts, above = list(map(printed, begins)), list(map(printed, lasts)), top
    for z in heights:
        pen.helix(circle(centres[0], loop, begins[0], climb), loop, above, z)
        here = None
        for before, centre, start, end in zip(centres, centres[1:], begins[1:], lasts[1:], strict=False):
            if here is None:
                pen.straight(start, pen.air)
            else:
                pen.follow(Path(here, (_back(here, before, start, side),)), pen.air)
            pen.follow(Path(start, (arc(start, end, centre, side),)))
            here = end
        above = z


def _back(end: Point, centre: Point, start: Point, side: int) -> Cut:
    """From the end of a loop round to the start of the next: tangential at first, within the loop's disc."""
    inwards = np.subtract(centre, end)
    inwards /= np.linalg.norm(inwards)
    way = np.subtract(start, end)
    middle = end + inwards * float(way @ way) / (2 * float(way @ inwards))
    return arc(end, start, (float(middle[0]), float(middle[1])), side)
