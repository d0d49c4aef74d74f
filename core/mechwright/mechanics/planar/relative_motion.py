"""Motion of one link as seen from another, whose acceleration pole and instant centre are those of the pair.

With z = e^{-iθⱼ} (Oᵢ - Oⱼ), W = ωᵢ - ωⱼ and L = αᵢ - αⱼ the acceleration pole of i relative to j is
z + z''/(W² - i L) in the frame of j, and the instant centre z + i z'/W. The pole of j relative to i is
another point, at the same distance from the instant centre.
"""

import numpy as np

from mechwright.mechanics.planar.poles import Circles, acceleration_pole, circles
from mechwright.mechanics.planar.rigid import BodyMotion, Plane, PointMotion, Pole, Turning

PARALLEL = 1e-12
"""Relative rates below this share of those of both links are rounding: the links translate to each other."""


def relative(body: BodyMotion, seen_from: BodyMotion) -> BodyMotion:
    """The motion of a body in the frame of another one.

    Examples
    --------
    Two cranks about one centre that turn alike stand still to each other:

    >>> crank = BodyMotion.about(1j, Turning.of([0.5], 3.0, 2.0))
    >>> found = relative(crank, crank)
    >>> found.turning.omega.tolist(), found.origin.acceleration.tolist()
    ([0.0], [0j])
    """
    one, two = body.turning, seen_from.turning
    back = Turning(-two.theta, -two.omega, -two.alpha, -two.jerk)
    a, b = body.origin, seen_from.origin
    r, v = a.position - b.position, a.velocity - b.velocity
    acceleration, jerk = a.acceleration - b.acceleration, a.jerk - b.jerk
    turn, first = back.direction, back.velocity_factor
    second, third = back.acceleration_factor, back.jerk_factor
    origin = PointMotion(
        r * turn,
        (v + first * r) * turn,
        (acceleration + 2 * first * v + second * r) * turn,
        (jerk + 3 * first * acceleration + 3 * second * v + third * r) * turn,
    )
    turning = Turning(
        one.theta - two.theta, one.omega - two.omega, one.alpha - two.alpha, one.jerk - two.jerk
    )
    return BodyMotion(origin, turning)


def relative_pole(body: BodyMotion, seen_from: BodyMotion) -> tuple[Pole, Plane]:
    """The acceleration pole of a body relative to another one.

    Returns
    -------
    pole, ground
        Where it is in the frame of ``seen_from`` (its ``fixed``) and in that of the body, and where that is
        on the ground (...), mm. NaN where the links translate to each other.
    """
    pole = acceleration_pole(_turning_only(body, seen_from))
    return pole, _on_ground(pole.fixed, seen_from)


def relative_circles(body: BodyMotion, seen_from: BodyMotion) -> Circles:
    """Instant centre and Bresse circles of a body relative to another one, in the frame of the latter."""
    return circles(_turning_only(body, seen_from))


def instant_centre(body: BodyMotion, seen_from: BodyMotion) -> Plane:
    """The point (...) that both have in common for an instant, on the ground, mm."""
    return _on_ground(relative_circles(body, seen_from).instant_centre, seen_from)


def _on_ground(place: Plane, frame: BodyMotion) -> Plane:
    return frame.origin.position + place * frame.turning.direction


def _turning_only(body: BodyMotion, seen_from: BodyMotion) -> BodyMotion:
    """The relative motion, with rates that are no more than rounding set to NaN: no pole, no centre."""
    seen, one, two = relative(body, seen_from), body.turning, seen_from.turning
    speed, rate = np.abs(one.omega) + np.abs(two.omega), np.abs(one.alpha) + np.abs(two.alpha)
    shifts = np.abs(seen.turning.omega) <= PARALLEL * speed
    shifts &= np.abs(seen.turning.alpha) <= PARALLEL * (rate + speed**2)
    omega = np.where(shifts, np.nan, seen.turning.omega)
    return BodyMotion(seen.origin, Turning(seen.turning.theta, omega, seen.turning.alpha, seen.turning.jerk))
