"""The plate's program for each control, and lines put into it at places that matter."""

from collections.abc import Callable
from dataclasses import replace
from functools import cache

from by_control import BY_NAME
from shop import DRILL, MILL, SPOT, plate_job, plate_program

from mechwright.plugins.host import host
from mechwright_cam.controls.contract import Control
from mechwright_cam.proof import Check, Scene
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.machine import Machine
from mechwright_cam.shop.posting import Measured, Posting

RETRACT = -2.0
PLACE = {"x": -312.5, "y": -201.25, "z": -388.012}
LENGTHS = {1: 81.2, 2: 104.055, 3: 77.0}


def job_of(control: str, *, measured: bool = False, work_offset: str = "G54") -> Job:
    changes: dict[str, object] = {"control": control, "machine": {"retract_z": RETRACT}}
    if measured:
        tools = tuple(t.model_copy(update={"length": LENGTHS[t.number]}) for t in (SPOT, DRILL, MILL))
        changes |= {"tools": tools, "measured": PLACE, "work_offset": work_offset}
    return plate_job(**changes)


@cache
def text_of(control: str, *, measured: bool = False, work_offset: str = "G54") -> str:
    """The program as it is posted; with ``measured`` it sets its own offsets."""
    program = replace(plate_program(), machine=Machine(retract_z=RETRACT), work_offset=work_offset)
    if measured:
        sections = tuple(
            replace(s, tool=s.tool.model_copy(update={"length": LENGTHS[s.tool.number]}))
            for s in program.sections
        )
        program = replace(
            program, sections=sections, posting=Posting(offsets=True), measured=Measured(**PLACE)
        )
    return host().get(Control, control).write(program)


def in_cut(text: str, words: str) -> tuple[str, int]:
    """The program as far as its first cut at Z-4.8, then a line and the end; and the number of that line."""
    lines = text.splitlines()
    at = next(k for k, line in enumerate(lines) if "Z-4.8" in line) + 1
    return "\n".join([*lines[:at], words, "M30"]) + "\n", at + 1


def at_the_end(text: str, words: str) -> tuple[str, int]:
    """The program with a line before its end, where the tool is up, and the number of that line."""
    lines = text.splitlines()
    at = lines.index("M30")
    return "\n".join([*lines[:at], words, *lines[at:]]) + "\n", at + 1


def before_the_last_retract(text: str, words: str) -> tuple[str, int]:
    """The program with a line where the tool is at the clearance plane, and the number of that line."""
    lines = text.splitlines()
    at = max(k for k, line in enumerate(lines) if line == "M5") + 1
    return "\n".join([*lines[:at], words, *lines[at:]]) + "\n", at + 1


def scene_of(control: str, text: str, job: Job | None = None) -> Scene:
    return Scene(text, job or job_of(control), BY_NAME[control])


def judged(rule: Callable[[Scene], Check], control: str, text: str, job: Job | None = None) -> Check:
    return rule(scene_of(control, text, job))


def refused(
    rule: Callable[[Scene], Check], control: str, text: str, line: int, job: Job | None = None
) -> Check:
    """The failed check, which has to name the line."""
    found = judged(rule, control, text, job)
    assert not found.passed
    assert (found.line, found.message.partition(": ")[0]) == (line, f"line {line}")
    return found
