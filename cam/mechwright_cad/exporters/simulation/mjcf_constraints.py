"""What closes loops, couples gears and drives."""

import xml.etree.ElementTree as ET
from collections.abc import Mapping

from mechwright.arrays import Array
from mechwright.contracts.joint import Joint
from mechwright.errors import KinematicsError
from mechwright_cad.exporters.simulation.bearings import Bearings
from mechwright_cad.exporters.simulation.elements import METRES, SOLREF, element
from mechwright_cad.exporters.simulation.mjcf_pins import LEVER, sites, write_pins
from mechwright_cad.exporters.simulation.tree import Tree


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
    bearings: Bearings,
) -> None:
    """Write sites and equalities of loops and gears, and motors of the joints that the input moves.

    Two points of its axis hold a pin. In a plane or on a sphere one would do: what is said twice is harmless.
    """
    equality = element(root, "equality")
    write_pins(root, bodies, tree, frames, bearings)
    for name, joint in tree.loops.items():
        if name in bearings.play:
            continue
        for number, way in enumerate((0.0, LEVER), start=1):
            pair = dict(
                zip(("site1", "site2"), sites(f"{name}.{number}", joint, way, bodies, frames), strict=True)
            )
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
