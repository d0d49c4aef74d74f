"""Which cutters a part needs."""

import math
from collections.abc import Sequence, Set
from dataclasses import replace
from itertools import product

import shapely

from mechwright.contracts.details import Detail
from mechwright.contracts.materials import material
from mechwright.contracts.part import Bore, Feature, Part, Pocket, Profile, is_outside
from mechwright.errors import DesignError, GeometryError, MechwrightError, ToolError
from mechwright_cam.operations.bore import cutters_of
from mechwright_cam.operations.choice import entry_place
from mechwright_cam.operations.compensation import has_entries
from mechwright_cam.operations.contract import Operation
from mechwright_cam.operations.drilling import starting_drill
from mechwright_cam.operations.hole_times import holes_time
from mechwright_cam.operations.ladder import change_time
from mechwright_cam.operations.rates import rates, rubs, runs_too_fast
from mechwright_cam.operations.ream import reaming
from mechwright_cam.operations.recess_zone import first_look, floor_mill
from mechwright_cam.operations.stock import Stock
from mechwright_cam.operations.tap import core_drill
from mechwright_cam.operations.twins import Twins
from mechwright_cam.operations.zone import Zone
from mechwright_cam.planning.assign import Assignments, assign
from mechwright_cam.planning.fewer_mills import fewer_mills
from mechwright_cam.setup.depths import through
from mechwright_cam.setup.job import Job
from mechwright_cam.setup.lay_out import make_job
from mechwright_cam.setup.limits import fits_collet, height_of
from mechwright_cam.setup.plate import plate_box
from mechwright_cam.shop.library import Library
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import MILLS, Tool, ToolKind

MOST_FLUTES = 3
"""With more a mill has too little room for the chips of a slot in soft material (handbook: 2 to 3)."""
AMPLE = 1000.0
"""Where the design leaves the stock open, cutters are chosen as if so much were around the part, mm."""
MOST_DRILLS = 5
"""Of no more drills all choices are compared."""
OPENS = 0.6
"""A drill of this share of a hole's width opens it well enough to save a larger one: the helix of the mill
then takes rings as wide as after the drill of the right size, only one or two more."""


def choose_tools(
    part: Part, settings: CamSettings, library: Library, assignments: Assignments | None = None
) -> tuple[Tool, ...]:
    """Give the tools named in the settings, or, if none is named, those that the part needs.

    The choice: the largest roughing mill that is sensible for the size of the part and leaves a frame in the
    stock; for every wall the largest mill that leaves no more than the tolerance in its corners, or else the
    one that leaves least; a mill for the bores; the largest drills that fit, and a spot drill for them. Mills
    are flat, but for a floor with a fillet, which takes a round one. Only mills long enough for the cut and
    with cutting data for the material count, and cutters that the spindle holds and that get over the part.

    Raises ToolError where a name is not in the library (close matches are listed), or no cutter can make it.
    """
    if settings.tools:
        doubles = {name for name in settings.tools if settings.tools.count(name) > 1}
        if doubles:
            raise DesignError(f"cam.tools: {min(doubles)!r} is listed twice; list it once")
        return tuple(library.get(name) for name in settings.tools)
    if part.outline is None:
        raise GeometryError(f"part {part.name} is no plate: it has no outline to mill")
    assignments = assignments or Assignments()
    operations = assignments.operations(settings)
    useless = assignments.untapped(library)
    library = Library(tuple(tool for tool in library.tools if tool.name not in useless))
    library = _best_fed(part, settings, _usable(part, settings, library))
    slow = _slow_enough(part, settings, library)
    if len(slow.tools) < len(library.tools):
        try:
            return _chosen(part, settings, slow, operations)
        except ToolError:
            pass  # then with one that runs too fast, which a warning tells of
    return _chosen(part, settings, library, operations)


def _chosen(
    part: Part, settings: CamSettings, library: Library, operations: Sequence[Operation]
) -> tuple[Tool, ...]:
    """The choice among all cutters of a library."""
    flat = tuple(tool for tool in library.tools if tool.nose == 0)
    every = Job(part, settings, flat, (0.0, 0.0), plate_box(part, settings, (AMPLE, AMPLE)))
    for outline in part.outlines:
        outline.polygon()  # one that cuts itself is refused before anything is grown around it
    chosen: list[Tool] = []
    twins = Twins(every)
    asked: list[tuple[Feature, Sequence[Tool]]] = []
    for feature in sorted(every.features, key=_turn):
        if twins.first(feature) is None:  # a turned copy asks for the same again
            asked.append((feature, _wanted(feature, every, chosen, operations)))
            chosen += asked[-1][1]
    idle = fewer_mills(every, asked)
    chosen = [tool for tool in chosen if tool.name not in idle]
    chosen += _floor_mills(replace(every, tools=library.tools))
    mills = list({mill.name: mill for mill in chosen}.values())
    drills = _drills(every, mills)
    details = [tool for detail in every.details for tool in _wanted(detail, every, mills, operations)]
    details = list({tool.name: tool for tool in details}.values())
    mills += _entering(every, [*drills, *mills, *details], operations)
    return (*drills, *sorted(mills, key=lambda tool: -tool.diameter), *details)


def _turn(feature: Feature) -> tuple[float, ...]:
    """Outsides are asked first, and bores last, from the smallest on: its mill may bore the larger too."""
    if isinstance(feature, Bore):
        return (2, feature.diameter, feature.top, feature.depth)
    return (0,) if is_outside(feature) else (1,)


def _wanted(
    feature: Feature | Detail, every: Job, chosen: Sequence[Tool], operations: Sequence[Operation]
) -> Sequence[Tool]:
    """The cutters that the first operation asks for that knows the feature."""
    answers = (operation.choose(feature, every, chosen) for operation in operations)
    return next((tools for tools in answers if tools is not None), ())


def _entering(every: Job, tools: list[Tool], operations: Sequence[Operation]) -> list[Tool]:
    """More mills, for walls at which compensation leaves those of ``tools`` no room for an entry.

    Planning itself is asked, of the mills of the library from the largest down.
    """
    if every.settings.compensation == "computer":
        return []
    more: list[Tool] = []
    try:
        job = make_job(every.part, every.settings, tools)
        lacking = _without_entries(job, operations)
    except MechwrightError:
        return []  # what is wrong will be said when the job is laid out
    for mill in every.mills:
        if not lacking:
            break
        if mill in tools or every.part.material not in mill.cutting or mill.diameter >= max(lacking.values()):
            continue
        try:
            trial = replace(job, tools=(*job.tools, mill))
            rest = _without_entries(trial, operations)
        except MechwrightError:
            continue
        if len(rest) < len(lacking):
            job, lacking = trial, rest
            more.append(mill)
    return more


def _without_entries(job: Job, operations: Sequence[Operation]) -> dict[str, float]:
    """Names of walls that their mills cannot enter under compensation, with the finest diameter, mm."""
    found = {}
    for task in assign(job, operations).every():
        zones = [task.data] if isinstance(task.data, Zone) else task.data if task.is_outside else []
        for zone in zones if not task.is_detail else []:
            left = task.region if isinstance(task.data, Zone) else zone.clear
            if not has_entries(job, zone, Stock(left), zone.finishers):
                found[zone.name] = zone.finisher.diameter
    return found


def _usable(part: Part, settings: CamSettings, library: Library) -> Library:
    """The cutters that the spindle holds and that get over the part; all if no mill of these cuts through it.

    The refusal that follows then names the machine.
    """
    machine, through = settings.machine, part.thickness + settings.breakthrough
    nose = math.inf if machine.nose_to_table is None else machine.nose_to_table
    usable = tuple(
        tool
        for tool in library.tools
        if height_of(tool, settings, part.thickness) <= nose and fits_collet(tool, machine)
    )
    cuts = any(tool.kind in MILLS and tool.flute_length >= through for tool in usable)
    return Library(usable) if cuts else library


def _best_fed(part: Part, settings: CamSettings, library: Library) -> Library:
    """Of flat mills of one diameter the one with the fastest feed, if its flutes are long enough.

    One whose teeth rub on this machine gives way to one with fewer flutes, and so does one with more than
    :data:`MOST_FLUTES` in soft material. Of two that are fed alike that with fewer stays.
    """
    machine, deep = settings.machine, part.thickness + settings.breakthrough
    stuff = material(part.material)
    soft = stuff.long_chips and stuff.kind != "steel"
    order: dict[str, tuple[bool, bool, float, int]] = {}
    for tool in library.tools:
        if tool.kind is ToolKind.END_MILL and part.material in tool.cutting:
            fed = rates(tool, part.material, machine).feed
            roomy = not soft or tool.flutes <= MOST_FLUTES
            order[tool.name] = not rubs(tool, part.material, machine), roomy, fed, -tool.flutes

    def beaten(tool: Tool) -> bool:
        reach = min(tool.flute_length, deep)
        return tool.name in order and any(
            other.diameter == tool.diameter
            and other.flute_length >= reach
            and order[other.name] > order[tool.name]
            for other in library.tools
            if other.name in order
        )

    return Library(tuple(tool for tool in library.tools if not beaten(tool)))


def _slow_enough(part: Part, settings: CamSettings, library: Library) -> Library:
    """Without the mills and drills that the machine's slowest speed overspeeds: others may do their work.

    Spot drills and the cutters of details have none that stand in for them.
    """

    def overspeeds(tool: Tool) -> bool:
        replaceable = tool.kind in MILLS or tool.kind is ToolKind.DRILL
        known = part.material in tool.cutting
        return replaceable and known and runs_too_fast(tool, part.material, settings.machine)

    return Library(tuple(tool for tool in library.tools if not overspeeds(tool)))


def _floor_mills(every: Job) -> list[Tool]:
    """The round mills for floors with a fillet."""
    found = []
    for feature in every.features:
        if isinstance(feature, Pocket) and feature.floor_radius > 0:
            mills, shapes = first_look(every, feature)
            if not shapely.is_empty(shapes.must):
                found.append(floor_mill(every, feature, mills, shapes)[0])
    return found


def _drills(every: Job, mills: Sequence[Tool]) -> list[Tool]:
    """Spot drill and drills for all holes through the plate: as few as open them well, in the least time.

    The ``mills`` are those that are chosen: they widen the holes, or open them themselves.
    """
    wanted: list[tuple[float, Tool]] = []
    needed: set[str] = set()
    drills: dict[str, Tool] = {}
    for feature in every.features:
        if isinstance(feature, Bore) and (core := core_drill(every, feature)) is not None:
            drills[core.name] = core
            needed.add(core.name)
            continue
        if not through(every, feature.top + feature.depth):
            continue
        if isinstance(feature, Bore):
            way = reaming(every, feature)
            drill, mill = (way.drill, way.mill) if way is not None else cutters_of(every, feature)
            width = feature.diameter
            if drill is not None and mill is None:
                drills[drill.name] = drill  # no other makes the hole to size
                needed.add(drill.name)
        elif isinstance(feature, Profile) and feature.side == "inside":
            _, radius = entry_place(shapely.Polygon(feature.loop.flatten()))
            width, drill = 2 * radius, starting_drill(every, 2 * radius, -every.floor)
        else:
            continue
        if drill is not None:
            wanted.append((width, drill))
    for width, drill in sorted(wanted, key=lambda hole: hole[1].diameter):
        if not any(OPENS * width <= other.diameter <= drill.diameter for other in drills.values()):
            drills[drill.name] = drill
    spots = every.tools_of(ToolKind.SPOT_DRILL)[:1]
    found = sorted(drills.values(), key=lambda tool: -tool.diameter)
    some = _worthwhile(every, mills, found, needed, spots)
    return (spots if some else []) + some


def _worthwhile(
    every: Job, mills: Sequence[Tool], drills: Sequence[Tool], needed: Set[str], spots: Sequence[Tool]
) -> list[Tool]:
    """Those of the drills with which holes take the least time: a mill may open them as well, on a helix.

    Of those ``needed`` all stay, and where a mill cannot do it. All others are tried with and without.
    """
    free = [drill for drill in drills if drill.name not in needed]
    if len(free) > MOST_DRILLS:
        return list(drills)
    ways = []
    for chosen in product((True, False), repeat=len(free)):
        left = {drill.name for drill, stays in zip(free, chosen, strict=True) if not stays}
        some = [drill for drill in drills if drill.name not in left]
        tools = (*mills, *some)
        try:
            seconds = holes_time(replace(every, tools=tools))
        except ToolError:
            continue
        ways.append(
            (seconds + (len(some) + (len(spots) if some else 0)) * change_time(every), len(some), some)
        )
    return min(ways, key=lambda way: way[:2])[2] if ways else list(drills)
