"""The planar geared five-bar from which the projection starts.

Points of the plane are complex numbers. The crank turns about a0 and carries a1, the arm turns about b0 by
the ratio times the crank's angle and carries b1; the coupler a1-c1 carries the path point p, the rocker is
c1-b1.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mechwright.arrays import Array

Complex = NDArray[np.complex128]


def points(pairs: ArrayLike) -> Complex:
    """Complex numbers (...) from coordinates (..., 2)."""
    pairs = np.asarray(pairs, dtype=float)
    return np.asarray(pairs[..., 0] + 1j * pairs[..., 1])


def pairs(points: Complex) -> Array:
    """Coordinates (..., 2) from complex numbers (...)."""
    return np.stack([points.real, points.imag], axis=-1)


@dataclass(frozen=True, slots=True)
class PlanarFiveBar:
    """One phase of a planar five-bar in the position of the input angle 0; pins as complex numbers."""

    a0: complex
    a1: complex
    b0: complex
    b1: complex
    c1: complex
    p1: complex
    ratio: float

    def at(self, angle: ArrayLike) -> tuple[Complex, Array]:
        """Path points (...) and turns of the coupler (...), rad, -π to π, at input angles (...), rad.

        NaN where the linkage cannot be assembled.
        """
        angle = np.asarray(angle, dtype=float)
        a = self.a0 + np.exp(1j * angle) * (self.a1 - self.a0)
        b = self.b0 + np.exp(1j * self.ratio * angle) * (self.b1 - self.b0)
        coupler, rocker = self.c1 - self.a1, abs(self.c1 - self.b1)
        base = b - a
        span = np.abs(base)
        with np.errstate(invalid="ignore", divide="ignore"):
            along = (span**2 + abs(coupler) ** 2 - rocker**2) / (2 * span)
            height = np.sqrt(abs(coupler) ** 2 - along**2)
            side = np.sign((coupler * np.conj(self.b1 - self.a1)).imag)
            turn = (along + 1j * side * height) * base / span / coupler
        return np.asarray(a + turn * (self.p1 - self.a1)), np.asarray(np.angle(turn))
