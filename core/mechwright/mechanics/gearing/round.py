"""Round pitch curves: involute gears as the simplest case of the contract."""

import math
from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.gearing.pair import Pair
from mechwright.mechanics.gearing.pitch_curve import Frame, PitchCurve


@dataclass(frozen=True)
class Round(PitchCurve):
    """A circle about the axis; its parameter is the direction.

    Examples
    --------
    >>> bool(abs(Round(20.0).perimeter - 40 * math.pi) < 1e-12)
    True
    """

    radius: float

    @property
    def perimeter(self) -> float:
        """2 π r, mm."""
        return math.tau * self.radius

    def arc(self, t: Array) -> Array:
        """Arc length r t (...), mm."""
        result: Array = self.radius * np.asarray(t, dtype=float)
        return result

    def arc_rate(self, t: Array) -> Array:
        """Derivative r (...), mm/rad."""
        return np.full(np.shape(t), self.radius)

    def parameter(self, arc: Array) -> Array:
        """Direction (...), rad, at arc lengths (...), mm: exact, where the table would only be near."""
        result: Array = np.asarray(arc, dtype=float) / self.radius
        return result

    def frame(self, t: Array, arc: Array | None = None) -> Frame:
        """The moving frame at directions (...)."""
        cos, sin = np.cos(t), np.sin(t)
        normal = np.stack((cos, sin), axis=-1)
        tangent = np.stack((-sin, cos), axis=-1)
        found = self.arc(t) if arc is None else arc
        return Frame(found, self.radius * normal, tangent, normal, np.full(np.shape(t), self.radius))


@dataclass(frozen=True)
class RoundPair(Pair):
    """Two circles that roll on each other from outside.

    Parameters
    ----------
    start
        θ2 at θ1 = 0, rad: gears whose first teeth stand on their x axes mesh with π - π/z2.
    """

    driver: Round
    driven: Round
    start: float = 0.0

    @classmethod
    def of(cls, driver: float, driven: float, start: float = 0.0) -> "RoundPair":
        """Of pitch radii, mm."""
        return cls(Round(driver), Round(driven), driver + driven, start)

    def law(self, theta: Array) -> tuple[Array, Array]:
        """θ2 = start - θ1 r1/r2, and its derivative."""
        ratio = -self.driver.radius / self.driven.radius
        theta = np.asarray(theta, dtype=float)
        return self.start + ratio * theta, np.full(theta.shape, ratio)
