"""Rules about offsets: lengths and diameters of tools, what a program writes into the control's tables."""

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from mechwright.tolerances import TOLERANCES
from mechwright_cam.controls.offsets import place_of
from mechwright_cam.controls.reading import Kind
from mechwright_cam.controls.reading.run import TableWrite
from mechwright_cam.proof.off_path import reaching
from mechwright_cam.proof.paths import NEAR, Paths
from mechwright_cam.proof.report import Check
from mechwright_cam.proof.scene import Scene, first

LAST_DECIMAL = 1.3e-3
"""A length in the program is the measured one if it differs by its last decimal at most, mm: a micrometre, or
half of a ten-thousandth of an inch."""


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
    if (step := first((offset > 0) & ~np.isin(offset, list(scene.tools)))) is not None:
        message = f"H{offset[step]} is in force here, the length of no tool of this job; take its G43 out"
        return scene.bad(step, message)
    return Check(True, f"every tool moves Z under its own {scene.control.length_words('')}")


def _length_by_hand(scene: Scene, stated: NDArray[np.bool_]) -> Check:
    """Without a table: each tool has its length from the program (G43.1), or is touched off.

    That is at a stop, or between files.
    """
    run, word = scene.run, scene.control.offsets.length_word
    given = scene.run.of_states(lambda state: np.nan if state.length is None else state.length)
    measured = scene.paths.of_tool(lambda tool: None if tool.length is None else tool.worn_length)
    if (step := first(stated & (np.abs(given - measured) > LAST_DECIMAL))) is not None:
        message = (
            f"{word} Z{given[step]:g} while the measured length of T{run.tool[step]} is {measured[step]:g} mm"
        )
        return scene.bad(step, message, float(given[step]), float(measured[step]), "mm")
    if (step := first(stated & (np.abs(given) > LAST_DECIMAL) & np.isnan(measured))) is not None:
        message = (
            f"{word} Z{given[step]:g} while the length of T{run.tool[step]} is not known; set its length in "
            f"the tool library, or take {word} out and touch it off"
        )
        return scene.bad(step, message)
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
    return _worn(scene) or Check(True, "compensation takes the D of the tool in the spindle")


def _worn(scene: Scene) -> Check | None:
    """The first cut at a wall by a tool that is known to be worn beyond the limits, and has no D for it."""
    run = scene.run
    without = run.cutting & (run.of_states(lambda state: state.side) == 0)
    for tool in scene.tools.values():
        off = tool.wear_diameter / 2
        limit = TOLERANCES.gouge if off > 0 else TOLERANCES.leftover
        if abs(off) <= limit + NEAR:
            continue
        mine = Paths(run.only(np.flatnonzero(without & (run.tool == tool.number))), [tool])
        more = np.full(len(mine.run), TOLERANCES.leftover)
        if not reaching(mine, scene.job, more, TOLERANCES.gouge, any_one=True).any():
            continue
        does = "keep" if off < 0 else "lose"
        message = (
            f"T{tool.number} ({tool.name}) is worn by {off:+g} mm as a radius and comes to walls without "
            f"cutter compensation: they {does} as much, {limit:g} mm at most; put in a new cutter, or give "
            "the wear to its D"
        )
        return scene.bad(int(first(without & (run.tool == tool.number)) or 0), message, abs(off), limit, "mm")
    return None


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
    if (write.table, write.number) == place_of(offset):
        own = {
            axis: (f"cam.measured.{axis.lower()}", getattr(job.settings.measured, axis.lower()))
            for axis in "XYZ"
        }
    elif lengths is not None and write.table == lengths[0] and write.number in scene.tools:
        tool = scene.tools[write.number]
        length = tool.length
        if length is not None and not scene.control.offsets.wear:
            length = tool.worn_length  # one column holds both
        own = {lengths[1]: (f"cam.measured.lengths.{tool.name}", length)}
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


def _allowed(scene: Scene) -> str:
    """The G10 that may stand in a program of this job."""
    offset = scene.job.settings.work_offset
    words = "its own: G10 L{} P{} for {}".format(*place_of(offset), offset)
    if scene.control.length_write is not None:
        words += f", L{scene.control.length_write[0]} for the lengths of its tools"
    return words


def _spelt(write: TableWrite) -> str:
    return f"G10 L{write.table} P{write.number}"
