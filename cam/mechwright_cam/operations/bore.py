"""Bores: opened by a drill if there is one, milled along helices, and finished on circles."""

import math
from collections.abc import Sequence
from functools import partial

import shapely

from mechwright.contracts.details import Detail
from mechwright.contracts.part import Bore, Feature
from mechwright.errors import ToolError
from mechwright.tolerances import TOLERANCES
from mechwright_cam.operations.choice import ROOMY, MisfitError, usable_mills
from mechwright_cam.operations.contour_writer import finish_bore_compensated
from mechwright_cam.operations.contract import Hole, Operation, Task
from mechwright_cam.operations.drilling import ON_SIZE, is_clearance, starting_drill, usable_drills
from mechwright_cam.operations.entry import enters
from mechwright_cam.operations.finishing import (
    FINISH_STEP,
    allowance_in,
    bore_heights,
    cut_width,
    finish_engagement,
)
from mechwright_cam.operations.pen import Pen, levels
from mechwright_cam.operations.steps import Steps
from mechwright_cam.operations.stock import Stock
from mechwright_cam.program.moves import Feed, FeedArc, Rapid
from mechwright_cam.setup.depths import bores, bottom_of, floor_allowance, through
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.tool import Tool
from mechwright_plane.leads import half_circles
from mechwright_plane.path import CIRCLE_BIAS, Path, arc, printed, round_from_right, rounded

TIGHTEST = 0.9
"""A mill up to this share still turns a helix; beyond, it would be a drill."""

CORELESS = 0.8
"""First helix in cutter radii: below 1, so that no core stays."""

SINKS = 0.05
"""Air all round a mill that is sunk into a hole, mm: a drill may wander by as much."""

SIDE = 0.2
"""A cut deeper than ``step_down`` is at most so many diameters wide: the mill cuts with its side then, and
its middle runs in what is cut already."""

FINE_MILL = 2.0
"""A hole in which only mills below this diameter, mm, have room for chips is left to a drill of its size: a
helix of so thin a mill takes minutes, and it bends more than a drill wanders."""

ONE_MORE = 60.0
"""One more mill for bores is worth it if it saves this time, s, and that of changing to it: about what it
takes to fetch it, to clamp it, and to measure its length."""


class BoreOperation(Operation):
    """Mills round holes, or leaves them to a drill of their size."""

    name = "bore"

    def claim(self, feature: Feature | Detail, job: Job) -> Task | None:
        """Any bore; raises ToolError if there is no way to make it."""
        if not isinstance(feature, Bore):
            return None
        drill, mill = cutters_of(job, feature)
        hole = None if drill is None else Hole(drill, feature.centre)
        bottom = bottom_of(job, feature.top, feature.depth)
        region = shapely.Point(feature.centre).buffer(feature.diameter / 2, quad_segs=EXACT)
        return Task(feature, self, () if mill is None else (mill,), -feature.top, bottom, region, hole)

    def choose(self, feature: Feature | Detail, every: Job, chosen: Sequence[Tool]) -> Sequence[Tool] | None:
        """A mill, unless one is chosen already that takes little longer, or a drill makes the bore."""
        if not isinstance(feature, Bore):
            return None
        bottom = bottom_of(every, feature.top, feature.depth)
        if sizing_drill(every, feature) is not None:
            return []
        able = [m for m in usable_mills(every, -bottom) if enters(m, feature.diameter, every.settings)]
        largest = max((mill.diameter for mill in chosen), default=math.inf)
        mill = boring_mill([m for m in able if m.diameter <= largest] or able, feature.diameter)
        if mill is None or mill in chosen:
            return []
        more = worth_one_more(every, feature, able, chosen, mill, alike_in(every, feature))
        return [mill] if more else []

    def cut(self, task: Task, stock: Stock, steps: Steps) -> Stock:
        """Out to the finishing allowance, then to size."""
        assert isinstance(task.feature, Bore)  # noqa: S101 - nothing else is claimed
        bore, job, drill = task.feature, steps.job, task.hole.drill if task.hole else None
        for mill in task.tools:
            air = stock.air_below(task.top)
            steps.add(
                f"{bore.name}: bore", mill, partial(rough_bore, job, bore, drill, air, steps.step_down(mill))
            )
            plain = job.settings.compensation == "computer"
            finish = finish_bore if plain else finish_bore_compensated
            engagement = finish_engagement(job.settings, mill.radius, bore.diameter / 2)
            steps.add(f"{bore.name}: finish", mill, partial(finish, job, bore), engagement)
        return Stock(gone=stock.gone)


EXACT = 256
"""Chords of a quarter of a bore, where its edge is looked at."""


def worth_one_more(
    every: Job, bore: Bore, able: Sequence[Tool], chosen: Sequence[Tool], mill: Tool, alike: int
) -> bool:
    """Whether a mill for so many bores alike saves more than its change, beside those ``chosen`` already."""
    roomy = [m for m in able if m in chosen and m.diameter <= ROOMY * bore.diameter]
    other = boring_mill(roomy, bore.diameter)
    if other is None:
        return True
    drill = starting_drill(every, bore.diameter, -bottom_of(every, bore.top, bore.depth))
    first, second = (boring_time(every, bore, drill, m) for m in (other, mill))
    return alike * (first - second) > ONE_MORE + every.settings.machine.tool_change


def alike_in(job: Job, bore: Bore) -> int:
    """How many bores of a job have the size of this one, with itself."""
    return sum(_size(one) == _size(bore) for one in bores(job))


def _size(bore: Bore) -> tuple[float, float, float]:
    return bore.diameter, bore.top, bore.depth


def sizing_drill(job: Job, bore: Bore) -> Tool | None:
    """The drill of its size that makes a hole through the plate of which no fit is said.

    The hole is small, or one through which a screw passes.
    """
    if bore.fit is not None or not (bore.diameter < FINE_MILL / ROOMY or is_clearance(bore.diameter)):
        return None
    return _drill_of_size(job, bore)


def _drill_of_size(job: Job, bore: Bore) -> Tool | None:
    """The drill of a through hole's own size."""
    if not through(job, bore.top + bore.depth):
        return None
    drills = usable_drills(job, -bottom_of(job, bore.top, bore.depth))
    return next((drill for drill in drills if abs(drill.diameter - bore.diameter) <= ON_SIZE), None)


def cutters_of(job: Job, bore: Bore) -> tuple[Tool | None, Tool | None]:
    """The drill and the mill of a bore, one of them at least; raises ToolError if nothing makes it."""
    small = sizing_drill(job, bore)
    if small is not None:
        return small, None
    depth = -bottom_of(job, bore.top, bore.depth)
    out = through(job, bore.top + bore.depth)
    usable = usable_mills(job, depth)
    # D does not bring a wall to size that the end of the cutter makes.
    round_too = out and job.settings.compensation == "computer"
    able = usable if round_too else [tool for tool in usable if tool.nose == 0]
    mill = boring_mill([tool for tool in able if enters(tool, bore.diameter, job.settings)], bore.diameter)
    if mill is not None:
        drill = starting_drill(job, bore.diameter, depth) if out else None
        return drill, mill
    drill = _drill_of_size(job, bore)
    if drill is not None:
        return drill, None
    if boring_mill(able, bore.diameter) is not None:
        raise ToolError(
            f"cam.compensation: no listed end mill has room in {bore.name} of {bore.diameter:g} mm, part "
            f"{job.part.name}, for an entry longer than D may be; the smallest is {able[-1].name}: list a "
            'smaller one, or use "wear" or "computer"'
        )
    message = (
        f"cam.tools: nothing makes {bore.name} of {bore.diameter:g} mm in part {job.part.name}: no end mill "
        f"up to {TIGHTEST * bore.diameter:.2f} mm{_short(job, bore, depth)} and no drill of "
        f"{bore.diameter:g} mm; list one"
    )
    least = min((tool.diameter for tool in able), default=None)
    raise ToolError(message) if least is None else MisfitError(message, bore.diameter, least / TIGHTEST)


def _short(job: Job, bore: Bore, depth: float) -> str:
    """In words, the mill that would enter a bore if its flutes were long enough; empty without one."""
    knows = [tool for tool in job.mills if job.part.material in tool.cutting]
    entering = [tool for tool in knows if tool.diameter <= TIGHTEST * bore.diameter]
    if not entering:
        return ""
    longest = max(entering, key=lambda tool: tool.flute_length)
    return f" with flutes of {depth:g} mm ({longest.name} has {longest.flute_length:g})"


def boring_mill(mills: list[Tool], diameter: float) -> Tool | None:
    """The mill for a hole: the largest with room for chips, else the smallest that fits at all.

    Flat end mills come before round ones, which leave a fillet on the floor of a blind hole and are for holes
    through the plate.
    """
    flat = [mill for mill in mills if mill.nose == 0 and mill.diameter <= TIGHTEST * diameter]
    mills = flat or mills
    roomy = [mill for mill in mills if mill.diameter <= ROOMY * diameter]
    snug = [mill for mill in mills if mill.diameter <= TIGHTEST * diameter]
    return roomy[0] if roomy else (snug[-1] if snug else None)


def _bottom(job: Job, bore: Bore, mill: Tool) -> float:
    """Depth of a bore's cuts, z in mm: out of the plate with all of a rounded corner."""
    bottom = bottom_of(job, bore.top, bore.depth)
    return bottom - mill.nose if bottom == job.floor else bottom


def boring_time(job: Job, bore: Bore, drill: Tool | None, mill: Tool) -> float:
    """Time in which a mill roughs and finishes a bore, s; rapids and corners do not count."""
    steps = Steps(job, job.settings.clearance, {mill.name: -_bottom(job, bore, mill)})

    def write(pen: Pen) -> None:
        rough_bore(job, bore, drill, shapely.Polygon(), steps.step_down(mill), pen)
        finish_bore(job, bore, pen)

    minutes, x, y = 0.0, *bore.centre
    for move in steps.moves(mill, write):
        if isinstance(move, FeedArc):
            begin, end = math.atan2(-move.j, -move.i), math.atan2(move.y - y - move.j, move.x - x - move.i)
            turn = ((end - begin) * (1 if move.ccw else -1)) % math.tau or math.tau
            minutes += turn * math.hypot(move.i, move.j) / move.feed
        if isinstance(move, FeedArc | Feed | Rapid):
            x, y = x if move.x is None else move.x, y if move.y is None else move.y
    return 60 * minutes


def _open_radius(air: shapely.Geometry, middle: shapely.Point) -> float:
    """Radius of what earlier setups have cut through at the middle of a bore, mm; 0 if they have not."""
    return float(air.boundary.distance(middle)) if shapely.contains(air, middle) else 0.0


def rough_bore(
    job: Job,
    bore: Bore,
    drill: Tool | None,
    air: shapely.Geometry,
    step_down: float,
    pen: Pen,
    *,
    to_size: bool = False,
) -> None:
    """Write rings out to the finishing allowance, from what a drill or earlier setups have opened.

    ``to_size`` leaves none: a reamer comes after it.

    A hole too narrow for the mill is opened along a helix, no turn of which is deeper than ``step_down``, mm.
    Rings are so deep that depth times width is no more than that of a full slot of this depth.
    """
    mill = pen.tool
    data = mill.cutting[job.part.material]
    # Too narrow for an allowance: the finishing circle is the only one.
    allowance = 0.0 if to_size else allowance_in(job, bore.diameter, mill)
    widest = bore.diameter / 2 - mill.radius - (allowance or CIRCLE_BIAS)
    if drill is not None and widest + mill.radius <= drill.radius + CIRCLE_BIAS:
        return  # the drill has left just the finishing allowance
    step = min(data.step_over, CORELESS) * mill.diameter
    bottom = _bottom(job, bore, mill)
    leave = floor_allowance(job, -bore.top, bottom)
    hole = max(0.0 if drill is None else drill.radius, _open_radius(air, shapely.Point(bore.centre)))
    free, radii = hole - mill.radius, []
    if free < SINKS:  # too narrow to be sunk in: down along a helix, and on from there
        free = min(widest, CORELESS * mill.radius)
        if drill is not None:
            free = max(free, min(widest, drill.radius + step - mill.radius))
        turn = round_from_right(bore.centre, free, job.settings.climb)
        feed = pen.rates.inside(free, mill.radius)
        pen.helix(turn, free, -bore.top, bottom + leave, step_down, feed)
        pen.straight(bore.centre)
        radii = [free]
    deepest = (job.settings.finish_step or FINISH_STEP) * mill.diameter
    for radius in widening(free, widest, min(step, SIDE * mill.diameter)):
        wide = cut_width(radius, mill.radius, free + mill.radius)
        deep = max(step_down, min(deepest, step_down * mill.diameter / wide))
        _ring(job, bore, pen, (free, radius), levels(-bore.top, bottom + leave, deep))
        radii.append(free := radius)
    if leave > 0:
        _floor(job, bore, pen, radii, bottom)
    pen.retract()


def widening(free: float, widest: float, step: float) -> list[float]:
    """Radii, mm, of the rings from where the centre may be sunk out to the ``widest``, in even steps.

    None is wider than twice the one before: so a mill that all but fills its hole gets out without a slot.

    >>> widening(1.0, 2.5, 2.0)
    [1.75, 2.5]
    >>> widening(0.1, 1.2, 0.5)
    [0.2, 0.4, 0.8, 1.2]
    """
    radii: list[float] = []
    while widest - free > TOLERANCES.noise:
        count = math.ceil((widest - free) / min(free, step) - TOLERANCES.noise)
        free = rounded(free + (widest - free) / count) if count > 1 else widest
        radii.append(free)
    return radii


def _ring(job: Job, bore: Bore, pen: Pen, radii: tuple[float, float], heights: list[float]) -> None:
    """Once round at every height, in a hole that is open to the first of two radii of the centre.

    The cutter is sunk there in the clear, and goes out to the second on a half circle.
    """
    (x, y), (free, radius) = bore.centre, radii
    turn = round_from_right(bore.centre, radius, job.settings.climb)
    start = printed((x - free + SINKS / 2, y))
    middle = ((start[0] + turn.start[0]) / 2, (start[1] + turn.start[1]) / 2)
    path = Path(start, (arc(start, turn.start, middle, turn.cuts[0].turn),)) + turn
    feed = pen.rates.inside(radius, pen.tool.radius)
    pen.go(start, pen.z < -bore.top)
    for z in heights:
        pen.straight(start)
        pen.sink(z)
        pen.follow(path, feed)


def _floor(job: Job, bore: Bore, pen: Pen, radii: list[float], bottom: float) -> None:
    """The floor of a blind bore in one pass: sunk along the innermost ring, then ring by ring outwards."""
    for radius in radii:
        turn = round_from_right(bore.centre, radius, job.settings.climb)
        pen.straight(turn.start)
        pen.ramp(turn, bottom)
        pen.follow(turn, pen.rates.inside(radius, pen.tool.radius))
    pen.straight(bore.centre)


def finish_bore(job: Job, bore: Bore, pen: Pen) -> None:
    """Write the finishing circles, entered and left on half circles from the middle."""
    mill = pen.tool
    radius = bore.diameter / 2 - mill.radius - CIRCLE_BIAS
    turn = round_from_right(bore.centre, radius, job.settings.climb)
    into, off = half_circles(bore.centre, turn)
    path, feed, bottom = into + turn + off, pen.rates.inside(radius, mill.radius), _bottom(job, bore, mill)
    pen.above(path.start)
    for z in bore_heights(job, mill, bore, bottom):
        pen.sink(z)
        pen.follow(path, feed)
    pen.retract()
