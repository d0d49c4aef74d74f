"""Holes that drills make: spotted, then drilled, for mills to start in or to size."""

import math

from mechwright.contracts.materials import JAMS, material
from mechwright.geometry.segments import Point
from mechwright.standards.screws import screw_sizes
from mechwright_cam.operations.pen import APPROACH
from mechwright_cam.operations.rates import rates
from mechwright_cam.program.moves import Drill, Move, Rapid
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.tool import Tool, ToolKind
from mechwright_plane.path import printed, rounded

SPOT = 0.6
"""Diameter of the spot in diameters of the drill: wider than its web, and gone with the hole."""

ON_SIZE = 0.005
"""A drill this near to a hole's diameter makes the hole to size, mm."""


CLEARANCES = frozenset(size.clearance(series) for size in screw_sizes() for series in ("fine", "medium"))
"""Diameters of clearance holes, mm (ISO 273): a screw finds its place in them though a drill has wandered by
0.1 mm. No other hole above the finest mills is left to a drill: what turns or sits in it needs its place."""


def is_clearance(diameter: float) -> bool:
    """Whether a hole is one through which a screw passes.

    >>> is_clearance(5.5), is_clearance(6.0)
    (True, False)
    """
    return any(abs(diameter - one) <= ON_SIZE for one in CLEARANCES)


def point_length(drill: Tool) -> float:
    """Length of a drill's point, mm."""
    return drill.radius / math.tan(math.radians(drill.point_angle) / 2)


def usable_drills(job: Job, depth: float) -> list[Tool]:
    """Drills of the job that can make a hole of full diameter to ``depth``, largest first."""
    return [d for d in job.tools_of(ToolKind.DRILL) if d.flute_length >= depth + point_length(d)]


def spot_drill(job: Job) -> Tool | None:
    """The spot drill of the job, None if it has none for this material."""
    return min(job.tools_of(ToolKind.SPOT_DRILL), key=lambda tool: tool.diameter, default=None)


def starting_drill(job: Job, diameter: float, depth: float) -> Tool | None:
    """The largest drill whose hole lies inside the roughing allowance of a hole."""
    limit = diameter - 2 * max(job.settings.stock_to_leave, ON_SIZE)
    return next((drill for drill in usable_drills(job, depth) if drill.diameter <= limit), None)


def drill_moves(
    job: Job, drill: Tool, places: list[Point], depth: float, clearance: float
) -> tuple[Move, ...]:
    """Drill holes of full diameter to ``depth`` mm below the stock's top."""
    name, ratio = job.part.material, depth / drill.diameter
    deep = ratio > material(name).unbroken
    peck = rounded(drill.cutting[name].step_down * drill.diameter) if deep else None
    bottom = rounded(-depth - point_length(drill))
    feed = rates(drill, name, job.settings.machine).feed
    holes = [(place, bottom) for place in places]
    return _holes(holes, feed, clearance, peck, breaking=deep and ratio <= JAMS)


def spot_moves(job: Job, spot: Tool, places: list[tuple[Point, float]], clearance: float) -> tuple[Move, ...]:
    """Spot holes for drills of the diameters given with the places."""
    speed = rates(spot, job.part.material, job.settings.machine)
    holes = []
    for place, diameter in places:
        wide = min(SPOT * diameter, spot.diameter)
        depth = wide / 2 / math.tan(math.radians(spot.point_angle) / 2)
        holes.append((place, rounded(-depth)))
    return _holes(holes, speed.feed, clearance, None, dwell=0.2)


def _holes(
    holes: list[tuple[Point, float]],
    feed: float,
    clearance: float,
    peck: float | None,
    dwell: float = 0.0,
    *,
    breaking: bool = False,
) -> tuple[Move, ...]:
    """Holes, each with its bottom, one right after the other, so that holes alike share one cycle."""
    moves: list[Move] = []
    for place, bottom in holes:
        x, y = printed(place)
        if not moves:
            moves.append(Rapid(x=x, y=y))
        moves.append(Drill(x, y, bottom, min(APPROACH, clearance), feed, peck, dwell, breaking))
    return (*moves, Rapid(z=clearance))
