"""How exactly each operation has to be run: as loosely as the part allows.

A control that can be asked to stay near the path is asked per operation. What leaves stock may be rounded; a
finishing pass together with what its path cuts stays within the limit of a gouge; and where the control would
be off by more than it is asked for, it is to go exactly to every corner.
"""

from collections.abc import Mapping, Sequence, Set
from dataclasses import replace
from itertools import count

import numpy as np

from mechwright.arrays import Array
from mechwright.tolerances import TOLERANCES
from mechwright_cam.controls.contract import Control
from mechwright_cam.controls.reading import Run
from mechwright_cam.controls.reading.run import Ints
from mechwright_cam.program.moves import OPERATION_COMMENT, Feed, FeedArc, Operation, Program
from mechwright_cam.proof.off_path import flat
from mechwright_cam.proof.scene import Scene
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.tool import MILLS, Tool

LIKELY = (0.5, 2.0)
"""The program has to do on machines with so many times the stated acceleration, too: it is rarely known
better."""
WALLS = "finish"
"""Operations whose names end so come to walls."""
BUDGET = TOLERANCES.gouge - 0.1 * TOLERANCES.arc_fit
"""Most that path and control may cut together, mm: less than the proof's limit by the last digits."""


def posted(
    program: Program, job: Job, control: Control, before: Scene | None = None
) -> tuple[Program, dict[str, str], Scene]:
    """A program with a tolerance for each operation, its files, and what the proof looks at.

    Each is the loosest that keeps its tool out of the part; what finishes walls begins with the second, and
    what has a tolerance with that. Holes and details are left as the control is usually asked for: nothing
    is won there. ``before``: of a program with the same moves, if there was one.
    """
    levels, doubtful = control.tolerances, set[int]()
    if levels and not program.posting.exact_stop:
        loosest: dict[int, float] = {}
        every = [(section.tool, one) for section in program.sections for one in section.operations]
        for n, (tool, operation) in enumerate(every):
            if _clears(tool, operation) and operation.tolerance != levels[-1]:
                doubtful.add(n)
                if operation.tolerance is None:
                    loosest[n] = levels[:-1][: 1 + operation.name.endswith(WALLS)][-1]
        program = _with(program, loosest)
    files, scene = _written(program, job, control, before)
    exact = _settled(program, scene, doubtful) if doubtful else program
    return (program, files, scene) if exact is program else (exact, *_written(exact, job, control, scene))


def _written(
    program: Program, job: Job, control: Control, before: Scene | None
) -> tuple[dict[str, str], Scene]:
    files = control.files(program)
    named = {name + control.suffix: text for name, text in files.items()}
    scene = Scene(named if len(files) > 1 else next(iter(files.values())), job, control)
    if before is not None and control.tolerances:
        scene.off_path.learn(before.off_path)
    return files, scene


def _settled(program: Program, scene: Scene, doubtful: Set[int]) -> Program:
    """The program, finer tolerances for those of the doubtful operations that cut the part with theirs."""
    run, levels = scene.run, scene.control.tolerances
    every = [operation for section in program.sections for operation in section.operations]
    starts = _starts(run)
    if len(starts) != len(every):
        # A text whose operations cannot be told apart.
        return _with(program, dict.fromkeys(doubtful, levels[-1]))
    number = np.searchsorted(starts, np.arange(len(run)), side="right") - 1
    finer: dict[int, float] = {}
    off = _most([motion.off for motion in scene.motions(LIKELY)])
    while doubtful:
        steps = scene.paths.steps[np.isin(number[scene.paths.steps], list(doubtful))]
        loose: set[int] = set()
        while (far := scene.off_path.too_deep(off, BUDGET, steps)).any():
            loose |= set(number[far].tolist())
            steps = steps[~np.isin(number[steps], list(loose))]
            if flat(scene.paths)[steps].all():
                break  # all of them have been told at once
        for one in loose:
            now = finer.get(one, every[one].tolerance)
            finer[one] = max(level for level in levels if now is None or level < now)
        doubtful = {one for one in loose if finer[one] > levels[-1]}
        if doubtful:
            again = np.flatnonzero(np.isin(number, list(doubtful)))
            off[again] = _off(scene, _asked(run.only(again), number[again], finer))
    return _with(program, finer) if finer else program


def _clears(tool: Tool, operation: Operation) -> bool:
    """Whether a mill cuts in an operation, elsewhere than straight down."""
    return tool.kind in MILLS and any(isinstance(move, Feed | FeedArc) for move in operation.moves)


def _with(program: Program, tolerances: Mapping[int, float]) -> Program:
    """The program with tolerances by number of the operation; those of all others stay."""
    number, sections = count(), []
    for section in program.sections:
        operations = tuple(
            replace(operation, tolerance=tolerances.get(next(number), operation.tolerance))
            for operation in section.operations
        )
        sections.append(replace(section, operations=operations))
    return replace(program, sections=tuple(sections))


def _starts(run: Run) -> Ints:
    """Step at which each operation begins."""
    return np.array(
        [r.step for r in run.remarks if r.text.lower().startswith(OPERATION_COMMENT)], dtype=np.int64
    )


def _asked(run: Run, number: Ints, tolerances: Mapping[int, float]) -> Run:
    """The same run with other tolerances for some operations; ``number`` (n,) is that of each step."""
    states, state = list(run.states), run.state.copy()
    for one, tolerance in tolerances.items():
        mine = number == one
        for old in np.unique(run.state[mine]).tolist():
            state[mine & (run.state == old)] = len(states)
            states.append(replace(run.states[old], off_path=tolerance, blend=tolerance))
    return replace(run, states=tuple(states), state=state)


def _off(scene: Scene, run: Run) -> Array:
    """How far (n,) each step may be off the path on any of the machines that this one may be, mm."""
    machine = scene.job.settings.machine
    accelerations = [share * machine.acceleration for share in (1.0, *LIKELY)]
    return _most([motion.off for motion in scene.control.lookahead.motions(run, machine, accelerations)])


def _most(values: Sequence[Array]) -> Array:
    return np.asarray(np.max(values, axis=0))
