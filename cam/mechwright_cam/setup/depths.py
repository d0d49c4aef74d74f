"""How deep cuts go.

A floor is finished all over at one height, whatever steps and cutters roughed it, and before the walls: what
stands in front of these then is the same from top to bottom.
"""

import math

from mechwright.contracts.details import CORE_PLAY, Thread
from mechwright.contracts.part import Bore
from mechwright.tolerances import TOLERANCES
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.tool import Tool, ToolKind

SAME_THREAD = 0.005
"""Sizes of a tap and a thread that differ by no more are the same, mm: inches are rounded in many lists."""
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


def core_of(job: Job, thread: Thread) -> Bore | None:
    """The hole in which a thread is cut: about its axis, of its core diameter, and deep enough."""
    for bore in bores(job):
        coaxial = math.dist(bore.centre, thread.centre) < TOLERANCES.closure
        near = abs(bore.diameter - thread.core) <= CORE_PLAY * thread.pitch
        if coaxial and near and bore.depth >= thread.depth:
            return bore
    return None


def thread_in(job: Job, bore: Bore) -> Thread | None:
    """The thread of which a hole is the core; None for any other hole."""
    threads = (detail for detail in job.details if isinstance(detail, Thread))
    return next((thread for thread in threads if core_of(job, thread) is bore), None)


def makes(tap: Tool, thread: Thread) -> bool:
    """Whether a tap is one of a thread: of its diameter, pitch and hand."""
    return (
        tap.kind is ToolKind.TAP
        and tap.left_hand == thread.left
        and abs(tap.diameter - thread.diameter) <= SAME_THREAD
        and abs((tap.pitch or 0.0) - thread.pitch) <= SAME_THREAD
    )


def tapped_deep(tap: Tool, thread: Thread) -> float:
    """How deep the tip of a tap goes for the last full turn of a thread, mm: by its chamfer deeper."""
    return thread.depth + tap.point_length
