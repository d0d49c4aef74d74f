"""Round pitch curves: involute gears as the simplest case of the contract."""

import math
from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.gearing.pair import Pair
from mechwright.mechanics.gearing.pitch_curve import Frame, PitchCurve


@dataclass(frozen=True)
class Round(PitchCurve):
    """A circle about the axis; its parameter is the direction. The radius of a ring is below 0.

    Examples
    --------
    >>> bool(abs(Round(20.0).perimeter - 40 * math.pi) < 1e-12)
    True
    """

    radius: float

    @property
    def _size(self) -> float:
        return abs(self.radius)

    @property
    def perimeter(self) -> float:
        """2 π r, mm."""
        return math.tau * self._size

    def arc(self, t: Array) -> Array:
        """Arc length r t (...), mm."""
        result: Array = self._size * np.asarray(t, dtype=float)
        return result

    def arc_rate(self, t: Array) -> Array:
        """Derivative r (...), mm/rad."""
        return np.full(np.shape(t), self._size)

    def parameter(self, arc: Array) -> Array:
        """Direction (...), rad, at arc lengths (...), mm: exact, where the table would only be near."""
        result: Array = np.asarray(arc, dtype=float) / self._size
        return result

    def frame(self, t: Array, arc: Array | None = None) -> Frame:
        """The moving frame at directions (...)."""
        cos, sin = np.cos(t), np.sin(t)
        outward = np.stack((cos, sin), axis=-1)
        tangent = np.stack((-sin, cos), axis=-1)
        found = self.arc(t) if arc is None else arc
        normal = math.copysign(1.0, self.radius) * outward
        return Frame(found, self._size * outward, tangent, normal, np.full(np.shape(t), self.radius))


@dataclass(frozen=True)
class RoundPair(Pair):
    """Two circles that roll on each other, or one in a ring.

    Parameters
    ----------
    start
        θ2 at θ1 = 0, rad: gears whose first teeth stand on their x axes mesh with π - π/z2, and a gear in a
        ring with π/z2.
    """

    driver: Round
    driven: Round
    start: float = 0.0

    @classmethod
    def of(cls, driver: float, driven: float, start: float = 0.0) -> "RoundPair":
        """Of pitch radii, mm; that of a ring is below 0."""
        return cls(Round(driver), Round(driven), abs(driver + driven), start)

    @property
    def side(self) -> int:
        """-1 in a ring."""
        return 1 if self.driven.radius > 0 else -1

    def law(self, theta: Array) -> tuple[Array, Array]:
        """θ2 = start - θ1 r1/r2, and its derivative."""
        ratio = -self.driver.radius / self.driven.radius
        theta = np.asarray(theta, dtype=float)
        return self.start + ratio * theta, np.full(theta.shape, ratio)
