"""A window of constant ratio, quintic blends on both sides of it, and the constant that closes the turn."""

import math
from dataclasses import dataclass

import numpy as np

from mechwright import Array
from mechwright.mechanics.gearing import RatioLaw


@dataclass(frozen=True)
class WindowLaw(RatioLaw):
    """The ratio ``ratio`` for |φ| up to half of ``width``, blends of ``blend`` each, rad, and :attr:`beyond`.

    A blend is the smoothstep x³ (10 - 15 x + 6 x²): no derivative up to the second jumps at its ends.
    """

    lobes: tuple[int, int]
    ratio: float
    width: float
    blend: float

    @property
    def beyond(self) -> float:
        """The ratio outside: the mean of a blend is 1/2, so that (2π/N2 - i (2h + b))/(T - 2h - b)."""
        taken = self.width + self.blend
        return (math.tau / self.lobes[1] - self.ratio * taken) / (self.period - taken)

    @property
    def breaks(self) -> tuple[float, ...]:
        """Both ends of both blends."""
        near, far = self.width / 2, self.width / 2 + self.blend
        return (near, far, self.period - far, self.period - near)

    def rates(self, phi: Array) -> tuple[Array, Array, Array]:
        """Of the smoothstep on both sides of the middle."""
        turned = np.asarray(phi, dtype=float)
        away = np.mod(turned + self.period / 2, self.period) - self.period / 2
        x = np.clip((np.abs(away) - self.width / 2) / self.blend, 0.0, 1.0)
        side, step = np.sign(away) / self.blend, self.beyond - self.ratio
        return (
            self.ratio + step * x**3 * (10 - 15 * x + 6 * x * x),
            step * side * 30 * (x * (1 - x)) ** 2,
            step * side**2 * 60 * x * (1 - x) * (1 - 2 * x),
        )
