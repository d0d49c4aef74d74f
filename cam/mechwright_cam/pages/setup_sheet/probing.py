"""What is to be seen to before a program probes."""

from mechwright_cam.setup.job import Job
from mechwright_cam.shop.lengths import Lengths


def about_probing(job: Job, offset: str, file: str, to: Lengths) -> tuple[str, ...]:
    """How the program that probes is used, and what has to be free."""
    probe, (x0, y0, x1, y1) = job.settings.probe, job.stock
    beside = to.with_unit(probe.diameter + 2 * probe.doubt + 4)
    size, left, front = to.with_unit(probe.diameter), to.signed((y0 + y1) / 2), to.signed((x0 + x1) / 2)
    return (
        f"{file} finds the stock's top and its left and front edges with the touch probe T{probe.tool} (ball "
        f"{size}) and sets {offset}. It cuts nothing, and no proof has judged it: run it in single block the "
        "first time.",
        f"Before: set {offset} by eye, to {to.with_unit(probe.doubt)} in X, Y and Z, with the probe's own "
        "length in force where the control keeps lengths. Touch the ball with a finger: the control has to "
        "see it.",
        f"Free of clamps: the top near the left front corner, the left edge at Y {left}, the front edge at "
        f"X {front}, and {beside} beside both. The left edge is touched towards X+, the front one "
        "towards Y+.",
        "A touch that meets nothing, or something on the way down, ends the program: nothing of that axis "
        "has been set then.",
    )
