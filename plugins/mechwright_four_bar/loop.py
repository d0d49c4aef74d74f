"""Motion of the four-bar from the position of its crank to the jerk of its follower, in closed form.

All angles are counter-clockwise from X; A0 = 0. With d = f e^{iθ} - a e^{iφ} from A to B0, D = |d|:

* loop a e^{iφ} + c e^{iσ} = f e^{iθ} + b e^{iψ};
* c e^{iσ} = d (k + i β W) / (2 D²), k = c² - b² + D², W² = (c + D + b)(c + D - b)(b + c - D)(b - c + D),
  branch β = ±1;
* the n-th derivative of the loop is c e^{iσ} i σ⁽ⁿ⁾ - b e^{iψ} i ψ⁽ⁿ⁾ = Rₙ with Rₙ of lower derivatives, so
  σ⁽ⁿ⁾ = -Re(Rₙ e^{-iψ}) / (c sin(σ - ψ)) and ψ⁽ⁿ⁾ = -Re(Rₙ e^{-iσ}) / (b sin(σ - ψ)).

Rates are per radian of the crank here; at a toggle, sin(σ - ψ) = 0, they are infinite.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from mechwright import Array
from mechwright.mechanics.planar import BodyMotion, Plane, PointMotion, Turning
from mechwright_four_bar.dimensions import FourBar


@dataclass(frozen=True, slots=True)
class Rates:
    """Direction exp(i angle) (...) of a link, and the first three derivatives of its angle by the crank's."""

    direction: Plane
    first: Array
    second: Array
    third: Array

    def turning(self, drive: Turning) -> Turning:
        """The same over time, with the crank's own rates; the angle runs on over a turn."""
        angle = np.unwrap(np.angle(self.direction))
        return Turning(angle, *drive.carried(self.first, self.second, self.third))


@dataclass(frozen=True, slots=True)
class Loop:
    """The links at crank angles φ (...); NaN where the loop cannot be closed.

    Parameters
    ----------
    phi
        Crank angles (...), rad.
    joint_a, joint_b
        A and B (...), mm from A0.
    coupler, follower
        Their directions and rates.
    """

    phi: Array
    joint_a: Plane
    joint_b: Plane
    coupler: Rates
    follower: Rates

    def bodies(self, bar: FourBar, drive: Turning | float) -> dict[str, BodyMotion]:
        """Motion over time of ``crank`` (origin A0), ``coupler`` (A, x to B) and ``follower`` (B0).

        ``drive`` is the crank at the same samples, or its constant speed, rad/s.
        """
        if not isinstance(drive, Turning):
            drive = Turning.of(self.phi, drive)
        lever = bar.crank * np.exp(1j * self.phi)
        origin = PointMotion.of(
            self.joint_a,
            drive.velocity_factor * lever,
            drive.acceleration_factor * lever,
            drive.jerk_factor * lever,
        )
        pivot = complex(bar.ground * np.exp(1j * bar.ground_angle))
        return {
            "crank": BodyMotion.about(0j, drive),
            "coupler": BodyMotion(origin, self.coupler.turning(drive)),
            "follower": BodyMotion.about(pivot, self.follower.turning(drive)),
        }


def close(bar: FourBar, phi: ArrayLike) -> Loop:
    """Close the loop at crank angles φ (...), rad.

    Examples
    --------
    >>> loop = close(FourBar(40, 120, 80, 100), np.deg2rad(120))
    >>> round(float(loop.coupler.first * 10), 9), round(float(loop.follower.first * 10), 9)
    (1.394587381, 5.143123395)
    """
    phi = np.asarray(phi, dtype=float)
    a, c, b = bar.crank, bar.coupler, bar.follower
    crank = np.exp(1j * phi)
    d = np.asarray(bar.ground * np.exp(1j * np.asarray(bar.ground_angle)) - a * crank, dtype=np.complex128)
    with np.errstate(invalid="ignore", divide="ignore"):
        s, p = directions(d, c, b, bar.branch)
        sine = (s * np.conj(p)).imag
        coupler, follower = -1 / (c * sine), -1 / (b * sine)
        r = -1j * a * crank
        w1, v1 = coupler * (r * np.conj(p)).real, follower * (r * np.conj(s)).real
        r = a * crank + c * w1**2 * s - b * v1**2 * p
        w2, v2 = coupler * (r * np.conj(p)).real, follower * (r * np.conj(s)).real
        r = 1j * a * crank + c * (3 * w1 * w2 + 1j * w1**3) * s - b * (3 * v1 * v2 + 1j * v1**3) * p
        w3, v3 = coupler * (r * np.conj(p)).real, follower * (r * np.conj(s)).real
    joint_a = np.asarray(a * crank, dtype=np.complex128)
    return Loop(phi, joint_a, joint_a + c * s, Rates(s, w1, w2, w3), Rates(p, v1, v2, v3))


def directions(d: Plane, coupler: ArrayLike, follower: ArrayLike, branch: int) -> tuple[Plane, Plane]:
    """Directions exp(i angle) (...) of coupler and follower over the vector d (...) from A to B0.

    NaN where the two do not reach.
    """
    c, b = np.asarray(coupler), np.asarray(follower)
    distance = np.abs(d)
    with np.errstate(invalid="ignore", divide="ignore"):
        k = (c - b) * (c + b) + distance**2
        w = np.sqrt((c + distance + b) * (c + distance - b) * (b + c - distance) * (b - c + distance))
        s = d * (k + 1j * branch * w) / (2 * c * distance**2)
        p = (c * s - d) / b
        p /= np.abs(p)  # what is left of the rounding where b is far smaller than c
    return s, p
