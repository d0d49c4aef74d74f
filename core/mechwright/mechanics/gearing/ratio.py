"""The law of a pair: how fast the driven gear turns for each angle of the driver.

Glossary
--------
φ
    Angle of the driver, rad.
ψ
    Angle of the driven gear, counted positive in the sense in which it turns, rad; ψ = 0 at φ = 0.
ratio
    i = dψ/dφ, above 0: output over input, so that the ratios of a chain multiply. Many texts use its inverse.
lobe
    The piece of a pitch curve that repeats: N1 of them on the driver, N2 on the driven gear.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Sequence
from functools import cached_property

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.gearing.primitive import Primitive

BEYOND = 2.0
"""rad beyond each end of a sector's travel for which its pitch curves go on: the coarsest teeth need two
pitches."""


class RatioLaw(ABC):
    """A law of period 2π/N1 whose mean is N1/N2: both pitch curves close.

    The ratio and its first derivative are continuous, or the pitch curves have a corner; where its second
    derivative jumps, their curvature does.
    """

    lobes: tuple[int, int]
    """N1 and N2."""

    @property
    def period(self) -> float:
        """2π/N1, rad: one lobe of the driver."""
        return math.tau / self.lobes[0]

    @property
    def travel(self) -> float | None:
        """Angle, rad, from φ = 0 over which sectors roll on each other; None: gears go all the way round.

        The pitch curves of a sector go on for :data:`BEYOND` behind both ends, and need not close.
        """
        return None

    @property
    def breaks(self) -> Sequence[float]:
        """Angles φ within a period at which some derivative of the ratio jumps; none by default."""
        return ()

    @abstractmethod
    def rates(self, phi: Array) -> tuple[Array, Array, Array]:
        """i, di/dφ and d²i/dφ² (...) at angles φ (...), rad."""

    @cached_property
    def _integral(self) -> Primitive:
        return Primitive.of(lambda phi: self.rates(phi)[0], self.period, self.breaks)

    def angle(self, phi: Array) -> Array:
        """ψ (...), rad, at angles φ (...): the integral of the ratio."""
        return self._integral(phi)

    def grid(self, count: int) -> Array:
        """Angles φ (n,), rad, over one lobe at which extremes are sought; every break is one of them."""
        even = np.linspace(0.0, self.period, count)
        return np.unique(np.concatenate((even, np.asarray(self.breaks, dtype=float))))
