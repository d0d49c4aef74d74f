"""How deep cuts go.

A floor is finished all over at one height, whatever steps and cutters roughed it, and before the walls: what
stands in front of these then is the same from top to bottom.
"""

from mechwright.contracts.part import Bore
from mechwright.tolerances import TOLERANCES
from mechwright_cam.setup.job import Job

LARGEST_SHARE = 0.5
"""Most of a recess's depth that is left for its floor: roughing takes at least as much as finishing."""


def through(job: Job, depth: float) -> bool:
    """Whether a feature of this depth goes through the plate."""
    return depth >= job.thickness - TOLERANCES.noise


def bottom_of(job: Job, top: float, depth: float) -> float:
    """Height z of the bottom of a cut; through cuts go below the plate."""
    return job.floor if through(job, top + depth) else -(top + depth)


def floor_allowance(job: Job, top: float, bottom: float) -> float:
    """What roughing leaves above the bottom of a cut, mm; nothing where that is not in the plate."""
    if bottom <= job.floor:
        return 0.0
    return min(job.settings.floor_to_leave, LARGEST_SHARE * (top - bottom))


def bores(job: Job) -> list[Bore]:
    """The round holes."""
    return [feature for feature in job.features if isinstance(feature, Bore)]
