"""Engravings: along their strokes, with the point of a chamfer mill."""

from functools import partial

import shapely

from mechwright.contracts.details import Engraving
from mechwright.contracts.sections import plan_view
from mechwright.errors import DesignError, ToolError
from mechwright.tolerances import TOLERANCES
from mechwright_cam.operations.contract import Task
from mechwright_cam.operations.pen import Pen
from mechwright_cam.operations.pointed import DetailOperation, spread
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.tool import ToolKind
from mechwright_plane.path import polyline

NARROWER = 0.5
"""An engraving line is at least this share of the width it may have."""


class Engrave(DetailOperation):
    """Cuts lines into the top face."""

    name = "engrave"
    detail = Engraving

    def task(self, detail: Engraving, job: Job) -> Task:
        """Choose the tool; raises ToolError if there is none, and says what it needs."""
        strokes = shapely.multilinestrings(
            [shapely.LineString(stroke) for stroke in detail.strokes if len(stroke) > 1]
        )
        for feature in job.inner:
            if feature.top <= TOLERANCES.noise and shapely.intersects(plan_view(feature), strokes):
                raise DesignError(
                    f"part {job.part.name}: the engraving {detail.name} runs over {feature.name}, where "
                    "nothing stands; engravings go on the top face: place it elsewhere, or make it smaller"
                )
        for tool in reversed(job.tools_of(ToolKind.CHAMFER)):
            line = 2 * spread(tool, detail.depth)
            if not tool.centre_cutting:
                continue
            if NARROWER * detail.width <= line <= detail.width + TOLERANCES.noise and line <= tool.diameter:
                write = partial(_strokes, detail=detail)
                return Task(detail, self, (tool,), 0.0, -detail.depth, data=write)
        raise ToolError(
            f"cam.tools: no pointed cutter engraves {detail.name} of part {job.part.name} {detail.depth:g} "
            f"mm deep with lines {NARROWER * detail.width:g} to {detail.width:g} mm wide; list a "
            "finer chamfer mill that has centre_cutting = true"
        )


def _strokes(pen: Pen, detail: Engraving) -> None:
    for stroke in detail.strokes:
        path = polyline(stroke)
        pen.above(path.start)
        pen.sink(0.0)
        pen.sink(-detail.depth, pen.rates.plunge)
        pen.follow(path)
    pen.retract()
