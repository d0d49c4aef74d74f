"""What holds a plate where neither tabs nor a bore nor a vice do."""

from mechwright_cam.setup.job import Job
from mechwright_cam.shop.lengths import Lengths

BEDS = {
    "vacuum": "The plate lies on a vacuum table: all of it, with no leak under what is cut through.",
    "tape": "Stick the plate down with double-sided tape all over, on a flat board; degrease both.",
}


def bed_and_clamp_lines(job: Job, to: Lengths) -> list[str]:
    """A line for the bed, and one for each clamp on the plate."""
    bed = job.settings.hold.bed
    lines = [] if bed is None else [BEDS[bed]]
    for toe in job.toes:
        x0, y0, x1, y1 = (to.signed(value, 1) for value in toe.shape.bounds)
        lines.append(
            f"Toe clamp {toe.number}: from X {x0} to {x1} and Y {y0} to {y1}, bolt and all, and no higher "
            f"than Z {to.signed(toe.top, 1)}."
        )
    return lines
