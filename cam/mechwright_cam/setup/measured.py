"""Whether one measured work offset can be that of several programs, which all write it (``post.offsets``)."""

from collections.abc import Iterator, Sequence

from mechwright.contracts.finding import Finding
from mechwright_cam.setup.job import Job

INDICATED = 0.01
"""Places and thicknesses that differ by less are the same, mm: what a plate is indicated to."""


def check_measured(jobs: Sequence[Job]) -> Iterator[Finding]:
    """Programs that write one measured place, though their zeros lie at different heights or places.

    Z0 is the top of the plate, so plates of different thickness on one table differ in Z. X0 Y0 may be as far
    from the edges as it likes where parts are held by a bore, on one arbor; against stops it may not.
    """
    first: dict[tuple[object, ...], Job] = {}
    for job in jobs:
        cam = job.settings
        if not cam.post.offsets or cam.measured.z is None:  # posts say that it is missing
            continue
        place = (cam.work_offset, cam.measured.x, cam.measured.y, cam.measured.z)
        other = first.setdefault(place, job)
        where = f"{other.part.name} and {job.part.name} both set {cam.work_offset}"
        own = f"measure {job.part.name} for itself in [cam.part.{job.part.name}.measured]"
        remedy = (
            own if job.side == "top" else "leave x, y and z out of cam.second_side, and set it at the machine"
        )
        (x, y), (u, v) = other.datum, job.datum
        if abs(job.thickness - other.thickness) > INDICATED:
            thick = f"{other.thickness:g} and {job.thickness:g} mm thick"
            message = f"{where} Z to the same, and their plates are {thick}"
            yield Finding.error(
                "cam.measured", "cam.measured.z", message, cam.measured.z, unit="mm", remedy=remedy
            )
        elif job.clamp is None and max(abs(x - u), abs(y - v)) > INDICATED:
            message = (
                f"{where} X and Y to the same, and X0 Y0 is elsewhere on their plates: the probed edges "
                f"are at X{x:.2f} Y{y:.2f} and at X{u:.2f} Y{v:.2f}"
            )
            remedy += ', or use origin = "corner"' if job.side == "top" else ""
            yield Finding.warning("cam.measured", "cam.measured", message, remedy=remedy)
