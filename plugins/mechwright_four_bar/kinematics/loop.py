"""Motion of the four-bar from the position of its crank to the jerk of its follower, in closed form.

All angles are counter-clockwise from X; A0 = 0. With d = f e^{iθ} - a e^{iφ} from A to B0, D = |d|:

* loop a e^{iφ} + c e^{iσ} = f e^{iθ} + b e^{iψ};
* :mod:`mechwright.mechanics.planar.dyad` closes it over d.

Rates are per radian of the crank here; at a toggle, sin(σ - ψ) = 0, they are infinite.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from mechwright import Array
from mechwright.mechanics.planar import BodyMotion, Plane, PointMotion, Turning
from mechwright.mechanics.planar.dyad import Rates, dyad
from mechwright_four_bar.kinematics.dimensions import FourBar


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

    def bodies(self, bar: FourBar, drive: Turning | float, pivot: complex = 0j) -> dict[str, BodyMotion]:
        """Motion over time of ``crank`` (origin A0), ``coupler`` (A, x to B) and ``follower`` (B0).

        ``drive`` is the crank at the same samples, or its constant speed, rad/s; ``pivot`` is A0, mm.
        """
        if not isinstance(drive, Turning):
            drive = Turning.of(self.phi, drive)
        lever = bar.crank * np.exp(1j * self.phi)
        origin = PointMotion.of(
            self.joint_a + pivot,
            drive.velocity_factor * lever,
            drive.acceleration_factor * lever,
            drive.jerk_factor * lever,
        )
        end = pivot + complex(bar.ground * np.exp(1j * bar.ground_angle))
        return {
            "crank": BodyMotion.about(pivot, drive),
            "coupler": BodyMotion(origin, self.coupler.turning(drive)),
            "follower": BodyMotion.about(end, self.follower.turning(drive)),
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
    lever = bar.crank * np.exp(1j * phi)
    pivot = bar.ground * np.exp(1j * np.asarray(bar.ground_angle))
    d = tuple(np.asarray(one, dtype=np.complex128) for one in (pivot - lever, -1j * lever, lever, 1j * lever))
    coupler, follower = dyad((d[0], d[1], d[2], d[3]), bar.coupler, bar.follower, bar.branch)
    joint_a = np.asarray(lever, dtype=np.complex128)
    return Loop(phi, joint_a, joint_a + bar.coupler * coupler.direction, coupler, follower)
