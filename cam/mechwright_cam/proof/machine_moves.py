"""Moves with an end that the text does not say: where the tool was left, machine places, reference points.

Such an end may be anywhere in the travel of X and Y, so nothing may stand as high as the tool on the way. All
axes run at once, and none waits for another: while X and Y cross, Z may be at either end of its way.
"""

import numpy as np
from numpy.typing import NDArray

from mechwright_cam.controls.reading import Kind
from mechwright_cam.proof.machine_rules import retract
from mechwright_cam.proof.paths import NEAR
from mechwright_cam.proof.report import Check
from mechwright_cam.proof.scene import Scene, first


def positions(scene: Scene) -> Check:
    """No feed and no low or sideways rapid starts at a place or height that the program never stated.

    On a machine without zero the first rapid of Z alone starts where the operator has left the tool.
    """
    run = scene.run
    away = run.end[:, :2] - run.start[:, :2]
    if not scene.job.settings.machine.homed:
        away[np.isnan(run.end[:, :2]) & np.isnan(run.start[:, :2])] = 0.0
    sideways = np.nan_to_num(away, nan=1.0).any(axis=1)
    unknown = ~np.isfinite(run.start).all(axis=1) | ~np.isfinite(run.end).all(axis=1)
    lost = np.isnan(run.start[:, 2]) | np.isnan(run.end[:, 2])
    rapid = run.kind == Kind.RAPID
    if (step := first((run.cutting & unknown) | (rapid & sideways & lost))) is not None:
        return scene.bad(step, f"moves from an unknown height or place; first {retract(scene)}")
    height = max(scene.job.settings.clearance, scene.job.highest + NEAR)
    blind = _blind(scene, max(scene.clear, scene.job.highest + NEAR))
    if (step := first(rapid & blind)) is not None:
        message = f"moves below Z{height:g} from a place in X and Y that the text does not say; "
        return scene.bad(step, message + f"first {retract(scene)}, then go to X and Y, then to Z")
    far = np.logical_or.accumulate((run.kind == Kind.HOME) & run.machine_xy)
    if (step := first(rapid & far & _blind(scene, np.inf))) is not None:
        message = (
            "comes down from a place in machine coordinates while X and Y are not those of the work yet; "
            f"first {retract(scene)}, then go to X and Y, then to Z"
        )
        return scene.bad(step, message)
    return Check(True, "every move starts from a known height")


def _blind(scene: Scene, height: float) -> NDArray[np.bool_]:
    """(n,) whether a step from an X or Y that the text does not say ends, or crosses, below a height."""
    run, least = scene.run, height - NEAR
    start, end = np.isfinite(run.start[:, :2]), np.isfinite(run.end[:, :2])
    found = (end & ~start).any(axis=1)
    low = ~(run.end[:, 2] >= least) | (found & ~(run.start[:, 2] >= least))
    return low & ~(start & end).all(axis=1)


def machine_moves(scene: Scene) -> Check:
    """X and Y go to machine places and reference points at the upper end of Z, and Z goes there only.

    What stands elsewhere on the table nobody has told of: the clearance plane is above the stock and what
    holds it. A point in the work by which G28 and G30 go is the end of a rapid like any other.
    """
    run = scene.run
    if not scene.job.settings.machine.homed:
        if (step := first(run.kind == Kind.HOME)) is not None:
            message = "goes to a machine coordinate, and the machine has no zero; write a place in the work"
            return scene.bad(step, message)
        return Check(True, "no move is in machine coordinates, which the machine does not have")
    start, end = run.start[:, 2], run.end[:, 2]  # NaN, an unknown height, is no safe one
    home = run.kind == Kind.HOME
    step = first(home & run.machine_xy & ~(np.isposinf(start) & np.isposinf(end)))
    if step is not None:
        comes = bool(np.isposinf(start[step]))
        z = float((end if comes else start)[step])
        found = "an unknown height" if np.isnan(z) else f"Z{z:g}"
        message = (
            f"X or Y go to a place in machine coordinates while Z {'goes to' if comes else 'is at'} {found}, "
            f"and what stands on the way is not known; before it, in a line of its own, {retract(scene)}"
        )
        return scene.bad(step, message, None if np.isnan(z) else z)
    if (step := first(home & np.isnan(end))) is not None:
        top = scene.control.upper_end(scene.job.settings.machine)
        message = (
            f"Z goes to a height in machine coordinates below Z{top:g}, which may be in the work; "
            f"{retract(scene)}, or set cam.machine.retract_z to a lower height that is above everything"
        )
        return scene.bad(step, message)
    said = "in machine coordinates X and Y move at the upper end of Z, and Z goes up"
    if run.stored is None:
        return Check(True, said)
    line, word = run.stored
    message = (
        f"line {line}: {word} takes Z to a place that is stored in the control, which no program tells: see "
        "that it is above everything on the table"
    )
    return Check(True, message, line, told=True)
