"""Copies of parts where they stand, and which of them move as one."""

from collections.abc import Sequence
from dataclasses import dataclass

from mechwright.contracts.joint import GROUND
from mechwright.contracts.motion import Motion, Poses
from mechwright.contracts.part import Instance, Part
from mechwright.errors import GeometryError


@dataclass(frozen=True)
class Placed:
    """One copy of a part, with the poses of the body that it belongs to."""

    part: Part
    instance: Instance
    poses: Poses


def placed(parts: Sequence[Part], motion: Motion) -> list[Placed]:
    """All copies of all parts; raises GeometryError for one of a body that the motion does not have."""
    found = []
    for part in parts:
        for instance in part.instances:
            if instance.body not in motion.poses:
                raise GeometryError(
                    f"part {part.name} is an instance of body {instance.body!r}, which the motion does not "
                    f"move; it has {', '.join(sorted(motion.poses)) or 'none'}"
                )
            found.append(Placed(part, instance, motion.poses[instance.body]))
    return found


def rigid(motion: Motion) -> dict[str, str]:
    """Every body of a motion to the name of the one that all that are fixed to it share."""
    head = {name: name for name in (GROUND, *motion.poses)}

    def find(name: str) -> str:
        while head[name] != name:
            name = head[name]
        return name

    for joint in motion.joints.values():
        if joint.kind == "fixed":
            one, two = find(joint.one), find(joint.two)
            head[max(one, two)] = min(one, two)  # the ground's name is the least of all
    return {name: find(name) for name in head}
