"""Moves in machine coordinates (G53) and to reference points (G28, G30), which lie anywhere in the work."""

import numpy as np

from mechwright_cam.controls.reading import Kind
from mechwright_cam.proof.machine_rules import retract
from mechwright_cam.proof.paths import NEAR
from mechwright_cam.proof.report import Check
from mechwright_cam.proof.scene import Scene, first


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
