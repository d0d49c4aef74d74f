"""How far the control leaves the programmed path at corners: no further than a gouge may be deep."""

import numpy as np

from mechwright.tolerances import TOLERANCES
from mechwright_cam.proof.paths import NEAR
from mechwright_cam.proof.report import Check
from mechwright_cam.proof.scene import Scene, first, in_work

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
