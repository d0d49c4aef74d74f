"""Rules about the offsets of tools: length and diameter."""

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from mechwright_cam.controls.reading import Kind
from mechwright_cam.proof.report import Check
from mechwright_cam.proof.scene import Scene, first

LAST_DECIMAL = 1e-3
"""A length in the program is the measured one if it differs by its last decimal at most, mm."""


def length_offset(scene: Scene) -> Check:
    """The active length offset is the tool's own before Z is moved to a height above the work."""
    run = scene.run
    stated = run.moving & np.isfinite(run.end[:, 2]) & (run.tool > 0)
    if not scene.control.offsets.lengths:
        return _length_by_hand(scene, stated)
    offset = scene.run.of_states(lambda state: -2 if state.length_offset is None else state.length_offset)
    if (step := first(stated & (offset != run.tool))) is not None:
        tool, active = int(run.tool[step]), int(offset[step])
        if active in {0, -2}:
            found = "Z is moved without a length offset"
        elif active == -1:
            found = "Z is moved with a length written into the program (G43.1)"
        else:
            found = f"Z is moved with H{active}"
        message = f"{found} while T{tool} is in the spindle; write {scene.control.length_words(tool)}"
        return scene.bad(step, message, active, tool)
    return Check(True, "every tool moves Z under its own G43 H")


def _length_by_hand(scene: Scene, stated: NDArray[np.bool_]) -> Check:
    """Without a table: each tool has its length from the program (G43.1), or is touched off.

    That is at a stop, or between files.
    """
    run, word = scene.run, scene.control.offsets.length_word
    given = scene.run.of_states(lambda state: np.nan if state.length is None else state.length)
    measured = scene.paths.of_tool(lambda tool: tool.length)
    if (step := first(stated & (np.abs(given - measured) > LAST_DECIMAL))) is not None:
        message = (
            f"{word} Z{given[step]:g} while the measured length of T{run.tool[step]} is {measured[step]:g} mm"
        )
        return scene.bad(step, message, float(given[step]), float(measured[step]), "mm")
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
            message = (
                f"Z is moved with T{run.tool[at]} as if it were as long as the tool before; "
                f"stop ({scene.control.m(0)}) to touch it off"
                + (f", or write {word} with its length" if word else "")
            )
            return scene.bad(at, message)
    message = "every tool is touched off" + (f", or has its length from {word}" if word else "")
    return Check(True, message)


def diameter_offset(scene: Scene) -> Check:
    """Cutter compensation takes the D of the tool in the spindle."""
    run = scene.run
    active = scene.run.of_states(lambda state: -1 if state.diameter_offset is None else state.diameter_offset)
    own = scene.paths.of_tool(lambda tool: tool.d_number)
    if (step := first(run.moving & (active >= 0) & (own > 0) & (active != own))) is not None:
        found, wanted = int(active[step]), int(own[step])
        message = (
            f"compensation with D{found} while T{run.tool[step]} is in the spindle; write D{wanted}, or set "
            f"diameter_offset = {found} in the tool library"
        )
        return scene.bad(step, message, found, wanted)
    return Check(True, "compensation takes the D of the tool in the spindle")
