"""From the joints of a mechanism to a tree of bodies, and what closes its loops.

Glossary
--------
branch
    A body, and the joint by which it hangs on another that is nearer to the ground.
loop
    A pin between two bodies that both hang on the ground already.
"""

from collections.abc import Mapping
from dataclasses import dataclass

from mechwright.contracts.joint import GROUND, Joint
from mechwright.errors import KinematicsError


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


def tree_of(joints: Mapping[str, Joint], bodies: Mapping[str, object]) -> Tree:
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
