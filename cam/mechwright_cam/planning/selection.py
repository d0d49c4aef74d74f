"""Which cutters a part needs, and whether those at hand can make it."""

import math
from collections.abc import Callable, Sequence
from functools import partial

import shapely

from mechwright.errors import DesignError, GeometryError, MechwrightError, ToolError
from mechwright.findings import Finding, Severity
from mechwright.materials import HSS_SPEED
from mechwright.materials import material as material_of
from mechwright.part import Bore, OpenProfile, Part, Pocket, Profile
from mechwright.tolerances import TOLERANCES
from mechwright.tooling import CamSettings, Stock, Tool, ToolKind
from mechwright_cam.job import Job, make_job
from mechwright_cam.library import Library
from mechwright_cam.nest import Nest, outlines_of
from mechwright_cam.planning.bending import MOST, deflection
from mechwright_cam.planning.choice import (
    ROOMY,
    SAME_REACH,
    entry_place,
    finishing_choice,
    outside_mills,
    path_radius,
    roomy_mills,
    usable_mills,
)
from mechwright_cam.planning.details import plan_detail
from mechwright_cam.planning.holes import boring_mill, plan_bore, starting_drill
from mechwright_cam.planning.rates import rates
from mechwright_cam.planning.recess import recess
from mechwright_cam.planning.slot import slot_mill, slots
from mechwright_cam.planning.zone import (
    Zone,
    bores,
    bottom_of,
    check_clamp,
    inner_zones,
    outer_zones,
    roughing_mills,
    through,
)
from mechwright_cam.plate import plate_box
from mechwright_cam.reach import closed_area, closing, leaves_at_most, remainder
from mechwright_cam.toolpath.offsets import ROUGH, grow, thinned

ROUGHING_SHARE = 0.15
"""Largest roughing mill in shares of the part's narrow side: a larger one turns too much stock into chips."""
HANDY = 6.0
"""Up to this diameter, mm, a roughing mill is sensible for a part of any size: it wastes little."""
PAYS = 1.5
"""An intermediate roughing mill is at least this many times as wide as the finishing one."""
AMPLE = 1000.0
"""Where the design leaves the stock open, cutters are chosen as if so much were around the part, mm."""
MILLS = frozenset({ToolKind.END_MILL, ToolKind.BULL_NOSE, ToolKind.BALL})
"""Cutters whose chip load goes with their diameter."""
HALF = 0.5
"""It takes at least this share of what the finishing mill would have to rough."""
BRISK = 0.25
"""A mill below this share of a bore's diameter bores too slowly to save another tool."""
OPENS = 0.6
"""A drill of this share of a hole's width opens it well enough to save a larger one: the helix of the mill
then takes rings as wide as after the drill of the right size, only one or two more."""
SLENDER = 5.0
"""Beyond this many diameters of depth a mill bends noticeably: makers list such cutters as long-reach."""


def choose_tools(part: Part, settings: CamSettings, library: Library) -> tuple[Tool, ...]:
    """Give the tools named in the settings, or, if none is named, those that the part needs.

    The choice: the largest roughing mill that is sensible for the size of the part and leaves a frame in the
    stock; for every wall the largest mill that leaves no more than the tolerance in its corners, or else the
    one that leaves least; a mill for the bores; the largest drills that fit, and a spot drill for them. Only
    mills long enough for the cut and with cutting data for the material count.

    Raises
    ------
    ToolError
        A name is not in the library (close matches are listed), or no cutter can make the part.
    """
    if settings.tools:
        doubles = {name for name in settings.tools if settings.tools.count(name) > 1}
        if doubles:
            raise DesignError(f"cam.tools: {min(doubles)!r} is listed twice; list it once")
        return tuple(library.get(name) for name in settings.tools)
    if part.outline is None:
        raise GeometryError(f"part {part.name} is no plate: it has no outline to mill")
    every = Job(part, settings, library.tools, (0.0, 0.0), plate_box(part, settings, AMPLE))
    mills = _mills(every)
    chosen = {mill.name: mill for mill in mills}
    drills = _drills(every)
    details = {tool.name: tool for tool in (plan_detail(every, d).tool for d in every.details)}
    return (*drills, *sorted(chosen.values(), key=lambda tool: -tool.diameter), *details.values())


def _mills(every: Job) -> list[Tool]:
    """The end mills of the choice; ``every`` has the whole library."""
    part = every.part
    fit = usable_mills(every, -every.floor)
    boxes = [outline.bounds for outline in outlines_of(part)]
    widest = max(HANDY, ROUGHING_SHARE * min(min(x1 - x0, y1 - y0) for x0, y0, x1, y1 in boxes))
    sensible = [mill for mill in fit if mill.diameter <= widest] or fit[-1:]
    chosen: list[Tool] = []
    openings = []
    for feature in every.features:
        if isinstance(feature, Pocket) or (isinstance(feature, Profile) and feature.side == "inside"):
            openings.append(feature)
        elif isinstance(feature, Profile):
            shape = shapely.Polygon(feature.loop.flatten())
            roughing = outside_mills(_roughing(every, sensible, shape), shape, every.settings.stock_to_leave)
            finest = _finest_needed(roughing, shape, every.settings.corner_mill)
            chosen += [roughing[0], *_between(every, roughing, finest, shape), finest]
    for feature in openings:
        chosen += _inside(every, feature)
    # From the smallest on: what bores a small hole may bore the larger ones as well.
    for bore in sorted(bores(every), key=lambda bore: bore.diameter):
        chosen += _boring(every, bore, chosen)
    return chosen or fit[:1]


def _inside(every: Job, feature: Profile | Pocket) -> list[Tool]:
    """The mill for an opening or a recess; none if the feature takes nothing, which planning will say."""
    if isinstance(feature, OpenProfile):
        mill = slot_mill(every, feature)
        if mill is not None:
            return [mill]
    bottom = bottom_of(every, feature.top, feature.depth)
    able = usable_mills(every, -bottom)
    shapes = recess(every, feature, able[0].diameter, bottom)
    if shapely.is_empty(shapes.must):
        return []
    able = roomy_mills(able, shapes.must)
    return [
        _finest_needed(able, shapes.keep, every.settings.corner_mill, shapes.must if shapes.open else None)
    ]


def _roughing(every: Job, mills: list[Tool], part: shapely.Polygon) -> list[Tool]:
    """The mills for an outside: with tabs only those whose channel leaves a frame."""
    open_ = every.settings.stock == Stock() and not isinstance(every.part, Nest)
    if every.settings.hold.method != "tabs" or open_:
        return mills
    return roughing_mills(every, mills, part, framed=True)


def _between(every: Job, mills: list[Tool], finest: Tool, part: shapely.Polygon) -> list[Tool]:
    """A mill that takes much of what the largest leaves to the finest, if there is one."""

    def left(mill: Tool) -> float:
        reach = mill.radius + every.settings.stock_to_leave
        return closed_area(grow(thin, reach, ROUGH), reach) - float(part.area)

    thin = thinned(part)
    middle = [mill for mill in mills[1:] if mill.diameter >= PAYS * finest.diameter]
    if not middle:
        return []
    most, least = left(mills[0]), left(finest)
    for mill in middle:
        if most - left(mill) >= HALF * (most - least) > 0:
            return [mill]
    return []


def _finest_needed(
    mills: Sequence[Tool], keep: shapely.Geometry, least: float, near: shapely.Geometry | None = None
) -> Tool:
    """The largest mill that leaves next to nothing on a wall, else the largest as good as the finest.

    No mill below ``least``, mm, is taken for the sake of sharp corners.
    """
    low, high = 0, len(mills)
    while low < high:
        middle = (low + high) // 2
        if leaves_at_most(keep, path_radius(mills[middle]), SAME_REACH, near):
            high = middle
        else:
            low = middle + 1
    if low < len(mills):
        return mills[low]
    return finishing_choice(_worthwhile(mills, keep, least, near), keep, near)


FITS = 0.9
"""A mill is worth choosing where what larger ones leave holds a disc of this share of it."""


def _worthwhile(
    mills: Sequence[Tool], keep: shapely.Geometry, least: float, near: shapely.Geometry | None
) -> Sequence[Tool]:
    """The mills down to ``least``, mm, and finer ones only as far as they fit into what is left."""
    coarse = [mill for mill in mills if mill.diameter >= least] or list(mills[:1])
    for finer in mills[len(coarse) :]:
        left = shapely.difference(closing(keep, coarse[-1].radius), keep)
        if near is not None:
            left = shapely.intersection(left, near)
        if not shapely.is_empty(grow(left, -FITS * finer.radius, ROUGH)):
            coarse.append(finer)
    return coarse


def _boring(every: Job, bore: Bore, chosen: list[Tool]) -> list[Tool]:
    """A mill for a bore, unless one is chosen already or a drill makes the bore."""
    depth = -bottom_of(every, bore.top, bore.depth)
    able = usable_mills(every, depth)
    brisk = [mill for mill in chosen if BRISK * bore.diameter <= mill.diameter <= ROOMY * bore.diameter]
    if any(mill in able for mill in brisk):
        return []
    largest = max((mill.diameter for mill in chosen), default=able[0].diameter)
    mill = boring_mill([mill for mill in able if mill.diameter <= largest] or able, bore.diameter)
    return [] if mill is None else [mill]


def _drills(every: Job) -> list[Tool]:
    """Spot drill and drills for all holes through the plate, as few as open every hole well."""
    wanted: list[tuple[float, Tool]] = []
    for feature in every.features:
        if not through(every, feature.top + feature.depth):
            continue
        if isinstance(feature, Bore):
            hole = plan_bore(every, feature)
            width, drill = feature.diameter, hole.drill
            if drill is not None and hole.mill is None:
                width = drill.diameter  # no other makes the hole to size
        elif isinstance(feature, Profile) and feature.side == "inside":
            _, radius = entry_place(shapely.Polygon(feature.loop.flatten()))
            width, drill = 2 * radius, starting_drill(every, 2 * radius, -every.floor)
        else:
            continue
        if drill is not None:
            wanted.append((width, drill))
    drills: dict[str, Tool] = {}
    for width, drill in sorted(wanted, key=lambda hole: hole[1].diameter):
        if not any(OPENS * width <= other.diameter for other in drills.values()):
            drills[drill.name] = drill
    spots = [
        tool
        for tool in every.tools
        if tool.kind is ToolKind.SPOT_DRILL and every.part.material in tool.cutting
    ]
    first = [max(spots, key=lambda tool: tool.diameter)] if spots and drills else []
    return first + sorted(drills.values(), key=lambda tool: -tool.diameter)


def check_tools(part: Part, settings: CamSettings, library: Library) -> list[Finding]:
    """Find what stands in the way of cutting a part, and what is worth knowing about its cutters.

    Errors: a tool that is not in the library, a wall, bore or opening that no listed cutter makes, a clamp or
    stock in the way. Warnings: a cutter that cannot run at its cutting speed on this machine, a listed tool
    without data for the material. Notes: slender cutters, and stock that stays in corners.
    """
    return lay_out(part, settings, library)[1]


def lay_out(part: Part, settings: CamSettings, library: Library) -> tuple[Job | None, list[Finding]]:
    """Choose the cutters of a part and lay it into its stock, with all that :func:`check_tools` finds.

    The job is None if the cutters cannot be chosen or the part does not fit its stock.
    """
    try:
        tools = choose_tools(part, settings, library)
        job = make_job(part, settings, tools)
    except MechwrightError as error:
        return None, [_refusal(error)]
    found: list[Finding] = []
    zones: list[Zone] = []
    for bore in bores(job):
        _try(found, partial(plan_bore, job, bore))
    _try(found, lambda: zones.extend(inner_zones(job, skip=slots(job))))
    _try(found, lambda: zones.extend(outer_zones(job)))
    _try(found, partial(check_clamp, job))
    for detail in job.details:
        _try(found, partial(plan_detail, job, detail))
    if not found:
        found += _corners(job, zones)
    return job, found + _travel(job) + _remarks(job)


def _travel(job: Job) -> list[Finding]:
    """Whether the machine is large enough: the least that the finest end mill travels around the part."""
    machine = job.settings.machine
    if not job.end_mills:
        return []
    x0, y0, x1, y1 = job.target.bounds
    around = job.end_mills[-1].diameter
    axes = (("x", x1 - x0 + around, machine.travel_x), ("y", y1 - y0 + around, machine.travel_y))
    return [
        Finding(
            "cam.travel",
            Severity.ERROR,
            f"cam.machine.travel_{axis}",
            f"part {job.part.name} asks for {wanted:.1f} mm of travel in {axis.upper()}",
            wanted,
            travel,
            "mm",
            "take a larger machine",
        )
        for axis, wanted, travel in axes
        if wanted > travel
    ]


def _try(found: list[Finding], action: Callable[[], object]) -> None:
    try:
        action()
    except MechwrightError as error:
        found.append(_refusal(error))


def _refusal(error: MechwrightError) -> Finding:
    """An error that names its parameter in front, as a finding."""
    text = str(error)
    parameter, _, message = text.partition(": ")
    if not parameter.startswith("cam") or " " in parameter:
        parameter, message = "cam.tools" if isinstance(error, ToolError) else "cam", text
    return Finding("cam.cannot-cut", Severity.ERROR, parameter, message)


def _corners(job: Job, zones: list[Zone]) -> list[Finding]:
    """The remainder on every wall."""
    found = []
    for zone in zones:
        if zone.at_tabs:
            continue
        found += _partly(job, zone)
        depth = remainder(zone.wall, zone.finisher.radius, zone.must)
        if depth > TOLERANCES.leftover:
            found.append(
                Finding(
                    "cam.unreachable",
                    Severity.NOTE,
                    "cam.tools",
                    f"{zone.finisher.name} leaves up to {depth:.3f} mm in corners of {zone.name} "
                    f"of {job.part.name}",
                    depth,
                    TOLERANCES.leftover,
                    "mm",
                )
            )
    return found


def _remarks(job: Job) -> list[Finding]:
    found = []
    machine, material = job.settings.machine, job.part.material
    for tool in job.tools:
        data = tool.cutting.get(material)
        if data is None:
            found.append(
                Finding(
                    "cam.tool-unused",
                    Severity.WARNING,
                    "cam.tools",
                    f"{tool.name} has no cutting data for {material} and is not used",
                    remedy=f"add {material} to its table in the tool library",
                )
            )
            continue
        speed = rates(tool, material, machine).spindle
        if (
            speed <= machine.spindle_min
            and speed * tool.diameter * math.pi > 1000 * data.cutting_speed * 1.01
        ):
            found.append(
                Finding(
                    "cam.too-fast",
                    Severity.WARNING,
                    "cam.machine.spindle_min",
                    f"{tool.name} runs faster than {data.cutting_speed:g} m/min in {material}",
                    machine.spindle_min,
                    1000 * data.cutting_speed / (math.pi * tool.diameter),
                    "rpm",
                    "take a smaller tool",
                )
            )
        if tool.kind is ToolKind.END_MILL and -job.floor > SLENDER * tool.diameter:
            found.append(
                Finding(
                    "cam.slender",
                    Severity.NOTE,
                    "cam.tools",
                    f"{tool.name} cuts {-job.floor:g} mm deep, {-job.floor / tool.diameter:.1f} diameters",
                    -job.floor / tool.diameter,
                    SLENDER,
                    "",
                )
            )
            found += _bending(job, tool)
        found += _figures(tool, material)
    return found


MOSTLY = 0.9
"""A recess of which the mills reach less than this is hardly what was drawn."""


def _partly(job: Job, zone: Zone) -> list[Finding]:
    """Whether much of a recess is too narrow for all its mills."""
    if zone.kind == "outside":
        return []
    must = zone.clear if zone.must is None else zone.must
    radius = zone.finisher.radius
    reach = grow(grow(zone.clear, -radius, ROUGH), radius, ROUGH)
    share = float(shapely.intersection(reach, must).area / must.area)
    if share >= MOSTLY:
        return []
    return [
        Finding(
            "cam.partly",
            Severity.WARNING,
            "cam.tools",
            f"{zone.finisher.name} reaches {100 * share:.0f} % of {zone.name} of {job.part.name}",
            100 * share,
            100 * MOSTLY,
            "%",
            "list a smaller end mill",
        )
    ]


def _bending(job: Job, tool: Tool) -> list[Finding]:
    """Whether a slender mill bends too much; the deepest cut counts."""
    bent = deflection(tool, job.part.material, -job.floor)
    if bent <= MOST:
        return []
    return [
        Finding(
            "cam.deflection",
            Severity.WARNING,
            "cam.tools",
            f"{tool.name} bends {bent:.3f} mm in its roughing cut, {-job.floor:g} mm deep in {job.part.name}",
            bent,
            MOST,
            "mm",
            "take less step_down in the tool library, or a thicker cutter",
        )
    ]


def _figures(tool: Tool, workpiece: str) -> list[Finding]:
    """Whether an end mill's cutting data are of the usual size: a slip of the decimal point is not."""
    if tool.kind not in MILLS:
        return []
    data, usual = tool.cutting[workpiece], material_of(workpiece)
    share = HSS_SPEED if tool.substrate == "hss" else 1.0
    found = []
    for what, value, (low, high), unit in (
        ("cutting_speed", data.cutting_speed, (usual.speed[0] * share, usual.speed[1] * share), "m/min"),
        ("chip_load", data.chip_load, tuple(tool.diameter * s for s in usual.chip_share), "mm"),
    ):
        if not low <= value <= high:
            found.append(
                Finding(
                    "cam.cutting-data",
                    Severity.WARNING,
                    "cam.tool_library",
                    f"{what} of {tool.name} in {workpiece}: {value:g} {unit}, usual {low:.3g} to {high:.3g}",
                    value,
                    high if value > high else low,
                    unit,
                    "look at what the cutter's maker says, and correct the tool library",
                )
            )
    return found
