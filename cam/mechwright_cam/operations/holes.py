"""Holes: spot drill, drill, and helical bore to size."""

import math
from dataclasses import dataclass

import shapely

from mechwright.contracts.materials import JAMS, material
from mechwright.contracts.part import Bore
from mechwright.errors import ToolError
from mechwright.geometry.segments import Point
from mechwright.tolerances import TOLERANCES
from mechwright_cam.operations.choice import ROOMY, usable_mills
from mechwright_cam.operations.entry import enters
from mechwright_cam.operations.finishing import finish_depth
from mechwright_cam.operations.floors import floor_allowance
from mechwright_cam.operations.pen import APPROACH, Pen, levels
from mechwright_cam.operations.rates import rates
from mechwright_cam.plane.path import CIRCLE_BIAS, Path, arc, circle, rounded
from mechwright_cam.program.moves import Drill, Feed, FeedArc, Move, Rapid
from mechwright_cam.setup.depths import bottom_of, through
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.tool import Tool, ToolKind

SPOT = 0.6
"""Diameter of the spot in diameters of the drill: wider than its web, and gone with the hole."""

SNUG = 0.9
"""A mill up to this share still turns a helix; beyond, it would be a drill."""

CORELESS = 0.8
"""First helix in cutter radii: below 1, so that no core stays."""

ON_SIZE = 0.005
"""A drill this near to a hole's diameter makes the hole to size, mm."""


def point_length(drill: Tool) -> float:
    """Length of a drill's point, mm."""
    return drill.radius / math.tan(math.radians(drill.point_angle) / 2)


def usable_drills(job: Job, depth: float) -> list[Tool]:
    """Drills of the job that can make a hole of full diameter to ``depth``, largest first."""
    fit = [
        tool
        for tool in job.tools
        if tool.kind is ToolKind.DRILL
        and job.part.material in tool.cutting
        and tool.flute_length >= depth + point_length(tool)
    ]
    return sorted(fit, key=lambda tool: -tool.diameter)


def spot_drill(job: Job) -> Tool | None:
    """The spot drill of the job, None if it has none for this material."""
    fit = [t for t in job.tools if t.kind is ToolKind.SPOT_DRILL and job.part.material in t.cutting]
    return min(fit, key=lambda tool: tool.diameter, default=None)


def starting_drill(job: Job, diameter: float, depth: float) -> Tool | None:
    """The largest drill whose hole lies inside the roughing allowance of a hole."""
    limit = diameter - 2 * max(job.settings.stock_to_leave, ON_SIZE)
    return next((drill for drill in usable_drills(job, depth) if drill.diameter <= limit), None)


def boring_mill(mills: list[Tool], diameter: float) -> Tool | None:
    """The mill for a hole: the largest with room for chips, else the smallest that fits at all.

    Flat end mills come before round ones, which leave a fillet on the floor of a blind hole and are for holes
    through the plate.
    """
    flat = [mill for mill in mills if mill.nose == 0 and mill.diameter <= SNUG * diameter]
    mills = flat or mills
    roomy = [mill for mill in mills if mill.diameter <= ROOMY * diameter]
    snug = [mill for mill in mills if mill.diameter <= SNUG * diameter]
    return roomy[0] if roomy else (snug[-1] if snug else None)


def _bottom(job: Job, bore: Bore, mill: Tool) -> float:
    """Depth of a bore's cuts, z in mm: out of the plate with all of a rounded corner."""
    bottom = bottom_of(job, bore.top, bore.depth)
    return bottom - mill.nose if bottom == job.floor else bottom


@dataclass(frozen=True)
class BorePlan:
    """The cutters of one bore."""

    bore: Bore
    drill: Tool | None
    mill: Tool | None


def plan_bore(job: Job, bore: Bore) -> BorePlan:
    """Choose the cutters of a bore; raises ToolError if there is no way to make it."""
    depth = -bottom_of(job, bore.top, bore.depth)
    out = through(job, bore.top + bore.depth)
    usable = usable_mills(job, depth)
    # D does not bring a wall to size that the end of the cutter makes.
    round_too = out and job.settings.compensation == "computer"
    able = usable if round_too else [tool for tool in usable if tool.nose == 0]
    mill = boring_mill([tool for tool in able if enters(tool, bore.diameter, job.settings)], bore.diameter)
    if mill is not None:
        drill = starting_drill(job, bore.diameter, depth) if out else None
        return BorePlan(bore, drill, mill)
    for drill in usable_drills(job, depth):
        if abs(drill.diameter - bore.diameter) <= ON_SIZE and through(job, bore.top + bore.depth):
            return BorePlan(bore, drill, None)
    if boring_mill(able, bore.diameter) is not None:
        raise ToolError(
            f"cam.compensation: no listed end mill has room in {bore.name} of {bore.diameter:g} mm, part "
            f"{job.part.name}, for an entry longer than D may be; the smallest is {able[-1].name}: list a "
            'smaller one, or use "wear" or "computer"'
        )
    raise ToolError(
        f"cam.tools: nothing makes {bore.name} of {bore.diameter:g} mm in part {job.part.name}: no end mill "
        f"up to {SNUG * bore.diameter:.2f} mm and no drill of {bore.diameter:g} mm; list one"
    )


def drill_moves(
    job: Job, drill: Tool, places: list[Point], depth: float, clearance: float
) -> tuple[Move, ...]:
    """Drill holes of full diameter to ``depth`` mm below the stock's top."""
    speed = rates(drill, job.part.material, job.settings.machine)
    ratio = depth / drill.diameter
    deep = ratio > material(job.part.material).unbroken
    peck = drill.cutting[job.part.material].step_down * drill.diameter if deep else None
    bottom = rounded(-depth - point_length(drill))
    peck = None if peck is None else rounded(peck)
    holes = [(place, bottom) for place in places]
    return _holes(holes, speed.feed, clearance, peck, breaking=deep and ratio <= JAMS)


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
        x, y = rounded(place[0]), rounded(place[1])
        if not moves:
            moves.append(Rapid(x=x, y=y))
        moves.append(Drill(x, y, bottom, min(APPROACH, clearance), feed, peck, dwell, breaking))
    return (*moves, Rapid(z=clearance))


def boring_time(job: Job, plan: BorePlan) -> float:
    """Time in which the mill of a bore roughs and finishes it, s; rapids and corners do not count."""
    assert plan.mill is not None  # noqa: S101 - the caller has one
    settings = job.settings
    speed = rates(plan.mill, job.part.material, settings.machine)
    pen = Pen(plan.mill, speed, settings.clearance, math.tan(math.radians(settings.ramp_angle)))
    rough_bore(job, plan, pen)
    finish_bore(job, plan, pen)
    minutes, x, y = 0.0, *plan.bore.centre
    for move in pen.moves:
        if isinstance(move, FeedArc):
            begin, end = math.atan2(-move.j, -move.i), math.atan2(move.y - y - move.j, move.x - x - move.i)
            turn = ((end - begin) * (1 if move.ccw else -1)) % math.tau or math.tau
            minutes += turn * math.hypot(move.i, move.j) / move.feed
        if isinstance(move, FeedArc | Feed | Rapid):
            x, y = x if move.x is None else move.x, y if move.y is None else move.y
    return 60 * minutes


def open_radius(job: Job, bore: Bore) -> float:
    """Radius of what earlier setups have cut through at the middle of a bore, mm; 0 if they have not."""
    air, middle = job.air_below(-bore.top), shapely.Point(bore.centre)
    return float(air.boundary.distance(middle)) if shapely.contains(air, middle) else 0.0


def rough_bore(job: Job, plan: BorePlan, pen: Pen) -> bool:
    """Write helices out to the finishing allowance; whether there was anything to write."""
    bore, mill = plan.bore, plan.mill
    assert mill is not None  # noqa: S101 - the caller has one
    data = mill.cutting[job.part.material]
    widest = bore.diameter / 2 - mill.radius - max(job.settings.stock_to_leave, CIRCLE_BIAS)
    final = bore.diameter / 2 - mill.radius - CIRCLE_BIAS
    if plan.drill is not None and widest + mill.radius <= plan.drill.radius + CIRCLE_BIAS:
        return False  # the drill has left just the finishing allowance
    # Too narrow for an allowance: the finishing circle is the only one.
    widest = widest if widest >= final / 2 else final
    step = min(data.step_over, CORELESS) * mill.diameter
    first = min(widest, CORELESS * mill.radius)
    if plan.drill is not None:
        first = max(first, min(widest, plan.drill.radius + step - mill.radius))
    edge = open_radius(job, bore) - mill.radius
    if edge > 0:  # outwards from there in even rings
        edge = min(edge, widest)
        first = edge + (widest - edge) / max(math.ceil((widest - edge) / step - TOLERANCES.noise), 1)
    count = math.ceil((widest - first) / step - TOLERANCES.noise) + 1
    radii = [*(first + number * (widest - first) / (count - 1) for number in range(count - 1)), widest]
    bottom = _bottom(job, bore, mill)
    leave = floor_allowance(job, -bore.top, bottom)
    for radius in radii:
        _helix(job, bore, pen, radius, data.step_down * mill.diameter, bottom + leave)
    if leave > 0:
        _floor(job, bore, pen, radii, bottom)
    pen.retract()
    return True


def _floor(job: Job, bore: Bore, pen: Pen, radii: list[float], bottom: float) -> None:
    """The floor of a blind bore in one pass: sunk along the innermost ring, then ring by ring outwards."""
    for radius in radii:
        turn = circle(bore.centre, radius, (bore.centre[0] + radius, bore.centre[1]), job.settings.climb)
        pen.straight(turn.start)
        pen.ramp(turn, bottom)
        pen.follow(turn, pen.rates.inside(radius, pen.tool.radius))
    pen.straight(bore.centre)


def _helix(job: Job, bore: Bore, pen: Pen, radius: float, step_down: float, bottom: float) -> None:
    """Down along a helix, once round at the bottom, and to the middle."""
    turn = circle(bore.centre, radius, (bore.centre[0] + radius, bore.centre[1]), job.settings.climb)
    # A little less than the steepest, for rounding.
    pitch = min(step_down, math.tau * radius * pen.slope * 0.999)
    pen.above(turn.start)
    pen.sink(-bore.top)
    for z in levels(-bore.top, bottom, pitch):
        pen.descend(turn, z, min(pen.rates.ramp, pen.rates.inside(radius, pen.tool.radius)))
    pen.follow(turn, pen.rates.inside(radius, pen.tool.radius))
    pen.straight(bore.centre)


def finish_bore(job: Job, plan: BorePlan, pen: Pen) -> None:
    """Write the finishing circles, entered and left on half circles from the middle."""
    bore, mill = plan.bore, plan.mill
    assert mill is not None  # noqa: S101 - the caller has one
    radius = bore.diameter / 2 - mill.radius - CIRCLE_BIAS
    bottom = _bottom(job, bore, mill)
    ccw = job.settings.climb
    x, y = rounded(bore.centre[0]), rounded(bore.centre[1])
    turn = circle(bore.centre, radius, (bore.centre[0] + radius, bore.centre[1]), ccw)
    middle, side = ((x + turn.start[0]) / 2, (y + turn.start[1]) / 2), 1 if ccw else -1
    path = Path(
        (x, y),
        (
            arc((x, y), turn.start, middle, side),
            *turn.cuts,
            arc(turn.start, (x, y), middle, side),
        ),
    )
    heights = levels(-bore.top, bottom, finish_depth(job.settings, mill, job.part.material))
    feed = pen.rates.inside(radius, mill.radius)
    pen.above((x, y))
    for z in heights + [bottom] * job.settings.spring_passes:
        pen.sink(z)
        pen.follow(path, feed)
    pen.retract()
