"""Which cutters a part needs."""

import math
from bisect import bisect_left
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial

import shapely

from mechwright.contracts.part import Bore, OpenProfile, Part, Pocket, Profile
from mechwright.errors import DesignError, GeometryError, MechwrightError, ToolError
from mechwright_cam.operations.centre_lines import groove_mill, grooves
from mechwright_cam.operations.choice import (
    ROOMY,
    entry_place,
    finishing_choice,
    roomy_mills,
    same_reach,
    usable_mills,
)
from mechwright_cam.operations.compensation import has_entries
from mechwright_cam.operations.details import plan_detail
from mechwright_cam.operations.entry import enters
from mechwright_cam.operations.holes import BorePlan, boring_mill, boring_time, plan_bore, starting_drill
from mechwright_cam.operations.rates import runs_too_fast
from mechwright_cam.operations.recess import recess
from mechwright_cam.operations.slots import fills_a_slot
from mechwright_cam.plane.offsets import ROUGH, areas, grow, polygons
from mechwright_cam.plane.reach import closing, leaves_at_most, roughly_closed_area
from mechwright_cam.planning.zones import floor_mills, inner_zones, outer_zones, roughing_mills
from mechwright_cam.setup.depths import bores, bottom_of, through
from mechwright_cam.setup.job import Job, wear_margin
from mechwright_cam.setup.lay_out import make_job
from mechwright_cam.setup.limits import height_of
from mechwright_cam.setup.nest import Nest
from mechwright_cam.setup.plate import plate_box
from mechwright_cam.shop.holding import Stock
from mechwright_cam.shop.library import Library
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import MILLS, Tool, ToolKind

Fits = Callable[[Tool], bool]
"""Whether a mill may be used."""

ROUGHING_SHARE = 0.15
"""Largest roughing mill in shares of the part's narrow side: a larger one turns too much stock into chips."""
HANDY = 6.0
"""Up to this diameter, mm, a roughing mill is sensible for a part of any size: it wastes little."""
PAYS = 1.5
"""An intermediate roughing mill is at least this many times as wide as the finishing one."""
AMPLE = 1000.0
"""Where the design leaves the stock open, cutters are chosen as if so much were around the part, mm."""
HALF = 0.5
"""It takes at least this share of what the finishing mill would have to rough."""
ONE_MORE = 60.0
"""One more mill for bores is worth it if it saves this time, s, and that of changing to it: about what it
takes to fetch it, to clamp it, and to measure its length."""
OPENS = 0.6
"""A drill of this share of a hole's width opens it well enough to save a larger one: the helix of the mill
then takes rings as wide as after the drill of the right size, only one or two more."""


def choose_tools(part: Part, settings: CamSettings, library: Library) -> tuple[Tool, ...]:
    """Give the tools named in the settings, or, if none is named, those that the part needs.

    The choice: the largest roughing mill that is sensible for the size of the part and leaves a frame in the
    stock; for every wall the largest mill that leaves no more than the tolerance in its corners, or else the
    one that leaves least; a mill for the bores; the largest drills that fit, and a spot drill for them. Mills
    are flat, but for a floor with a fillet, which takes a round one. Only mills long enough for the cut and
    with cutting data for the material count, and cutters that get over the part within the machine's travel.

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
    library = _low_enough(part, settings, library)
    slow = _slow_enough(part, settings, library)
    if len(slow.tools) < len(library.tools):
        try:
            return _chosen(part, settings, slow)
        except ToolError:
            pass  # then with one that runs too fast, which a warning tells of
    return _chosen(part, settings, library)


def _chosen(part: Part, settings: CamSettings, library: Library) -> tuple[Tool, ...]:
    """The choice among all cutters of a library."""
    flat = tuple(tool for tool in library.tools if tool.nose == 0)
    every = Job(part, settings, flat, (0.0, 0.0), plate_box(part, settings, AMPLE))
    for outline in part.outlines:
        outline.polygon()  # one that cuts itself is refused before anything is grown around it
    mills = [*_mills(every), *_floor_mills(replace(every, tools=library.tools))]
    chosen = {mill.name: mill for mill in mills}
    drills = _drills(every)
    details = {tool.name: tool for tool in (plan_detail(every, d).tool for d in every.details)}
    chosen |= {mill.name: mill for mill in _entering(every, [*drills, *chosen.values(), *details.values()])}
    return (*drills, *sorted(chosen.values(), key=lambda tool: -tool.diameter), *details.values())


def _entering(every: Job, tools: list[Tool]) -> list[Tool]:
    """More mills, for walls at which compensation leaves those of ``tools`` no room for an entry.

    Planning itself is asked, of the mills of the library from the largest down.
    """
    if every.settings.compensation == "computer":
        return []
    more: list[Tool] = []
    try:
        job = make_job(every.part, every.settings, tools)
        lacking = _without_entries(job)
    except MechwrightError:
        return []  # what is wrong will be said when the job is laid out
    for mill in every.mills:
        if not lacking:
            break
        if mill in tools or every.part.material not in mill.cutting or mill.diameter >= max(lacking.values()):
            continue
        try:
            trial = replace(job, tools=(*job.tools, mill))
            rest = _without_entries(trial)
        except MechwrightError:
            continue
        if len(rest) < len(lacking):
            job, lacking = trial, rest
            more.append(mill)
    return more


def _without_entries(job: Job) -> dict[str, float]:
    """Names of walls that their mills cannot enter under compensation, with the finest diameter, mm."""
    zones = [*inner_zones(job, skip=grooves(job)), *outer_zones(job)]
    return {zone.name: zone.finisher.diameter for zone in zones if not has_entries(job, zone)}


def _low_enough(part: Part, settings: CamSettings, library: Library) -> Library:
    """The cutters that get over the part; all of them if no mill of these cuts through it.

    The refusal that follows then names the machine.
    """
    travel, through = settings.machine.travel_z, part.thickness + settings.breakthrough
    low = tuple(tool for tool in library.tools if height_of(tool, settings, part.thickness) <= travel)
    cuts = any(tool.kind in MILLS and tool.flute_length >= through for tool in low)
    return Library(low) if cuts else library


def _slow_enough(part: Part, settings: CamSettings, library: Library) -> Library:
    """Without the mills and drills that the machine's slowest speed overspeeds: others may do their work.

    Spot drills and the cutters of details have none that stand in for them.
    """

    def overspeeds(tool: Tool) -> bool:
        replaceable = tool.kind in MILLS or tool.kind is ToolKind.DRILL
        known = part.material in tool.cutting
        return replaceable and known and runs_too_fast(tool, part.material, settings.machine)

    return Library(tuple(tool for tool in library.tools if not overspeeds(tool)))


def _mills(every: Job) -> list[Tool]:
    """The end mills of the choice; ``every`` has the whole library."""
    part = every.part
    fit = usable_mills(every, -every.floor)
    boxes = [outline.bounds for outline in part.outlines]
    widest = max(HANDY, ROUGHING_SHARE * min(min(x1 - x0, y1 - y0) for x0, y0, x1, y1 in boxes))
    sensible = [mill for mill in fit if mill.diameter <= widest] or fit[-1:]
    chosen: list[Tool] = []
    openings = []
    for feature in every.features:
        if isinstance(feature, Pocket) or (isinstance(feature, Profile) and feature.side == "inside"):
            openings.append(feature)
        elif isinstance(feature, Profile):
            shape = shapely.Polygon(feature.loop.flatten())
            chosen += _outside(every, sensible, shape)
    for feature in openings:
        chosen += _inside(every, feature)
    # From the smallest on: what bores a small hole may bore the larger ones as well.
    alike: dict[tuple[float, float, float], list[Bore]] = {}
    for bore in bores(every):
        alike.setdefault((bore.diameter, bore.top, bore.depth), []).append(bore)
    for size in sorted(alike):
        chosen += _boring(every, alike[size], chosen)
    return chosen or fit[:1]


def _outside(every: Job, sensible: list[Tool], shape: shapely.Polygon) -> list[Tool]:
    """The mills that rough and finish an outside; none is as wide as a slot of it, if there is a choice."""
    mills = _roughing(every, sensible, shape)
    fits = partial(_fits, mills, shape, every.settings)
    first = next(filter(fits, mills))
    finest = _finest_needed(mills, shape, every.settings, fits=fits)
    return [first, *_between(every, first, mills, finest, shape, fits), finest]


def _fits(mills: Sequence[Tool], shape: shapely.Polygon, settings: CamSettings, mill: Tool) -> bool:
    """Whether a mill of these may be used around a shape; the finest may in any case."""
    bias = settings.path.bias
    return mill is mills[-1] or not fills_a_slot(mill.radius, shape, settings.stock_to_leave, bias)


def _inside(every: Job, feature: Profile | Pocket) -> list[Tool]:
    """The mill for an opening or a recess; none if the feature takes nothing, which planning will say."""
    if isinstance(feature, OpenProfile):
        mill = groove_mill(every, feature)
        if mill is not None:
            return [mill]
    bottom = bottom_of(every, feature.top, feature.depth)
    able = usable_mills(every, -bottom)
    shapes = recess(every, feature, able[0].diameter, bottom)
    if shapely.is_empty(shapes.must):
        return []
    if isinstance(feature, Pocket) and feature.floor_radius > 0:
        # The wall is for a round mill; a flat one clears what is further away, if there is room.
        inner = polygons(grow(shapes.must, -feature.floor_radius, ROUGH))
        width = 2 * max((entry_place(part)[1] for part in inner), default=0.0)
        return [mill for mill in able if mill.diameter <= min(ROOMY * width, HANDY)][:1]
    able = roomy_mills(able, shapes.must)
    return [_finest_needed(able, shapes.keep, every.settings, shapes.must if shapes.open else None)]


def _floor_mills(every: Job) -> list[Tool]:
    """The round mills for floors with a fillet."""
    found = []
    for feature in every.features:
        if isinstance(feature, Pocket) and feature.floor_radius > 0:
            bottom = bottom_of(every, feature.top, feature.depth)
            mills = usable_mills(every, -bottom, feature.floor_radius)
            shapes = recess(every, feature, mills[0].diameter, bottom)
            if not shapely.is_empty(shapes.must):
                found += floor_mills(every, feature, mills, shapes)[0]
    return found


def _roughing(every: Job, mills: list[Tool], part: shapely.Polygon) -> list[Tool]:
    """The mills for an outside: as in planning those whose channel leaves a frame, if there are any."""
    if every.settings.stock == Stock() and not isinstance(every.part, Nest):
        return mills  # the stock is made large enough for them
    return roughing_mills(every, mills, part, framed=every.settings.hold.method == "tabs")


def _between(
    every: Job, first: Tool, mills: list[Tool], finest: Tool, part: shapely.Polygon, fits: Fits
) -> list[Tool]:
    """A mill that takes much of what the largest leaves to the finest, if there is one."""

    def left(mill: Tool) -> float:
        reach = mill.radius + every.settings.stock_to_leave
        return roughly_closed_area(part, reach) - float(part.area)

    middle = [mill for mill in mills if PAYS * finest.diameter <= mill.diameter < first.diameter]
    if not middle:
        return []
    most, least = left(first), left(finest)
    if most <= least:
        return []
    # The smaller a mill, the more it takes.
    enough = bisect_left(middle, True, key=lambda mill: most - left(mill) >= HALF * (most - least))
    return next(([mill] for mill in middle[enough:] if fits(mill)), [])


def _finest_needed(
    mills: Sequence[Tool],
    keep: shapely.Geometry,
    settings: CamSettings,
    near: shapely.Geometry | None = None,
    fits: Fits = lambda _: True,
) -> Tool:
    """The largest mill that leaves next to nothing on a wall, else the largest as good as the finest.

    No mill below ``corner_mill`` is taken for the sake of sharp corners.
    """
    most, more = same_reach(settings.path), settings.path.bias + wear_margin(settings)
    # What a mill leaves only shrinks with its size.
    clean = bisect_left(mills, True, key=lambda mill: leaves_at_most(keep, mill.radius + more, most, near))
    for mill in mills[clean:]:
        if fits(mill):
            return mill
    fitting = [mill for mill in mills if fits(mill)]
    return finishing_choice(_worthwhile(fitting, keep, settings.corner_mill, near), keep, settings, near)


FITS = 0.9
"""A mill is worth choosing where what larger ones leave holds a disc of this share of it."""


def _worthwhile(
    mills: Sequence[Tool], keep: shapely.Geometry, least: float, near: shapely.Geometry | None
) -> Sequence[Tool]:
    """The mills down to ``least``, mm, and finer ones only as far as they fit into what is left."""
    coarse = [mill for mill in mills if mill.diameter >= least] or list(mills[:1])
    for finer in mills[len(coarse) :]:
        # On a grid, for a closing may touch itself, on which exact overlays fail.
        left = shapely.difference(closing(keep, coarse[-1].radius), keep, grid_size=ROUGH)
        if near is not None:
            left = areas(shapely.intersection(areas(left), areas(near)))
        if not shapely.is_empty(grow(left, -FITS * finer.radius, ROUGH)):
            coarse.append(finer)
    return coarse


def _boring(every: Job, holes: list[Bore], chosen: list[Tool]) -> list[Tool]:
    """A mill for bores of one size, unless one is chosen already or a drill makes them."""
    bore = holes[0]
    depth = -bottom_of(every, bore.top, bore.depth)
    able = [m for m in usable_mills(every, depth) if enters(m, bore.diameter, every.settings)]
    largest = max((mill.diameter for mill in chosen), default=math.inf)
    mill = boring_mill([mill for mill in able if mill.diameter <= largest] or able, bore.diameter)
    if mill is None:
        return []
    roomy = [m for m in able if m in chosen and m.diameter <= ROOMY * bore.diameter]
    other = boring_mill(roomy, bore.diameter)
    if other is not None:
        first, second = (
            boring_time(every, BorePlan(bore, plan_bore(every, bore).drill, m)) for m in (other, mill)
        )
        if len(holes) * (first - second) <= ONE_MORE + every.settings.machine.tool_change:
            return []
    return [mill]


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
