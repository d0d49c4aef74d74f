"""Whether one measured work offset can be that of several programs, which all write it (``post.offsets``)."""

from collections.abc import Sequence

from mechwright.contracts.finding import Finding, Severity
from mechwright_cam.setup.job import Job

INDICATED = 0.01
"""Places and thicknesses that differ by less are the same, mm: what a plate is indicated to."""


def check_measured(jobs: Sequence[Job]) -> list[Finding]:
    """Programs that write one measured place, though their zeros lie at different heights or places.

    Z0 is the top of the plate, so plates of different thickness on one table differ in Z. X0 Y0 may be as far
    from the edges as it likes where parts are held by a bore, on one arbor; against stops it may not.
    """
    found: list[Finding] = []
    first: dict[tuple[object, ...], Job] = {}
    for job in jobs:
        cam = job.settings
        if not cam.post.offsets or cam.measured.z is None:  # posts say that it is missing
            continue
        place = (cam.work_offset, cam.measured.x, cam.measured.y, cam.measured.z)
        other = first.setdefault(place, job)
        where = f"{other.part.name} and {job.part.name} both set {cam.work_offset}"
        remedy = (
            f"measure {job.part.name} for itself in [cam.part.{job.part.name}.measured]"
            if job.side == "top"
            else "leave x, y and z out of cam.second_side, and set it at the machine"
        )
        if abs(job.thickness - other.thickness) > INDICATED:
            found.append(
                Finding(
                    "cam.measured",
                    Severity.ERROR,
                    "cam.measured.z",
                    f"{where} Z to the same, and their plates are {other.thickness:g} and "
                    f"{job.thickness:g} mm thick",
                    cam.measured.z,
                    unit="mm",
                    remedy=remedy,
                )
            )
        elif job.clamp is None and any(
            abs(a - b) > INDICATED for a, b in zip(job.datum, other.datum, strict=True)
        ):
            found.append(
                Finding(
                    "cam.measured",
                    Severity.WARNING,
                    "cam.measured",
                    f"{where} X and Y to the same, and X0 Y0 is elsewhere on their plates: the probed edges "
                    f"are at X{other.datum[0]:.2f} Y{other.datum[1]:.2f} and at X{job.datum[0]:.2f} "
                    f"Y{job.datum[1]:.2f}",
                    remedy=f'{remedy}, or use origin = "corner"' if job.side == "top" else remedy,
                )
            )
    return found
