"""What works on a mechanism from outside: forces, torques, and inertia that hangs on its bodies."""

import math
from dataclasses import dataclass, field

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.joint import Vector
from mechwright.errors import KinematicsError

NONE: Vector = (0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True)
class Load:
    """What the outside does to a body of a motion.

    Parameters
    ----------
    body
        Of the motion.
    force, torque
        On the body in the coordinates of the poses, N and N·m, the same all along but for ``share``.
    point
        Of the body, in its coordinates, at which the force works, mm.
    resisting
        Torque against the body's turning whichever way it turns, N·m.
    inertia
        Moment of inertia, kg m², about the body's own z through its origin, of all that turns with it, its
        own parts included, in place of theirs; None: that of its parts.
    mass
        kg of all that slides with the body, its own parts included, in place of theirs; None: that of its
        parts.
    share
        (n,) what of force and torque works at each sample of the motion, as of a spring; None: all.

    Raises
    ------
    KinematicsError
        A number is not finite, or a resistance, an inertia or a mass is below 0.

    Examples
    --------
    >>> brake = Load("wheel", resisting=0.3)
    """

    body: str
    force: Vector = NONE
    torque: Vector = NONE
    point: Vector = NONE
    resisting: float = 0.0
    inertia: float | None = None
    mass: float | None = None
    share: Array | None = field(default=None, compare=False)

    def __post_init__(self) -> None:
        numbers = (
            *self.force,
            *self.torque,
            *self.point,
            self.resisting,
            self.inertia or 0.0,
            self.mass or 0.0,
        )
        if not all(math.isfinite(number) for number in numbers):
            raise KinematicsError(f"the load on {self.body!r} is not finite: {numbers}")
        if self.share is not None and not np.isfinite(self.share).all():
            raise KinematicsError(f"the share of the load on {self.body!r} is not finite everywhere")
        if min(self.resisting, self.inertia or 0.0, self.mass or 0.0) < 0:
            raise KinematicsError(
                f"the load on {self.body!r} resists by {self.resisting:g} N·m and has {self.inertia} kg m² "
                f"and {self.mass} kg; the limit of each is 0"
            )
