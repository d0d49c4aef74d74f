"""The pitch curve of a gear: the contract on which teeth stand and which rolls on its mate.

Glossary
--------
body frame
    The gear's own: origin on the axis of rotation, angles counter-clockwise.
t
    The curve's own parameter, rad: 2π once round, counter-clockwise. It need not be an angle.
arc
    Arc length s from t = 0, mm, counter-clockwise. Neither wraps: t + 2π lies one perimeter on.
"""

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mechwright.arrays import Array

GUESSES = 513
"""Entries of the table that inverts the arc length: 2e-5 rad wrong on a smooth curve, which two Newton steps
make rounding."""

NEWTON_STEPS = 3
"""One more than the table's error needs."""

LAST_STEP = 1e-9
"""Step of Newton's method, rad, whose square is rounding: none after it changes anything."""


@dataclass(frozen=True)
class Frame:
    """Moving frame of a pitch curve, counter-clockwise, in the body frame.

    It turns as dr/ds = t, dt/ds = -n/ρ, dn/ds = t/ρ. The normal points out of the body: n = -i t of a gear,
    and n = +i t, towards the axis, of a ring, whose body lies around its curve.

    Parameters
    ----------
    arc
        Arc length (...), mm.
    point, tangent, normal
        (..., 2); the point r in mm, the tangent t and the normal n out of the body, of unit length.
    radius
        Radius of curvature ρ (...), mm: above 0 where the body is convex, below 0 where it is hollow, as a
        ring is all round, infinite where it is straight.
    """

    arc: Array
    point: Array
    tangent: Array
    normal: Array
    radius: Array

    @property
    def polar_radius(self) -> Array:
        """Distance (...), mm, from the axis."""
        radius: Array = np.hypot(self.point[..., 0], self.point[..., 1])
        return radius

    @property
    def polar_angle(self) -> Array:
        """Direction (...), rad, as seen from the axis, in [-π, π]."""
        angle: Array = np.arctan2(self.point[..., 1], self.point[..., 0])
        return angle

    def offset(self, height: float) -> Array:
        """Points (..., 2), mm, at a height over the curve, along its normal."""
        points: Array = self.point + height * self.normal
        return points

    @property
    def tilt(self) -> Array:
        """Angle ν (...), rad, of the tangent against the circle about the axis: tan ν = dr/(r dθ)."""
        tilt: Array = np.arcsin((self.tangent * self.point).sum(axis=-1) / self.polar_radius)
        return tilt


class PitchCurve(ABC):
    """A smooth closed curve about the axis, seen from which its direction rises all the way round.

    Position and tangent are continuous; flanks stay smooth where the curvature jumps.
    """

    @property
    @abstractmethod
    def perimeter(self) -> float:
        """Arc length once round, mm: the number of teeth times the pitch."""

    @abstractmethod
    def arc(self, t: Array) -> Array:
        """Arc length (...), mm, from t = 0 to parameters (...), to rounding."""

    @abstractmethod
    def arc_rate(self, t: Array) -> Array:
        """Derivative ds/dt (...), mm/rad, above 0."""

    @abstractmethod
    def frame(self, t: Array, arc: Array | None = None) -> Frame:
        """The moving frame at parameters (...); ``arc`` is given where it is known already."""

    @property
    def breaks(self) -> Array:
        """Parameters (n,), rad, 0 to 2π, at which the curvature jumps; none by default."""
        return np.empty(0)

    def around(self, count: int) -> Array:
        """Parameters (count,), rad, along all of the curve that has teeth, in equal steps."""
        return np.linspace(0.0, math.tau, count, endpoint=False)

    @cached_property
    def _table(self) -> tuple[Array, Array]:
        t = np.linspace(0, math.tau, GUESSES)
        return self.arc(t), t

    def parameter(self, arc: Array) -> Array:
        """Parameter t (...), rad, at arc lengths (...), mm: Newton's method on :meth:`arc`."""
        turns, rest = np.divmod(np.asarray(arc, dtype=float), self.perimeter)
        t = np.interp(rest, *self._table)
        result: Array = self._inverted(t, rest) + math.tau * turns
        return result

    def _inverted(self, t: Array, arc: Array) -> Array:
        """Parameters (...), rad, at arc lengths (...), mm, from others near them."""
        for _ in range(NEWTON_STEPS):
            step = (self.arc(t) - arc) / self.arc_rate(t)
            t = t - step
            if not step.size or np.abs(step).max() < LAST_STEP:
                break
        return t

    def frame_at(self, arc: Array) -> Frame:
        """The moving frame at arc lengths (...), mm."""
        return self.frame(self.parameter(arc), np.asarray(arc, dtype=float))
