"""What a program writes into the tables of the control: only the job's own offsets, as they were measured."""

import re

from mechwright_cam.controls.reading.run import TableWrite
from mechwright_cam.proof.offset_rules import LAST_DECIMAL
from mechwright_cam.proof.report import Check
from mechwright_cam.proof.scene import Scene

_ROWS = (
    (r"G(5[4-9])", 2, -53),
    (r"G59\.([1-3])", 2, 6),
    (r"(?:G54\.1|G154) P(\d+)", 20, 0),
)
"""How work offsets are spelt, the L of G10 that sets them, and what to add to their number for its P."""


def offset_tables(scene: Scene) -> Check:
    """G10 sets the job's work offset and the lengths of its tools to what was measured, and nothing else."""
    for write in scene.run.writes:
        wrong = _wrong(scene, write)
        if wrong:
            return scene.bad(write.step, f"{_spelt(write)} {wrong}")
    return Check(True, "the program writes no offset but the job's own")


def _wrong(scene: Scene, write: TableWrite) -> str:
    """What is wrong with one G10, and what to do; nothing if it is the job's own."""
    if write.incremental:
        return "while G91 is in force may add to what the table holds; write G90 before it"
    job = scene.job
    offset, lengths = job.settings.work_offset, scene.control.length_write
    own: dict[str, tuple[str, float | None]] = {}
    if (write.table, write.number) == _place_of(offset):
        own = {
            axis: (f"cam.measured.{axis.lower()}", getattr(job.settings.measured, axis.lower()))
            for axis in "XYZ"
        }
    elif lengths is not None and write.table == lengths[0] and write.number in scene.tools:
        tool = scene.tools[write.number]
        own = {lengths[1]: (f"cam.measured.lengths.{tool.name}", tool.length)}
    if not own or not write.values:
        return f"writes into a table that this job leaves alone ({_allowed(scene)}); take it out"
    for letter, value in write.values.items():
        if letter not in own:
            return f"sets {letter}, which this job leaves alone; take it out"
        key, planned = own[letter]
        if planned is None:
            return f"sets {letter}{value:g}, and {key} is not given; measure it, or take it out"
        if not abs(value - planned) <= LAST_DECIMAL:
            return f"sets {letter}{value:g}, {key} is {planned:g}; write that, or take it out"
    return ""


def _place_of(offset: str) -> tuple[int, int]:
    """L and P of the G10 that sets a work offset."""
    for pattern, table, more in _ROWS:
        if match := re.fullmatch(pattern, offset):
            return table, int(match[1]) + more
    return 0, 0


def _allowed(scene: Scene) -> str:
    """The G10 that may stand in a program of this job."""
    offset = scene.job.settings.work_offset
    words = "its own: G10 L{} P{} for {}".format(*_place_of(offset), offset)
    if scene.control.length_write is not None:
        words += f", L{scene.control.length_write[0]} for the lengths of its tools"
    return words


def _spelt(write: TableWrite) -> str:
    return f"G10 L{write.table} P{write.number}"
