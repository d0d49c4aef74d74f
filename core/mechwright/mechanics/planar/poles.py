"""Poles and circles of a body that moves in the plane, and what the acceleration of its drive does to them.

Glossary
--------
instant centre
    P, the point of the body that has no velocity just now.
inflection circle
    The points whose acceleration is along their velocity: their paths are straight just there.
circle of zero tangential acceleration
    The points whose acceleration is across their velocity; with the inflection circle the Bresse circles.
acceleration pole
    G, the point without acceleration: the circles meet in P and in G.
acceleration ratio
    k = α/ω² of the drive, per radian.

With u the velocity with which P goes along its centrode, the circles have the diameters J = -i u/ω and
T = u ω/α from P, and G = P + J/(1 - i α/ω²). The drive's acceleration adds k times the velocity to the
acceleration of every point, and k ω to α: it leaves u and J as they are, so that the poles of all k are the
inflection circle without P, and the k of a pole in a place is - (its acceleration at k = 0) / (its velocity).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from mechwright.arrays import Array
from mechwright.mechanics.planar.rigid import FARTHEST, BodyMotion, Plane, Pole


@dataclass(frozen=True, slots=True)
class Circles:
    """Instant centre and Bresse circles (...) on the ground, mm; what is at infinity is NaN.

    Parameters
    ----------
    instant_centre
        P.
    inflection, tangential
        Diameters from P as vectors: of the inflection circle, J, and of the circle of zero tangential
        acceleration, T.
    """

    instant_centre: Plane
    inflection: Plane
    tangential: Plane

    @property
    def inflection_pole(self) -> Plane:
        """The point P + J, opposite to P on the inflection circle."""
        return self.instant_centre + self.inflection


def circles(body: BodyMotion) -> Circles:
    """The circles of a body; none where it does not turn, and no second one where it does so evenly.

    Examples
    --------
    The inflection circle of a wheel that rolls on a line has the wheel's radius as its diameter:

    >>> from mechwright.mechanics.planar import PointMotion, Turning
    >>> wheel = BodyMotion(PointMotion.of([2j], [-2.0]), Turning.of([0.0], 1.0))
    >>> found = circles(wheel)
    >>> found.instant_centre.round(9).tolist(), found.inflection_pole.round(9).tolist()
    ([0j], [2j])
    """
    omega, alpha = body.turning.omega, body.turning.alpha
    v, a = body.origin.velocity, body.origin.acceleration
    with np.errstate(all="ignore"):
        lever = 1j * v / omega
        u = v + 1j * a / omega - 1j * v * alpha / omega**2
        found = lever, -1j * u / omega, u * omega / alpha
        return Circles(body.origin.position + _near(found[0]), _near(found[1]), _near(found[2]))


def acceleration_pole(body: BodyMotion) -> Pole:
    """The point without acceleration, G = A - a_A / (i α - ω²); none where all points share one acceleration.

    Examples
    --------
    >>> from mechwright.mechanics.planar import Turning
    >>> crank = BodyMotion.about(1 + 0j, Turning.of([0.0], 3.0))
    >>> acceleration_pole(crank).fixed.tolist()
    [(1+0j)]
    """
    value, factor = np.broadcast_arrays(body.origin.acceleration, body.turning.acceleration_factor)
    finite = np.abs(value) < FARTHEST * np.abs(factor)
    lever = np.where(finite, -value / np.where(finite, factor, 1.0), np.nan + 0j)
    return Pole(body.origin.position + lever, lever / body.turning.direction)


def ratio_of_pole(body: BodyMotion, place: ArrayLike) -> tuple[Array, Array]:
    """The acceleration ratio of the drive at which a body has its acceleration pole in a place of the ground.

    Parameters
    ----------
    body
        Its motion (...) with the drive at 1 rad/s, constant.
    place
        Places (...), mm.

    Returns
    -------
    ratio, miss
        k (...), per radian, with which the place accelerates least, and the sine of the angle between its
        acceleration and its velocity: 0 where the place is on the inflection circle, and the pole is there.
        NaN in the instant centre, which no k makes the pole.
    """
    lever = np.asarray(place, dtype=complex) - body.origin.position
    velocity = body.origin.velocity + body.turning.velocity_factor * lever
    acceleration = body.origin.acceleration + body.turning.acceleration_factor * lever
    with np.errstate(all="ignore"):
        ratio = -acceleration / velocity
        miss = np.where(acceleration == 0, 0.0, np.abs(ratio.imag) / np.abs(ratio))
        return np.where(np.isfinite(ratio), ratio.real, np.nan), miss


def _near(vector: Plane) -> Plane:
    """NaN for what is at infinity."""
    return np.where(np.abs(vector) < FARTHEST, vector, np.nan + 0j)
