"""Play of pins, and friction of those that close loops, as tendons of MuJoCo.

A tendon between the axes of pin and hole that may be as long as half the play leaves the pin free within its
hole, and pushes where it touches. A tendon over the hinges of both bodies has the angle that a pin of a loop
turns by.
"""

import xml.etree.ElementTree as ET
from collections.abc import Mapping

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.joint import GROUND, Joint
from mechwright_cad.exporters.simulation.bearings import Bearings
from mechwright_cad.exporters.simulation.elements import METRES, SOLREF, Value, element, remark
from mechwright_cad.exporters.simulation.tree import Tree

LEVER = 10.0
"""How far from a pin's place a second point keeps its axis, mm: the length of a usual bearing."""

HARD = (0.99, 0.999, 1e-6)
"""MuJoCo's solimp of a pin on its hole: nearly all of the speed is taken within a micrometre."""

PARALLEL = 1e-9
"""By how much less than 1 the product of two unit vectors is that are parallel."""


def sites(
    name: str, joint: Joint, way: float, bodies: Mapping[str, ET.Element], frames: Mapping[str, Array]
) -> list[str]:
    """Mark a point of a joint's axis, ``way`` mm from its place, on both bodies; the names of both sites."""
    point = np.array(joint.point) + way * np.array(joint.axis)
    found = []
    for body in (joint.one, joint.two):
        at = np.linalg.inv(frames[body]) @ frames[joint.one] @ [*point, 1.0]
        found.append(f"{name}.{body or 'ground'}")
        element(bodies[body], "site", name=found[-1], group="4", pos=at[:3] * METRES)
    return found


def write_pins(
    root: ET.Element,
    bodies: Mapping[str, ET.Element],
    tree: Tree,
    frames: Mapping[str, Array],
    bearings: Bearings,
) -> None:
    """Write the tendons of pins; nothing without friction and play."""
    tendons = ET.Element("tendon")
    hinges = {branch.name: branch.joint for branch in tree.branches}
    for name, play in bearings.play.items():
        # A hinge keeps its axis parallel by itself: one point is enough.
        joint = hinges.get(name) or tree.loops[name]
        for number, way in enumerate((0.0,) if name in hinges else (0.0, LEVER), start=1):
            limits: dict[str, Value] = {"limited": "true", "range": [0.0, play]}
            limits |= {"solreflimit": SOLREF, "solimplimit": HARD}
            spatial = element(tendons, "spatial", name=f"play-{name}.{number}", group="4", **limits)
            for site in sites(f"{name}.{number}", joint, way, bodies, frames):
                element(spatial, "site", site=site)
    for name, loop in tree.loops.items():
        if name not in bearings.friction:
            continue
        turns = _turns(loop, tree, frames)
        if turns is None:
            remark(root, f"left out: friction of {name}: it closes a loop of axes that are not parallel")
            continue
        fixed = element(tendons, "fixed", name=f"friction-{name}", frictionloss=bearings.friction[name])
        for hinge, sense in turns.items():
            element(fixed, "joint", joint=hinge, coef=sense)
    if len(tendons):
        root.append(tendons)


def _turns(pin: Joint, tree: Tree, frames: Mapping[str, Array]) -> dict[str, float] | None:
    """Hinges to +1 or -1: their sum is the angle of a pin; None where their axes are not parallel."""
    holders = {branch.body: branch for branch in tree.branches}
    axis = frames[pin.one][:3, :3] @ pin.axis
    found: dict[str, float] = {}
    for body, sense in ((pin.two, 1.0), (pin.one, -1.0)):
        at = body
        while at != GROUND:
            branch = holders[at]
            if branch.joint.kind == "revolute":
                along = frames[branch.joint.one][:3, :3] @ branch.joint.axis @ axis
                along *= -1.0 if branch.turned else 1.0
                if abs(along) < 1 - PARALLEL:
                    return None
                found[branch.name] = found.get(branch.name, 0.0) + sense * float(np.sign(along))
            at = branch.parent
    return {name: sense for name, sense in found.items() if sense}
