"""Floors of recesses: roughing stops a little above, and a pass of their own takes the rest.

The floor is finished all over at one height, whatever steps and cutters roughed it, and before the walls:
what stands in front of these then is the same from top to bottom.
"""

from dataclasses import replace
from itertools import pairwise

import shapely

from mechwright_cam.operations.stock import Stock
from mechwright_cam.operations.zone import Zone
from mechwright_cam.setup.job import Job

LARGEST_SHARE = 0.5
"""Most of a recess's depth that is left for its floor: roughing takes at least as much as finishing."""


def floor_allowance(job: Job, top: float, bottom: float) -> float:
    """What roughing leaves above the bottom of a cut, mm; nothing where that is not in the plate."""
    if bottom <= job.floor:
        return 0.0
    return min(job.settings.floor_to_leave, LARGEST_SHARE * (top - bottom))


OPENED = 0.05
"""Share of a recess that has to be open from below before it is cut in two layers for it."""
THIN = 0.2
"""A layer that begins or ends so near to an opening, mm, is not divided there."""


def over_openings(zone: Zone, stock: Stock) -> list[tuple[Zone, Stock]]:
    """A recess in layers from the top down, each without what earlier setups have opened from below."""
    inside = [
        air.top
        for air in stock.gone
        if zone.bottom + THIN < air.top < zone.top - THIN
        and shapely.intersection(air.shape, stock.left).area > OPENED * stock.left.area
    ]
    heights = [zone.top, *sorted(set(inside), reverse=True), zone.bottom]
    found = []
    for place, (top, bottom) in enumerate(pairwise(heights)):
        name = zone.name if place == 0 else f"{zone.name} around the opening"
        layer = replace(zone, name=name, top=top, bottom=bottom)
        found.append((layer, stock.without(stock.air_below(top)) if stock.gone else stock))
    return found
