"""How the bodies of a mechanism hold each other: what a simulation needs beside the poses."""

import math
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import Literal

from mechwright.errors import KinematicsError

GROUND = ""
"""Name of what stands still: the coordinates in which poses are given."""

JointKind = Literal["fixed", "revolute", "prismatic", "gear", "contact"]

UNIT = 1e-9
"""By how much the length of an axis may differ from 1."""

Vector = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Joint:
    """What holds body ``two`` to body ``one``.

    Parameters
    ----------
    kind
        ``fixed``: both move as one. ``revolute``: ``two`` turns about the axis. ``prismatic``: ``two`` slides
        along the axis and does not turn. ``gear``: ``two`` turns ``ratio`` times as far as ``one``, each in
        the revolute joint that has it as its ``two``; a rack slides in a prismatic one. ``contact``: surfaces
        that touch now and then push each other.
    one, two
        Bodies of the motion; ``one`` may be ``GROUND``.
    point
        A place on the axis where the joint is made, in the coordinates of ``one``, mm.
    axis
        Unit vector in the coordinates of ``one``; a positive angle or way of ``two`` is about it or along it.
    ratio
        Of a gear, of a rack in mm for each rad; None where it changes over the turn.
    radius
        Of a contact: radius, mm, of the round pin about the axis with which ``one`` touches; 0 if it is
        all of its plates.
    drives
        Whether the input moves this joint.

    Raises
    ------
    KinematicsError
        Numbers that are not finite, an axis that is no unit vector, a body that holds itself, or a radius
        below 0.

    Examples
    --------
    >>> shaft = Joint("revolute", GROUND, "crank", drives=True)
    >>> pin = Joint("revolute", "crank", "coupler", (30.0, 0.0, 0.0))
    """

    kind: JointKind
    one: str
    two: str
    point: Vector = (0.0, 0.0, 0.0)
    axis: Vector = (0.0, 0.0, 1.0)
    ratio: float | None = None
    radius: float = 0.0
    drives: bool = False

    def __post_init__(self) -> None:
        where = f"the {self.kind} joint of {self.two!r} on {self.one or 'the ground'!r}"
        if self.one == self.two:
            raise KinematicsError(f"{where}: a body cannot hold itself; name two bodies")
        numbers = (*self.point, *self.axis, self.radius, 0.0 if self.ratio is None else self.ratio)
        if not all(math.isfinite(number) for number in numbers):
            raise KinematicsError(f"{where}: point, axis, ratio and radius are finite, not {numbers}")
        if not abs(math.hypot(*self.axis) - 1) <= UNIT:
            raise KinematicsError(f"{where}: its axis {self.axis} is no unit vector; divide it by its length")
        if self.radius < 0:
            raise KinematicsError(f"{where}: a radius of {self.radius:g} mm; the limit is 0")


def check_bodies(joints: Mapping[str, Joint], bodies: Collection[str]) -> None:
    """Raise KinematicsError if a joint holds a body that is none of ``bodies``."""
    for name, joint in joints.items():
        for body in (joint.one, joint.two):
            if body not in bodies and not (body == GROUND and body == joint.one):
                raise KinematicsError(
                    f"the joint {name!r} holds body {body!r}, which has no poses; "
                    f"those that have: {', '.join(sorted(bodies)) or 'none'}"
                )


def fixed(one: str, *bodies: str) -> dict[str, Joint]:
    """Joints, each named by its body, that fix bodies to ``one``.

    >>> list(fixed("crank", "crank-pin", "shaft"))
    ['crank-pin', 'shaft']
    """
    return {body: Joint("fixed", one, body) for body in bodies}
