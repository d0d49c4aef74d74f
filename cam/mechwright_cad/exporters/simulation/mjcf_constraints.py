"""What closes loops, couples gears and drives."""

import xml.etree.ElementTree as ET
from collections.abc import Mapping

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.joint import Joint
from mechwright.errors import KinematicsError
from mechwright_cad.exporters.simulation.elements import METRES, SOLREF, element
from mechwright_cad.exporters.simulation.tree import Tree

LEVER = 10.0
"""How far from a pin's place a second point keeps its axis, mm: the length of a usual bearing."""


def check_gears(joints: Mapping[str, Joint], tree: Tree) -> None:
    """Raise KinematicsError for a gear that MJCF cannot hold."""
    guided = {
        branch.body: branch.joint.kind
        for branch in tree.branches
        if branch.joint.kind in ("revolute", "prismatic") and not branch.turned
    }
    for name, joint in joints.items():
        if joint.kind != "gear":
            continue
        if joint.ratio is None:
            raise KinematicsError(
                f"the ratio of {joint.one} and {joint.two} ({name}) changes over the turn, and MJCF couples "
                "angles by a polynomial of degree 4 at most, which cannot follow it; write STEP or GLB"
            )
        for body in (joint.one, joint.two):
            if body not in guided:
                raise KinematicsError(
                    f"the gear {name} turns {body}, which is body two of no revolute joint that leads to the "
                    "ground; name it so"
                )
        if guided[joint.one] == "prismatic":
            raise KinematicsError(
                f"the gear {name} has the rack {joint.one} as its body one; name the pinion so"
            )


def write_constraints(
    root: ET.Element,
    bodies: Mapping[str, ET.Element],
    tree: Tree,
    joints: Mapping[str, Joint],
    frames: Mapping[str, Array],
) -> None:
    """Write sites and equalities of loops and gears, and motors of the joints that the input moves.

    Two points of its axis hold a pin. In a plane or on a sphere one would do: what is said twice is harmless.
    """
    equality = element(root, "equality")
    for name, joint in tree.loops.items():
        for number, way in enumerate((0.0, LEVER), start=1):
            point = np.array(joint.point) + way * np.array(joint.axis)
            sites = []
            for body in (joint.one, joint.two):
                at = np.linalg.inv(frames[body]) @ frames[joint.one] @ [*point, 1.0]
                sites.append(f"{name}.{number}.{body or 'ground'}")
                element(bodies[body], "site", name=sites[-1], group="4", pos=at[:3] * METRES)
            pair = {"site1": sites[0], "site2": sites[1]}
            element(equality, "connect", name=f"{name}.{number}", solref=SOLREF, **pair)
    hinges = {branch.body: branch.name for branch in tree.branches}
    kinds = {branch.body: branch.joint.kind for branch in tree.branches}
    for name, joint in joints.items():
        if joint.kind == "gear" and joint.ratio is not None:
            one, two, ratio = joint.one, joint.two, joint.ratio
            if kinds[two] == "prismatic":
                # MuJoCo softens the coupling by the inertia of both alone: in rad, not in m, it stays stiff.
                one, two, ratio = two, one, 1 / (ratio * METRES)
            pair = {"joint1": hinges[two], "joint2": hinges[one]}
            polynomial = [0.0, ratio, 0.0, 0.0, 0.0]
            element(equality, "joint", name=name, polycoef=polynomial, solref=SOLREF, **pair)
    motors = element(root, "actuator")
    for branch in tree.branches:
        if branch.joint.drives:
            element(motors, "motor", name=f"drive-{branch.name}", joint=branch.name)
