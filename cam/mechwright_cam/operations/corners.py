"""What is worth knowing of corners and passages that the mills of a zone do not reach."""

from functools import lru_cache

import shapely

from mechwright.contracts.finding import Finding, Severity
from mechwright.tolerances import TOLERANCES
from mechwright_cam.operations.zone import Zone
from mechwright_cam.plane.offsets import ROUGH, grow
from mechwright_cam.plane.reach import remainder
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.cutter import SAME_RADIUS

MOSTLY = 0.9
"""A recess of which the mills reach less than this is hardly what was drawn."""


def corner_remarks(zone: Zone, job: Job, slack: float = 0.0) -> list[Finding]:
    """The remainder on the wall of a zone, and at its foot; its finisher reaches ``slack`` mm further."""
    share, depth = _reached(zone.like or zone, slack, job.wear_margin)
    found = [*_partly(job, zone, share), *_fillet(job, zone)]
    if depth > TOLERANCES.leftover:
        message = f"{zone.finisher.name} leaves up to {depth:.3f} mm in corners of {zone.name}"
        found.append(_unreachable(job, message, depth, TOLERANCES.leftover))
    return found


@lru_cache(maxsize=64)
def _reached(zone: Zone, slack: float, wear: float) -> tuple[float, float]:
    """The part of a recess that its finisher reaches, and the most that it leaves on its wall, mm."""
    radius, share = zone.reach_radius - slack, 1.0
    if zone.kind != "outside":
        must = zone.clear if zone.must is None else zone.must
        reach = grow(grow(zone.clear, -radius, ROUGH), radius, ROUGH)
        share = float(shapely.intersection(reach, must).area / must.area)
    return share, remainder(zone.wall, radius + wear, zone.must)


def _unreachable(job: Job, message: str, value: float, limit: float, remedy: str = "") -> Finding:
    what = f"{message} of {job.part.name}"
    return Finding("cam.unreachable", Severity.NOTE, "cam.tools", what, value, limit, "mm", remedy)


def _fillet(job: Job, zone: Zone) -> list[Finding]:
    """The fillet that a round mill leaves at the foot of a wall where none is drawn."""
    last = zone.finishers[0]
    if zone.through or last.nose <= zone.floor_radius + SAME_RADIUS:
        return []
    message = f"{last.name} leaves a fillet of {last.nose:g} mm at the foot of {zone.name}"
    return [_unreachable(job, message, last.nose, zone.floor_radius, "list a flat end mill as well")]


def _partly(job: Job, zone: Zone, share: float) -> list[Finding]:
    """Whether much of a recess is too narrow for all its mills."""
    if share >= MOSTLY:
        return []
    return [
        Finding(
            "cam.partly",
            Severity.WARNING,
            "cam.tools",
            f"{zone.finisher.name} reaches {100 * share:.0f} % of {zone.name} of {job.part.name}",
            100 * share,
            100 * MOSTLY,
            "%",
            "list a smaller end mill",
        )
    ]
