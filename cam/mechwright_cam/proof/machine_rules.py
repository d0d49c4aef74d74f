"""Rules about the machine's state and places: each looks at one thing, and gives one check."""

import numpy as np
from numpy.typing import NDArray

from mechwright_cam.controls.reading import Kind
from mechwright_cam.proof.paths import NEAR
from mechwright_cam.proof.report import Check
from mechwright_cam.proof.scene import Scene, first

SAFE_MODES = {"units": "G21", "distance": "G90", "plane": "G17", "cutter compensation": "G40"}


def retract(scene: Scene) -> str:
    """What to write for a full retract on this control and machine."""
    return f"retract with {scene.control.retract_words(scene.job.settings.machine)}"


def program_end(scene: Scene) -> Check:
    """The program says that it ends, with the tool up."""
    run = scene.run
    if not run.ended:
        where = "" if run.files else f"line {run.lines}: "
        end = f"{scene.control.m(30)} or {scene.control.m(2)}"
        return Check(False, f"{where}the program has no end; write {end}", run.lines)
    if run.beyond:
        message = (
            f"line {run.beyond}: this stands behind the program's end and is not run; delete it, or verify "
            "it as a program of its own"
        )
        return Check(False, message, run.beyond)
    moved = np.flatnonzero(run.moving | (run.kind == Kind.HOME))
    if moved.size == 0 or not run.cutting.any():
        return Check(False, "the program cuts nothing", run.lines)
    last = int(moved[-1])
    height = float(run.end[last, 2])
    if not height >= scene.job.settings.clearance - NEAR:
        return scene.bad(last, f"the program ends with the tool down; {retract(scene)}", height)
    return Check(True, "the program ends with the tool up")


def modes(scene: Scene) -> Check:
    """Units, distances, plane and compensation are set before the first move in work coordinates."""
    if (step := first(scene.run.moving)) is not None:
        missing = [word for group, word in SAFE_MODES.items() if group not in scene.state(step).stated]
        if missing:
            return scene.bad(step, f"moves before {' '.join(missing)}; set the modes first")
    return Check(True, "units, distance mode, plane and compensation are stated")


def tools(scene: Scene) -> Check:
    """Every tool that moves is one of the job."""
    run = scene.run
    if (step := first(run.moving & ~np.isin(run.tool, list(scene.tools)))) is not None:
        known = ", ".join(f"T{n}" for n in sorted(scene.tools)) or "none"
        number = int(run.tool[step])
        named = f"T{number} is not a tool of this job" if number else "no tool was changed to"
        return scene.bad(step, f"{named}; its tools are {known}", number)
    return Check(True, "all tools belong to the job")


def tool_change(scene: Scene) -> Check:
    """Tools are changed at a safe height."""
    run, clearance = scene.run, scene.job.settings.clearance
    if (step := first((run.kind == Kind.TOOL) & ~(run.end[:, 2] >= clearance - NEAR))) is not None:
        return scene.bad(step, f"a tool is changed without a retract; before it {retract(scene)}")
    return Check(True, "tools are changed at the machine's upper end")


def stops(scene: Scene) -> Check:
    """Where the program stops for the operator's hands, the spindle stands still and the tool is up."""
    run = scene.run
    stop, halt = run.kind == Kind.STOP, scene.control.m(0)
    if (step := first(stop & (scene.run.of_states(lambda state: state.spindle) != 0))) is not None:
        message = f"{halt} stops the program while the spindle turns; write {scene.control.m(5)} before it"
        return scene.bad(step, message)
    if (step := first(stop & ~(run.start[:, 2] >= scene.job.settings.clearance - NEAR))) is not None:
        return scene.bad(step, f"{halt} stops the program with the tool down; before it {retract(scene)}")
    return Check(True, "at stops the spindle stands still and the tool is up")


def work_offset(scene: Scene) -> Check:
    """All moves are made in the work offset of the job."""
    wanted = scene.job.settings.work_offset
    wrong = scene.run.of_states(lambda state: state.work_offset != wanted)
    if (step := first(scene.run.moving & wrong)) is not None:
        used = scene.state(step).work_offset or "no stated work offset"
        return scene.bad(step, f"moves in {used}; the job is set up in {wanted}")
    return Check(True, f"all moves are in {wanted}")


def positions(scene: Scene) -> Check:
    """No feed and no low or sideways rapid starts at a place or height that the program never stated."""
    run = scene.run
    sideways = np.nan_to_num(run.end[:, :2] - run.start[:, :2], nan=1.0).any(axis=1)
    unknown = ~np.isfinite(run.start).all(axis=1) | ~np.isfinite(run.end).all(axis=1)
    lost = np.isnan(run.start[:, 2]) | np.isnan(run.end[:, 2])
    step = first((run.cutting & unknown) | ((run.kind == Kind.RAPID) & ((sideways & lost) | _blind(scene))))
    if step is not None:
        return scene.bad(step, f"moves from an unknown height or place; first {retract(scene)}")
    return Check(True, "every move starts from a known height")


def _blind(scene: Scene) -> NDArray[np.bool_]:
    """(n,) whether a step from an X or Y that the text does not say ends, or goes sideways, low down."""
    run, least = scene.run, scene.job.settings.clearance - NEAR
    start, end = np.isfinite(run.start[:, :2]), np.isfinite(run.end[:, :2])
    found = (end & ~start).any(axis=1)
    low = ~(run.end[:, 2] >= least) | (found & ~(run.start[:, 2] >= least))
    return low & ~(start & end).all(axis=1)


def machine_moves(scene: Scene) -> Check:
    """X and Y go to such places with the tool up all the way, and Z goes up only."""
    run, limit = scene.run, scene.job.settings.clearance
    least = limit - NEAR
    start, end = run.start[:, 2], run.end[:, 2]  # NaN, an unknown height, is no safe one
    step = first(run.machine_xy & ~((start >= least) & (end >= least)))
    if step is not None and start[step] >= least:
        message = (
            f"Z comes below the clearance plane, Z{limit:g}, while X or Y go to a place in machine "
            "coordinates; leave Z out of the line"
        )
        return scene.bad(step, message, None, limit, "mm")
    if step is not None:
        z = float(start[step])
        found = "an unknown height" if np.isnan(z) else f"Z{z:g}"
        message = (
            f"X or Y go to a place in machine coordinates from {found}, the clearance plane is Z{limit:g}; "
            f"before it {retract(scene)}"
        )
        return scene.bad(step, message, None if np.isnan(z) else z, limit, "mm")
    if (step := first((run.kind == Kind.HOME) & np.isnan(end))) is not None:
        top = scene.job.settings.machine.retract_z
        message = (
            f"Z goes to a height in machine coordinates below Z{top:g}, which may be in the work; "
            f"{retract(scene)}, or set cam.machine.retract_z to a lower height that is above everything"
        )
        return scene.bad(step, message)
    return Check(True, "in machine coordinates X and Y move with the tool up, and Z goes up")
