"""What a table of the design file puts around a mechanism: parts, and where they stand or go along."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.axial_stack import AxialStack
from mechwright.contracts.finding import Finding
from mechwright.contracts.joint import GROUND, Joint, Vector
from mechwright.contracts.motion import Motion, Poses, Rates
from mechwright.contracts.part import Part
from mechwright.errors import KinematicsError

Turn = tuple[Vector, Vector, Vector]
"""A rotation, by rows."""

UPRIGHT: Turn = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
OVER: Turn = ((1.0, 0.0, 0.0), (0.0, -1.0, 0.0), (0.0, 0.0, -1.0))
"""As it is, and turned over about x."""


def turned(angle: float) -> Turn:
    """A rotation about z, rad."""
    c, s = float(np.cos(angle)), float(np.sin(angle))
    return (c, -s, 0.0), (s, c, 0.0), (0.0, 0.0, 1.0)


@dataclass(frozen=True)
class Place:
    """Where a body stands in another one of the motion or in the ground: its origin, mm, and rotation."""

    origin: Vector = (0.0, 0.0, 0.0)
    rotation: Turn = UPRIGHT
    on: str = GROUND


@dataclass(frozen=True)
class Surroundings:
    """What stands around a mechanism.

    Parameters
    ----------
    parts
        None where a finding is an error.
    places
        Bodies that the parts are instances of, beside those of the motion.
    findings
        What there is to say of them: of the stage ``parts``.
    stacks
        Axial stacks of these parts, each with the play that is meant.
    replaces
        Names of parts of the mechanism that stand no more, since some of ``parts`` do in their place.
    reverses
        Whether the torque of the drive changes its sense within a turn.
    """

    parts: tuple[Part, ...] = ()
    places: Mapping[str, Place] = field(default_factory=dict)
    findings: tuple[Finding, ...] = ()
    stacks: tuple[AxialStack, ...] = ()
    replaces: tuple[str, ...] = ()
    reverses: bool = False

    def around(self, motion: Motion) -> Motion:
        """The motion with the places as bodies, each fixed to what it stands on.

        Raises KinematicsError where a place has the name of a body, or stands on none.

        >>> import numpy as np
        >>> from mechwright.contracts.motion import Channel
        >>> still = Motion("t", {"t": Channel(np.zeros(2), "rad")})
        >>> Surroundings(places={"plate": Place((0.0, 0.0, 5.0))}).around(still).poses["plate"].position[0]
        array([0., 0., 5.])
        """
        if not self.places:
            return motion
        poses, joints = dict(motion.poses), dict(motion.joints)
        for name, place in self.places.items():
            if name in poses or (place.on != GROUND and place.on not in poses):
                raise KinematicsError(f"the place {name!r} on {place.on!r} cannot be a body of this motion")
            origin, rotation = np.array(place.origin), np.array(place.rotation)
            if place.on == GROUND:
                count = motion.samples
                poses[name] = Poses(np.tile(origin, (count, 1)), np.tile(rotation, (count, 1, 1)))
            else:
                poses[name] = _carried(poses[place.on], origin, rotation)
            if motion.joints:
                joints[name] = Joint("fixed", place.on, name, place.origin)
        return replace(motion, poses=poses, joints=joints)


def _carried(carrier: Poses, origin: Array, rotation: Array) -> Poses:
    """The poses of what stands on a body, and their rates where those of the body are known."""
    place = np.eye(4)
    place[:3, :3], place[:3, 3] = rotation, origin
    rates = carrier.rates
    if rates is not None:
        rates = Rates(rates.first @ place, rates.second @ place)
    return Poses(carrier.transform(origin[None])[:, 0], carrier.rotation @ rotation, rates)
