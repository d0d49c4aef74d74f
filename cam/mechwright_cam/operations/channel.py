"""The mills for an outside: the channel that they open, its frame, and the slots that they would fill.

A mill as wide as a slot leaves no stock on its walls for finishing.

Where such a mill can be but one with its allowance cannot, its centre runs along the middle of the slot, and
farther than the mill's radius from any place where there is room for the allowance. Whether there is any such
place shows on thinned shapes, on the safe side; only then the exact ones are looked at.
"""

import math
from collections.abc import Sequence
from functools import lru_cache

import numpy as np
import shapely

from mechwright.errors import DesignError
from mechwright_cam.operations.zone import SLACK
from mechwright_cam.setup.job import Job
from mechwright_cam.setup.vice import can_be_clamped, surrounding_stock
from mechwright_cam.shop.tool import Tool
from mechwright_plane.buffers import buffered
from mechwright_plane.nest import Nest
from mechwright_plane.offsets import ROUGH, filled, grow, polygons, simplified, thinned
from mechwright_plane.reach import ROUGHLY, closing, roughly_swollen

LEAST_FRAME = 1.0
"""Least width of the frame that tabs end in, mm."""

FILLS = 0.9
"""Share of a mill's radius. Where a disc of this size has room that a mill with its allowance cannot enter,
the walls are parallel, and as far apart as the mill is wide: a corner of 25 degrees or more has no such room
for mills from 1 mm and the usual allowance on."""

STRIP = 2.0
"""A strip of stock narrower than this, mm, does not stand between two passes: the proof takes a bridge that
is not much narrower for none."""

NEARLY = 1e-6
"""Gaps are compared to this, mm: parts that were placed at a distance have it but for rounding."""


def roughing_mills(
    job: Job, mills: list[Tool], part: shapely.Geometry, framed: bool | None = None, wide: float = 1.0
) -> list[Tool]:
    """The mills whose channel around the part, ``wide`` diameters, leaves a frame, largest first.

    Without tabs a frame is only nice to have; with them (``framed``, by default if the job has tabs) it is an
    error if no mill leaves one.
    """
    apart = _neighbour(job, part)
    fit = [mill for mill in mills if _has_frame(job, part, channel_width(job, mill, wide), apart)]
    if fit or not (bool(job.tabs) if framed is None else framed):
        return fit or mills
    least = channel_width(job, mills[-1], wide)
    if apart < 2 * least + LEAST_FRAME:
        raise DesignError(
            f"cam.nest.gap: {apart:.2f} mm between the parts of {job.part.name} leave no frame between two "
            f"channels of {least:.2f} mm; use at least {math.ceil(2 * least + LEAST_FRAME):g} mm"
        )
    x0, y0, x1, y1 = part.bounds
    margin = min(x0 - job.stock[0], y0 - job.stock[1], job.stock[2] - x1, job.stock[3] - y1)
    raise DesignError(
        f"cam.stock: a margin of {margin:.2f} mm leaves no frame for the tabs of part {job.part.name} beside "
        f"a channel of {least:.2f} mm; use at least {math.ceil(least + LEAST_FRAME):g} mm"
        + (", or hold by the bore" if can_be_clamped(job.part) and not isinstance(job.part, Nest) else "")
    )


def channel_width(job: Job, mill: Tool, wide: float = 1.0) -> float:
    """Width of the channel that a mill opens around the part, so many diameters and what is left, mm."""
    return wide * mill.diameter + max(job.settings.stock_to_leave, SLACK)


def _has_frame(job: Job, part: shapely.Geometry, width: float, apart: float) -> bool:
    """Whether the stock around a channel of this width is one ring at least LEAST_FRAME wide.

    The next part of a nest is so far ``apart``, mm.
    """
    x0, y0, x1, y1 = part.bounds
    far = width + LEAST_FRAME
    return bool(
        x0 - far >= job.stock[0]
        and y0 - far >= job.stock[1]
        and x1 + far <= job.stock[2]
        and y1 + far <= job.stock[3]
        and apart >= width + far - NEARLY
    )


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


def channel_of(
    job: Job, part: shapely.Polygon, mill: Tool, wide: float = 1.0
) -> tuple[shapely.Geometry, shapely.Geometry | None]:
    """What has to go around the part, and the outer limit of the channel."""
    width = channel_width(job, mill, wide)
    thin = thinned(part)  # the finishing of the wall does not depend on it
    if not _has_frame(job, part, width, _neighbour(job, part)):
        # The channel breaks out of the plate: the corners would come loose, so all of the plate goes.
        if job.settings.stock.finished:
            return surrounding_stock(shapely.box(*job.stock), part), None
        return shapely.box(*job.stock).difference(thin), None
    # Whatever the channel encloses would come loose, so it goes as well.
    near = roughly_swollen(part, width - mill.radius)
    channel = _with_strips(simplified(filled(grow(near, mill.radius, ROUGH)), ROUGH))
    return channel.difference(thin), channel


def _with_strips(channel: shapely.Geometry) -> shapely.Geometry:
    """The channel with the strips of stock that it would leave standing in slots: they bend and break off."""
    closed = grow(grow(channel, STRIP / 2, ROUGH), -STRIP / 2, ROUGH)
    strips = [piece for piece in polygons(closed.difference(channel)) if piece.area >= STRIP**2]
    if not strips:
        return channel
    wide = [piece.buffer(ROUGH) for piece in strips]  # they meet the channel, rounding or not
    return simplified(filled(shapely.union_all([channel, *wide])), ROUGH)


def outside_mills(mills: Sequence[Tool], part: shapely.Geometry, allowance: float, bias: float) -> list[Tool]:
    """The mills for an outside, without those as wide as one of its slots if there is a smaller one."""
    last = mills[-1]
    return [m for m in mills if m is last or not fills_a_slot(m.radius, part, allowance, bias)]


@lru_cache(maxsize=64)
def fills_a_slot(radius: float, part: shapely.Geometry, allowance: float, bias: float) -> bool:
    """Whether a mill of this radius, mm, enters a slot of the part that has no room for its allowance.

    Its finishing path runs ``bias`` off the wall, mm.
    """
    allowance = max(allowance, bias)
    if not _may_fill(radius, part, allowance, bias):
        return False
    only = shapely.difference(closing(part, radius + allowance), closing(part, radius + bias))
    return not shapely.is_empty(buffered(only, -FILLS * radius, 8))


def _may_fill(radius: float, part: shapely.Geometry, allowance: float, bias: float) -> bool:
    """A first look at thinned shapes, which never says no where the exact ones say yes.

    A disc of FILLS radii stands in what only the mill without its allowance reaches: its middle is within a
    radius of a place of the mill's centre, and a radius and its own size away from all places with allowance.
    """
    apart = FILLS * radius + allowance - bias
    roomless = grow(roughly_swollen(part, radius + allowance), -apart, ROUGH)
    closed = roughly_swollen(part, radius + bias - ROUGHLY)
    return not shapely.is_empty(shapely.difference(roomless, closed))
