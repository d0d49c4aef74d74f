"""What is worth knowing of corners and passages that the mills of a zone do not reach."""

from functools import lru_cache

import shapely

from mechwright.contracts.finding import Finding, Severity
from mechwright.tolerances import TOLERANCES
from mechwright_cam.operations.zone import Zone
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.cutter import SAME_RADIUS
from mechwright_plane.offsets import swept
from mechwright_plane.reach import remainder

MOSTLY = 0.9
"""A recess of which the mills reach less than this is hardly what was drawn."""


def corner_remarks(zone: Zone, job: Job, slack: float = 0.0) -> list[Finding]:
    """The remainder on the wall of a zone, and at its foot; its finisher reaches ``slack`` mm further."""
    share, depth = _reached(zone.like or zone, slack, job.wear_margin)
    found, where, first = [], f"{zone.name} of {job.part.name}", zone.finishers[0]
    if share < MOSTLY:  # much of a recess is too narrow for all its mills
        message = f"{zone.finisher.name} reaches {100 * share:.0f} % of {where}"
        figures = (100 * share, 100 * MOSTLY, "%", "list a smaller end mill")
        found.append(Finding.warning("cam.partly", "cam.tools", message, *figures))
    if not zone.through and first.nose > zone.floor_radius + SAME_RADIUS:  # a fillet where none is drawn
        message = f"{first.name} leaves a fillet of {first.nose:g} mm at the foot of {where}"
        remedy = "list a flat end mill as well"
        found.append(_unreachable(message, first.nose, zone.floor_radius, remedy))
    if depth > TOLERANCES.leftover:
        message = f"{zone.finisher.name} leaves up to {depth:.3f} mm in corners of {where}"
        found.append(_unreachable(message, depth, TOLERANCES.leftover))
    return found


@lru_cache(maxsize=64)
def _reached(zone: Zone, slack: float, wear: float) -> tuple[float, float]:
    """The part of a recess that its finisher reaches, and the most that it leaves on its wall, mm."""
    radius, share = zone.reach_radius - slack, 1.0
    if zone.kind != "outside":
        must = zone.clear if zone.must is None else zone.must
        share = float(shapely.intersection(swept(zone.clear, radius), must).area / must.area)
    return share, remainder(zone.wall, radius + wear, zone.must)


def _unreachable(message: str, value: float, limit: float, remedy: str = "") -> Finding:
    return Finding("cam.unreachable", Severity.NOTE, "cam.tools", message, value, limit, "mm", remedy)
