"""The dimensions of a geared five-bar, and its machine.

All angles are counter-clockwise from X; A0 = 0. With the crank at θ and the arm at φ = δ + ρ θ the links
close as r1 e^{iθ} + c e^{iσ} = f e^{iγ} + r4 e^{iφ} + r3 e^{iψ}. The acute transmission angle μ between
coupler and rocker has cos μ = |c² + r3² - D²| / (2 c r3), with the distance D of A and B1.

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
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from mechwright import Array
from mechwright.contracts.design_table import Rowwise, number
from mechwright.mechanics.planar import Turning
from mechwright.mechanics.planar.free_bodies import GROUND
from mechwright.mechanics.planar.machine import Drive, GearPair, Machine, Revolute
from mechwright.mechanics.planar.positions import Solution, solve
from mechwright_five_bar.parameters import FiveBarParams


@dataclass(frozen=True)
class FiveBar(Rowwise):
    """Lengths in mm, angles in rad, branch +1 (open) or -1 (crossed); columns (n, 1) of a table of designs.

    Parameters
    ----------
    crank, coupler, rocker, arm, ground, ground_angle
        See the module; the direction γ of B0 from A0.
    offset, teeth, sense, branch
        δ; teeth of the gears on crank and arm; +1 where both turn the same way; the side of A-B1 that has C.

    Examples
    --------
    >>> bar = FiveBar(100, 90, 130, 100, 125, 0.0, math.radians(3.5), (20, 40), 1)
    >>> bar.ratio, bar.turns
    (0.5, 2)

    The path point of the reference in its first pose, from A along the coupler and across:

    >>> found = bar.at(math.radians(83)).bodies["coupler"].point(30 + 85j).position
    >>> complex(found[0]).__format__(".6f")
    '-5.768823+187.586890j'
    """

    crank: Any
    coupler: Any
    rocker: Any
    arm: Any
    ground: Any
    ground_angle: Any
    offset: Any
    teeth: tuple[int, int]
    sense: int
    branch: Any = 1

    @property
    def ratio(self) -> float:
        """Turns of the arm per turn of the crank."""
        return self.sense * self.teeth[0] / self.teeth[1]

    @property
    def turns(self) -> int:
        """Turns of the crank that bring the linkage back."""
        return self.teeth[1] // math.gcd(*self.teeth)

    @property
    def lengths(self) -> tuple[Any, Any, Any, Any, Any]:
        """Crank, coupler, rocker, arm, ground, mm."""
        return self.crank, self.coupler, self.rocker, self.arm, self.ground

    @property
    def pivot(self) -> Any:
        """B0 from A0."""
        return number(self.ground * np.exp(1j * self.ground_angle))

    @property
    def machine(self) -> Machine:
        """Links, pins and gears; the frames of crank, coupler, rocker and arm begin in A0, A, B1 and B0."""
        joints = (
            Revolute("A0", GROUND, "crank", 0j, 0j),
            Revolute("A", "crank", "coupler", self.crank, 0j),
            Revolute("C", "coupler", "rocker", self.coupler, self.rocker),
            Revolute("B1", "arm", "rocker", self.arm, 0j),
            Revolute("B0", GROUND, "arm", self.pivot, 0j),
            GearPair("gears", "crank", "arm", GROUND, self.ratio, self.offset),
        )
        return Machine(joints, [Drive("crank")], {"C": self.branch})

    def at(self, theta: ArrayLike) -> Solution:
        """Poses of the links at angles (..., n) of the crank, or at one, rad."""
        return solve(self.machine, [Turning.of(np.atleast_1d(theta))], rates=0)

    def pivots(self, theta: ArrayLike) -> tuple[Any, Any]:
        """A and B1 (...) with the crank at angles θ (...), mm."""
        theta = np.asarray(theta, dtype=float)
        arm = self.arm * np.exp(1j * (self.offset + self.ratio * theta))
        return self.crank * np.exp(1j * theta), self.pivot + arm

    def squared_distance(self, theta: ArrayLike) -> Array:
        """D² (...), mm²."""
        a, b1 = self.pivots(theta)
        square: Array = np.abs(b1 - a) ** 2
        return square


def bar_of(params: FiveBarParams) -> FiveBar:
    """The dimensions of a design, or of a table of designs."""
    return FiveBar(
        params.crank,
        params.coupler,
        params.rocker,
        params.arm,
        params.ground,
        number(np.radians(params.ground_angle)),
        number(np.radians(params.arm_angle)),
        (params.crank_teeth, params.arm_teeth),
        1 if params.idler_teeth else -1,
        number(np.where(np.asarray(params.branch) == "open", 1, -1)),
    )
