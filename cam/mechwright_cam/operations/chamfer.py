"""Chamfers: along an edge, with the flank of a mill of 90 degrees."""

import math
from functools import partial
from itertools import product

import shapely

from mechwright.arrays import Array
from mechwright.contracts.details import Chamfer
from mechwright.contracts.sections import plan_view
from mechwright.errors import DesignError, ToolError
from mechwright.tolerances import TOLERANCES
from mechwright_cam.operations.contract import Task
from mechwright_cam.operations.pen import Pen, levels
from mechwright_cam.operations.pointed import DetailOperation, spread
from mechwright_cam.setup.job import Job
from mechwright_cam.setup.vice import CLAMP_GAP
from mechwright_cam.shop.tool import Tool, ToolKind
from mechwright_plane.arcfit import fit
from mechwright_plane.offsets import BIAS, FIT, grow, rings
from mechwright_plane.path import Path

BELOW = (0.3, 0.1)
"""How far a chamfer mill's tip stands below the chamfer, mm, tried in this order: its very tip cuts badly."""
SOFTER = 1.01
"""Ramps are by this share longer than the steepest, for rounding."""
LAYER = 1.0
"""A chamfer mill goes so much deeper at a time, mm: wide ones, as of countersinks, take several rounds."""


class ChamferOperation(DetailOperation):
    """Breaks an edge all around."""

    name = "chamfer"
    detail = Chamfer

    def task(self, detail: Chamfer, job: Job) -> Task:
        """Choose the tool; raises ToolError if there is none, and says what it needs."""
        region = shapely.Polygon(detail.loop.flatten())
        # Around the rim the tip must stay above the tabs.
        tabs = max((tab.top for tab in job.tabs if detail.side == "outside"), default=-math.inf)
        held, floor, beside = False, _floor_below(job, detail, region), -math.inf
        right = [t for t in job.tools_of(ToolKind.CHAMFER) if abs(t.point_angle - 90) <= TOLERANCES.noise]
        for tool, below in product(right, BELOW):
            deep = detail.width + below
            if spread(tool, deep) > tool.radius or deep > tool.flute_length:
                continue
            held = held or -deep < tabs
            if -deep < max(tabs, floor - TOLERANCES.noise):
                continue
            found = _rings(job, detail, region, tool, below)
            room = _beside_clamp(job, detail, found, tool)
            if found and room < CLAMP_GAP:
                beside = max(beside, room)
            elif found:
                paths = [fit(ring, FIT, job.settings.path.lines_per_arc) for ring in found]
                write = partial(_around, paths=paths, z=-deep)
                return Task(detail, self, (tool,), 0.0, -deep, data=write)
        if held:
            raise DesignError(
                f"cam.hold.tab_height: the chamfer {detail.name} of {detail.width:g} mm in part "
                f"{job.part.name} would cut into the tabs, whose upper side is at Z{tabs:g}; "
                "make the tabs lower"
            )
        if job.clamp is not None and beside > -math.inf:
            most = math.floor(10 * (job.clamp.diameter + 2 * (beside - CLAMP_GAP))) / 10
            raise DesignError(
                f"cam.hold.clamp_diameter: chamfer mills for {detail.name} of part {job.part.name} come "
                f"within {CLAMP_GAP:g} mm of a clamp of {job.clamp.diameter:g} mm; "
                + (f"use at most {most:g} mm, or tabs" if most > 0 else "use tabs")
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
        for feature in job.inner
        if feature.top + feature.depth < job.thickness - TOLERANCES.noise
        and shapely.intersects(plan_view(feature), grow(region, -TOLERANCES.leftover))
    ]
    return max(floors, default=-math.inf)


def _rings(job: Job, detail: Chamfer, region: shapely.Polygon, tool: Tool, below: float) -> list[Array]:
    """Where the tool's centre runs along an edge, its tip so far below the chamfer, mm."""
    offset = spread(tool, below) + BIAS
    if detail.side == "outside":
        return rings(grow(region, offset), job.settings.climb)[:1]
    frame = shapely.box(*region.bounds).buffer(4 * tool.diameter)
    found = rings(shapely.difference(frame, grow(region, -offset)), job.settings.climb)
    return [ring for ring in found if shapely.contains(region, shapely.LinearRing(ring))]


def _beside_clamp(job: Job, detail: Chamfer, found: list[Array], tool: Tool) -> float:
    """Room between a mill on its way and the clamp that is on when the rim is cut, mm; inf without one."""
    if job.clamp is None or detail.side != "outside" or not found:
        return math.inf
    away = shapely.distance(shapely.multilinestrings(found), shapely.Point(job.clamp.centre))
    return float(away) - tool.radius - job.clamp.diameter / 2


def _around(pen: Pen, paths: list[Path], z: float) -> None:
    """Each path round at its depth, entered by a ramp along it; wide ones, as of countersinks, in layers."""
    for path in paths:
        if path.cuts:
            pen.above(path.start)
            above = 0.0
            for height in levels(0.0, z, LAYER):
                _lap(pen, path, above, height)
                above = height
    pen.retract()


def _lap(pen: Pen, path: Path, above: float, z: float) -> None:
    """Down along the beginning of a path, once round from there, and over the beginning again."""
    run = SOFTER * (above - z) / pen.slope
    if not path.closed or run >= path.length:
        pen.enter(path, above, z, clear=False)
        pen.follow(path)
        return
    begin, rest = path.split(run)
    pen.sink(above)
    pen.descend(begin, z)
    pen.follow(rest)
    pen.follow(begin)
