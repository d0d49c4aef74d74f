"""Deflection of shafts on two bearings: closed forms, and stepped shafts by Castigliano's theorem.

Sources: any table of beams; Castigliano's second theorem, the integral of M m/(E I) with M of the load and m
of a unit force (or moment) where the deflection (or slope) is asked: both are linear in each piece, so
Simpson's rule is exact.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from mechwright.errors import GeometryError
from mechwright.mechanics.strength.shaft import second_moment

STEEL = 210_000.0
"""Young's modulus, MPa."""

GEAR_SLOPE, BALL_SLOPE = 5e-4, 6e-4
"""Greatest slope of a shaft under a gear, and in a ball bearing, rad; handbook."""

GEAR_DEFLECTION = 0.01
"""Greatest deflection under a gear, in modules; handbook."""


@dataclass(frozen=True)
class Deflection:
    """At the load, mm and rad; slopes in the bearings, rad; reactions, N, positive against the load.

    ``near`` is the bearing at 0 and ``far`` the one at L; of an overhung shaft the one next to the load is
    near.
    """

    deflection: float
    slope: float
    near_slope: float
    far_slope: float
    near: float
    far: float


def straddled(d: float, span: float, at: float, force: float, modulus: float = STEEL) -> Deflection:
    """A plain shaft on bearings at 0 and ``span``, loaded at ``at`` between them.

    >>> found = straddled(12, 80, 30, 200)
    >>> round(1000 * found.deflection, 4), (found.near, found.far)
    (8.7718, (125.0, 75.0))
    """
    if not 0 < at < span:
        raise GeometryError(f"a load at {at:g} mm is not between bearings at 0 and {span:g} mm")
    a, b, stiff = at, span - at, 6 * modulus * second_moment(d) * span
    return Deflection(
        2 * force * a * a * b * b / stiff,
        2 * force * a * b * abs(b - a) / stiff,
        force * b * (span**2 - b * b) / stiff,
        force * a * (span**2 - a * a) / stiff,
        force * b / span,
        force * a / span,
    )


def overhung(d: float, span: float, beyond: float, force: float, modulus: float = STEEL) -> Deflection:
    """A plain shaft on two bearings, loaded ``beyond`` the near one; the far one is pulled the other way."""
    if not (span > 0 and beyond > 0):
        raise GeometryError(f"bearings {span:g} mm apart and a load {beyond:g} mm beyond: both above 0")
    c, stiff = beyond, 6 * modulus * second_moment(d)
    return Deflection(
        2 * force * c * c * (span + c) / stiff,
        force * c * (2 * span + 3 * c) / stiff,
        2 * force * c * span / stiff,
        force * c * span / stiff,
        force * (span + c) / span,
        -force * c / span,
    )


@dataclass(frozen=True)
class SteppedShaft:
    """A shaft of pieces, each a diameter and its length, mm, on bearings at two places from its start."""

    pieces: tuple[tuple[float, float], ...]
    near: float
    far: float

    @property
    def length(self) -> float:
        """Mm."""
        return sum(length for _, length in self.pieces)

    def deflection(self, forces: Sequence[tuple[float, float]], at: float, modulus: float = STEEL) -> float:
        """Where forces (place, N) act, the deflection at a place, mm.

        >>> shaft = SteppedShaft(((10, 20), (14, 40), (10, 20)), 0, 80)
        >>> round(1000 * shaft.deflection([(30, 200)], 30), 5)
        6.76788
        """
        return self._castigliano(forces, [(at, 1.0)], modulus)

    def slope(self, forces: Sequence[tuple[float, float]], at: float, modulus: float = STEEL) -> float:
        """The slope there, rad, by the unit moment."""
        return self._castigliano(forces, [], modulus, unit_moment=at)

    def reactions(self, forces: Sequence[tuple[float, float]]) -> tuple[float, float]:
        """Of the bearings near and far, N."""
        span = self.far - self.near
        far = sum(force * (place - self.near) for place, force in forces) / span
        return sum(force for _, force in forces) - far, far

    def moment(self, forces: Sequence[tuple[float, float]], at: float) -> float:
        """Bending moment at a place, N mm."""
        near, far = self.reactions(forces)
        pulls = [(self.near, near), (self.far, far), *((place, -force) for place, force in forces)]
        return sum(force * (at - place) for place, force in pulls if place < at)

    def _castigliano(
        self,
        forces: Sequence[tuple[float, float]],
        unit: Sequence[tuple[float, float]],
        modulus: float,
        unit_moment: float | None = None,
    ) -> float:
        span = self.far - self.near

        def virtual(x: float, after: bool) -> float:
            if unit_moment is None:
                return self.moment(unit, x)
            # A unit moment at its place is carried by a couple of reactions, 1/L each.
            lift = (-(x - self.near) if x > self.near else 0.0) + (x - self.far if x > self.far else 0.0)
            jump = 1.0 if x > unit_moment or (x == unit_moment and after) else 0.0
            return lift / span + jump

        places = {0.0, self.length, self.near, self.far, *(place for place, _ in forces)}
        places |= {place for place, _ in unit} | ({unit_moment} if unit_moment is not None else set())
        ends, start = [], 0.0
        for d, long in self.pieces:
            ends.append((start, start + long, second_moment(d)))
            start += long
        total = 0.0
        for low, high, stiff in ends:
            inner = sorted({low, high, *(place for place in places if low < place < high)})
            for x0, x1 in pairwise(inner):
                middle = (x0 + x1) / 2
                parts = ((x0, 1, True), (middle, 4, True), (x1, 1, False))
                product = sum(
                    weight * self.moment(forces, x) * virtual(x, after) for x, weight, after in parts
                )
                total += product * (x1 - x0) / 6 / (modulus * stiff)
        return total
