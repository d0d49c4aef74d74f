"""Pitch curves that roll on each other by a given law, and the pair of them.

With the centre distance a, the ratio i(φ), the side σ (+1 for two gears, -1 for a gear that runs in a ring)
and w = 1 + σ i, rolling without slip makes

    r1 = a i/w,  r2 = a/w,  G = √(i² w² + i'²),  ds/dφ = a G/w²,  tan ν = i'/(i w),
    1/ρ1 = w³ (i² w + 2 i'² - i i'')/(a G³),  1/ρ1 + 1/ρ2 = w³/(a G)  (Euler and Savary).

A pitch curve is convex where its curvature is above 0; that of a ring is hollow, and its ratio below 1. The
driver's contact runs clockwise in its body as φ rises. That of a driven gear runs counter-clockwise from the
direction π at φ = 0, that of a ring clockwise from the direction 0.
"""

import math
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.gearing.pair import POSITIONS_PER_TOOTH, Pair
from mechwright.mechanics.gearing.pitch_curve import GUESSES, Frame, PitchCurve
from mechwright.mechanics.gearing.primitive import Primitive
from mechwright.mechanics.gearing.ratio import BEYOND, RatioLaw

_BESIDE = 1e-7
"""rad on both sides of a break of the law, between which a jump is told from a bend."""

_JUMP = 1e-4
"""Share of the second derivative of the ratio by which it jumps; less no fit takes notice of."""


@dataclass(frozen=True, slots=True)
class Rolling:
    """Both pitch curves at angles φ, for a centre distance of 1; arrays (...).

    Parameters
    ----------
    r1, r2
        Polar radii.
    r1_rate, r2_rate
        Their derivatives by φ, 1/rad.
    speed
        ds/dφ, the same for both.
    tilt
        Slope ν, rad, of both pitch curves against the circles about their axes.
    curvature1, curvature2
        Signed: above 0 where the gear's body is convex.
    """

    r1: Array
    r2: Array
    r1_rate: Array
    r2_rate: Array
    speed: Array
    tilt: Array
    curvature1: Array
    curvature2: Array

    @classmethod
    def of(cls, law: RatioLaw, phi: Array, side: int = 1) -> "Rolling":
        """The formulas of the module."""
        i, first, second = law.rates(phi)
        w = 1 + side * i
        g = np.sqrt((i * w) ** 2 + first**2)
        rise = first / w**2
        one = w**3 * (i * i * w + 2 * first**2 - i * second) / g**3
        tilt = np.arctan2(first, i * w)
        return cls(i / w, 1 / w, rise, -side * rise, g / w**2, tilt, one, w**3 / g - one)


@dataclass(frozen=True)
class RolledCurve(PitchCurve):
    """One of both pitch curves of a law.

    Parameters
    ----------
    law
        The law of the pair.
    distance
        Centre distance a, mm.
    roll
        Arc length over φ for a centre distance of 1.
    side
        σ: -1 where the driver runs in a ring.
    """

    law: RatioLaw
    distance: float
    roll: Primitive = field(compare=False)
    side: int = 1

    @property
    def sense(self) -> float:
        """φ over the curve's own parameter t."""
        raise NotImplementedError

    @property
    def perimeter(self) -> float:
        """As many lobes as the curve has, each of the length that both share."""
        return self.distance * self.roll.total * abs(self.sense) * self.law.lobes[0]

    @cached_property
    def breaks(self) -> Array:
        """Where the second derivative of the ratio jumps, in all lobes."""
        law, edge = self.law, np.asarray(self.law.breaks, dtype=float)
        before, after = (law.rates(edge + side * _BESIDE)[2] for side in (-1, 1))
        jumps = edge[np.abs(after - before) > _JUMP * (1 + np.abs(before) + np.abs(after))]
        lobes = round(law.lobes[0] * abs(self.sense))
        phi = (jumps + law.period * np.arange(lobes)[:, None]).ravel()
        return np.sort(phi / self.sense % math.tau)

    def arc(self, t: Array) -> Array:
        """Arc length (...), mm, from t = 0."""
        result: Array = math.copysign(self.distance, self.sense) * self.roll(
            self.sense * np.asarray(t, dtype=float)
        )
        return result

    def arc_rate(self, t: Array) -> Array:
        """Derivative ds/dt (...), mm/rad."""
        rate: Array = self.distance * abs(self.sense) * self._at(self.sense * t).speed
        return rate

    def around(self, count: int) -> Array:
        """Parameters (count,), rad, once round, or of a sector over its travel."""
        travel = self.law.travel
        return super().around(count) if travel is None else np.linspace(0.0, travel, count) / self.sense

    @cached_property
    def _table(self) -> tuple[Array, Array]:
        travel = self.law.travel
        if travel is None:
            return super()._table
        t = np.linspace(-BEYOND, travel + BEYOND, GUESSES) / self.sense
        t.sort()
        return self.arc(t), t

    def parameter(self, arc: Array) -> Array:
        """As of any curve; that of a sector goes on beyond its travel and comes never round."""
        if self.law.travel is None:
            return super().parameter(arc)
        arc = np.asarray(arc, dtype=float)
        return self._inverted(np.interp(arc, *self._table), arc)

    def _at(self, phi: Array) -> Rolling:
        return Rolling.of(self.law, phi, self.side)

    def _frame(
        self, t: Array, arc: Array | None, radius: Array, turned: Array, rise: Array, curvature: Array
    ) -> Frame:
        """The frame of polar radii (...) for a = 1, in directions (...), rad, and rises dr/(r dθ) (...)."""
        a = self.distance
        length = np.sqrt(1 + rise**2)
        cos, sin = np.cos(turned), np.sin(turned)
        point = a * np.stack((radius * cos, radius * sin), axis=-1)
        tangent = np.stack(((rise * cos - sin) / length, (rise * sin + cos) / length), axis=-1)
        normal = np.stack((tangent[..., 1], -tangent[..., 0]), axis=-1)
        with np.errstate(divide="ignore"):
            bend = a / curvature
        return Frame(
            self.arc(t) if arc is None else np.asarray(arc, dtype=float), point, tangent, normal, bend
        )


class DriverCurve(RolledCurve):
    """Of the driver; its parameter t = -φ is the direction of the contact in its body."""

    @property
    def sense(self) -> float:
        """-1: the contact runs clockwise as the gear turns counter-clockwise."""
        return -1.0

    def frame(self, t: Array, arc: Array | None = None) -> Frame:
        """The moving frame at directions (...)."""
        t = np.asarray(t, dtype=float)
        now = self._at(-t)
        return self._frame(t, arc, now.r1, t, -now.r1_rate / now.r1, now.curvature1)


class DrivenCurve(RolledCurve):
    """Of the driven gear; its parameter t = φ N1/N2 runs once round as the gear does."""

    @property
    def sense(self) -> float:
        """N2/N1, the driver's turns in one of this gear."""
        return self.law.lobes[1] / self.law.lobes[0]

    def frame(self, t: Array, arc: Array | None = None) -> Frame:
        """The moving frame at parameters (...)."""
        phi = self.sense * np.asarray(t, dtype=float)
        now = self._at(phi)
        # dψ = i dφ = (r1/r2) dφ is what the direction turns by.
        rise = now.r2_rate / now.r1
        return self._frame(t, arc, now.r2, math.pi + self.law.angle(phi), rise, now.curvature2)


class RingCurve(RolledCurve):
    """Of a ring; its parameter t = -φ N1/N2 runs against the contact, which goes clockwise."""

    @property
    def sense(self) -> float:
        """-N2/N1."""
        return -self.law.lobes[1] / self.law.lobes[0]

    def frame(self, t: Array, arc: Array | None = None) -> Frame:
        """The moving frame at parameters (...), its normal towards the axis."""
        phi = self.sense * np.asarray(t, dtype=float)
        now = self._at(phi)
        found = self._frame(t, arc, now.r2, -self.law.angle(phi), -now.r2_rate / now.r1, now.curvature2)
        return replace(found, normal=-found.normal)


@dataclass(frozen=True)
class RolledPair(Pair):
    """A pair by a law: θ1 = φ, θ2 = -ψ of two gears, θ2 = ψ of a ring.

    Examples
    --------
    A constant ratio makes circles.

    >>> class Constant(RatioLaw):
    ...     lobes = (1, 2)
    ...     def rates(self, phi):
    ...         return np.full(np.shape(phi), 0.5), np.zeros(np.shape(phi)), np.zeros(np.shape(phi))
    >>> pair = RolledPair.of(Constant(), 90.0)
    >>> round(pair.driver.perimeter / math.tau, 12), round(pair.driven.perimeter / math.tau, 12)
    (30.0, 60.0)
    >>> ring = RolledPair.of(Constant(), 30.0, side=-1)
    >>> round(ring.driver.perimeter / math.tau, 12), round(ring.driven.perimeter / math.tau, 12)
    (30.0, 60.0)
    """

    driver: RolledCurve
    driven: RolledCurve

    @classmethod
    def of(cls, law: RatioLaw, distance: float, side: int = 1) -> "RolledPair":
        """At a centre distance, mm; the driver runs in a ring where ``side`` is -1."""
        roll = lobe_of(law, side)
        driven = DrivenCurve if side > 0 else RingCurve
        return cls(DriverCurve(law, distance, roll, side), driven(law, distance, roll, side), distance)

    @classmethod
    def of_pitch(cls, law: RatioLaw, pitch: float, teeth: int, side: int = 1) -> "RolledPair":
        """With so many teeth of a pitch, mm, on the driver: they need a centre distance of their own."""
        unit = cls.of(law, 1.0, side)
        return cls.of(law, pitch * teeth / unit.rolled, side)

    @property
    def rolled(self) -> float:
        """Arc, mm, of the driver over which its teeth are counted: all round, or over the travel."""
        travel = self.ratio.travel
        if travel is None:
            return self.driver.perimeter
        return self.distance * float(self.driver.roll(np.asarray(travel)))

    def pitch(self, teeth: int) -> float:
        """Of so many teeth."""
        return self.rolled / teeth

    def run(self, teeth: int, positions: int | None = None) -> Array:
        """As of any pair; of sectors over their travel, both ends included."""
        if self.ratio.travel is None:
            return super().run(teeth, positions)
        count = POSITIONS_PER_TOOTH * teeth + 1 if positions is None else positions
        arcs: Array = -self.rolled * np.linspace(0.0, 1.0, count)
        return arcs

    @property
    def side(self) -> int:
        """σ of both curves."""
        return self.driver.side

    @cached_property
    def ratio(self) -> RatioLaw:
        """The law."""
        return self.driver.law

    def law(self, theta: Array) -> tuple[Array, Array]:
        """-σ ψ and -σ i."""
        return -self.side * self.ratio.angle(theta), -self.side * self.ratio.rates(theta)[0]


def lobe_of(law: RatioLaw, side: int = 1) -> Primitive:
    """Arc length of the pitch curves over φ, for a centre distance of 1; ``total`` is that of one lobe."""
    return Primitive.of(lambda phi: Rolling.of(law, phi, side).speed, law.period, law.breaks)
