"""Rules about what holds in the work: spindle, coolant, feeds, speeds, arcs, dwells, and corners.

What the control may cut where it leaves the path, and what the path cuts, are one gouge.
"""

from copy import copy

import numpy as np
from numpy.typing import NDArray

from mechwright.tolerances import TOLERANCES
from mechwright_cam.controls.reading import Kind
from mechwright_cam.proof.machine_rules import retract
from mechwright_cam.proof.off_path import deepest_off_path
from mechwright_cam.proof.paths import NEAR
from mechwright_cam.proof.report import Check
from mechwright_cam.proof.scene import Scene, first, in_work
from mechwright_cam.proof.stock import UNEVEN
from mechwright_cam.proof.tap_rules import of_taps, turns

MAX_DWELL = 10.0
"""Longest dwell that makes sense, s: beyond it, a control that counts milliseconds was meant."""


def spindle(scene: Scene) -> Check:
    """The spindle turns as the cutter asks while it is in the work, and starts and stops clear of it."""
    turning, wanted = scene.run.of_states(lambda state: state.spindle_rotation), turns(scene)
    working = in_work(scene)
    if (step := first((working | _goes_in(scene)) & (turning != wanted))) is not None:
        names = {
            1: f"clockwise ({scene.control.m(3)})",
            -1: f"backwards ({scene.control.m(4)})",
            0: "not at all",
        }
        goes = "feeds into the work" if working[step] else "goes below the top of the stock at rapid"
        message = f"{goes} while the spindle turns {names[int(turning[step])]}; "
        if of_taps(scene)[step]:
            message += f"there this tap has to turn {names[int(wanted[step])]}: tap with a tapping cycle"
        else:
            message += f"write S and {scene.control.m(3)}"
        return scene.bad(step, message)
    for change in scene.run.spindle_changes:
        if scene.stock.touches(change):
            place = " ".join(f"{axis}{value:.3f}" for axis, value in zip("XYZ", change.place, strict=True))
            message = (
                f"the spindle starts or stops while T{change.tool} stands less than {UNEVEN:g} mm off the "
                f"stock; before it {retract(scene)}, at {place}"
            )
            message = f"{scene.spot(change.line, change.file)}: {message}"
            return Check(False, message, change.line, None, UNEVEN, "mm", change.place, file=change.file)
    return Check(True, "the spindle turns the right way whenever the cutter is in the work")


def _goes_in(scene: Scene) -> NDArray[np.bool_]:
    """(n,) rapids of a cutter below the top of the stock, but for those straight up.

    The way up from where the spindle stopped is free: there the tool stood clear of all that is left, and
    material does not come back. Whatever else lies below the top is no place for a cutter that stands: a way
    that was cut is a wall on both sides. Rapids of taps are judged with their thread.
    """
    run = scene.run
    low = np.fmin(run.start[:, 2], run.end[:, 2]) < -NEAR
    still = (np.abs(run.end[:, :2] - run.start[:, :2]) <= NEAR).all(axis=1)
    up = still & (run.end[:, 2] >= run.start[:, 2])
    found: NDArray[np.bool_] = (run.kind == Kind.RAPID) & low & ~up & ~of_taps(scene)
    return found


def coolant(scene: Scene) -> Check:
    """Coolant runs as planned while the cutter is in the work; a program of other hands may have any."""
    job, wanted = scene.job, scene.job.settings.coolant
    if not job.planned and "coolant" not in job.settings.model_fields_set:
        found = {scene.run.states[index].coolant for index in set(scene.run.state[in_work(scene)].tolist())}
        return Check(True, f"no coolant is planned; in the work it is {' and '.join(sorted(found)) or 'off'}")
    wrong = scene.run.of_states(lambda state: state.coolant != wanted)
    if (step := first(in_work(scene) & wrong)) is not None:
        word = scene.control.m({"flood": 8, "mist": 7, "off": 9}[wanted])
        message = f"cuts with coolant {scene.state(step).coolant}, planned is {wanted}; write {word}"
        return scene.bad(step, message)
    return Check(True, f"coolant is {wanted} whenever the cutter is in the work")


COARSE = 1.3
"""Last decimals by which the radii of an arc may differ, where these are coarse: four of an inch."""


def arcs(scene: Scene) -> Check:
    """Arcs end as far from their centre as they start."""
    # Where the last decimal is coarser than that, no writer could do better than to round to it.
    error, limit = scene.run.arc_error, max(TOLERANCES.arc_fit, COARSE * scene.control.resolution)
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
        return scene.bad(
            step, f"a feed of {found:g} mm/min is above the machine's {limit:g}", found, limit, "mm/min"
        )
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
        message = f"waits for {found:g} s, at most {MAX_DWELL:g} s make sense; {scene.control.dwell_words}"
        return scene.bad(step, message, found, MAX_DWELL, "s")
    return Check(True, "dwells are short")


LOOSEST = 0.05
"""A path that is off by more is another path, mm: nothing else in the proof would hold for it."""


def path_tolerance(scene: Scene) -> Check:
    """The control has a bound on how far it leaves the path, and there, too, stays out of the part."""
    run, name, limit = scene.run, scene.control.title, TOLERANCES.gouge
    off, exact = scene.motion.off, scene.control.exact_words
    advice = "write " + " or ".join(filter(None, (scene.control.rounding_words, exact)))
    words = run.of_states(lambda state: state.off_path)
    if (step := first(run.moving & np.isinf(words))) is not None:
        message = (
            f"nothing bounds how far {name} leaves the path at corners, the limit is {limit:g} mm; before it "
            f"{advice}"
        )
        return scene.bad(step, message, None, limit, "mm")
    if (step := first(in_work(scene) & (words > LOOSEST))) is not None:
        found = float(words[step])
        said = f" ({scene.control.bound_words})" if scene.control.bound_words else ""
        message = (
            f"{name} may leave the path by {found:g} mm at corners{said}, {LOOSEST:g} mm at most; {advice}"
        )
        return scene.bad(step, message, found, LOOSEST, "mm")
    if not off.any():
        return Check(True, f"no word lets {name} leave the path further than its settings do")
    if scene.gouge is not None and scene.gouge.depth > limit:
        return Check(
            True, f"not asked of {name}, for the path itself cuts into the part, and no tolerance mends that"
        )
    far = scene.off_path.too_deep(off, limit, any_one=True)
    if far.any():
        some = copy(scene.paths)
        some.steps = some.steps[far[some.steps]]
        cut = deepest_off_path(some, scene.job, off)
        assert cut is not None  # noqa: S101 - it has just been found
        away = float(off[cut.step])
        message = (
            f"{name} may be {away:.4f} mm off the path there, and cuts {cut.depth:.4f} mm into the finished "
            f"part, the limit is {limit:g} mm; write {exact} before it, or feed slower"
        )
        return scene.bad(cut.step, message, cut.depth, limit, "mm", cut.at)
    return Check(
        True, "where the control leaves the path, too, the tool stays out of the part", limit=limit, unit="mm"
    )
