"""Rules about the state of the machine: each looks at one thing, and gives one check."""

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from mechwright.tolerances import TOLERANCES
from mechwright_cam.controls.reading import Kind
from mechwright_cam.proof.paths import NEAR
from mechwright_cam.proof.report import Check
from mechwright_cam.proof.scene import Scene, first, in_work, moving

MAX_DWELL = 10.0
"""Longest dwell that makes sense, s: beyond it, a control that counts milliseconds was meant."""
LENGTH = 1e-3
"""A length in the program is the measured one if it differs by its last decimal at most, mm."""
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
        return Check("program-end", False, f"{where}the program has no end; write {end}", run.lines)
    if run.beyond:
        return Check(
            "program-end",
            False,
            f"line {run.beyond}: this stands behind the program's end and is not run; delete it, or verify "
            "it as a program of its own",
            run.beyond,
        )
    moved = np.flatnonzero(np.isin(run.kind, (Kind.RAPID, Kind.FEED, Kind.ARC, Kind.HOME)))
    if moved.size == 0 or not run.cutting.any():
        return Check("program-end", False, "the program cuts nothing", run.lines)
    last = int(moved[-1])
    height = float(run.end[last, 2])
    if not height >= scene.job.settings.clearance - NEAR:
        return scene.bad(
            "program-end", last, f"the program ends with the tool down; {retract(scene)}", height
        )
    return Check("program-end", True, "the program ends with the tool up")


def modes(scene: Scene) -> Check:
    """Units, distances, plane and compensation are set before the first move in work coordinates."""
    step = first(moving(scene.run))
    if step is not None:
        missing = [word for group, word in SAFE_MODES.items() if group not in scene.state(step).stated]
        if missing:
            return scene.bad("modes", step, f"moves before {' '.join(missing)}; set the modes first")
    return Check("modes", True, "units, distance mode, plane and compensation are stated")


def tools_known(scene: Scene) -> Check:
    """Every tool that moves is one of the job."""
    run = scene.run
    step = first(moving(run) & ~np.isin(run.tool, list(scene.tools)))
    if step is not None:
        known = ", ".join(f"T{n}" for n in sorted(scene.tools)) or "none"
        number = int(run.tool[step])
        named = f"T{number} is not a tool of this job" if number else "no tool was changed to"
        return scene.bad("tools", step, f"{named}; its tools are {known}", number)
    return Check("tools", True, "all tools belong to the job")


def length_offset(scene: Scene) -> Check:
    """The active length offset is the tool's own before Z is moved to a height above the work."""
    run = scene.run
    stated = moving(run) & np.isfinite(run.end[:, 2]) & (run.tool > 0)
    if not scene.control.offsets.lengths:
        return _length_by_hand(scene, stated)
    offset = scene.of_states(lambda state: -2 if state.length_offset is None else state.length_offset)
    step = first(stated & (offset != run.tool))
    if step is not None:
        tool, active = int(run.tool[step]), int(offset[step])
        if active in {0, -2}:
            found = "Z is moved without a length offset"
        elif active == -1:
            found = "Z is moved with a length written into the program (G43.1)"
        else:
            found = f"Z is moved with H{active}"
        return scene.bad(
            "length-offset",
            step,
            f"{found} while T{tool} is in the spindle; write {scene.control.length_words(tool)}",
            active,
            tool,
        )
    return Check("length-offset", True, "every tool moves Z under its own G43 H")


def _length_by_hand(scene: Scene, stated: NDArray[np.bool_]) -> Check:
    """Without a table: each tool has its length from the program (G43.1), or is touched off.

    That is at a stop, or between files.
    """
    run, word = scene.run, scene.control.offsets.length_word
    given = scene.of_states(lambda state: np.nan if state.length is None else state.length)
    known = {number: tool.length for number, tool in scene.tools.items()}
    measured = np.array([np.nan if (n := known.get(t)) is None else n for t in run.tool.tolist()])
    step = first(stated & np.isfinite(given) & np.isfinite(measured) & (np.abs(given - measured) > LENGTH))
    if step is not None:
        return scene.bad(
            "length-offset",
            step,
            f"{word} Z{given[step]:g} while the measured length of T{run.tool[step]} is "
            f"{measured[step]:g} mm",
            float(given[step]),
            float(measured[step]),
            "mm",
        )
    # Where the operator could touch off: at a stop, or before a file starts.
    chances = np.flatnonzero(run.kind == Kind.STOP)
    changes = np.flatnonzero(run.kind == Kind.TOOL)
    begun = np.zeros(len(run), dtype=np.int64) if run.file.size == 0 else run.file
    for before, change in pairwise(changes.tolist()):
        used = np.flatnonzero(stated[change:] & np.isnan(given[change:]))
        if used.size == 0:
            continue
        at = change + int(used[0])
        fresh = begun[at] != begun[before] or ((chances > change) & (chances < at)).any()
        if not fresh:
            return scene.bad(
                "length-offset",
                at,
                f"Z is moved with T{run.tool[at]} as if it were as long as the tool before; "
                f"stop ({scene.control.m(0)}) to touch it off"
                + (f", or write {word} with its length" if word else ""),
            )
    return Check(
        "length-offset",
        True,
        "every tool is touched off" + (f", or has its length from {word}" if word else ""),
    )


def diameter_offset(scene: Scene) -> Check:
    """Cutter compensation takes the D of the tool in the spindle."""
    run = scene.run
    active = scene.of_states(lambda state: -1 if state.diameter_offset is None else state.diameter_offset)
    own = np.zeros(len(run), dtype=np.int64)
    for number, tool in scene.tools.items():
        own[run.tool == number] = tool.d_number
    step = first(moving(run) & (active >= 0) & (own > 0) & (active != own))
    if step is not None:
        found, wanted = int(active[step]), int(own[step])
        return scene.bad(
            "diameter-offset",
            step,
            f"compensation with D{found} while T{run.tool[step]} is in the spindle; write D{wanted}, or set "
            f"diameter_offset = {found} in the tool library",
            found,
            wanted,
        )
    return Check("diameter-offset", True, "compensation takes the D of the tool in the spindle")


def stops(scene: Scene) -> Check:
    """Where the program stops for the operator's hands, the spindle stands still and the tool is up."""
    run = scene.run
    stop, halt = run.kind == Kind.STOP, scene.control.m(0)
    step = first(stop & (scene.of_states(lambda state: state.spindle) != 0))
    if step is not None:
        return scene.bad(
            "stops",
            step,
            f"{halt} stops the program while the spindle turns; write {scene.control.m(5)} before it",
        )
    step = first(stop & ~(run.start[:, 2] >= scene.job.settings.clearance - NEAR))
    if step is not None:
        return scene.bad(
            "stops", step, f"{halt} stops the program with the tool down; before it {retract(scene)}"
        )
    return Check("stops", True, "at stops the spindle stands still and the tool is up")


def work_offset(scene: Scene) -> Check:
    """All moves are made in the work offset of the job."""
    wanted = scene.job.settings.work_offset
    wrong = scene.of_states(lambda state: state.work_offset != wanted)
    step = first(moving(scene.run) & wrong)
    if step is not None:
        used = scene.state(step).work_offset or "no stated work offset"
        return scene.bad("work-offset", step, f"moves in {used}; the job is set up in {wanted}")
    return Check("work-offset", True, f"all moves are in {wanted}")


def positions(scene: Scene) -> Check:
    """No feed and no low or sideways rapid starts at a place or height that the program never stated."""
    run = scene.run
    sideways = np.nan_to_num(run.end[:, :2] - run.start[:, :2], nan=1.0).any(axis=1)
    unknown = ~np.isfinite(run.start).all(axis=1) | ~np.isfinite(run.end).all(axis=1)
    lost = np.isnan(run.start[:, 2]) | np.isnan(run.end[:, 2])
    step = first((run.cutting & unknown) | ((run.kind == Kind.RAPID) & ((sideways & lost) | _blind(scene))))
    if step is not None:
        return scene.bad("positions", step, f"moves from an unknown height or place; first {retract(scene)}")
    return Check("positions", True, "every move starts from a known height")


def _blind(scene: Scene) -> NDArray[np.bool_]:
    """(n,) whether a step from an X or Y that the text does not say ends, or goes sideways, low down."""
    run, least = scene.run, scene.job.settings.clearance - NEAR
    start, end = np.isfinite(run.start[:, :2]), np.isfinite(run.end[:, :2])
    found = (end & ~start).any(axis=1)
    low = ~(run.end[:, 2] >= least) | (found & ~(run.start[:, 2] >= least))
    blind: NDArray[np.bool_] = low & ~(start & end).all(axis=1)
    return blind


def spindle(scene: Scene) -> Check:
    """The spindle turns clockwise while the cutter is in the work."""
    turning = scene.of_states(lambda state: state.spindle if state.rpm > 0 else 0)
    step = first(in_work(scene) & (turning != 1))
    if step is not None:
        how = f"backwards ({scene.control.m(4)})" if turning[step] == -1 else "not at all"
        return scene.bad(
            "spindle",
            step,
            f"feeds into the work while the spindle turns {how}; write S and {scene.control.m(3)}",
        )
    return Check("spindle", True, "the spindle turns clockwise whenever the cutter is in the work")


def coolant(scene: Scene) -> Check:
    """Coolant runs as planned while the cutter is in the work."""
    wanted = scene.job.settings.coolant
    wrong = scene.of_states(lambda state: state.coolant != wanted)
    step = first(in_work(scene) & wrong)
    if step is not None:
        word = scene.control.m({"flood": 8, "mist": 7, "off": 9}[wanted])
        return scene.bad(
            "coolant",
            step,
            f"cuts with coolant {scene.state(step).coolant}, planned is {wanted}; write {word}",
        )
    return Check("coolant", True, f"coolant is {wanted} whenever the cutter is in the work")


def arcs(scene: Scene) -> Check:
    """Arcs end as far from their centre as they start."""
    error, limit = scene.run.arc_error, TOLERANCES.arc_fit
    worst = int(np.argmax(error)) if error.size else 0
    if error.size and error[worst] > limit:
        found = float(error[worst])
        return scene.bad(
            "arcs",
            worst,
            f"the arc's radii at its start and end differ by {found:.4f} mm, the limit is {limit:g} mm",
            found,
            limit,
            "mm",
        )
    return Check(
        "arcs", True, "all arcs are consistent", value=float(error.max(initial=0.0)), limit=limit, unit="mm"
    )


def feeds(scene: Scene) -> Check:
    """Feeds are within the machine's limit."""
    limit = scene.job.settings.machine.max_feed
    step = first(scene.run.feed > limit + NEAR)
    if step is not None:
        found = float(scene.run.feed[step])
        return scene.bad(
            "feeds", step, f"F{found:g} is above the machine's {limit:g} mm/min", found, limit, "mm/min"
        )
    return Check("feeds", True, "feeds are within the machine's limit", limit=limit, unit="mm/min")


def speeds(scene: Scene) -> Check:
    """Spindle speeds are within the machine's limits."""
    machine = scene.job.settings.machine
    rpm = scene.of_states(lambda state: state.rpm if state.spindle else machine.spindle_min)
    wrong = (rpm > machine.spindle_max + NEAR) | (rpm < machine.spindle_min - NEAR)
    step = first(in_work(scene) & wrong)
    if step is not None:
        found = float(rpm[step])
        over = found > machine.spindle_max
        limit = machine.spindle_max if over else machine.spindle_min
        side = "above" if over else "below"
        return scene.bad(
            "speeds", step, f"S{found:g} is {side} the spindle's {limit:g} rpm", found, limit, "rpm"
        )
    return Check(
        "speeds", True, "speeds are within the spindle's limits", limit=machine.spindle_max, unit="rpm"
    )


def dwells(scene: Scene) -> Check:
    """No dwell is so long that its unit must be wrong."""
    step = first(scene.run.seconds > MAX_DWELL)
    if step is not None:
        found = float(scene.run.seconds[step])
        return scene.bad(
            "dwells",
            step,
            f"waits for {found:g} s, at most {MAX_DWELL:g} s make sense; P is in seconds",
            found,
            MAX_DWELL,
            "s",
        )
    return Check("dwells", True, "dwells are short")


def tool_changes(scene: Scene) -> Check:
    """Tools are changed at a safe height."""
    run, clearance = scene.run, scene.job.settings.clearance
    step = first((run.kind == Kind.TOOL) & ~(run.end[:, 2] >= clearance - NEAR))
    if step is not None:
        return scene.bad(
            "tool-change", step, f"a tool is changed without a retract; before it {retract(scene)}"
        )
    return Check("tool-change", True, "tools are changed at the machine's upper end")
