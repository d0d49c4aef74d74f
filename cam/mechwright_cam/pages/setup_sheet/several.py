"""How many of a part are made, at how many work offsets at once, and from how many files."""

import math
from collections.abc import Sequence

from mechwright_cam.controls.contract import Control
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.lengths import Lengths


def quantity(job: Job) -> int:
    """How many of the part the mechanism needs."""
    return max(1, len(job.part.instances))


def runs(job: Job) -> int:
    """How often the program is run for them: each run makes one at every work offset."""
    return math.ceil(quantity(job) / len(job.settings.offsets))


def quantity_text(job: Job) -> str:
    """How many are needed, and how many a run makes where that is more than one."""
    each = len(job.settings.offsets)
    return f"{quantity(job)}" if each == 1 else f"{quantity(job)} ({each} in a run)"


def in_order(file_names: Sequence[str]) -> str:
    """The files of a program in the order in which they are run."""
    if len(file_names) == 1:
        return file_names[0]
    return f"{', '.join(file_names[:-1])} and {file_names[-1]}, one after the other"


def active_words(job: Job, control: Control) -> str:
    """What is said of the work offsets before the run."""
    names = [control.offset_words(offset) for offset in job.settings.offsets]
    if len(names) == 1:
        return f"{names[0]} must be the active offset."
    return f"The program goes to {', '.join(names[:-1])} and {names[-1]} by itself, tool by tool."


def about_others(
    job: Job, control: Control, reach: tuple[float, float, float, float] | None, to: Lengths, *, touched: bool
) -> tuple[str, ...]:
    """What is to be seen to at the further work offsets.

    ``reach`` is what cutters cover below the rapids, mm; with ``touched`` tools are touched off one by one.
    """
    others = " and ".join(map(control.offset_words, job.settings.more_offsets))
    lines = [
        f"One more plate of the same size for each of {others}: clamp it like the first one, and set "
        f"{'X and Y' if touched else 'X, Y and Z'} of its work offset on it in the same way."
    ]
    if not touched:
        lines.append("Tool lengths are measured once, on the first plate, and hold for all.")
    if reach is not None:
        (x0, y0, x1, y1), (left, front, right, rear) = reach, job.stock
        across, along = max(x1 - left, right - x0), max(y1 - front, rear - y0)
        lines.append(
            f"From zero to zero they lie at least {to.fixed(across, 1)} {to.unit} apart in X, or "
            f"{to.fixed(along, 1)} {to.unit} in Y: so far do cutters reach. Clamps and holders come to that."
        )
    return tuple(lines)
