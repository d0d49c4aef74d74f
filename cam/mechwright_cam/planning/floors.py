"""Floors of recesses: roughing stops a little above, and a pass of their own takes the rest.

The floor is finished all over at one height, whatever steps and cutters roughed it, and before the walls:
what stands in front of these then is the same from top to bottom.
"""

from dataclasses import replace

from mechwright_cam.job import Job
from mechwright_cam.planning.zone import Zone

LARGEST_SHARE = 0.5
"""Most of a recess's depth that is left for its floor: roughing takes at least as much as finishing."""


def floor_allowance(job: Job, top: float, bottom: float) -> float:
    """What roughing leaves above the bottom of a cut, mm; nothing where that is not in the plate."""
    if bottom <= job.floor:
        return 0.0
    return min(job.settings.floor_to_leave, LARGEST_SHARE * (top - bottom))


def layers(zone: Zone, allowance: float) -> tuple[Zone, Zone]:
    """A recess in two layers: what is roughed, and what is left on its floor."""
    height = zone.bottom + allowance
    rough, floor = replace(zone, bottom=height), replace(zone, top=height)
    rough.left = floor.left = zone.left
    return rough, floor
