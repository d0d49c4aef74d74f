"""That plates which are clamped one by one fit on one plate: a nest takes fewer clampings."""

from collections.abc import Iterator, Sequence

from mechwright.contracts.finding import Finding, Severity
from mechwright.errors import DesignError
from mechwright_cam.planning.nesting import MOST, copies, nest_of
from mechwright_cam.setup.clamping import rim_margins, widest_channel
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.holding import Stock
from mechwright_cam.shop.packing import WEB
from mechwright_cam.shop.table import JobSettings
from mechwright_plane.nest import Nest


def nest_notes(settings: JobSettings, jobs: Sequence[Job]) -> Iterator[Finding]:
    """A note for the plates that are alike in material and thickness, and that the machine has room for.

    Parts with settings of their own, of both sides, or out of stock of a stated size are left alone.
    """
    turned = {job.part.name.removesuffix("-underside") for job in jobs if job.side == "underside"}
    alike: dict[tuple[str, float], list[Job]] = {}
    for job in jobs:
        own = job.part.name in settings.parts or job.part.name in turned or job.side == "underside"
        if not own and job.settings.hold.method == "tabs" and not isinstance(job.part, Nest):
            alike.setdefault((job.part.material, job.part.thickness), []).append(job)
    if settings.cam.nest is not None or settings.cam.stock != Stock():
        return
    for (material, thickness), group in alike.items():
        total = sum(copies(job.part) for job in group)
        if 1 < total <= MOST and _fits(group):
            names = ", ".join(job.part.name for job in group)
            message = (
                f"{total} plates of {material} {thickness:g} mm are clamped one by one: {names}; a nest of "
                f"them is clamped once"
            )
            yield Finding(
                "cam.nest-fits", Severity.NOTE, "cam.nest", message, total, remedy="add the table [cam.nest]"
            )


def _fits(group: Sequence[Job]) -> bool:
    """Whether the nest of some jobs, with its rim, lies within the travel of the machine."""
    settings, channel = group[0].settings, max(map(widest_channel, group))
    try:
        nest = nest_of("nest", [job.part for job in group], settings, 2 * channel + WEB)
    except DesignError:  # a blank in hand is too small for all of them
        return False
    assert nest.outline is not None  # noqa: S101 - a nest is a plate
    x0, y0, x1, y1 = nest.outline.bounds
    mx, my = rim_margins(x1 - x0, y1 - y0, channel)
    machine = settings.machine
    return x1 - x0 + 2 * mx <= machine.travel_x and y1 - y0 + 2 * my <= machine.travel_y
