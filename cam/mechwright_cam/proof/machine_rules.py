"""Rules about the machine's state and places: each looks at one thing, and gives one check."""

import numpy as np

from mechwright_cam.controls.reading import Kind, Run
from mechwright_cam.controls.reading.run import Ints
from mechwright_cam.proof.report import Check
from mechwright_cam.proof.scene import Scene, first

SAFE_MODES = {"distance": "G90", "plane": "G17", "cutter compensation": "G40"}


def retract(scene: Scene) -> str:
    """What to write for a full retract on this control and machine."""
    return f"retract with {scene.control.retract_words(scene.job.settings.machine)}"


def program_end(scene: Scene) -> Check:
    """The program says that it ends, with the tool up."""
    run = scene.run
    if run.beyond:
        message = (
            f"line {run.beyond}: this stands behind the program's end and is not run; delete it, or verify "
            "it as a program of its own"
        )
        return Check(False, message, run.beyond)
    if not run.ended:
        ends = set(run.file[run.kind == Kind.END].tolist()) if run.files else set[int]()
        where = next(
            (f"{name}: " for n, name in enumerate(run.files) if n not in ends), f"line {run.lines}: "
        )
        end = f"{scene.control.m(30)} or {scene.control.m(2)}"
        return Check(False, f"{where}the program has no end; write {end}", run.lines)
    moved = np.flatnonzero(run.moving | (run.kind == Kind.HOME))
    if moved.size == 0 or not run.cutting.any():
        return Check(False, "the program cuts nothing", run.lines)
    for last in _of_files(run, moved, last=True):
        height = float(run.end[last, 2])
        if not height >= scene.clear:
            return scene.bad(last, f"the program ends with the tool down; {retract(scene)}", height)
    return Check(True, "the program ends with the tool up")


def modes(scene: Scene) -> Check:
    """Units, distances, plane and compensation are set before each file's first move in work coordinates.

    So are G94, G98 and G91.1, where a move hangs on them and the control keeps them from program to program;
    where it begins with them their lack is told.
    Of shifts and turns that a program may leave nothing can be seen in the next one: that is told.
    """
    if scene.run.unsaid is not None:
        line, word = scene.run.unsaid
        message = (
            f"line {line}: moves before {word}, so that what an earlier program has set holds; set it first"
        )
        return Check(False, message, line)
    words = {"units": scene.control.unit_word, **SAFE_MODES}
    if not scene.control.compensates:
        del words["cutter compensation"]
    for step in _of_files(scene.run, np.flatnonzero(scene.run.moving)):
        missing = [word for group, word in words.items() if group not in scene.state(step).stated]
        if missing:
            return scene.bad(step, f"moves before {' '.join(missing)}; set the modes first")
    if scene.run.hoped is not None:
        line, word = scene.run.hoped
        message = f"line {line}: moves as {word} says, which an earlier program may have changed; "
        return Check(True, f"{message}write {word} before it, or see that it is in force", line, told=True)
    said = "units, distance mode, plane and compensation are stated"
    left = scene.control.leftover
    return Check(True, f"{said}; not told by any program is {left}" if left else said)


def _of_files(run: Run, steps: Ints, *, last: bool = False) -> list[int]:
    """The first of some steps in each file, or the last: between two of them hands move the machine."""
    files = run.file[steps] if run.file.size else np.zeros(steps.size, dtype=np.int64)
    order = slice(None, None, -1) if last else slice(None)
    found = steps[order][np.unique(files[order], return_index=True)[1]]
    return [int(step) for step in np.sort(found)]


def tools(scene: Scene) -> Check:
    """Every tool that moves, and every one that a T word makes ready, is one of the job."""
    run, known = scene.run, ", ".join(f"T{n}" for n in sorted(scene.tools)) or "none"
    if (step := first(run.moving & ~np.isin(run.tool, list(scene.tools)))) is not None:
        number = int(run.tool[step])
        named = f"T{number} is not a tool of this job" if number else "no tool was changed to"
        return scene.bad(step, f"{named}; its tools are {known}", number)
    for ready in run.selected:
        if ready.tool and ready.tool not in scene.tools:
            message = f"T{ready.tool} is made ready and is not a tool of this job; its tools are {known}"
            return Check(
                False,
                f"{scene.spot(ready.line, ready.file)}: {message}",
                ready.line,
                ready.tool,
                file=ready.file,
            )
    return Check(True, "all tools belong to the job")


def tool_change(scene: Scene) -> Check:
    """Tools are changed at a safe height."""
    run = scene.run
    changes = run.kind == Kind.TOOL
    if not scene.job.settings.machine.homed:  # the first one of a file says what is in the spindle already
        changes[_of_files(run, np.flatnonzero(changes))] = False
    if (step := first(changes & ~(run.end[:, 2] >= scene.clear))) is not None:
        return scene.bad(step, f"a tool is changed without a retract; before it {retract(scene)}")
    return Check(True, "tools are changed at the machine's upper end")


def stops(scene: Scene) -> Check:
    """Where the program stops for the operator's hands, spindle and coolant are off and the tool is up.

    So it is where it stops only if a switch is on.
    """
    run, control = scene.run, scene.control
    stop = np.isin(run.kind, (Kind.STOP, Kind.MAYBE))
    turns = run.of_states(lambda state: state.spindle) != 0
    down = ~(run.start[:, 2] >= scene.clear)
    wet = run.of_states(lambda state: state.coolant != "off")
    for wrong, how in (
        (turns, f"while the spindle turns; write {control.m(5)} before it"),
        (down, f"with the tool down; before it {retract(scene)}"),
        (wet, f"while coolant runs; write {control.m(9)} before it"),
    ):
        if (step := first(stop & wrong)) is not None:
            halt = control.m(0 if run.kind[step] == Kind.STOP else 1)
            return scene.bad(step, f"{halt} stops the program {how}")
    return Check(True, "at stops spindle and coolant are off and the tool is up")


def work_offset(scene: Scene) -> Check:
    """All moves are made in the work offset of the job."""
    wanted, words = scene.job.settings.work_offset, scene.control.offset_words
    wrong = scene.run.of_states(lambda state: state.work_offset != wanted)
    if (step := first(scene.run.moving & wrong)) is not None:
        used = scene.state(step).work_offset
        said = words(used) if used else "no stated work offset"
        return scene.bad(step, f"moves in {said}; the job is set up in {words(wanted)}")
    return Check(True, f"all moves are in {words(wanted)}")
