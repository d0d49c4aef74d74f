"""How a shaft turns: its angle and three rates, and what follows for all that it carries along."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mechwright.arrays import Array

Plane = NDArray[np.complex128]
"""Points or vectors of the plane, x + i y."""


@dataclass(frozen=True, slots=True)
class Turning:
    """Angle (...) in rad, and its first three rates in rad/s, rad/s², rad/s³."""

    theta: Array
    omega: Array
    alpha: Array
    jerk: Array

    @classmethod
    def of(
        cls, theta: ArrayLike, omega: ArrayLike = 0.0, alpha: ArrayLike = 0.0, jerk: ArrayLike = 0.0
    ) -> "Turning":
        """Broadcast the four to one shape.

        >>> Turning.of([0.0, 1.0], 2.0).omega.tolist()
        [2.0, 2.0]
        """
        arrays = (np.asarray(values, dtype=float) for values in (theta, omega, alpha, jerk))
        return cls(*(np.array(values) for values in np.broadcast_arrays(*arrays)))

    def scaled(self, ratio: float) -> "Turning":
        """The turning of a shaft that is geared to this one."""
        return Turning(ratio * self.theta, ratio * self.omega, ratio * self.alpha, ratio * self.jerk)

    def carried(self, first: Array, second: Array, third: Array) -> tuple[Array, Array, Array]:
        """Three rates over time (...) of what has these derivatives by the angle: the chain rule."""
        return (
            first * self.omega,
            second * self.omega**2 + first * self.alpha,
            third * self.omega**3 + 3 * second * self.omega * self.alpha + first * self.jerk,
        )

    def part(self, samples: slice) -> "Turning":
        """Some of the samples."""
        return Turning(self.theta[samples], self.omega[samples], self.alpha[samples], self.jerk[samples])

    @property
    def direction(self) -> Plane:
        """The unit vectors exp(i θ)."""
        unit: Plane = np.exp(1j * self.theta)
        return unit

    @property
    def velocity_factor(self) -> Plane:
        """What turns a lever into its velocity: i ω."""
        return np.asarray(1j * self.omega, np.complex128)

    @property
    def acceleration_factor(self) -> Plane:
        """What turns a lever into its acceleration: i α - ω²."""
        return np.asarray(1j * self.alpha - self.omega**2, np.complex128)

    @property
    def jerk_factor(self) -> Plane:
        """What turns a lever into its jerk: i (j - ω³) - 3 ω α."""
        return np.asarray(1j * (self.jerk - self.omega**3) - 3 * self.omega * self.alpha, np.complex128)
