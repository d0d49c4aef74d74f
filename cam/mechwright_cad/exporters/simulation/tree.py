"""From the joints of a mechanism to a tree of bodies, and what closes its loops.

Glossary
--------
branch
    A body, and the joint by which it hangs on another that is nearer to the ground.
loop
    A pin between two bodies that both hang on the ground already.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.joint import GROUND, Joint
from mechwright.contracts.motion import Motion
from mechwright.contracts.part import Instance, Part
from mechwright.errors import GeometryError, KinematicsError
from mechwright_cad.bodies import bodies_of


@dataclass(frozen=True)
class Branch:
    """A body on its parent, by the joint of that name, in which it is ``two`` unless it is ``turned``."""

    body: str
    parent: str
    name: str
    joint: Joint

    @property
    def turned(self) -> bool:
        """Whether the joint counts the other way: the body is its ``one``."""
        return self.joint.one == self.body


@dataclass(frozen=True)
class Tree:
    """All bodies, parents before children, and the pins that close loops, by name."""

    branches: tuple[Branch, ...]
    loops: Mapping[str, Joint]


def tree_of(joints: Mapping[str, Joint], bodies: Iterable[str]) -> Tree:
    """The tree of bodies. What does not turn is in it first, so that only pins close loops.

    Raises
    ------
    KinematicsError
        A body is held by no joint, or a slide closes a loop.
    """
    order = {"fixed": 0, "prismatic": 0, "revolute": 1}
    holding = sorted(
        ((name, joint) for name, joint in joints.items() if joint.kind in order),
        key=lambda item: order[item[1].kind],
    )
    group = {body: body for body in (GROUND, *bodies)}
    chosen: dict[str, Joint] = {}
    loops: dict[str, Joint] = {}
    for name, joint in holding:
        one, two = group[joint.one], group[joint.two]
        if one != two:
            chosen[name] = joint
            group = {body: one if top == two else top for body, top in group.items()}
        elif joint.kind == "revolute":
            loops[name] = joint
        else:
            raise KinematicsError(
                f"the {joint.kind} joint {name} closes a loop, and only revolute joints can; "
                "say each joint once, and a loop with a pin in it"
            )
    loose = [body for body, top in group.items() if top != group[GROUND]]
    if loose:
        raise KinematicsError(
            f"no joint holds the {'body' if len(loose) == 1 else 'bodies'} {', '.join(loose)}; "
            "the motion's joints have to lead from the ground to every body"
        )
    return Tree(_branches(chosen), loops)


def _branches(chosen: dict[str, Joint]) -> tuple[Branch, ...]:
    found: list[Branch] = []
    reached = [GROUND]
    for parent in reached:
        for name, joint in chosen.items():
            if parent not in (joint.one, joint.two):
                continue
            body = joint.two if joint.one == parent else joint.one
            if body not in reached:
                reached.append(body)
                found.append(Branch(body, parent, name, joint))
    return tuple(found)


def placed_of(parts: Sequence[Part], motion: Motion, sample: int) -> dict[str, list[tuple[Part, Instance]]]:
    """The parts of each body and of the ground.

    Raises KinematicsError for a motion that does not say how its bodies are joined, GeometryError for an
    instance that belongs to no body, or a sample that is not there.
    """
    if not motion.joints:
        raise KinematicsError(
            "it does not say how its bodies are joined (Motion.joints), which a simulation has to know"
        )
    placed: dict[str, list[tuple[Part, Instance]]] = {body: [] for body in (GROUND, *motion.poses)}
    for one in bodies_of(parts, motion, sample):
        placed[one.instance.body].append((one.part, one.instance))
    return placed


def frames_of(motion: Motion, sample: int) -> dict[str, Array]:
    """Frames (4, 4) of all bodies and of the ground, mm."""
    found: dict[str, Array] = {GROUND: np.eye(4)}
    for body, poses in motion.poses.items():
        found[body] = np.eye(4)
        found[body][:3, :3], found[body][:3, 3] = poses.rotation[sample], poses.position[sample]
    return found


def check_masses(tree: Tree, masses: Mapping[str, float]) -> None:
    """Refuse a body that moves, with all that is fixed to it, and weighs nothing."""
    total = dict(masses)
    for branch in reversed(tree.branches):
        if branch.joint.kind == "fixed":
            total[branch.parent] += total[branch.body]
    for branch in tree.branches:
        if branch.joint.kind != "fixed" and not total[branch.body] > 0:
            raise GeometryError(
                f"body {branch.body} moves and has no mass: no part is an instance of it or of what is fixed "
                "to it; give it a part"
            )
