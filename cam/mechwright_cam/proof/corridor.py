"""How far the control leaves the path: what it may cut there, and what the path cuts, are one gouge."""

from copy import copy

import numpy as np

from mechwright.tolerances import TOLERANCES
from mechwright_cam.proof.off_path import deepest_off_path, too_deep
from mechwright_cam.proof.report import Check
from mechwright_cam.proof.scene import Scene, first, in_work

ADVICE = f"write G64 P{TOLERANCES.arc_fit:g} Q0 (in mm) or G61"
"""What to write: as our own programs have it."""
LOOSEST = 0.05
"""A path that is off by more is another path, mm: nothing else in the proof would hold for it."""


def path_tolerance(scene: Scene) -> Check:
    """The control has a bound on how far it leaves the path, and there, too, stays out of the part."""
    run, name, limit = scene.run, scene.control.title, TOLERANCES.gouge
    off = scene.control.lookahead.motion(run, scene.job.settings.machine).off
    words = run.of_states(lambda state: state.off_path)
    if (step := first(run.moving & np.isinf(words))) is not None:
        message = (
            f"nothing bounds how far {name} leaves the path at corners, the limit is {limit:g} mm; before it "
            f"{ADVICE}"
        )
        return scene.bad(step, message, None, limit, "mm")
    if (step := first(in_work(scene) & (words > LOOSEST))) is not None:
        found = float(words[step])
        message = (
            f"{name} may leave the path by {found:g} mm at corners (P and Q of G64 together), {LOOSEST:g} mm "
            f"at most; {ADVICE}"
        )
        return scene.bad(step, message, found, LOOSEST, "mm")
    if not off.any():
        return Check(True, f"no word lets {name} leave the path further than its settings do")
    far = too_deep(scene.paths, scene.job, off, limit)
    if far.any():
        some = copy(scene.paths)
        some.steps = some.steps[far[some.steps]]
        cut = deepest_off_path(some, scene.job, off)
        assert cut is not None  # noqa: S101 - it has just been found
        away = float(off[cut.step])
        message = (
            f"{name} may be {away:.4f} mm off the path there, and cuts {cut.depth:.4f} mm into the finished "
            f"part, the limit is {limit:g} mm; write G61 before it, or feed slower"
        )
        return scene.bad(cut.step, message, cut.depth, limit, "mm", cut.at)
    return Check(
        True, "where the control leaves the path, too, the tool stays out of the part", limit=limit, unit="mm"
    )
