"""What is to be seen to before a program probes a stock, or measures tools."""

from collections.abc import Sequence

from mechwright_cam.controls.contract import Control
from mechwright_cam.pages.setup_sheet.several import in_order
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


def about_measuring(job: Job, control: Control, files: Sequence[str], to: Lengths) -> tuple[str, ...]:
    """How the programs that measure tools are used, and what they rely on."""
    setter, offset = job.settings.setter, control.offset_words(job.settings.work_offset)
    assert setter.x is not None and setter.y is not None and setter.over is not None  # noqa: S101, PT018
    place = f"machine X {to.signed(setter.x)}, Y {to.signed(setter.y)}"
    each = (
        f"{in_order(files)} measures all tools on the setter and writes their lengths into the tool table."
        if control.offsets.lengths
        else f"Before each file run its own of {', '.join(files)}, with the tool put in: it sets {offset} Z."
    )
    first = f" Set {offset} Z first." if control.offsets.lengths else ""
    return (
        f"{each} The setter stands at {place}; its top is {to.signed(setter.over)} {to.unit} from "
        f"the top of the stock.{first}",
        "They cut nothing: the spindle stays off, X and Y move at the upper end, and each tool touches "
        "twice. Press the setter with a finger first: the control has to see it.",
        f"A touch that meets nothing {to.with_unit(setter.travel)} below its start, or a setter that is "
        "pressed already, ends the program, and nothing of that tool has been written.",
    )
