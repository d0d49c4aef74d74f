"""Setups: what is cut from above, what from the underside, and the job of a plate that has been turned over.

Glossary
--------
underside feature
    One that does not begin at the top face or in something cut from there: it is milled in a second setup.
flip axis
    The axis of the part, parallel to X or Y, about which the plate is turned over. A point on it stays where
    it is, so dowels on it fit both sides.
"""

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Literal

import numpy as np
import shapely

from mechwright.contracts.finding import Finding, errors
from mechwright.contracts.part import Bore, Feature, Part
from mechwright.errors import DesignError
from mechwright.geometry import Loop, Outline
from mechwright.geometry.mirror import turned_over, turned_point
from mechwright_cam.planning.assign import Assignments
from mechwright_cam.planning.remarks import lay_out, refusal
from mechwright_cam.setup.clamping import least_margin, widest_channel
from mechwright_cam.setup.job import LEVEL, Air, Job
from mechwright_cam.setup.sides import SIGNS, _over, sides
from mechwright_cam.setup.thin_floors import thin_floors
from mechwright_cam.setup.turned import Frame, TurnedOver
from mechwright_cam.setup.views import inside_of
from mechwright_cam.shop.holding import Hold, Stock
from mechwright_cam.shop.library import Library
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import widest_mill
from mechwright_plane.offsets import ROUGH, filled, grow

DOWEL_FRAME = 3.0
"""Stock between the channel around the part and a dowel's wall, mm: what holds the tabs."""

UNDERSIDE = "-underside"
"""What a part's name ends in for its second setup."""

SECOND = "cam.second-side"
"""Code of what is wrong with it."""

WALL = 3.0
"""Stock around a dowel hole, mm: it must not break out under the dowel."""


def lay_out_setups(
    part: Part, settings: CamSettings, library: Library, assignments: Assignments | None = None
) -> tuple[list[Job], list[Finding]]:
    """The jobs of a part: one, or a second one for the underside; with all findings.

    There are fewer jobs if a finding is an error.
    """
    assignments = assignments or Assignments()
    try:
        upper, under = sides(part)
    except DesignError as error:
        return [], [refusal(error, SECOND)]
    if not under:
        job, found = lay_out(part, settings, library, (), assignments)
        return ([], found) if job is None else ([job], [*found, *thin_floors(part, upper, ())])
    first = replace(part, machined=upper)
    job, found = lay_out(first, settings, library, under, assignments)
    if job is None:
        return [], found
    try:
        if settings.second_side.locate == "dowels":
            settings = _with_room(job)
            dowels = _dowels(job, settings)
            first = replace(part, machined=(*dowels, *upper))
            job, found = lay_out(first, settings, library, (*under, *dowels), assignments)
            if job is None:
                return [], found
        second, more = _second(job, part, under, library, assignments)
    except DesignError as error:
        return [], [*found, refusal(error, SECOND)]
    thin = thin_floors(part, upper, under)
    return ([job] if second is None else [job, second]), [*found, *more, *thin]


def _second(
    first: Job, part: Part, under: Sequence[Feature], library: Library, assignments: Assignments
) -> tuple[Job | None, list[Finding]]:
    """The job of the underside: the plate is the part, and keeps all but the underside's features."""
    side = first.settings.second_side
    own = (side.work_offset, *side.more_offsets)
    for before, offset in enumerate(own):
        if offset in first.settings.offsets:
            raise DesignError(
                f"cam.second_side.work_offset: {offset} is the first side's; the second needs its own"
            )
        if offset in own[:before]:
            raise DesignError(f"cam.second_side.more_offsets: {offset} is named twice; name it once")
    if first.settings.hold.method != "tabs":
        raise DesignError(
            f"cam.hold.method: part {part.name} has features on its underside and would be loose by then; "
            'use method = "tabs"'
        )
    floor = part.thickness - LEVEL
    bores = [f for f in first.part.features if isinstance(f, Bore) and f.top + f.depth >= floor]
    if side.locate == "bore" and not bores:
        raise DesignError(f"cam.second_side.locate: part {part.name} has no bore; use edges or dowels")
    x0, y0, x1, y1 = first.stock
    ox, oy = first.origin
    plate = Loop.polygon([(x0 + ox, y0 + oy), (x1 + ox, y0 + oy), (x1 + ox, y1 + oy), (x0 + ox, y1 + oy)])
    features = tuple(_over(feature, part.thickness, side.flip) for feature in under)
    dowels = [bore for bore in bores if bore not in part.features]
    over = TurnedOver(
        part.name + UNDERSIDE,
        Outline(turned_over(plate, side.flip)),
        part.thickness,
        part.material,
        part.instances,
        part.colour,
        features,
        frame=_frame(first, dowels, side.flip),
    )
    # The plate lies elsewhere now: what was measured for the first side must not be written into this offset.
    place: dict[str, object] = {"x": side.x, "y": side.y, "z": side.z, "more": {}}
    post = first.settings.post
    changes = {
        "work_offset": side.work_offset,
        "more_offsets": side.more_offsets,
        "stock": Stock(margin=0.0),
        "hold": Hold(),
        "measured": first.settings.measured.model_copy(update=place),
        "post": post.model_copy(update={"offsets": post.offsets and side.x is not None}),
    }
    settings = first.settings.model_copy(update=changes)
    job, found = lay_out(over, settings, library, (), assignments)
    if job is None or errors(found):
        return None, found
    located = {"bore": sorted(bores, key=lambda bore: -bore.diameter)[:1], "dowels": dowels}
    turned = (turned_point(bore.centre, side.flip) for bore in located.get(side.locate, ()))
    pick_up = tuple((x - job.origin[0], y - job.origin[1]) for x, y in turned)
    return assignments.carry(job, replace(job, side="underside", pick_up=pick_up)), found


def _frame(first: Job, dowels: Sequence[Bore], flip: Literal["x", "y"]) -> Frame:
    """The part in its frame when the plate has been turned over, in the part's coordinates."""
    sign, body = np.array(SIGNS[flip]), filled(first.target)
    tabs = [shapely.difference(tab.shape, body) for tab in first.tabs]
    holds = shapely.transform(shapely.union_all(tabs), lambda points: points + first.origin)
    pins = [grow(inside_of(dowel), WALL, ROUGH) for dowel in dowels]  # they stand in their holes
    return Frame(
        shapely.transform(body, lambda points: (points + first.origin) * sign),
        shapely.transform(first.target, lambda points: (points + first.origin) * sign),
        shapely.transform(shapely.union_all([holds, *pins]), lambda points: points * sign),
    )


def turned_shape(shape: shapely.Geometry, first: Job, second: Job) -> shapely.Geometry:
    """A shape of the first setup's work coordinates in those of the second."""
    sign = np.array(SIGNS[first.settings.second_side.flip])
    return shapely.transform(shape, lambda p: (p + first.origin) * sign - second.origin)


def carried(cut: Sequence[tuple[shapely.Geometry, float]], first: Job, second: Job) -> tuple[Air, ...]:
    """What the first setup has cut down to heights z of its own, as the second finds it from below."""
    return tuple(Air(turned_shape(shape, first, second), -z - first.thickness) for shape, z in cut)


def _with_room(job: Job) -> CamSettings:
    """Settings with stock for dowels on two sides, where the design leaves the stock open."""
    settings = job.settings
    if settings.stock != Stock():
        return settings
    margin = max(math.ceil(_beside(job)), least_margin(widest_channel(job)))
    return settings.model_copy(update={"stock": Stock(margin=margin)})


def _beside(job: Job) -> float:
    """Least stock beside both ends of the part for a dowel, mm."""
    return widest_mill(job.tools) + DOWEL_FRAME + WALL + job.settings.second_side.dowel_diameter + WALL


def _dowels(job: Job, settings: CamSettings) -> tuple[Bore, ...]:
    """Two dowel holes on the flip axis, one at each end of the plate."""
    side, diameter = settings.second_side, settings.second_side.dowel_diameter
    assert job.part.outline is not None  # noqa: S101 - a job is about a plate
    x0, y0, x1, y1 = job.part.outline.bounds
    wanted = settings.stock
    if wanted.length is not None and wanted.width is not None:
        mx, my = (wanted.length - (x1 - x0)) / 2, (wanted.width - (y1 - y0)) / 2
    else:
        mx = my = wanted.margin or 0.0
    inset = WALL + diameter / 2
    along = (x0 - mx + inset, x1 + mx - inset) if side.flip == "x" else (y0 - my + inset, y1 + my - inset)
    need = _beside(job)
    if (mx if side.flip == "x" else my) < need:
        raise DesignError(
            f"cam.stock: dowels of {diameter:g} mm on the {side.flip.upper()} axis need {need:.1f} mm of "
            f"stock beside both ends of part {job.part.name}; take a larger plate"
        )
    places = [(at, 0.0) if side.flip == "x" else (0.0, at) for at in along]
    return tuple(
        Bore(f"dowel-{number}", place, diameter, 0.0, job.thickness)
        for number, place in enumerate(places, start=1)
    )
