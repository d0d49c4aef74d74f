"""How exactly each operation has to be run: as loosely as the part allows.

A control that can be asked to stay near the path is asked per operation. What leaves stock may be rounded; a
finishing pass together with what its path cuts stays within the limit of a gouge; and where the control would
be off by more than it is asked for, it is to go exactly to every corner.
"""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from mechwright.arrays import Array
from mechwright.tolerances import TOLERANCES
from mechwright_cam.controls.contract import Control
from mechwright_cam.controls.reading import Run
from mechwright_cam.controls.reading.run import Ints
from mechwright_cam.program.moves import OPERATION_COMMENT, Feed, FeedArc, Operation, Program
from mechwright_cam.proof.off_path import flat, too_deep
from mechwright_cam.proof.paths import Paths
from mechwright_cam.proof.scene import Scene
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.machine import Machine
from mechwright_cam.shop.tool import MILLS, Tool

LIKELY = (0.5, 1.0, 2.0)
"""The program has to do on machines with so many times the stated acceleration: it is rarely known better."""
BUDGET = TOLERANCES.gouge - 0.1 * TOLERANCES.arc_fit
"""Most that path and control may cut together, mm: less than the proof's limit by the last digits."""


def settled(program: Program, job: Job, control: Control) -> Program:
    """The program with the loosest tolerance for each operation that keeps its tool out of the part.

    Holes and details are left as the control is usually asked for: nothing is won there.
    """
    levels = control.tolerances
    every = [(section.tool, operation) for section in program.sections for operation in section.operations]
    clearing = {number for number, (tool, operation) in enumerate(every) if _clears(tool, operation)}
    if not levels or program.posting.exact_stop or not clearing:
        return program
    scene = Scene(_text(_with(program, dict.fromkeys(clearing, levels[0])), control), job, control)
    starts = _starts(scene.run)
    if len(starts) != len(every):
        return program  # a text whose operations cannot be told apart
    number = np.searchsorted(starts, np.arange(len(scene.run)), side="right") - 1
    chosen: dict[int, float] = {}
    for level in levels[:-1]:
        asked = _asked(scene.run, level)
        paths = Paths(asked, job.tools)
        paths.steps = paths.steps[np.isin(number[paths.steps], list(clearing - chosen.keys()))]
        off = _off(asked, control, program.machine)
        loose: set[int] = set()
        while (far := too_deep(paths, job, off, BUDGET)).any():
            loose |= set(number[far].tolist())
            paths.steps = paths.steps[~np.isin(number[paths.steps], list(loose))]
            if flat(paths)[paths.steps].all():
                break  # all of them have been told at once
        chosen |= dict.fromkeys(clearing - chosen.keys() - loose, level)
    return _with(program, dict.fromkeys(clearing, levels[-1]) | chosen)


def _clears(tool: Tool, operation: Operation) -> bool:
    """Whether a mill cuts in an operation, elsewhere than straight down."""
    return tool.kind in MILLS and any(isinstance(move, Feed | FeedArc) for move in operation.moves)


def _with(program: Program, tolerances: Mapping[int, float]) -> Program:
    """The program with tolerances by number of the operation."""
    number, sections = 0, []
    for section in program.sections:
        operations = []
        for operation in section.operations:
            operations.append(replace(operation, tolerance=tolerances.get(number)))
            number += 1
        sections.append(replace(section, operations=tuple(operations)))
    return replace(program, sections=tuple(sections))


def _text(program: Program, control: Control) -> str | Mapping[str, str]:
    files = control.files(program)
    return files if len(files) > 1 else next(iter(files.values()))


def _starts(run: Run) -> Ints:
    """Step at which each operation begins."""
    return np.array(
        [r.step for r in run.remarks if r.text.lower().startswith(OPERATION_COMMENT)], dtype=np.int64
    )


def _asked(run: Run, tolerance: float) -> Run:
    """The same run with all of it under one tolerance."""
    states = tuple(replace(state, off_path=tolerance, blend=tolerance) for state in run.states)
    return replace(run, states=states)


def _off(run: Run, control: Control, machine: Machine) -> Array:
    """How far (n,) each step may be off the path on any of the machines that this one may be, mm."""
    likely = [machine.model_copy(update={"acceleration": share * machine.acceleration}) for share in LIKELY]
    return np.asarray(np.max([control.lookahead.motion(run, one).off for one in likely], axis=0))
