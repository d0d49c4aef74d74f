"""Threads: milled along a helix in a bore of their core."""

import math
from functools import partial

from mechwright.contracts.details import Thread
from mechwright.errors import ToolError
from mechwright_cam.operations.contract import Task
from mechwright_cam.operations.pen import Pen
from mechwright_cam.operations.pointed import DetailOperation
from mechwright_cam.operations.tap import lacks
from mechwright_cam.setup.depths import core_of
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.tool import ToolKind
from mechwright_plane.leads import half_circles
from mechwright_plane.path import printed, round_from_right

AROUND = 0.1
"""Air all round a thread mill in its hole, mm."""
NECK_AIR = 0.02
"""Air between a thread mill's neck and the core, mm: the proof lets the neck touch nothing."""


class ThreadOperation(DetailOperation):
    """Mills a thread, right-hand or left-hand."""

    name = "thread"
    detail = Thread

    def task(self, detail: Thread, job: Job) -> Task:
        """Choose the tool; raises ToolError if there is none, and says what it needs."""
        hole = core_of(job, detail)
        if hole is None:
            raise ToolError(
                f"cam.tools: thread {detail.name} of part {job.part.name} has no bore of {detail.core:.2f} "
                f"mm that is {detail.depth:g} mm deep; draw one"
            )
        for tool in job.tools_of(ToolKind.THREAD_MILL):
            necked = detail.diameter / 2 - tool.radius + tool.hollow <= hole.diameter / 2 - NECK_AIR
            fits = tool.diameter <= hole.diameter - 2 * AROUND and tool.flute_length >= detail.depth
            if fits and necked:
                write = partial(_turns, detail=detail, climb=job.settings.climb)
                return Task(detail, self, (tool,), 0.0, -detail.depth, data=write)
        raise ToolError(
            f"cam.tools: no thread mill cuts {detail.name} of part {job.part.name}; list one of at most "
            f"{hole.diameter - 2 * AROUND:.2f} mm that reaches {detail.depth:g} mm, with teeth of at least "
            f"{detail.diameter / 2 - hole.diameter / 2 + NECK_AIR:.2f} mm beside its neck; "
            f"{lacks(job, detail)}"
        )


def _turns(pen: Pen, detail: Thread, climb: bool) -> None:
    """A helix: counter-clockwise to climb, and then a right-hand one upwards, a left-hand one downwards."""
    radius = detail.diameter / 2 - pen.tool.radius
    turn = round_from_right(printed(detail.centre), radius, climb)
    lead_in, lead_out = half_circles(detail.centre, turn)
    turns = math.ceil(detail.depth / detail.pitch) + 1
    bottom = -detail.depth
    heights = [bottom + number * detail.pitch for number in range(turns + 1)]
    if climb == detail.left:
        heights.reverse()
    feed = pen.rates.inside(radius, pen.tool.radius)
    pen.above(detail.centre)
    pen.sink(heights[0])
    pen.follow(lead_in, feed)
    for z in heights[1:]:
        pen.descend(turn, z, feed)
    pen.follow(lead_out, feed)
    pen.retract()
