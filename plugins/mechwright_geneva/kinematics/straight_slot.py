"""The motion of the classical wheel with straight slots, as a law.

The roller enters along the slot, so the half angles of crank and wheel make a right angle, and with
L = b/a = sin θw0, φ = θd0 - θd:

    θw = θw0 - β,  β = atan2(L sin φ, 1 - L cos φ)
    θw' = L (cos φ - L)/D,  θw'' = L (1 - L²) sin φ/D²,  D = 1 + L² - 2 L cos φ
    θw''' = -L (1 - L²) (cos φ/D² - 4 L sin²φ/D³)
"""

import math
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from mechwright.mechanics.laws import Law, Peaks, Rates


class StraightSlot(Law):
    """The law that a straight slot forces on the wheel.

    Parameters
    ----------
    slots
        Number of slots n, 3 or more.

    Examples
    --------
    >>> law = StraightSlot(4)
    >>> round(law.peaks.v * law.wheel_half_angle / law.crank_half_angle, 9)
    2.414213562
    """

    def __init__(self, slots: int) -> None:
        self.name = "straight"
        self.wheel_half_angle = math.pi / slots
        self.crank_half_angle = math.pi / 2 - self.wheel_half_angle
        self.ratio = math.sin(self.wheel_half_angle)

    @property
    def breaks(self) -> tuple[float, ...]:
        """None."""
        return ()

    def at(self, u: ArrayLike) -> Rates:
        """The rates at u (...)."""
        phi = self.crank_half_angle * (1 - 2 * np.asarray(u, dtype=float))
        ratio, sin, cos = self.ratio, np.sin(phi), np.cos(phi)
        d = 1 + ratio**2 - 2 * ratio * cos
        angle = self.wheel_half_angle - np.arctan2(ratio * sin, 1 - ratio * cos)
        skew = ratio * (1 - ratio**2)
        way, time = 2 * self.wheel_half_angle, 2 * self.crank_half_angle
        return Rates(
            angle / way,
            ratio * (cos - ratio) / d * time / way,
            skew * sin / d**2 * time**2 / way,
            -skew * (cos / d**2 - 4 * ratio * sin**2 / d**3) * time**3 / way,
        )

    @cached_property
    def peaks(self) -> Peaks:
        """At mid stroke; the acceleration's where cos φ = sqrt(q² + 2) - q, q = (1 + L²)/(4 L)."""
        q = (1 + self.ratio**2) / (4 * self.ratio)
        phi = math.acos(math.sqrt(q * q + 2) - q)
        at = self.at(np.array([0.5, (1 - phi / self.crank_half_angle) / 2]))
        return Peaks(float(at.v[0]), abs(float(at.a[1])), abs(float(at.j[0])))

    @property
    def least_velocity(self) -> float:
        """0 at both ends."""
        return 0.0
