"""What works on a mechanism from outside: forces, torques, and inertia that hangs on its bodies."""

import math
from dataclasses import dataclass

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
        On the body in the coordinates of the poses, N and N·m, the same all along.
    point
        Of the body, in its coordinates, at which the force works, mm.
    resisting
        Torque against the body's turning whichever way it turns, N·m.
    inertia
        Moment of inertia, kg m², about the body's own z through its origin, of all that turns with it, its
        own parts included, in place of theirs; None: that of its parts.

    Raises
    ------
    KinematicsError
        A number is not finite, or a resistance or an inertia is below 0.

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

    def __post_init__(self) -> None:
        numbers = (*self.force, *self.torque, *self.point, self.resisting, self.inertia or 0.0)
        if not all(math.isfinite(number) for number in numbers):
            raise KinematicsError(f"the load on {self.body!r} is not finite: {numbers}")
        if self.resisting < 0 or (self.inertia or 0.0) < 0:
            raise KinematicsError(
                f"the load on {self.body!r} resists by {self.resisting:g} N·m and has {self.inertia} kg m²; "
                "the limit of both is 0"
            )
