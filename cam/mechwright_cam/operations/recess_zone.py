"""The zone of a recess or an opening, and the mills that make it."""

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import shapely

from mechwright.contracts.part import Pocket, Profile
from mechwright.errors import DesignError, ToolError
from mechwright.tolerances import TOLERANCES
from mechwright_cam.operations.choice import (
    finishing_choice,
    last_mills,
    radius_in,
    roomy_mills,
    run_out,
    usable_mills,
    with_sharper,
)
from mechwright_cam.operations.compensation import entering
from mechwright_cam.operations.recess import Layer, Recess, reached_share, recess, walls_of
from mechwright_cam.operations.zone import SNUG, Zone
from mechwright_cam.setup.depths import bottom_of, through
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.cutter import CORNER_SHARE, LEAST_SHARE, makes_floor
from mechwright_cam.shop.tool import Tool
from mechwright_plane.offsets import ROUGH, areas, grow, swept

SCRATCH = 1e-4
"""A mill with a sharper nose that reaches so much of a feature levels it there, if only at its mouth."""

ENTERED = 0.5
"""Below this share of a groove a mill has only come in at its open ends."""

FILLED = 0.9
"""A mill makes a groove of its own width if it reaches this share of it."""


def recess_zone(
    job: Job, feature: Profile | Pocket, filler: Tool | None = None, like: Zone | None = None
) -> Zone:
    """Choose the mills of a recess and look at what they have to clear.

    A ``filler`` is just as wide as the recess and makes all of it; of a zone ``like`` it, that of a turned
    copy, the mills are taken over. Raises ToolError where no mill of the job enters it, or makes its floor;
    DesignError where there is nothing of the plate in it.
    """
    bottom, radius = bottom_of(job, feature.top, feature.depth), floor_radius(feature)
    filling = (filler,) if filler is not None else ()
    known = filling if like is None else like.finishers
    usable = usable_mills(job, -bottom, radius)
    shapes = recess(job, feature, usable, run_out(known, job.settings) if known else 0.0)
    if shapely.is_empty(shapes.must):
        raise DesignError(f"part {job.part.name}: {feature.name} takes nothing of the plate; remove it")
    walls = _walls(job, feature, usable)
    high = walls[0][0] if walls else math.inf
    mills, finishers, able = like.mills if like is not None else known, known, known[:0]
    if not known:
        mills, finishers, able = _mills(job, feature, usable, shapes, high)
        if shapes.open:  # once more, to run out no further than the finishing cutters need
            shapes = recess(job, feature, usable, run_out(finishers, job.settings))
    zone = Zone(
        feature.name,
        shapes.keep,
        shapes.around,
        -feature.top,
        bottom,
        "pocket" if isinstance(feature, Pocket) else "inside",
        mills,
        finishers,
        path=job.settings.path,
        below=bottom == job.floor,
        must=shapes.must if shapes.open else None,
        floor_radius=radius,
        walls=walls,
        like=like,
    )
    if job.settings.compensation == "computer" or not able:
        return zone
    left = areas(shapely.intersection(zone.clear, shapely.box(*job.stock))) if shapes.open else zone.clear
    choose = partial(last_mills, keep=zone.wall, settings=job.settings, near=zone.must, height=high)
    return replace(zone, finishers=entering(job, [(zone, left)], able, finishers, choose))


def _mills(
    job: Job, feature: Profile | Pocket, usable: list[Tool], shapes: Recess, high: float
) -> tuple[tuple[Tool, ...], tuple[Tool, ...], tuple[Tool, ...]]:
    """The mills of a recess, those that finish it, and those among which these were chosen.

    Its wall is ``high`` mm high up to its first step.
    """
    bias, bottom = job.settings.path.bias, bottom_of(job, feature.top, feature.depth)

    def reached(mill: Tool) -> float:
        return reached_share(shapes, radius_in(mill, high) + bias)

    def enters(mill: Tool) -> bool:
        return reached(mill) >= LEAST_SHARE

    if floor_radius(feature) > 0:
        last = floor_mill(job, feature, usable, shapes)[0]
        _check_passages(job, feature, last, shapes)
        return tuple(roomy_mills(usable, shapes.must, job.settings.stock_to_leave)), (last,), ()
    if not any(map(enters, reversed(usable))):
        usable = usable_mills(job, -bottom, enters=enters)
        if not any(map(enters, reversed(usable))):
            raise ToolError(
                f"cam.tools: no listed end mill enters {feature.name} of part {job.part.name}; the "
                f"smallest that cuts {-bottom:g} mm deep is {usable[-1].name}; list a smaller one"
            )
    mills = roomy_mills(usable, shapes.must, job.settings.stock_to_leave)
    finishing = with_sharper(usable, mills, lambda mill: reached(mill) >= SCRATCH)
    near = shapes.must if shapes.open else None
    last_ones = last_mills(finishing, shapes.keep, job.settings, near, high)
    return tuple(mills), tuple(last_ones), tuple(finishing)


def first_look(job: Job, feature: Profile | Pocket) -> tuple[list[Tool], Recess]:
    """The mills that may cut a recess, largest first, and its shapes; raises ToolError if there is none."""
    mills = usable_mills(job, -bottom_of(job, feature.top, feature.depth), floor_radius(feature))
    return mills, recess(job, feature, mills)


def floor_radius(feature: Profile | Pocket) -> float:
    """The fillet of a feature's floor, mm."""
    return feature.floor_radius if isinstance(feature, Pocket) else 0.0


def floor_mill(
    job: Job, feature: Pocket | Profile, mills: Sequence[Tool], shapes: Recess
) -> tuple[Tool, bool]:
    """The mill that makes a floor with a fillet, and whether it is just as wide as the recess.

    Raises ToolError if none has the radius, or none gets in.
    """
    radius, bias = floor_radius(feature), job.settings.path.bias
    able = [mill for mill in mills if makes_floor(mill, radius)]
    if not able:
        raise ToolError(
            f"cam.tools: no listed mill leaves the fillet of {radius:g} mm on the floor of {feature.name} of "
            f"part {job.part.name}; list a ball of {2 * radius:g} mm, or a bull nose with this corner radius"
        )
    if reached_share(shapes, able[-1].radius + bias) < ENTERED:
        fit = [mill for mill in able if reached_share(shapes, mill.radius - SNUG) >= FILLED]
        if fit:
            return fit[0], True
    fit = [mill for mill in able if reached_share(shapes, mill.radius + bias) >= LEAST_SHARE]
    if not fit:
        raise ToolError(
            f"cam.tools: {able[-1].name} makes the floor of {feature.name} of part {job.part.name}, but is "
            "wider than it; list a narrower mill with this corner radius, or give it a smaller floor_radius"
        )
    fit = roomy_mills(fit, shapes.must, job.settings.stock_to_leave)
    return finishing_choice(fit, shapes.keep, job.settings, shapes.must if shapes.open else None), False


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
    return areas(shapely.difference(shapes.must, swept(shapes.around, radius)))


def _walls(job: Job, feature: Pocket | Profile, mills: Sequence[Tool]) -> tuple[Layer, ...]:
    """What stands around a recess; nothing where its mills go out below, or all are flat."""
    if through(job, feature.top + feature.depth) or all(mill.nose == 0 for mill in mills):
        return ()
    return walls_of(job, feature, 2 * max(mill.diameter for mill in mills if mill.nose > 0))
