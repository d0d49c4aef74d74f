"""How well the disc locks the wheel."""

import math

from mechwright_geneva.mechanism import Mechanism


def horn_polar(m: Mechanism, radius: float) -> float:
    """Polar angle, rad, at which a circle of this radius about the crank's axis cuts the rim."""
    return math.acos((m.axes**2 + m.rim**2 - radius**2) / (2 * m.axes * m.rim))


def free_play(m: Mechanism) -> float:
    """Angle, rad, by which the locked wheel can turn either way.

    The first thing to touch is a horn: it leaves the circle of the concave arc, R_L + c, and meets that of the
    disc, R_L.
    """
    return horn_polar(m, m.arc) - horn_polar(m, m.lock)
