"""Whether a mill fills a slot of an outside: no stock would stay on its walls for finishing.

Where such a mill can be but one with its allowance cannot, its centre runs along the middle of the slot, and
farther than the mill's radius from any place where there is room for the allowance. Whether there is any such
place shows on thinned shapes, on the safe side; only then the exact ones are looked at.
"""

from collections.abc import Sequence
from functools import lru_cache

import shapely

from mechwright_cam.plane.buffers import buffered
from mechwright_cam.plane.offsets import ROUGH, grow
from mechwright_cam.plane.reach import ROUGHLY, closing, roughly_swollen
from mechwright_cam.shop.tool import Tool

FILLS = 0.9
"""Share of a mill's radius. Where a disc of this size has room that a mill with its allowance cannot enter,
the walls are parallel, and as far apart as the mill is wide: a corner of 25 degrees or more has no such room
for mills from 1 mm and the usual allowance on."""


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
