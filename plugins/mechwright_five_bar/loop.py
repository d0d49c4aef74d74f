"""The dimensions of a geared five-bar, and its motion from place to jerk in closed form.

All angles are counter-clockwise from X; A0 = 0. With the crank at θ, the arm at φ = δ + ρ θ and the vector
d = f e^{iγ} + r4 e^{iφ} - r1 e^{iθ} from A to B1:

* loop r1 e^{iθ} + c e^{iσ} = f e^{iγ} + r4 e^{iφ} + r3 e^{iψ}, closed by
  :mod:`mechwright.mechanics.planar.dyad`;
* transmission angle μ: acute angle between coupler and rocker, cos μ = |c² + r3² - D²| / (2 c r3).

Glossary
--------
crank r1, coupler c, rocker r3, arm r4, ground f
    A0-A, A-C, B1-C, B0-B1 and A0-B0, mm. The crank drives, and gears turn the arm with it.
ratio ρ
    Turns of the arm per turn of the crank, below 0 where they turn against each other.
offset δ
    Angle of the arm where that of the crank is 0.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from mechwright import Array
from mechwright.mechanics.planar import BodyMotion, Plane, PointMotion, Turning
from mechwright.mechanics.planar.dyad import Rates, dyad


@dataclass(frozen=True, slots=True)
class FiveBar:
    """Lengths in mm, angles in rad, branch +1 (open) or -1 (crossed).

    Parameters
    ----------
    crank, coupler, rocker, arm, ground, ground_angle
        See the module.
    offset, teeth, sense, branch
        δ; teeth of the gears on crank and arm; +1 where both turn the same way; β.

    Examples
    --------
    >>> bar = FiveBar(100, 90, 130, 100, 125, 0.0, math.radians(3.5), (20, 40), 1)
    >>> bar.ratio, bar.turns
    (0.5, 2)
    """

    crank: float
    coupler: float
    rocker: float
    arm: float
    ground: float
    ground_angle: float
    offset: float
    teeth: tuple[int, int]
    sense: int
    branch: int = 1

    @property
    def ratio(self) -> float:
        """Turns of the arm per turn of the crank."""
        return self.sense * self.teeth[0] / self.teeth[1]

    @property
    def turns(self) -> int:
        """Turns of the crank that bring the linkage back."""
        return self.teeth[1] // math.gcd(*self.teeth)

    @property
    def lengths(self) -> tuple[float, float, float, float, float]:
        """Crank, coupler, rocker, arm, ground, mm."""
        return self.crank, self.coupler, self.rocker, self.arm, self.ground

    @property
    def pivot(self) -> complex:
        """B0 from A0."""
        return complex(self.ground * np.exp(1j * self.ground_angle))

    def levers(self, theta: ArrayLike) -> tuple[Plane, Plane]:
        """A from A0 and B1 from B0 (...), mm."""
        theta = np.asarray(theta, dtype=float)
        return (
            np.asarray(self.crank * np.exp(1j * theta), dtype=np.complex128),
            np.asarray(self.arm * np.exp(1j * (self.offset + self.ratio * theta)), dtype=np.complex128),
        )

    def gap(self, theta: ArrayLike) -> tuple[Plane, Plane, Plane, Plane]:
        """The vector d (...) and its first three derivatives by the crank's angle, mm/rad and so on."""
        gap, first, second, third = self.gap_and_rates(theta, 3)
        return gap, first, second, third

    def gap_and_rates(self, theta: ArrayLike, order: int) -> list[Plane]:
        """The same with so many derivatives."""
        one, two = self.levers(theta)
        r = self.ratio
        gap = np.asarray(self.pivot + two - one, dtype=np.complex128)
        return [gap, *(1j**k * (r**k * two - one) for k in range(1, order + 1))]


@dataclass(frozen=True, slots=True)
class Loop:
    """The links at crank angles θ (...); NaN where the loop cannot be closed.

    Parameters
    ----------
    theta
        rad.
    joint_a, joint_b, joint_c
        A, B1 and C (...), mm from A0.
    coupler, rocker
        Their directions and rates.
    """

    theta: Array
    joint_a: Plane
    joint_b: Plane
    joint_c: Plane
    coupler: Rates
    rocker: Rates

    def bodies(self, bar: FiveBar, drive: Turning) -> dict[str, BodyMotion]:
        """Motion over time of ``crank`` (origin A0), ``coupler`` (A, x to C), ``rocker``, ``arm`` (B0)."""
        one, _ = bar.levers(self.theta)
        crank = BodyMotion.about(0j, drive)
        arm = BodyMotion.about(bar.pivot, _geared(bar, drive))
        return {
            "crank": crank,
            "coupler": BodyMotion(_carried(one, drive), self.coupler.turning(drive)),
            "rocker": BodyMotion(arm.point(bar.arm), self.rocker.turning(drive)),
            "arm": arm,
        }


def close(bar: FiveBar, theta: ArrayLike) -> Loop:
    """Close the loop at crank angles θ (...), rad.

    Examples
    --------
    The path point of the reference in its first pose, from A along the coupler and across:

    >>> bar = FiveBar(100, 90, 130, 100, 125, 0.0, math.radians(3.5), (20, 40), 1)
    >>> loop = close(bar, math.radians(83))
    >>> complex(loop.joint_a + (30 + 85j) * loop.coupler.direction).__format__(".6f")
    '-5.768823+187.586890j'
    """
    theta = np.asarray(theta, dtype=float)
    one, two = bar.levers(theta)
    d, first, second, third = bar.gap(theta)
    coupler, rocker = dyad((d, first, second, third), bar.coupler, bar.rocker, bar.branch)
    return Loop(
        theta, one, np.asarray(bar.pivot + two), one + bar.coupler * coupler.direction, coupler, rocker
    )


def _geared(bar: FiveBar, drive: Turning) -> Turning:
    """The arm's turning."""
    turned = drive.scaled(bar.ratio)
    return Turning(turned.theta + bar.offset, turned.omega, turned.alpha, turned.jerk)


def _carried(lever: Plane, drive: Turning) -> PointMotion:
    return PointMotion.of(
        lever, drive.velocity_factor * lever, drive.acceleration_factor * lever, drive.jerk_factor * lever
    )
