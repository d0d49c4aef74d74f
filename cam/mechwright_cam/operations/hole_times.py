"""How long the holes of a part take: drilled and widened, or opened by a mill on a helix."""

import math

import shapely

from mechwright.contracts.part import Bore, Profile
from mechwright_cam.operations.bore import boring_time, cutters_of
from mechwright_cam.operations.choice import ROOMY, entry_place
from mechwright_cam.operations.drilling import point_length, starting_drill
from mechwright_cam.operations.ladder import COME
from mechwright_cam.operations.rates import rates
from mechwright_cam.operations.ream import reaming
from mechwright_cam.operations.steps import slope
from mechwright_cam.operations.tap import core_drill
from mechwright_cam.setup.depths import through
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.tool import Tool

SPOTTED = 2.0
"""Time to spot a hole and to come to it, s."""


def holes_time(job: Job) -> float:
    """Time of all holes through the plate with the tools of the job, s, without changes of tool.

    Raises ToolError where the tools do not make one of them.
    """
    seconds = 0.0
    known: dict[tuple[object, ...], float] = {}
    for feature in job.features:
        if not through(job, feature.top + feature.depth):
            continue
        if isinstance(feature, Bore) and core_drill(job, feature) is None:
            alike = feature.diameter, feature.top, feature.depth, feature.fit
            if alike not in known:
                known[alike] = _bore_time(job, feature)
            seconds += known[alike]
        elif isinstance(feature, Profile) and feature.side == "inside":
            seconds += _opening_time(job, feature)
    return seconds


def _bore_time(job: Job, bore: Bore) -> float:
    """Time of a hole, s: spotted and drilled, if it is, and milled."""
    way = reaming(job, bore)
    drill, mill = (way.drill, way.mill) if way is not None else cutters_of(job, bore)
    return drilling_time(job, drill) + (0.0 if mill is None else boring_time(job, bore, drill, mill))


def drilling_time(job: Job, drill: Tool | None) -> float:
    """Time to spot and to drill a hole through the plate, s; none without a drill."""
    if drill is None:
        return 0.0
    feed = rates(drill, job.part.material, job.settings.machine).feed
    return SPOTTED + COME + 60 * (point_length(drill) - job.floor) / feed


def _opening_time(job: Job, feature: Profile) -> float:
    """Time until a mill is at the bottom of an opening, s: on ramps, or through a drilled hole."""
    _, radius = entry_place(shapely.Polygon(feature.loop.flatten()))
    drill = starting_drill(job, 2 * radius, -job.floor)
    if drill is not None:
        return drilling_time(job, drill)
    mills = [
        mill for mill in job.mills if mill.radius <= ROOMY * radius and job.part.material in mill.cutting
    ]
    mill = next(iter(mills), job.mills[-1])
    down, ramp = slope(mill, job.settings), rates(mill, job.part.material, job.settings.machine).ramp
    return 60 * math.hypot(job.floor, job.floor / down) / ramp
