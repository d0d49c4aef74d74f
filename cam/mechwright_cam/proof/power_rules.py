"""Whether the spindle has the power, and the torque, that the cuts ask for."""

import math

import numpy as np

from mechwright_cam.proof.loads import Loads
from mechwright_cam.proof.paths import NEAR
from mechwright_cam.proof.report import Check
from mechwright_cam.proof.scene import Scene
from mechwright_cam.shop.power import available, slower

ROUNDING = 0.02
"""A cut may ask for so much more than the spindle has, in shares: the grid is no more exact."""


def power(scene: Scene) -> Check:
    """No cut asks for more power than the spindle has at its speed."""
    loads, machine = scene.simulation.loads, scene.job.settings.machine
    loads = loads.only(np.flatnonzero(loads.rpm > 0))  # of a spindle that stands the rule on spindles tells
    given = available(machine, loads.rpm)
    share = loads.power / np.maximum(given, NEAR)
    worst = int(np.argmax(share)) if share.size else 0
    if not share.size or share[worst] <= 1 + ROUNDING:
        message = "no cut asks for more power than the spindle has"
        if share.size:
            torque = float(loads.torque[worst])
            message = (
                f"at most {loads.power[worst]:.2f} kW and {torque:.2f} N m in a cut, {share[worst]:.0%} of "
                f"what the spindle has at S{loads.rpm[worst]:g}"
            )
        found = float(loads.power[worst]) if share.size else 0.0
        limit = float(given[worst]) if share.size else None
        return Check(True, message, value=found, limit=limit, unit="kW")
    step, tool = int(loads.step[worst]), scene.tools[int(loads.tool[worst])]
    needed, limit = float(loads.power[worst]), float(given[worst])
    message = (
        f"T{tool.number} ({tool.name}) asks for {needed:.2f} kW and {loads.torque[worst]:.2f} N m at "
        f"S{loads.rpm[worst]:g} in {scene.job.part.material}, the spindle of {machine.name} has {limit:.2f} "
        f"kW there for the cut; {_remedy(loads.only(np.array([worst])), limit)}"
    )
    return scene.bad(step, message, needed, limit, "kW")


def _remedy(cut: Loads, limit: float) -> str:
    """The feed or the depth with which a cut passes."""
    needed, feed = float(cut.power[0]), float(cut.feed[0])
    lower = math.floor(feed * slower(cut.stuff, needed, limit))
    depth = math.floor(10 * float(cut.depth[0]) * limit / needed) / 10
    if cut.down[0] or depth <= 0:
        return f"lower F from {feed:g} to {lower}"
    return f"lower F from {feed:g} to {lower}, or cut {depth:g} mm deep instead of {cut.depth[0]:.1f}"
