"""A part is laid into its stock, and held."""

import math
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace

import shapely

from mechwright.contracts.part import Feature, Part, Profile
from mechwright.errors import DesignError
from mechwright.geometry.segments import Point
from mechwright_cam.setup.clamping import rim_margins
from mechwright_cam.setup.depths import bores
from mechwright_cam.setup.holding import Clamp, ToeClamp
from mechwright_cam.setup.job import PEELED, Job
from mechwright_cam.setup.plate import plate_box
from mechwright_cam.setup.tabs import lay_tabs
from mechwright_cam.setup.vice import CLAMP_GAP, lay_jaws
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import Tool, widest_mill
from mechwright_plane.nest import Nest, moved_feature

_TALL = 0.7
"""In plates of which tabs of the usual height would take more than this share, they are half as high."""

_LOWEST_TAB = 0.4
"""No lower tab is chosen for the sake of a recess beside the outside, mm: the next vibration breaks it."""

FRAME = 3.0
"""Least width of the frame around the widest channel where the design leaves the stock open, mm."""

CLAMP_RIM = 1.0
"""A clamp that the program chooses lies at least so wide on the part around its opening, mm."""


def _with_usual_tabs(settings: CamSettings, thickness: float) -> CamSettings:
    """The settings with tabs that a thin plate has room for, unless the design file says their height."""
    hold = settings.hold
    if "tab_height" in hold.model_fields_set or hold.tab_height <= _TALL * thickness:
        return settings
    return settings.model_copy(update={"hold": hold.model_copy(update={"tab_height": thickness / 2})})


def make_job(part: Part, settings: CamSettings, tools: Sequence[Tool], below: Sequence[Feature] = ()) -> Job:
    """Lay a plate part into its stock and decide how it is held.

    ``below`` are features that a second setup cuts from the underside, and its dowels: tabs stay clear of
    them. Raises GeometryError for a part that is no plate; DesignError where the stock is too small, or
    nothing of the part can be held as the settings say.
    """
    settings = _with_usual_tabs(settings, part.thickness)
    widest = widest_mill(tools) * (1.0 if settings.outsides == "contour" else PEELED)
    stock = plate_box(part, settings, _margins(part, settings, widest))
    origin = {
        "axis": (0.0, 0.0),
        "corner": (stock[0], stock[1]),
        "centre": ((stock[0] + stock[2]) / 2, (stock[1] + stock[3]) / 2),
    }[settings.origin]
    placed = Job(
        part,
        settings,
        tuple(tools),
        origin,
        (stock[0] - origin[0], stock[1] - origin[1], stock[2] - origin[0], stock[3] - origin[1]),
    )
    if isinstance(part, Nest) and settings.hold.method in {"bore", "vice"}:
        raise DesignError(
            f"cam.hold.method: the {len(part.placed)} parts of {part.name} are cut in one setup and "
            'cannot be clamped one by one; use method = "tabs", or no cam.nest'
        )
    if settings.hold.method == "bore":
        return replace(placed, clamp=_clamp(placed))
    if settings.hold.method == "vice":
        return replace(placed, jaws=lay_jaws(placed, widest))
    if settings.hold.method == "none":
        clamps = enumerate(settings.hold.toe_clamps, start=1)
        return replace(
            placed, toes=tuple(ToeClamp(number, shapely.box(*box), top) for number, (*box, top) in clamps)
        )
    if settings.stock.finished:
        raise DesignError(
            f"cam.stock.finished: tabs hold part {part.name} in a frame, and there is none at a finished "
            'edge; use hold.method = "vice" or "bore"'
        )
    x0, y0, _, _ = placed.target.bounds
    barred = [moved_feature(feature, -origin[0], -origin[1]) for feature in below]
    return _on_tabs(placed, max(x0 - placed.stock[0], y0 - placed.stock[1]), barred)


def _margins(part: Part, settings: CamSettings, widest: float) -> tuple[float, float]:
    """Stock beyond a part in X and Y, mm, around the channel that the largest cutter opens.

    A frame of 3 mm is stiff enough for tabs. Where toe clamps hold the plate it is wide enough for these.
    """
    if settings.hold.method not in {"tabs", "bore"} or part.outline is None:
        return widest + FRAME, widest + FRAME
    x0, y0, x1, y1 = part.outline.bounds
    return rim_margins(x1 - x0, y1 - y0, widest + settings.stock_to_leave)


def _on_tabs(job: Job, reach: float, below: Sequence[Feature]) -> Job:
    """The job on its tabs: lower ones where they stand up in a recess, unless the file says their height."""
    try:
        return replace(job, tabs=lay_tabs(job, reach, below))
    except DesignError:
        hold = job.settings.hold
        if "tab_height" in hold.model_fields_set:
            raise
        left = {round(job.thickness - feature.top - feature.depth, 6) for feature in job.inner}
        for height in sorted((one for one in left if _LOWEST_TAB <= one < hold.tab_height), reverse=True):
            lower = hold.model_copy(update={"tab_height": height})
            other = replace(job, settings=job.settings.model_copy(update={"hold": lower}))
            with suppress(DesignError):
                return replace(other, tabs=lay_tabs(other, reach, below))
        raise


def _clamp(job: Job) -> Clamp:
    round_, openings = bores(job), [f for f in job.features if isinstance(f, Profile) and f.side == "inside"]
    if round_:
        centre = max(round_, key=lambda bore: bore.diameter).centre
    elif openings:
        middle = shapely.Polygon(openings[0].loop.flatten()).centroid
        centre = (middle.x, middle.y)
    else:
        raise DesignError(
            f'cam.hold.method: part {job.part.name} has no bore to be held by; use method = "tabs"'
        )
    hold = job.settings.hold
    wide = hold.clamp_diameter
    if "clamp_diameter" not in hold.model_fields_set:
        opening = 2 * float(shapely.distance(shapely.Point(centre), job.target.boundary))
        fits = math.floor(10 * _widest_clamp(job, centre)) / 10
        wide = min(wide, max(fits, math.ceil(10 * (opening + 2 * CLAMP_RIM)) / 10))
    return Clamp(centre, wide, hold.clamp_height)


def _widest_clamp(job: Job, centre: Point) -> float:
    """The widest clamp that keeps off the outside, mm."""
    reach = shapely.distance(shapely.Point(centre), job.target.exterior)
    return math.floor(200 * (float(reach) - CLAMP_GAP)) / 100


def check_clamp(job: Job) -> None:
    """Raise DesignError if the clamp comes too near to the outside."""
    if job.clamp is None:
        return
    limit = _widest_clamp(job, job.clamp.centre)
    if job.clamp.diameter > limit:
        raise DesignError(
            f"cam.hold.clamp_diameter: a clamp of {job.clamp.diameter:g} mm comes within {CLAMP_GAP:g} "
            f"mm of the outside of part {job.part.name}; use at most {max(limit, 0):.2f} mm, or tabs"
        )
