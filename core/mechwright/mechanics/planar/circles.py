"""Curvature of the paths of a moving body, and the circles that order them.

With the velocity pole P, its rate of change u along the centrodes, and z = r - P:

* u = v_A + i a_A/ω - i v_A α/ω²;
* the inflection circle goes through P and P + J, J = -i u/ω: there the acceleration has no normal part;
* the Bresse circle goes through P and P + T, T = u ω/α: there it has no tangential part;
* the acceleration pole is the foot of the perpendicular from P on the line from P + J to P + T;
* Euler and Savary: the path of r has its centre of curvature in r - |z|² z / (|z|² - Re(z* J)).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.mechanics.planar.poles import FARTHEST, velocity_pole
from mechwright.mechanics.planar.rigid import BodyMotion, Plane, PointMotion


@dataclass(frozen=True, slots=True)
class Circle:
    """A circle at each sample.

    Parameters
    ----------
    near, far
        Ends (...) of a diameter, mm: the velocity pole, and the point across; NaN where there is no circle.
    exists
        Where (...) there is one. The inflection circle is missing where ω = 0, the Bresse circle also where
        α = 0: it is then the straight pole tangent.
    """

    near: Plane
    far: Plane
    exists: NDArray[np.bool_]

    @property
    def centre(self) -> Plane:
        """Centres (...), mm."""
        return (self.near + self.far) / 2

    @property
    def diameter(self) -> Array:
        """Diameters (...), mm."""
        return np.abs(self.far - self.near)


@dataclass(frozen=True, slots=True)
class Curvature:
    """Curvature of a path at each sample.

    Parameters
    ----------
    signed
        Curvature (...), 1/mm, positive where the path bends to the left of the velocity; NaN at a cusp.
    centre
        Centre of curvature (...), mm; NaN at a cusp and where the path is straight.
    cusp
        Where (...) the point stands still, so that the path has no direction.
    straight
        Where (...) the point is on the inflection circle, so that the centre is at infinity.
    """

    signed: Array
    centre: Plane
    cusp: NDArray[np.bool_]
    straight: NDArray[np.bool_]


def pole_velocity(body: BodyMotion) -> Plane:
    """Rate (...), mm/s, at which the velocity pole runs along the centrodes; NaN where it is not finite."""
    pole = velocity_pole(body)
    omega, alpha = _filled(body.turning.omega, pole.finite), body.turning.alpha
    a, v = body.origin.acceleration, body.origin.velocity
    rate: Plane = np.where(pole.finite, v + 1j * (a - v * alpha / omega) / omega, np.nan + 0j)
    return rate


def inflection_circle(body: BodyMotion) -> Circle:
    """The circle of points whose path is straight just now."""
    pole = velocity_pole(body)
    lever = -1j * pole_velocity(body) / _filled(body.turning.omega, pole.finite)
    return _circle(pole.fixed, lever, pole.finite)


def bresse_circle(body: BodyMotion) -> Circle:
    """The circle of points whose speed is stationary just now, also called the cuspidal circle of speeds."""
    pole, turning = velocity_pole(body), body.turning
    rate = pole_velocity(body) * turning.omega
    is_round = pole.finite & (np.abs(rate) < FARTHEST * np.abs(turning.alpha))
    return _circle(pole.fixed, rate / _filled(turning.alpha, is_round), is_round)


def _filled(values: Array, where: NDArray[np.bool_]) -> Array:
    """The values, with ones where they would divide to infinity."""
    return np.where(where, values, 1.0)


def _circle(near: Plane, lever: Plane, exists: NDArray[np.bool_]) -> Circle:
    nowhere = np.nan + 0j
    return Circle(np.where(exists, near, nowhere), np.where(exists, near + lever, nowhere), exists)


def curvature_of_path(point: PointMotion) -> Curvature:
    """Curvature of any path from velocity and acceleration: Im(v* a) / |v|³.

    It needs no pole, so that it holds where the body only shifts too.

    Examples
    --------
    >>> from mechwright.mechanics.planar import PointMotion
    >>> bend = curvature_of_path(PointMotion.of([2.0], 6j, -18.0))  # 3 rad/s on a circle of 2 mm
    >>> bend.signed.tolist(), bend.centre.tolist()
    ([0.5], [0j])
    """
    velocity, acceleration = np.broadcast_arrays(point.velocity, point.acceleration)
    speed = np.abs(velocity)
    # A point that its own acceleration brings to rest within 1/FARTHEST seconds stands still.
    cusp = speed * FARTHEST <= np.abs(acceleration)
    safe = np.where(cusp, 1.0, speed)
    cross = (np.conj(velocity) * acceleration).imag
    signed = np.where(cusp, np.nan, cross / safe**3)
    straight = ~cusp & (np.abs(signed) * FARTHEST <= 1)
    bent = ~cusp & ~straight
    normal = 1j * velocity / safe
    centre = np.where(bent, point.position + normal / np.where(bent, signed, 1.0), np.nan + 0j)
    return Curvature(signed, centre, cusp, straight)
