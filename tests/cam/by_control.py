"""The built-in controls by name; and proof and reader, which take LinuxCNC where a test names no control."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from mechwright.plugins.host import host
from mechwright_cam import exactness, proof
from mechwright_cam.controls import reading
from mechwright_cam.controls.contract import Control
from mechwright_cam.controls.dialect import Dialect
from mechwright_cam.controls.gcode import GcodeControl
from mechwright_cam.controls.reading import Run
from mechwright_cam.pages import setup_sheet
from mechwright_cam.pages.setup_sheet import procedure
from mechwright_cam.planning import plan
from mechwright_cam.program.moves import Program
from mechwright_cam.proof import judge
from mechwright_cam.proof.found_tabs import with_found_tabs
from mechwright_cam.proof.rules import ask
from mechwright_cam.proof.simulation import Simulation, simulate
from mechwright_cam.setup.job import Job

BY_NAME: dict[str, GcodeControl] = {
    name: registered.item
    for name, registered in host().of(Control).items()
    if registered.distribution == "mechwright" and isinstance(registered.item, GcodeControl)
}
EVERY = tuple(BY_NAME)
CONTROLS = tuple(name for name, control in BY_NAME.items() if control.dialect.translate is None)
"""Those whose own words are RS274's; of the others test_siemens.py tells what their words are."""
LINUXCNC = BY_NAME["linuxcnc"]


def interpret(text: str, reader: GcodeControl | Dialect = LINUXCNC, **settings: Any) -> Run:
    """Run a text as a control reads it, or one of a dialect of its own."""
    dialect = reader if isinstance(reader, Dialect) else replace(reader.dialect, name=reader.title)
    return reading.interpret(text, dialect, **settings)


def prove(text: str | Mapping[str, str], job: Job, control: Control = LINUXCNC) -> proof.Proof:
    return proof.prove(text, job, control)


RULES = {rule.name: rule for rule in judge.RULES}


def asked(check: str, text: str | Mapping[str, str], job: Job, control: Control = LINUXCNC) -> proof.Check:
    """What one rule of the proof says of a program without optional lines; no other one is asked."""
    return ask(RULES[check], with_found_tabs(scene_of(text, job, control)))


def posted(of: Job, program: Program | None = None, control: Control = LINUXCNC) -> str:
    """The text of a job's program as machining writes it: each operation with its tolerance."""
    return control.write(settled(plan(of) if program is None else program, of, control))


def settled(program: Program, of: Job, control: Control = LINUXCNC) -> Program:
    """A program with the tolerance of each operation."""
    return exactness.posted(program, of, control)[0]


def read(text: str | Mapping[str, str], job: Job, control: Control = LINUXCNC, more: float = 0.0) -> Run:
    return scene_of(text, job, control).read(more)


def scene_of(text: str | Mapping[str, str], job: Job, control: Control = LINUXCNC) -> proof.Scene:
    return proof.Scene(text, job, control)


def simulated(text: str, job: Job) -> Simulation:
    return simulate(scene_of(text, job).paths, job)


def cut_away(text: str | Mapping[str, str], job: Job, control: Control = LINUXCNC) -> Any:
    return proof.cut_away(scene_of(text, job, control))


def setup_html(job: Job, program: Any, proof: Any = None, control: Control | None = None, **more: Any) -> str:
    """The setup sheet, for the control that the job names."""
    return setup_sheet.setup_html(job, program, proof, control or BY_NAME[job.settings.control], **more)


def summary_html(
    programs: Sequence[tuple[Job, Any, Any]], control: Control | None = None, **more: Any
) -> str:
    return setup_sheet.summary_html(programs, control or BY_NAME[programs[0][0].settings.control], **more)


def steps(job: Job, tools: Sequence[int], **more: Any) -> list[procedure.Step]:
    return procedure.steps(job, BY_NAME[job.settings.control], tools, **more)
