"""How well the disc locks the wheel."""

import math

from mechwright_geneva.mechanism import Mechanism
from mechwright_geneva.wheel import Wheel


def horn_polar(m: Mechanism, radius: float) -> float:
    """Polar angle, rad, at which a circle of this radius about the crank's axis cuts the rim."""
    return math.acos((m.axes**2 + m.rim**2 - radius**2) / (2 * m.axes * m.rim))


def cover(m: Mechanism) -> float:
    """Crank angle after a stroke's end, rad, from which the disc covers both horns."""
    return Wheel(m).arc_half


def free_play(m: Mechanism) -> float:
    """Angle, rad, by which the locked wheel can turn either way where the disc covers both horns.

    A horn then leaves the circle of the concave arc, R_L + c, and meets that of the disc, R_L.
    """
    return horn_polar(m, m.arc) - horn_polar(m, m.lock)
