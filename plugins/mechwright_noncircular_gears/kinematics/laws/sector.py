"""Laws over less than a turn: what a formula, a table or a spiral says from φ = 0 to the end of the travel.

Both pitch curves are open. Flanks of the last teeth come from a little beyond their ends, so the law goes on
there: a quintic leads on from i, i' and i'' to a constant ratio. Farther on it comes back to where it began,
for integrals and curves that are periodic; nothing is made of that.
"""

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.interpolate import BSpline, make_interp_spline

from mechwright import Array
from mechwright.mechanics.formula import Formula
from mechwright.mechanics.gearing import RatioLaw
from mechwright.mechanics.gearing.ratio import BEYOND

_HALVINGS = 24
"""Of a blend, until the ratio stays near to that of its end."""

_LEAST = 0.4
"""Share of the ratio at an end that stays on its blend, and by whose inverse it grows at most."""

_RISE: Array = np.array([0, 0, 0, 10.0, -15, 6])
_STEP = np.polynomial.Polynomial(_RISE)
"""From 0 to 1 with two derivatives of 0 at both ends."""

_SHARES = np.linspace(0.0, 1.0, 65)


class Course(ABC):
    """The ratio over the travel."""

    @abstractmethod
    def rates(self, phi: Array) -> tuple[Array, Array, Array]:
        """i, di/dφ and d²i/dφ² (...) at angles φ (...), rad, within the travel."""


@dataclass(frozen=True)
class RatioCourse(Course):
    """i = f(φ) by a formula: its values count, for nothing has to close."""

    text: str

    def rates(self, phi: Array) -> tuple[Array, Array, Array]:
        """Exact derivatives."""
        return Formula(self.text, "phi")(phi)[:3]


@dataclass(frozen=True)
class AngleCourse(Course):
    """ψ = f(φ) - f(0) by a formula."""

    text: str

    def rates(self, phi: Array) -> tuple[Array, Array, Array]:
        """Exact derivatives."""
        return Formula(self.text, "phi")(phi)[1:]


@dataclass(frozen=True)
class TableCourse(Course):
    """ψ through ``nodes``, pairs (φ, ψ), rad: a spline of the fifth degree without knots beside its ends."""

    nodes: tuple[tuple[float, float], ...]

    @cached_property
    def _spline(self) -> BSpline:
        return make_interp_spline(*np.array(self.nodes).T, k=5)

    def rates(self, phi: Array) -> tuple[Array, Array, Array]:
        """Derivatives of the spline."""
        one, two, three = (np.asarray(self._spline(phi, nu=order)) for order in (1, 2, 3))
        return one, two, three


@dataclass(frozen=True)
class SpiralCourse(Course):
    """The driver's pitch curve is a logarithmic spiral, r1 = a q exp(c φ) with q = i/(1 + i) at φ = 0.

    Its slope is the same all along: no law leads from one ratio to another over a shorter travel with less.
    """

    first: float
    last: float
    travel: float

    @property
    def slope(self) -> float:
        """C = tan ν."""
        return math.log(self.last * (1 + self.first) / (self.first * (1 + self.last))) / self.travel

    def rates(self, phi: Array) -> tuple[Array, Array, Array]:
        """With r = r1/a: i = r/(1 - r), i' = r'/(1 - r)², i'' = r''/(1 - r)² + 2 r'²/(1 - r)³."""
        c = self.slope
        r = self.first / (1 + self.first) * np.exp(c * np.asarray(phi, dtype=float))
        rest = 1 - r
        return r / rest, c * r / rest**2, c * c * r / rest**2 + 2 * (c * r) ** 2 / rest**3


@dataclass(frozen=True)
class SectorLaw(RatioLaw):
    """A law from φ = 0 to ``end``, rad, and what leads on from there and up to there."""

    course: Course
    end: float
    lobes: tuple[int, int] = (1, 1)

    @property
    def travel(self) -> float:
        """The end of the travel, rad."""
        return self.end

    @property
    def period(self) -> float:
        """Travel, what goes on beyond both ends, and a way back, rad: no turn of any gear."""
        return self.end + 3 * BEYOND

    @cached_property
    def turned(self) -> float:
        """Angle, rad, by which the driven gear goes on over the travel."""
        x, weight = np.polynomial.legendre.leggauss(_GAUSS)
        edges = np.linspace(0.0, self.end, _PIECES + 1)
        half = np.diff(edges)[:, None] / 2
        phi = edges[:-1, None] + half * (1 + x)
        return float((half * weight * self.course.rates(phi)[0]).sum())

    @cached_property
    def _blends(self) -> "tuple[_Blend, _Blend]":
        """From φ = 0 backwards, and on from the end."""
        begin, end = (
            np.array([float(one[0]) for one in self.course.rates(np.array([at]))]) for at in (0.0, self.end)
        )
        return _Blend.of(begin * (1.0, -1.0, 1.0)), _Blend.of(end)

    @property
    def breaks(self) -> tuple[float, ...]:
        """The end of the travel, and those of the blends and of the way back."""
        one, two = self._blends
        beyond = {two.length, BEYOND, 2 * BEYOND, 2 * BEYOND + (BEYOND - one.length)}
        return tuple(self.end + way for way in sorted({0.0, *beyond}))

    def grid(self, count: int) -> Array:
        """Angles (count,), rad, over the travel: what lies beyond it is no law of the design."""
        return np.linspace(0.0, self.end, count)

    def shape(self, phi: Array) -> tuple[Array, Array, Array]:
        """The ratio and its derivatives over the travel."""
        return self.course.rates(phi)

    def rates(self, phi: Array) -> tuple[Array, Array, Array]:
        """Of the course, of a blend, or of the way back."""
        x = np.mod(np.asarray(phi, dtype=float) + BEYOND, self.period) - BEYOND
        before, inside = x < 0, (x >= 0) & (x <= self.end)
        own = self.course.rates(np.where(inside, x, 0.0))
        one, two = self._blends
        under = one.rates(np.where(before, -x, 0.0))
        over = two.rates(np.where(x > self.end, x - self.end, 0.0))
        share = np.clip((x - self.end) / BEYOND - 1, 0.0, 1.0)
        step = one.constant - two.constant
        found = []
        for order in range(3):
            back = _STEP.deriv(order)(share) if order else _STEP(share)
            beyond = over[order] + step * back / BEYOND**order
            found.append(
                np.where(inside, own[order], np.where(before, (-1.0) ** order * under[order], beyond))
            )
        return found[0], found[1], found[2]


@dataclass(frozen=True, eq=False)
class _Blend:
    """From i, i', i'' at an end of the travel to a constant ratio over a length, rad."""

    terms: np.polynomial.Polynomial
    length: float
    constant: float

    @classmethod
    def of(cls, end: Array) -> "_Blend":
        """The longest that keeps well above 0; its slope falls evenly to 0."""
        i, di, ddi = (float(one) for one in end)
        length = BEYOND
        for _ in range(_HALVINGS):
            constant = float(np.clip(i + di * length / 2, i / 2, 2 * i))
            terms = (constant - i) * _RISE
            terms[0] += i
            terms += length * di * np.array([0, 1.0, 0, -6, 8, -3])
            terms += length**2 * ddi * np.array([0, 0, 0.5, -1.5, 1.5, -0.5])
            found = cls(np.polynomial.Polynomial(terms), length, constant)
            values = found.terms(_SHARES)
            if values.min() >= _LEAST * i and values.max() <= i / _LEAST:
                break
            length /= 2
        return found

    def rates(self, away: Array) -> tuple[Array, Array, Array]:
        """The ratio and its derivatives by the way (...), rad, from the end."""
        share = np.clip(away / self.length, 0.0, 1.0)
        one, two = (self.terms.deriv(order)(share) / self.length**order for order in (1, 2))
        return self.terms(share), one, two


_GAUSS, _PIECES = 16, 24
"""Points of a piece, and pieces of the travel, of the integral of a course: smooth ones need four."""


def swung(law: RatioLaw, phi: Array, travel: float) -> tuple[Array, Array, Array]:
    """Rates of ψ (...) at φ (...) on the way there, by the swing's phase: φ'² = φ (S - φ), φ'' = S/2 - φ."""
    first, second = np.sqrt(np.maximum(phi * (travel - phi), 0.0)), travel / 2 - phi
    i, di, ddi = law.rates(phi)
    jerk = ddi * first**3 + 3 * di * first * second - i * first
    return i * first, di * first**2 + i * second, jerk
