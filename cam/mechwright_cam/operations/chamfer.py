"""Chamfers: along an edge, with the flank of a mill of 90 degrees."""

import math
from functools import partial

import shapely

from mechwright.contracts.details import Chamfer
from mechwright.contracts.sections import plan_view
from mechwright.errors import DesignError, ToolError
from mechwright.tolerances import TOLERANCES
from mechwright_cam.operations.contract import Task
from mechwright_cam.operations.pen import Pen
from mechwright_cam.operations.pointed import DetailOperation, spread
from mechwright_cam.plane.arcfit import fit
from mechwright_cam.plane.offsets import BIAS, FIT, grow, rings
from mechwright_cam.plane.path import Path
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.tool import ToolKind

BELOW = (0.3, 0.1)
"""How far a chamfer mill's tip stands below the chamfer, mm, tried in this order: its very tip cuts badly."""


class ChamferOperation(DetailOperation):
    """Breaks an edge all around."""

    name = "chamfer"
    detail = Chamfer

    def task(self, detail: Chamfer, job: Job) -> Task:
        """Choose the tool; raises ToolError if there is none, and says what it needs."""
        region = shapely.Polygon(detail.loop.flatten())
        # Around the rim the tip must stay above the tabs.
        tabs = max((tab.top for tab in job.tabs if detail.side == "outside"), default=-math.inf)
        held, floor = False, _floor_below(job, detail, region)
        for tool in job.tools_of(ToolKind.CHAMFER):
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
                    bottom = -(detail.width + below)
                    write = partial(_around, paths=paths, z=bottom)
                    return Task(detail, self, (tool,), 0.0, bottom, data=write)
        if held:
            raise DesignError(
                f"cam.hold.tab_height: the chamfer {detail.name} of {detail.width:g} mm in part "
                f"{job.part.name} would cut into the tabs, whose upper side is at Z{tabs:g}; "
                "make the tabs lower"
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


def _within(ring: object, region: shapely.Polygon) -> bool:
    return bool(shapely.contains(region, shapely.LinearRing(ring)))


def _around(pen: Pen, paths: list[Path], z: float) -> None:
    """Each path once round at its depth, entered by a ramp along it."""
    for path in paths:
        if path.cuts:
            pen.above(path.start)
            pen.enter(path, 0.0, z, clear=False)
            pen.follow(path)
    pen.retract()
