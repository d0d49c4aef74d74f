"""Chamfers, threads and engravings: what is cut into the shape when it is made."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import shapely

from mechwright.contracts.details import Chamfer, Detail, Engraving, Thread
from mechwright.contracts.part import Bore, Profile
from mechwright.contracts.sections import plan_view
from mechwright.errors import DesignError, ToolError
from mechwright.tolerances import TOLERANCES
from mechwright_cam.operations.pen import Pen
from mechwright_cam.plane.arcfit import fit
from mechwright_cam.plane.offsets import BIAS, FIT, grow, rings
from mechwright_cam.plane.path import Path, arc, circle, polyline, rounded
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.tool import Tool, ToolKind

BELOW = (0.3, 0.1)
"""How far a chamfer mill's tip stands below the chamfer, mm, tried in this order: its very tip cuts badly."""
NARROWER = 0.5
"""An engraving line is at least this share of the width it may have."""
AROUND = 0.1
"""Air all round a thread mill in its hole, mm."""
CORE_PLAY = 0.25
"""By how much, in pitches, a hole may miss the core diameter of its thread: ISO 965's tolerance, roughly."""


@dataclass(frozen=True)
class DetailPlan:
    """A detail, its tool, and what writes its moves; ``outside``: only when the rim is cut."""

    detail: Detail
    tool: Tool
    write: Callable[[Pen], None]

    @property
    def outside(self) -> bool:
        """Whether the rim of the part has to be there first."""
        return isinstance(self.detail, Chamfer) and self.detail.side == "outside"


def plan_detail(job: Job, detail: Detail) -> DetailPlan:
    """Choose the tool of a detail; raises ToolError if there is none, and says what it needs."""
    match detail:
        case Chamfer():
            return _chamfer(job, detail)
        case Thread():
            return _thread(job, detail)
        case Engraving():
            return _engraving(job, detail)


def _tools(job: Job, kind: ToolKind) -> list[Tool]:
    fit = [t for t in job.tools if t.kind is kind and job.part.material in t.cutting]
    return sorted(fit, key=lambda tool: -tool.diameter)


def spread(tool: Tool, height: float) -> float:
    """Radius of a pointed tool at a height above its tip, mm."""
    return tool.tip_diameter / 2 + height * math.tan(math.radians(tool.point_angle / 2))


def _chamfer(job: Job, detail: Chamfer) -> DetailPlan:
    region = shapely.Polygon(detail.loop.flatten())
    # Around the rim the tip must stay above the tabs.
    tabs = max((tab.top for tab in job.tabs if detail.side == "outside"), default=-math.inf)
    held, floor = False, _floor_below(job, detail, region)
    for tool in _tools(job, ToolKind.CHAMFER):
        if abs(tool.point_angle - 90) > TOLERANCES.noise:
            continue
        for below in BELOW:
            offset = spread(tool, below) + BIAS
            wide = spread(tool, below + detail.width)
            if wide > tool.radius or detail.width + below > tool.flute_length:
                continue
            if -(detail.width + below) < tabs:
                held = True
                continue
            if -(detail.width + below) < floor - TOLERANCES.noise:
                continue
            if detail.side == "outside":
                blocked = grow(region, offset)
            else:
                frame = shapely.box(*region.bounds).buffer(4 * tool.diameter)
                blocked = shapely.difference(frame, grow(region, -offset))
            climb = job.settings.climb
            found = rings(blocked, climb)
            inner = [ring for ring in found if _within(ring, region)]
            found = inner if detail.side == "inside" else found[:1]
            if found:
                paths = [fit(ring, FIT, job.settings.path.lines_per_arc) for ring in found]
                return DetailPlan(detail, tool, partial(_around, paths=paths, z=-(detail.width + below)))
    if held:
        raise DesignError(
            f"cam.hold.tab_height: the chamfer {detail.name} of {detail.width:g} mm in part {job.part.name} "
            f"would cut into the tabs, whose upper side is at Z{tabs:g}; make the tabs lower"
        )
    if detail.width + BELOW[-1] > -floor + TOLERANCES.noise:
        raise DesignError(
            f"part {job.part.name}: the chamfer {detail.name} of {detail.width:g} mm would cut the floor "
            f"{-floor:g} mm below its edge, for its tip goes {BELOW[-1]:g} mm deeper; make it "
            f"{max(-floor - BELOW[-1], 0):g} mm at most"
        )
    raise ToolError(
        f"cam.tools: no chamfer mill of 90 degrees cuts {detail.name} of {detail.width:g} mm in part "
        f"{job.part.name}; list one that goes {detail.width + BELOW[-1]:g} mm deep and into its corners"
    )


def _floor_below(job: Job, detail: Chamfer, region: shapely.Polygon) -> float:
    """The highest floor inside an edge that is chamfered, z in mm; -inf without any."""
    if detail.side == "outside":
        return -math.inf
    floors = [
        -(feature.top + feature.depth)
        for feature in job.features
        if not (isinstance(feature, Profile) and feature.side == "outside")
        and feature.top + feature.depth < job.thickness - TOLERANCES.noise
        and shapely.intersects(plan_view(feature), grow(region, -TOLERANCES.leftover))
    ]
    return max(floors, default=-math.inf)


def _within(ring: object, region: shapely.Polygon) -> bool:
    return bool(shapely.contains(region, shapely.LinearRing(ring)))


def _around(pen: Pen, paths: list[Path], z: float) -> None:
    """Each path once round at its depth, entered by a ramp along it."""
    for path in paths:
        if path.cuts:
            pen.above(path.start)
            pen.sink(0.0)
            pen.ramp(path, z)
            pen.follow(path)
    pen.retract()


def _engraving(job: Job, detail: Engraving) -> DetailPlan:
    strokes = shapely.multilinestrings(
        [shapely.LineString(stroke) for stroke in detail.strokes if len(stroke) > 1]
    )
    for feature in job.features:
        outside = isinstance(feature, Profile) and feature.side == "outside"
        if (
            not outside
            and feature.top <= TOLERANCES.noise
            and shapely.intersects(plan_view(feature), strokes)
        ):
            raise DesignError(
                f"part {job.part.name}: the engraving {detail.name} runs over {feature.name}, where nothing "
                "stands; engravings go on the top face: place it elsewhere, or make it smaller"
            )
    for tool in reversed(_tools(job, ToolKind.CHAMFER)):
        line = 2 * spread(tool, detail.depth)
        if NARROWER * detail.width <= line <= detail.width + TOLERANCES.noise and line <= tool.diameter:
            return DetailPlan(detail, tool, partial(_strokes, detail=detail))
    raise ToolError(
        f"cam.tools: no pointed cutter engraves {detail.name} of part {job.part.name} {detail.depth:g} mm "
        f"deep with lines {NARROWER * detail.width:g} to {detail.width:g} mm wide; list a finer chamfer mill"
    )


def _strokes(pen: Pen, detail: Engraving) -> None:
    for stroke in detail.strokes:
        path = polyline(stroke)
        pen.above(path.start)
        pen.sink(0.0)
        pen.sink(-detail.depth, pen.rates.plunge)
        pen.follow(path)
    pen.retract()


def _thread(job: Job, detail: Thread) -> DetailPlan:
    holes = [
        f
        for f in job.features
        if isinstance(f, Bore) and math.dist(f.centre, detail.centre) < TOLERANCES.closure
    ]
    play = CORE_PLAY * detail.pitch
    hole = next((h for h in holes if abs(h.diameter - detail.core) <= play and h.depth >= detail.depth), None)
    if hole is None:
        raise ToolError(
            f"cam.tools: thread {detail.name} of part {job.part.name} has no bore of {detail.core:.2f} mm "
            f"that is {detail.depth:g} mm deep; draw one"
        )
    for tool in _tools(job, ToolKind.THREAD_MILL):
        if tool.diameter <= hole.diameter - 2 * AROUND and tool.flute_length >= detail.depth:
            return DetailPlan(detail, tool, partial(_turns, detail=detail, climb=job.settings.climb))
    raise ToolError(
        f"cam.tools: no thread mill cuts {detail.name} of part {job.part.name}; list one of at most "
        f"{hole.diameter - 2 * AROUND:.2f} mm that reaches {detail.depth:g} mm"
    )


def _turns(pen: Pen, detail: Thread, climb: bool) -> None:
    """A right-hand helix: upwards counter-clockwise to climb, downwards clockwise against it."""
    x, y = (rounded(value) for value in detail.centre)
    radius = detail.diameter / 2 - pen.tool.radius
    turn = circle((x, y), radius, (x + radius, y), climb)
    side = 1 if climb else -1
    middle = ((x + turn.start[0]) / 2, y)
    lead_in = Path((x, y), (arc((x, y), turn.start, middle, side),))
    lead_out = Path(turn.start, (arc(turn.start, (x, y), middle, side),))
    turns = math.ceil(detail.depth / detail.pitch) + 1
    bottom = -detail.depth
    heights = [bottom + number * detail.pitch for number in range(turns + 1)]
    if not climb:
        heights.reverse()
    feed = pen.rates.inside(radius, pen.tool.radius)
    pen.above((x, y))
    pen.sink(heights[0])
    pen.follow(lead_in, feed)
    for z in heights[1:]:
        pen.descend(turn, z, feed)
    pen.follow(lead_out, feed)
    pen.retract()
