"""What the published example of an adjustable five-bar is compared with, besides the family itself.

The planar geared five-bar from which the projection starts, the printed tables of its projection, and how its
structural error behaves for all lengths.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import minimize_scalar

from mechwright.arrays import Array
from mechwright_spherical.synthesis.planar import Complex
from mechwright_spherical.synthesis.structural import PlanarDesign, errors, grid, scaled_error

FIRST_LENGTH, DOUBLINGS = 8.0, 4
"""Lengths of the extrapolation: 8 to 64, where rounding grows from 1e-13 to 1e-9 of the result."""

TABLE_3 = (
    (0.0339, 0.3549, 0.9343),
    (0.0516, 0.3490, 0.9357),
    (0.0671, 0.3370, 0.9391),
    (0.0795, 0.3190, 0.9444),
    (0.0339, 0.3549, 0.9343),
    (0.0665, 0.3556, 0.9322),
    (0.0975, 0.3514, 0.9311),
)
"""Projected path points."""

TABLE_4 = {
    "a0": (0.0, 0.0001, 1.0),
    "a1": (0.0239, 0.1947, 0.9806),
    "a1n": (-0.0264, 0.1944, 0.9806),
    "b0": (0.2425, 0.0, 0.9701),
    "b1": (0.3614, 0.1306, 0.9232),
    "c1": (0.1687, 0.2753, 0.9464),
    "c1n": (0.2235, 0.3265, 0.9184),
}
"""Projected pins."""


@dataclass(frozen=True, slots=True)
class PlanarFiveBar:
    """One phase of a planar geared five-bar in the position of the input angle 0; pins as complex numbers.

    The crank turns about a0 and carries a1, the arm turns about b0 by the ratio times the crank's angle and
    carries b1; the coupler a1-c1 carries the path point p, the rocker is c1-b1.
    """

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


def peak(design: PlanarDesign, position: int | None = None) -> tuple[float, float]:
    """Length at which the error times the length is greatest, and that value."""
    lengths = grid()
    values = scaled_error(design, lengths, position)
    top = int(np.nanargmax(values))
    found = minimize_scalar(
        lambda d: -float(scaled_error(design, d, position)),
        bounds=(lengths[max(top - 1, 0)], lengths[min(top + 1, len(lengths) - 1)]),
        method="bounded",
        options={"xatol": 1e-10},
    )
    return float(found.x), -float(found.fun)


def asymptote(design: PlanarDesign) -> Array:
    """K (n,) of error = K/d³ for long projections of exact planar targets.

    The error times d³ is a series in d⁻²; doubling the length again and again takes its terms out one by one
    (Romberg).
    """
    d = FIRST_LENGTH * 2.0 ** np.arange(DOUBLINGS)
    rows = errors(design, d) * d[:, None] ** 3
    for term in range(1, DOUBLINGS):
        rows = (4**term * rows[1:] - rows[:-1]) / (4**term - 1)
    return np.asarray(rows[0])
