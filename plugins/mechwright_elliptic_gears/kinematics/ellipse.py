"""The pitch ellipse, measured along its arc, and two that roll on each other.

Its parameter is the eccentric angle u, rad: the point (a cos u, b sin u) from the ellipse's centre. u = 0 is
the far vertex, the end of the major axis that is farther from the axis of rotation. The axis is the focus
that is the origin of the part frame; the far vertex lies on +x at a (1 + e).

The arc length is an incomplete elliptic integral, s = a [E(u + π/2 | e²) - E(e²)]. Its integrand
sqrt(1 - e² cos² u) is periodic and analytic, so its Fourier series converges geometrically: a few dozen terms
give the integral, for all u at once, to the last digit.
"""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from mechwright import Array
from mechwright.mechanics.gearing import Frame, Pair, PitchCurve
from mechwright_elliptic_gears.kinematics.equations import Turning, driven, pitch_radii, tilt

_SERIES_SAMPLES = 256
"""Terms fall like exp(-2 k arcosh(1/e)); at e = 0.9 the 43rd is below 1e-17, so 128 leave no aliasing."""

_ON_AXIS = 1e-12
"""Least distance from the major axis in semi-minor axes: on it, inside, two feet are equally near."""

_ON_ELLIPSE, _FOOT_STEPS = 1e-14, 100
"""Residual of a foot: rounding; and steps, of which six or seven are the rule."""

_MEANS = 5
"""Steps of the mean: it doubles its digits with each, and has two of them after one at e = 0.9."""

_SERIES_CUT = 1e-17
"""Terms below this share of the first are rounding."""


def perimeter_of(eccentricity: Any) -> Any:
    """The perimeter 4 E(e) of ellipses of semi-major axis 1, by the arithmetic-geometric mean.

    >>> float(perimeter_of(0.6)) == Ellipse(1.0, 0.6).perimeter
    True
    """
    mean, root = np.ones_like(eccentricity, dtype=float), np.sqrt(1 - np.square(eccentricity))
    rest, power = 1 - np.square(eccentricity) / 2, 0.5
    for _ in range(_MEANS):
        half = (mean - root) / 2
        mean, root, power = mean - half, np.sqrt(mean * root), 2 * power
        rest = rest - power * half**2
    return 2 * math.pi / mean * rest


def depth_in(semi_major: Any, eccentricity: Any, x: Array, y: Array) -> Array:
    """Distance (...), mm, of points x, y about a focus from ellipses: positive inside, negative outside.

    In the quadrant of a point x, y about the centre, the foot of its perpendicular is a² x/(s + c²), b² y/s
    with the one s > 0 that puts it on the ellipse. That function of s falls and is convex, so that Newton's
    method from the left of the root goes up to it.
    """
    a, c = semi_major, semi_major * eccentricity
    b = a * np.sqrt(1 - np.square(eccentricity))
    x, y = np.abs(x - c), np.maximum(np.abs(y), _ON_AXIS * b)
    s = np.maximum(b * y, a * x - c * c)
    for _ in range(_FOOT_STEPS):
        along, across = a * x / (s + c * c), b * y / s
        level = along**2 + across**2 - 1
        s = s + level / (2 * (along**2 / (s + c * c) + across**2 / s))
        if np.abs(level).max() < _ON_ELLIPSE:
            break
    away = np.hypot(x - a * a * x / (s + c * c), y - b * b * y / s)
    depth: Array = np.where((x / a) ** 2 + (y / b) ** 2 < 1, away, -away)
    return depth


@dataclass(frozen=True)
class Ellipse(PitchCurve):
    """An ellipse given by its semi-major axis (mm, above 0) and eccentricity (0 to 0.9).

    Examples
    --------
    >>> ellipse = Ellipse(50.0, 0.6)
    >>> ellipse.semi_minor, ellipse.focal_distance
    (40.0, 30.0)
    >>> bool(abs(Ellipse(1.0, 0.0).perimeter - math.tau) < 1e-15)
    True
    """

    semi_major: float
    eccentricity: float

    @property
    def semi_minor(self) -> float:
        """B = a sqrt(1 - e²), mm."""
        return self.semi_major * math.sqrt(1 - self.eccentricity**2)

    @property
    def focal_distance(self) -> float:
        """C = a e, centre to focus, mm."""
        return self.semi_major * self.eccentricity

    @property
    def least_radius(self) -> float:
        """Radius of curvature b²/a at the ends of the major axis, mm."""
        return self.semi_minor**2 / self.semi_major

    @property
    def greatest_radius(self) -> float:
        """Radius of curvature a²/b at the ends of the minor axis, mm."""
        return self.semi_major**2 / self.semi_minor

    @cached_property
    def _terms(self) -> Array:
        """Cosine coefficients of sqrt(1 - e² cos² u) in 2 u, the mean first."""
        u = np.pi * np.arange(_SERIES_SAMPLES) / _SERIES_SAMPLES
        terms = np.fft.rfft(np.sqrt(1 - (self.eccentricity * np.cos(u)) ** 2)).real / _SERIES_SAMPLES
        terms[1:] *= 2
        last = np.flatnonzero(np.abs(terms) > _SERIES_CUT * terms[0]).max()
        kept: Array = terms[: last + 1]
        return kept

    @property
    def complete_integral(self) -> float:
        """Complete elliptic integral of the second kind E, modulus e: the perimeter is 4 a E."""
        return float(self._terms[0]) * math.pi / 2

    @property
    def perimeter(self) -> float:
        """4 a E, mm."""
        return 4 * self.semi_major * self.complete_integral

    def arc(self, u: Array) -> Array:
        """Arc length (...), mm, from the far vertex to eccentric angles u (...)."""
        u = np.asarray(u, dtype=float)
        weights = self._terms[1:] / (2 * np.arange(1, self._terms.size))
        # Clenshaw's recurrence for a sine series in 2 u.
        twice = 2 * np.cos(2 * u)
        one, two, free = np.zeros_like(u), np.zeros_like(u), np.empty_like(u)
        for weight in weights[::-1]:
            np.multiply(twice, one, out=free)
            free += weight
            free -= two
            one, two, free = free, one, two
        result: Array = self.semi_major * (self._terms[0] * u + one * np.sin(2 * u))
        return result

    def _speed(self, u: Array) -> Array:
        """ds/du in units of a."""
        speed: Array = np.sqrt(1 - (self.eccentricity * np.cos(u)) ** 2)
        return speed

    def arc_rate(self, u: Array) -> Array:
        """Derivative ds/du (...), mm/rad."""
        rate: Array = self.semi_major * self._speed(u)
        return rate

    def depth(self, points: Array) -> Array:
        """Distance (n,), mm, of points (n, 2) from the ellipse: positive inside, negative outside."""
        return depth_in(self.semi_major, self.eccentricity, points[:, 0], points[:, 1])

    def frame(self, u: Array, arc: Array | None = None) -> Frame:
        """The moving frame at eccentric angles u (...); ``arc`` is given where it is known already."""
        a, b = self.semi_major, self.semi_minor
        cos, sin, speed = np.cos(u), np.sin(u), self._speed(u)
        point = np.stack((a * cos + self.focal_distance, b * sin), axis=-1)
        tangent = np.stack((-sin / speed, b / a * cos / speed), axis=-1)
        normal = np.stack((tangent[..., 1], -tangent[..., 0]), axis=-1)
        radius = a * a / b * speed**3
        return Frame(self.arc(u) if arc is None else arc, point, tangent, normal, radius)


class EllipticPair(Pair):
    """Two congruent ellipses that turn about foci 2a apart, in the closed forms of their kinematics."""

    driver: Ellipse

    @classmethod
    def of(cls, ellipse: Ellipse) -> "EllipticPair":
        """An ellipse and its copy."""
        return cls(ellipse, ellipse, 2 * ellipse.semi_major)

    def law(self, theta: Array) -> tuple[Array, Array]:
        """Equations (7) and (5)."""
        mate = driven(Turning.of(theta, 1.0), self.driver.eccentricity)
        return mate.theta, mate.omega

    def pitch_radii(self, theta: Array) -> tuple[Array, Array]:
        """Equations (1) and (2)."""
        return pitch_radii(Turning.of(theta), self.driver.semi_major, self.driver.eccentricity)

    def tilt(self, arc: Array) -> Array:
        """As the shafts see it."""
        return tilt(Turning.of(self.angles(arc)[0]), self.driver.eccentricity)
