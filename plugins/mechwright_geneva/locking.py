"""How well the disc locks the wheel."""

import math

from mechwright_geneva.mechanism import Mechanism
from mechwright_geneva.wheel import Wheel

_STEPS = 8
"""Steps of Newton's method from the small-angle play: quadratic from the first on."""


def horn_polar(m: Mechanism, radius: float) -> float:
    """Polar angle, rad, at which a circle of this radius about the crank's axis cuts the rim."""
    return math.acos((m.axes**2 + m.rim**2 - radius**2) / (2 * m.axes * m.rim))


def cover(m: Mechanism) -> float:
    """Crank angle after a stroke's end, rad, from which the disc covers both horns."""
    return Wheel(m).arc_half


def free_play(m: Mechanism, after: float | None = None) -> float:
    """Angle, rad, by which the wheel locked by the disc can turn either way.

    Parameters
    ----------
    m
        The mechanism.
    after
        Crank angle from the nearer end of the dwell, rad, above 0; the middle of the dwell if left out.

    Notes
    -----
    Where the disc covers both horns, a horn leaves the circle of the concave arc, R_L + c, and meets that of
    the disc, R_L. Nearer to an end it is the end of the disc's arc that meets the concave arc, which turns by
    t about the wheel's axis: abs(R_L d - a (exp(it) - 1)) = R_L + c, d the direction of the arc's end; about
    c/(a sin η) at η from the end.
    """
    middle = m.pitch / 2 - m.crank_half
    eta = middle if after is None else min(after, m.pitch - 2 * m.crank_half - after)
    if eta >= cover(m):
        return horn_polar(m, m.arc) - horn_polar(m, m.lock)
    play = m.params.lock_clearance / (m.axes * math.sin(eta))
    for _ in range(_STEPS):
        miss, slope = _miss(m, eta, play)
        play -= miss / slope
    return play


def _miss(m: Mechanism, eta: float, turn: float) -> tuple[float, float]:
    """How far the end of the disc's arc stands in the turned concave arc, and its rate."""
    x = -m.lock * math.cos(eta) - m.axes * (math.cos(turn) - 1)
    y = -m.lock * math.sin(eta) - m.axes * math.sin(turn)
    distance = math.hypot(x, y)
    slope = (x * m.axes * math.sin(turn) - y * m.axes * math.cos(turn)) / distance
    return distance - m.arc, slope
