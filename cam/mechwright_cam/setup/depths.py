"""How deep cuts go."""

from mechwright.contracts.part import Bore
from mechwright.tolerances import TOLERANCES
from mechwright_cam.setup.job import Job


def through(job: Job, depth: float) -> bool:
    """Whether a feature of this depth goes through the plate."""
    return depth >= job.thickness - TOLERANCES.noise


def bottom_of(job: Job, top: float, depth: float) -> float:
    """Height z of the bottom of a cut; through cuts go below the plate."""
    return job.floor if through(job, top + depth) else -(top + depth)


def bores(job: Job) -> list[Bore]:
    """The round holes."""
    return [feature for feature in job.features if isinstance(feature, Bore)]
