"""Rules about what holds in the work: spindle, coolant, feeds, speeds, arcs, dwells, and corners."""

import numpy as np

from mechwright.tolerances import TOLERANCES
from mechwright_cam.proof.paths import NEAR
from mechwright_cam.proof.report import Check
from mechwright_cam.proof.scene import Scene, first, in_work

MAX_DWELL = 10.0
"""Longest dwell that makes sense, s: beyond it, a control that counts milliseconds was meant."""


def spindle(scene: Scene) -> Check:
    """The spindle turns clockwise while the cutter is in the work."""
    turning = scene.run.of_states(lambda state: state.spindle if state.rpm > 0 else 0)
    if (step := first(in_work(scene) & (turning != 1))) is not None:
        how = f"backwards ({scene.control.m(4)})" if turning[step] == -1 else "not at all"
        message = f"feeds into the work while the spindle turns {how}; write S and {scene.control.m(3)}"
        return scene.bad(step, message)
    return Check(True, "the spindle turns clockwise whenever the cutter is in the work")


def coolant(scene: Scene) -> Check:
    """Coolant runs as planned while the cutter is in the work."""
    wanted = scene.job.settings.coolant
    wrong = scene.run.of_states(lambda state: state.coolant != wanted)
    if (step := first(in_work(scene) & wrong)) is not None:
        word = scene.control.m({"flood": 8, "mist": 7, "off": 9}[wanted])
        message = f"cuts with coolant {scene.state(step).coolant}, planned is {wanted}; write {word}"
        return scene.bad(step, message)
    return Check(True, f"coolant is {wanted} whenever the cutter is in the work")


def arcs(scene: Scene) -> Check:
    """Arcs end as far from their centre as they start."""
    error, limit = scene.run.arc_error, TOLERANCES.arc_fit
    worst = int(np.argmax(error)) if error.size else 0
    if error.size and error[worst] > limit:
        found = float(error[worst])
        message = f"the arc's radii at its start and end differ by {found:.4f} mm, the limit is {limit:g} mm"
        return scene.bad(worst, message, found, limit, "mm")
    return Check(True, "all arcs are consistent", value=float(error.max(initial=0.0)), limit=limit, unit="mm")


def feeds(scene: Scene) -> Check:
    """Feeds are within the machine's limit."""
    limit = scene.job.settings.machine.max_feed
    if (step := first(scene.run.feed > limit + NEAR)) is not None:
        found = float(scene.run.feed[step])
        return scene.bad(step, f"F{found:g} is above the machine's {limit:g} mm/min", found, limit, "mm/min")
    return Check(True, "feeds are within the machine's limit", limit=limit, unit="mm/min")


def speeds(scene: Scene) -> Check:
    """Spindle speeds are within the machine's limits."""
    machine = scene.job.settings.machine
    rpm = scene.run.of_states(lambda state: state.rpm if state.spindle else machine.spindle_min)
    wrong = (rpm > machine.spindle_max + NEAR) | (rpm < machine.spindle_min - NEAR)
    if (step := first(in_work(scene) & wrong)) is not None:
        found = float(rpm[step])
        over = found > machine.spindle_max
        limit = machine.spindle_max if over else machine.spindle_min
        side = "above" if over else "below"
        return scene.bad(step, f"S{found:g} is {side} the spindle's {limit:g} rpm", found, limit, "rpm")
    return Check(True, "speeds are within the spindle's limits", limit=machine.spindle_max, unit="rpm")


def dwells(scene: Scene) -> Check:
    """No dwell is so long that its unit must be wrong."""
    if (step := first(scene.run.seconds > MAX_DWELL)) is not None:
        found = float(scene.run.seconds[step])
        message = f"waits for {found:g} s, at most {MAX_DWELL:g} s make sense; P is in seconds"
        return scene.bad(step, message, found, MAX_DWELL, "s")
    return Check(True, "dwells are short")


ADVICE = f"write G64 P{TOLERANCES.arc_fit:g} (in mm) or G61"
"""What to write: as wide as our own programs have it, Q is as wide by itself."""


def path_tolerance(scene: Scene) -> Check:
    """The control has a bound on how far it leaves the path, and in the work it is within that of a gouge."""
    limit, name = TOLERANCES.gouge, scene.control.title
    off, cuts = scene.run.of_states(lambda state: state.off_path), in_work(scene)
    if (step := first(scene.run.moving & np.isinf(off))) is not None:
        message = (
            f"nothing bounds how far {name} leaves the path at corners, the limit is {limit:g} mm; before it "
            f"{ADVICE}"
        )
        return scene.bad(step, message, None, limit, "mm")
    if (step := first(cuts & (off > limit + NEAR))) is not None:
        found = float(off[step])
        message = (
            f"{name} may leave the path by {found:g} mm at corners (P and Q of G64 together), the limit is "
            f"{limit:g} mm; {ADVICE}"
        )
        return scene.bad(step, message, found, limit, "mm")
    if not scene.control.corners.tolerance:
        return Check(True, f"no word lets {name} leave the path further than its settings do")
    worst = float(off[cuts].max(initial=0.0))
    return Check(True, "the control stays near the path", value=worst, limit=limit, unit="mm")
