"""Rules about taps: a pitch in every turn, in and out in one way, with a spindle that turns back."""

import math

import numpy as np
import shapely
from numpy.typing import NDArray

from mechwright.tolerances import TOLERANCES
from mechwright_cam.controls.reading import Kind
from mechwright_cam.controls.reading.run import Ints
from mechwright_cam.proof.paths import NEAR
from mechwright_cam.proof.report import Check
from mechwright_cam.proof.scene import Scene, in_work
from mechwright_cam.shop.tool import Tool, ToolKind

RUN_UP = 2.0
"""So many pitches above the plate a tap starts at least: in less, no spindle and feed come together."""

SAME_HOLE = 0.01
"""Places that differ by less are one hole, mm."""

GIVES = 0.05
"""A floating holder may be fed by this share less than the pitch: the tap draws it out, as makers advise."""


def turns(scene: Scene) -> Ints:
    """(n,) how the spindle has to turn: 1, or of taps as their hand asks, and back on the way out."""
    wanted = np.ones(len(scene.run), dtype=np.int64)
    down = scene.run.end[:, 2] < scene.run.start[:, 2]
    for tool in _taps(scene):
        hand = -1 if tool.left_hand else 1
        mine = scene.run.tool == tool.number
        wanted[mine] = np.where(down[mine], hand, -hand)
    return wanted


def of_taps(scene: Scene) -> NDArray[np.bool_]:
    """(n,) whether a tap is in the spindle."""
    return np.isin(scene.run.tool, [tool.number for tool in _taps(scene)])


def tapping(scene: Scene) -> Check:
    """Taps go a pitch in every turn, in a cycle of the control, from well above the plate."""
    run, working = scene.run, in_work(scene)
    low = np.fmin(run.start[:, 2], run.end[:, 2])
    for tool in _taps(scene):
        mine = run.tool == tool.number
        for step in np.flatnonzero(mine & (run.kind == Kind.RAPID) & (low < -NEAR)).tolist():
            message = f"T{tool.number} ({tool.name}) moves at rapid in the work, and tears its thread"
            return scene.bad(step, f"{message}; tap with a cycle of the control")
        for step in np.flatnonzero(mine & working).tolist():
            found = _lead(scene, tool, step) or _held(scene, tool, step) or _run_up(scene, tool, step)
            if found is not None:
                return found
    return _again(scene) or Check(True, "taps go a pitch in every turn")


def _lead(scene: Scene, tool: Tool, step: int) -> Check | None:
    """Feed over speed is the pitch: what they differ by adds up over all turns of the thread."""
    rpm, feed, pitch = scene.state(step).rpm, float(scene.run.feed[step]), tool.pitch or 0.0
    lead = feed / rpm if rpm > 0 else math.inf
    deep = -float(np.fmin(scene.run.start[step, 2], scene.run.end[step, 2]))
    if abs(lead - pitch) / pitch * deep <= TOLERANCES.gouge:
        return None
    if tool.floating and (1 - GIVES) * pitch <= lead < pitch:
        return None
    message = (
        f"F{feed:g} at S{rpm:g} feeds T{tool.number} ({tool.name}) {lead:.4f} mm in a turn, and its pitch is "
        f"{pitch:g} mm; write F{rpm * pitch:.3f} (mm/min)"
    )
    return scene.bad(step, message, lead, pitch, "mm")


def _held(scene: Scene, tool: Tool, step: int) -> Check | None:
    """A tap that is held fast needs a control that keeps feed and spindle together."""
    if tool.floating or scene.state(step).synchronous:
        return None
    message = (
        f"T{tool.number} ({tool.name}) is held fast, and nothing keeps feed and spindle together; tap it "
        "rigidly, or set floating in the tool library if its holder gives way"
    )
    return scene.bad(step, message)


def _run_up(scene: Scene, tool: Tool, step: int) -> Check | None:
    """Spindle and feed run together before a tap cuts."""
    high, least = float(max(scene.run.start[step, 2], scene.run.end[step, 2])), RUN_UP * (tool.pitch or 0.0)
    if high >= least - NEAR:
        return None
    message = (
        f"T{tool.number} ({tool.name}) starts or ends {high:.2f} mm above the plate, {least:g} mm at least: "
        "spindle and feed have to run together before it cuts; raise R"
    )
    return scene.bad(step, message, high, least, "mm")


def _again(scene: Scene) -> Check | None:
    """A thread is tapped once, unless the control begins at one mark of the spindle each time."""
    run = scene.run
    down = of_taps(scene) & run.cutting & (run.end[:, 2] < np.minimum(run.start[:, 2], -NEAR))
    marked = run.of_states(lambda state: state.synchronous) & scene.control.taps_again
    steps = np.flatnonzero(down & ~marked)
    places = shapely.points(run.end[steps, :2])
    one, other = shapely.STRtree(places).query(places, predicate="dwithin", distance=SAME_HOLE)
    later = one[one > other]
    if not later.size:
        return None
    step = int(steps[later.min()])
    message = (
        f"T{run.tool[step]} taps a thread that has been tapped before, and whether it finds its turns a "
        "setting of the machine says; tap it once"
    )
    return scene.bad(step, message)


def _taps(scene: Scene) -> list[Tool]:
    return [tool for tool in scene.tools.values() if tool.kind is ToolKind.TAP]
