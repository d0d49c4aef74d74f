"""Laws that follow from a pitch curve r1(φ) of the driver, and the centre distances at which the mate closes.

With r1 in units of its own and the centre distance A in the same, σ = 1 for two gears and -1 for a gear in a
ring, d = A - σ r1:

    i = r1/d,  i' = A r1'/d²,  i'' = A r1''/d² + 2 σ A r1'²/d³.

The integral of i over a lobe falls to 0 as A grows, from infinity, or in a ring from 2π/N1: exactly one A
closes the mate, in a ring if N2 is above N1.

| curve | r1 | A |
| --- | --- | --- |
| ellipse of N1 lobes | 1/(1 - e cos N1 φ) | [σ + √(1 - (1 - e²)(1 - k²))]/(1 - e²) |
| limaçon of N1 lobes | 1 + e cos N1 φ | σ q²/(q² - 1) [1 + √(1 - (1 - 1/q²)(1 - e²))] |
| eccentric circle | e cos φ + √(1 - e² sin² φ) | by bisection |

where k = N2/N1 and q = 1 + σ/k.
"""

import math
from abc import abstractmethod
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.optimize import brentq

from mechwright import Array
from mechwright.mechanics.gearing import Primitive, RatioLaw

_CLOSED = 4 * float(np.finfo(float).eps)
"""Error of a centre distance that is bracketed: rounding."""


def _root(square: float) -> float:
    """Of one number, or of those (n, 1) of many laws at once."""
    root: float = math.sqrt(square) if isinstance(square, float) else np.sqrt(square)
    return root


@dataclass(frozen=True)
class PitchLaw(RatioLaw):
    """A law by a pitch curve; ``eccentricity`` is its shape, 0 for a circle about the axis, ``side`` σ."""

    lobes: tuple[int, int]
    eccentricity: float
    side: int = 1

    @abstractmethod
    def radius(self, phi: Array) -> tuple[Array, Array, Array]:
        """r1, r1' and r1'' (...)."""

    @property
    @abstractmethod
    def apart(self) -> float:
        """A."""

    def rates(self, phi: Array) -> tuple[Array, Array, Array]:
        """The formulas of the module."""
        r, first, second = self.radius(np.asarray(phi, dtype=float))
        a, d = self.apart, self.apart - self.side * r
        return r / d, a * first / d**2, a * second / d**2 + 2 * self.side * a * first**2 / d**3


class EllipseLaw(PitchLaw):
    """An ellipse about its focus, and its relatives of several lobes."""

    @property
    def apart(self) -> float:
        """In units of the semi-latus rectum."""
        e2, k = self.eccentricity**2, self.lobes[1] / self.lobes[0]
        return (self.side + _root(1 - (1 - e2) * (1 - k * k))) / (1 - e2)

    def radius(self, phi: Array) -> tuple[Array, Array, Array]:
        """1/(1 - e cos N1 φ) and its derivatives."""
        n, e = self.lobes[0], self.eccentricity
        sin, cos = np.sin(n * phi), np.cos(n * phi)
        r = 1 / (1 - e * cos)
        return r, -n * e * sin * r**2, n * n * e * (2 * e * sin**2 * r**3 - cos * r**2)


class LimaconLaw(PitchLaw):
    """A limaçon about its axis."""

    @property
    def apart(self) -> float:
        """In units of the mean radius."""
        e2, q = self.eccentricity**2, 1 + self.side * self.lobes[0] / self.lobes[1]
        within = 1 - 1 / q**2
        return self.side / within * (1 + _root(1 - within * (1 - e2)))

    def radius(self, phi: Array) -> tuple[Array, Array, Array]:
        """1 + e cos N1 φ and its derivatives."""
        n, e = self.lobes[0], self.eccentricity
        sin, cos = np.sin(n * phi), np.cos(n * phi)
        return 1 + e * cos, -n * e * sin, -n * n * e * cos


class CircleLaw(PitchLaw):
    """A circle about a point beside its middle; it has one lobe."""

    @cached_property
    def apart(self) -> float:
        """In radii of the circle."""
        wanted = math.tau / self.lobes[1]

        def over(apart: float) -> float:
            def ratio(phi: Array) -> Array:
                r: Array = self.radius(phi)[0]
                return r / (apart - self.side * r)

            return Primitive.of(ratio, self.period).total - wanted

        # The ratio is at most that of the greatest radius all the way round, which bounds A from above; of a
        # round gear it is just that, so that the bound is put a little farther than rounding.
        least = max(0.0, self.side * (1 + self.eccentricity))
        far = near = (1 + self.eccentricity) * (self.side + self.lobes[1]) * (1 + 1e-9)
        while over(near) < 0:
            near = (near + least) / 2
        return float(brentq(over, near, far, xtol=_CLOSED, rtol=_CLOSED))

    def radius(self, phi: Array) -> tuple[Array, Array, Array]:
        """E cos φ + √(1 - e² sin² φ) and its derivatives."""
        e, sin, cos = self.eccentricity, np.sin(phi), np.cos(phi)
        q = np.sqrt(1 - (e * sin) ** 2)
        first = -e * e * sin * cos / q
        second = -e * e * (cos**2 - sin**2) / q - first**2 / q
        return e * cos + q, -e * sin + first, -e * cos + second
