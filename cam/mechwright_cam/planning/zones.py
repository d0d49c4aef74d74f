"""The zones of a job: recesses and openings, and the channel around the outside in its layers."""

import math
from collections.abc import Callable, Container, Sequence
from functools import partial

import numpy as np
import shapely

from mechwright.contracts.part import Pocket, Profile
from mechwright.errors import DesignError, ToolError
from mechwright.tolerances import TOLERANCES
from mechwright_cam.operations.choice import (
    finishing_choice,
    last_mills,
    radius_in,
    roomy_mills,
    usable_mills,
    with_sharper,
)
from mechwright_cam.operations.entry import lead_length
from mechwright_cam.operations.recess import Layer, Recess, reached_share, recess, walls_of
from mechwright_cam.operations.slots import outside_mills
from mechwright_cam.operations.zone import HEAVY, NOISE, SLACK, SNUG, Zone
from mechwright_cam.plane.offsets import ROUGH, areas, filled, grow, polygons, simplified, thinned
from mechwright_cam.plane.path import DECIMALS
from mechwright_cam.plane.reach import roughly_swollen
from mechwright_cam.setup.depths import bores, bottom_of, through
from mechwright_cam.setup.job import Job
from mechwright_cam.setup.nest import Nest
from mechwright_cam.setup.vice import CLAMP_GAP, beside, can_be_clamped
from mechwright_cam.shop.cutter import CORNER_SHARE, LEAST_SHARE, makes_floor
from mechwright_cam.shop.tool import Tool

SCRATCH = 1e-4
"""A mill with a sharper nose that reaches so much of a feature levels it there, if only at its mouth."""

ENTERED = 0.5
"""Below this share of a groove a mill has only come in at its open ends."""

FILLED = 0.9
"""A mill makes a groove of its own width if it reaches this share of it."""


def inner_zones(job: Job, skip: Container[str] = ()) -> list[Zone]:
    """Openings that are not round, and pockets, but for those of some names."""
    zones, path = [], job.settings.path
    for feature in job.features:
        if feature.name in skip:
            continue
        if not isinstance(feature, Pocket) and not (
            isinstance(feature, Profile) and feature.side == "inside"
        ):
            continue
        bottom = bottom_of(job, feature.top, feature.depth)
        radius = feature.floor_radius if isinstance(feature, Pocket) else 0.0
        mills = usable_mills(job, -bottom, radius)
        shapes = recess(job, feature, mills[0].diameter, bottom)
        if shapely.is_empty(shapes.must):
            raise DesignError(f"part {job.part.name}: {feature.name} takes nothing of the plate; remove it")
        walls, snug = _walls(job, feature, mills), False
        finishing: list[Tool] = []
        choose = partial(last_mills, settings=job.settings)
        if radius > 0:
            last, snug = floor_mills(job, feature, mills, shapes)
            if not snug:
                _check_passages(job, feature, last[-1], shapes)
            mills = last if snug else roomy_mills(mills, shapes.must)
        else:
            high = walls[0][0] if walls else math.inf

            def reached(mill: Tool, shapes: Recess = shapes, high: float = high) -> float:
                return reached_share(shapes, radius_in(mill, high) + path.bias)

            if max(map(reached, mills)) < LEAST_SHARE:
                mills = usable_mills(job, -bottom, enters=lambda mill: reached(mill) >= LEAST_SHARE)
            if max(map(reached, mills)) < LEAST_SHARE:
                raise ToolError(
                    f"cam.tools: no listed end mill enters {feature.name} of part {job.part.name}; the "
                    f"smallest that cuts {-bottom:g} mm deep is {mills[-1].name}; list a smaller one"
                )
            able, mills = mills, roomy_mills(mills, shapes.must)
            finishing = with_sharper(able, mills, lambda mill: reached(mill) >= SCRATCH)
            near = shapes.must if shapes.open else None
            choose = partial(choose, keep=shapes.keep, near=near, height=high)
            last = choose(finishing)
        if shapes.open:  # once more, to run out no further than the finishing cutters need
            run_out = max(mill.diameter + lead_length(mill, job.settings) for mill in last)
            run_out += job.settings.stock_to_leave + HEAVY
            shapes = recess(job, feature, run_out, bottom)
        zone = Zone(
            feature.name,
            shapes.keep,
            shapes.around,
            -feature.top,
            bottom,
            mills,
            last[-1],
            "pocket" if isinstance(feature, Pocket) else "inside",
            bottom == job.floor,
            feature,
            shapes.must if shapes.open else None,
            path=path,
            below=bottom == job.floor,
            before=tuple(last[:-1]),
            floor_radius=radius,
            snug=snug,
            walls=walls,
        )
        if shapes.open:
            zone.left = areas(shapely.intersection(zone.clear, shapely.box(*job.stock)))
        _make_enter(job, [zone], finishing, choose)
        zones.append(zone)
    return zones


def _make_enter(
    job: Job, zones: list[Zone], mills: Sequence[Tool], choose: Callable[[list[Tool]], list[Tool]]
) -> None:
    """Where compensation leaves the mills that finish a wall no room for their entry, let finer ones do it.

    ``choose`` gives those that finish of some. The finest is not asked: if it has no room, planning says so.
    """
    from mechwright_cam.operations.compensation import has_entries

    while finer := [mill for mill in mills if mill.diameter < zones[0].finisher.diameter]:
        if all(has_entries(job, zone) for zone in zones):
            return
        last = choose(finer)
        for zone in zones:
            zone.before, zone.finisher = tuple(last[:-1]), last[-1]


def _check_passages(job: Job, feature: Pocket | Profile, maker: Tool, shapes: Recess) -> None:
    """Refuse a floor with a fillet that its mill does not reach, but for corners, where finer mills do."""
    missed = _missed(maker.radius + job.settings.path.bias, shapes)
    # What it just fills counts as reached for the proof, though the way along an edge is none for it.
    snug = areas(shapely.difference(missed, _missed(maker.radius - SNUG, shapes)))
    passages = [grow(snug, -TOLERANCES.leftover, ROUGH)]
    if any(mill.radius < maker.radius for mill in job.mills):
        passages.append(grow(missed, -CORNER_SHARE * maker.radius, ROUGH))
    entered = reached_share(shapes, maker.radius + job.settings.path.bias) >= ENTERED
    if not entered or not all(map(shapely.is_empty, passages)):
        raise ToolError(
            f"cam.tools: {maker.name} makes the floor of {feature.name} of part {job.part.name}, but parts "
            "of it are narrower; list a narrower mill of this corner radius, or make its floor_radius smaller"
        )


def _missed(radius: float, shapes: Recess) -> shapely.Geometry:
    """What a mill that reaches so far does not get at, mm."""
    reach = grow(grow(shapes.around, -radius, ROUGH), radius, ROUGH)
    return areas(shapely.difference(shapes.must, reach))


def _walls(job: Job, feature: Pocket | Profile, mills: Sequence[Tool]) -> tuple[Layer, ...]:
    """What stands around a recess; nothing where its mills go out below, or all are flat."""
    if through(job, feature.top + feature.depth) or all(mill.nose == 0 for mill in mills):
        return ()
    return walls_of(job, feature, 2 * max(mill.diameter for mill in mills if mill.nose > 0))


def floor_mills(
    job: Job, feature: Pocket | Profile, mills: Sequence[Tool], shapes: Recess
) -> tuple[list[Tool], bool]:
    """The mill that makes a floor with a fillet, and whether it is just as wide as the recess.

    Raises ToolError if none has the radius, or none gets in.
    """
    radius, path = feature.floor_radius if isinstance(feature, Pocket) else 0.0, job.settings.path
    able = [mill for mill in mills if makes_floor(mill, radius)]
    if not able:
        raise ToolError(
            f"cam.tools: no listed mill leaves the fillet of {radius:g} mm on the floor of {feature.name} of "
            f"part {job.part.name}; list a ball of {2 * radius:g} mm, or a bull nose with this corner radius"
        )
    if reached_share(shapes, able[-1].radius + path.bias) < ENTERED:
        fit = [mill for mill in able if reached_share(shapes, mill.radius - SNUG) >= FILLED]
        if fit:
            return fit[:1], True
    fit = [mill for mill in able if reached_share(shapes, mill.radius + path.bias) >= LEAST_SHARE]
    if not fit:
        raise ToolError(
            f"cam.tools: {able[-1].name} makes the floor of {feature.name} of part {job.part.name}, but is "
            "wider than it; list a narrower mill with this corner radius, or give it a smaller floor_radius"
        )
    fit = roomy_mills(fit, shapes.must)
    return [finishing_choice(fit, shapes.keep, job.settings, shapes.must if shapes.open else None)], False


def outer_zones(job: Job) -> list[Zone]:
    """The outsides: one zone each, or two with tabs, above and below their tops."""
    return [zone for wall in outer_walls(job) for zone in wall]


def outer_walls(job: Job) -> list[list[Zone]]:
    """The zones of :func:`outer_zones`, outside by outside: a nest has several."""
    walls, path = [], job.settings.path
    for feature in job.features:
        if not (isinstance(feature, Profile) and feature.side == "outside"):
            continue
        if not through(job, feature.top + feature.depth):
            raise DesignError(
                f"part {job.part.name}: the outside {feature.name} ends {feature.depth:g} mm below "
                f"{feature.top:g} mm and not at the underside; only outsides through the plate can be cut"
            )
        part = shapely.Polygon(feature.loop.flatten())
        own = [tab for tab in job.tabs if shapely.intersects(tab.shape, part)]
        able = usable_mills(job, -job.floor)
        if own and own[0].ramped:
            able = _flat_mills(job, able)
        # A mill too wide for the frame is as good as none, for finishing as well.
        mills = roughing_mills(job, able, part)
        mills = outside_mills(mills, part, job.settings.stock_to_leave, path.bias)
        clear, channel = _channel(job, part, mills[0])
        choose = partial(last_mills, keep=part, settings=job.settings)
        last = choose(mills)

        layer = partial(
            Zone,
            wall=part,
            mills=mills,
            finisher=last[-1],
            kind="outside",
            through=True,
            path=path,
            channel=channel,
            before=tuple(last[:-1]),
        )
        zones: list[Zone] = []
        if shapely.is_empty(clear):
            continue  # all of its edges are those of the stock
        top = -feature.top
        if own:
            # Rounded upwards: a decimal too low would already cut the tabs.
            height = math.ceil(max(tab.top for tab in own) * 10**DECIMALS - NOISE) / 10**DECIMALS
            zones.append(layer(feature.name, clear=clear, top=top, bottom=height))
            if own[0].ramped:
                name = f"{feature.name} over the tabs"
                zones.append(
                    layer(name, clear=clear, top=height, bottom=job.floor, slopes=tuple(own), below=True)
                )
            else:
                tabs = shapely.union_all([tab.shape for tab in own])
                name = f"{feature.name} below the tabs"
                below = clear.difference(tabs)
                zones.append(layer(name, clear=below, top=height, bottom=job.floor, tabs=tabs, below=True))
        else:
            zones.append(layer(feature.name, clear=clear, top=top, bottom=job.floor, below=True))
        _make_enter(job, zones, mills, choose)
        walls.append(zones)
    return walls


def _flat_mills(job: Job, mills: list[Tool]) -> list[Tool]:
    """The flat end mills: the round end of another would go into the slopes of ramped tabs."""
    flat = [mill for mill in mills if mill.nose == 0]
    if not flat:
        raise DesignError(
            f"cam.hold.tab_shape: ramped tabs of part {job.part.name} are for flat end mills, and "
            f'{mills[-1].name} has a round end; list a flat one, or use "rectangular" tabs'
        )
    return flat


def roughing_mills(
    job: Job, mills: list[Tool], part: shapely.Geometry, framed: bool | None = None
) -> list[Tool]:
    """The mills whose channel around the part leaves a frame, largest first.

    Without tabs a frame is only nice to have; with them (``framed``, by default if the job has tabs) it is an
    error if no mill leaves one.
    """
    apart = _neighbour(job, part)
    fit = [mill for mill in mills if _has_frame(job, part, channel_width(job, mill), apart)]
    if fit or not (bool(job.tabs) if framed is None else framed):
        return fit or mills
    least = channel_width(job, mills[-1])
    if apart < 2 * least + FRAME:
        raise DesignError(
            f"cam.nest.gap: {apart:.2f} mm between the parts of {job.part.name} leave no frame between two "
            f"channels of {least:.2f} mm; use at least {math.ceil(2 * least + FRAME):g} mm"
        )
    x0, y0, x1, y1 = part.bounds
    margin = min(x0 - job.stock[0], y0 - job.stock[1], job.stock[2] - x1, job.stock[3] - y1)
    raise DesignError(
        f"cam.stock: a margin of {margin:.2f} mm leaves no frame for the tabs of part {job.part.name} beside "
        f"a channel of {least:.2f} mm; use at least {math.ceil(least + FRAME):g} mm"
        + (", or hold by the bore" if can_be_clamped(job.part) and not isinstance(job.part, Nest) else "")
    )


FRAME = 1.0
"""Least width of the frame that tabs end in, mm."""


def channel_width(job: Job, mill: Tool) -> float:
    """Width of the channel that a mill opens around the part in one pass, mm."""
    return mill.diameter + max(job.settings.stock_to_leave, SLACK)


def _has_frame(job: Job, part: shapely.Geometry, width: float, apart: float) -> bool:
    """Whether the stock around a channel of this width is one ring at least FRAME wide.

    The next part of a nest is so far ``apart``, mm.
    """
    x0, y0, x1, y1 = part.bounds
    far = width + FRAME
    return bool(
        x0 - far >= job.stock[0]
        and y0 - far >= job.stock[1]
        and x1 + far <= job.stock[2]
        and y1 + far <= job.stock[3]
        and apart >= width + far - NEARLY
    )


NEARLY = 1e-6
"""Gaps are compared to this, mm: parts that were placed at a distance have it but for rounding."""


def _neighbour(job: Job, part: shapely.Geometry) -> float:
    """Distance of an outside from the next part of a nest, mm; inf where it is alone."""
    if not isinstance(job.part, Nest):
        return math.inf
    others = np.array(polygons(job.target))
    x0, y0, x1, y1 = part.bounds
    lows, highs = np.split(shapely.bounds(others), 2, axis=1)
    between = np.hypot(*np.maximum(0.0, np.maximum(lows - (x1, y1), (x0, y0) - highs)).T)
    least = math.inf
    for at in np.argsort(between, kind="stable").tolist():
        if between[at] >= least:  # and so are the boxes of all that follow
            break
        # A turned polygon is not the same to the last digit; its own plate is the one it overlaps.
        if not shapely.intersects(others[at], part):
            least = min(least, float(shapely.distance(others[at], part)))
    return least


def _channel(job: Job, part: shapely.Polygon, mill: Tool) -> tuple[shapely.Geometry, shapely.Geometry | None]:
    """What has to go around the part, and the outer limit of the channel."""
    width = channel_width(job, mill)
    thin = thinned(part)  # the finishing of the wall does not depend on it
    if not _has_frame(job, part, width, _neighbour(job, part)):
        # The channel breaks out of the plate: the corners would come loose, so all of the plate goes.
        if job.settings.stock.finished:
            return beside(shapely.box(*job.stock), part), None
        return shapely.box(*job.stock).difference(thin), None
    # Whatever the channel encloses would come loose, so it goes as well.
    near = roughly_swollen(part, width - mill.radius)
    channel = simplified(filled(grow(near, mill.radius, ROUGH)), ROUGH)
    return channel.difference(thin), channel


def check_clamp(job: Job) -> None:
    """Raise DesignError if the clamp comes too near to the outside."""
    if job.clamp is None:
        return
    reach = shapely.distance(shapely.Point(job.clamp.centre), job.target.exterior)
    limit = 2 * (float(reach) - CLAMP_GAP)
    if job.clamp.diameter > limit:
        raise DesignError(
            f"cam.hold.clamp_diameter: a clamp of {job.clamp.diameter:g} mm comes within {CLAMP_GAP:g} "
            f"mm of the outside of part {job.part.name}; use at most {max(limit, 0):.2f} mm, or tabs"
        )


__all__ = [
    "Zone",
    "bores",
    "bottom_of",
    "check_clamp",
    "inner_zones",
    "outer_walls",
    "outer_zones",
    "polygons",
    "roughing_mills",
    "through",
]
