"""The construction of a slider-crank with the auxiliary circle, by ruler and compass (seed document 001).

C1 = 0 and C2 = H are the slider's limits, y points to the crank's side. The circle over C1C2 from which the
stroke is seen at θ = π (K - 1)/(K + 1) holds the crank's pivot A; with AC1 = b - a and AC2 = a + b,

* E on AC2 with AE = AC1 leaves EC2 = 2 a, and F, the middle of the smaller arc over C1C2, has FC1 = FE = FC2;
* G, the foot of F on AC2, is the middle of EC2: C2G = GE = a, AG = b, AF = b / cos(θ/2).

A lies on the arc from C1 to C1', the point opposite to C2, or on its mirror image; on the upper arc, from C1'
to C2', the rod is too short for the crank to turn, and on the smaller arc the stroke is seen at 180° - θ.
Nothing here uses the closed forms of :mod:`mechwright_slider_crank.synthesis.stroke`: both have to agree.
"""

import cmath
import math
from dataclasses import dataclass

from mechwright import GeometryError


@dataclass(frozen=True, slots=True)
class Found:
    """Where the construction leads: places, mm, and the lengths that are taken off.

    Parameters
    ----------
    pivot
        A.
    divide, foot
        E and G on AC2.
    pin
        B with the slider in C1: C1A prolonged beyond A by a.
    """

    pivot: complex
    divide: complex
    foot: complex
    pin: complex
    stroke: float

    @property
    def crank(self) -> float:
        """The length a, half of EC2."""
        return abs(self.stroke - self.divide) / 2

    @property
    def rod(self) -> float:
        """The length b, AG."""
        return abs(self.pivot - self.foot)

    @property
    def offset(self) -> float:
        """The height of A over the stroke, e."""
        return self.pivot.imag

    @property
    def position(self) -> float:
        """λ, the angle of AC2 to the stroke, rad: the place of A on its arc."""
        return cmath.phase(self.stroke - self.pivot.conjugate())


@dataclass(frozen=True, slots=True)
class AuxiliaryCircle:
    """The circle of a stroke H, mm, and a time ratio K between 1 and 3.

    Examples
    --------
    >>> circle = AuxiliaryCircle(120, 1.5)
    >>> round(circle.radius, 6), round(circle.by_crank(35).rod, 6)
    (102.078097, 161.543563)
    """

    stroke: float
    time_ratio: float

    def __post_init__(self) -> None:
        if not (self.stroke > 0 and 1 < self.time_ratio < 3):
            raise GeometryError(
                f"no circle for a stroke of {self.stroke:g} mm and a time ratio of {self.time_ratio:g}: the "
                f"stroke "
                "must be above 0, the ratio between 1 and 3"
            )

    @property
    def theta(self) -> float:
        """θ, rad."""
        return math.pi * (self.time_ratio - 1) / (self.time_ratio + 1)

    @property
    def ends(self) -> tuple[complex, complex]:
        """C1 and C2."""
        return 0j, complex(self.stroke)

    @property
    def centre(self) -> complex:
        """O, the tip of the triangle over C1C2 with base angles of 90° - θ."""
        return complex(self.stroke / 2, self.stroke / 2 * math.tan(math.pi / 2 - self.theta))

    @property
    def radius(self) -> float:
        """OC1."""
        return abs(self.centre)

    @property
    def middle(self) -> complex:
        """F, where the perpendicular from O meets the smaller arc."""
        return self.centre - 1j * self.radius

    @property
    def opposite(self) -> tuple[complex, complex]:
        """C1', opposite to C2, and C2', opposite to C1: the ends of the arcs on which A may lie."""
        return 2 * self.centre - self.stroke, 2 * self.centre

    @property
    def last(self) -> float:
        """λ at C1', 90° - θ, rad."""
        return math.pi / 2 - self.theta

    def at(self, position: float) -> Found:
        """A on the ray from C2 at λ, rad, to the stroke; raises GeometryError off the arc from C1 to C1'."""
        if not 0 < position <= self.last * (1 + 1e-12):
            raise GeometryError(
                f"λ = {math.degrees(position):g}° is off the arc of A; it lies above 0 and up to "
                f"{math.degrees(self.last):g}°"
            )
        ray = -cmath.exp(-1j * position)
        # The chord from C2 along the ray: twice the part of C2O along it.
        reach = 2 * ((self.centre - self.stroke) * ray.conjugate()).real
        return self._from(self.stroke + reach * ray)

    def by_offset(self, offset: float) -> Found:
        """The line MN at the height e meets the circle in A; raises GeometryError for one beyond C1'."""
        most = self.opposite[0].imag
        if not 0 < offset <= most * (1 + 1e-12):
            raise GeometryError(
                f"the line MN at e = {offset:g} mm misses the arc of A; e must be above 0 and at most "
                f"{most:.6g} mm"
            )
        across = math.sqrt(self.radius**2 - (offset - self.centre.imag) ** 2)
        return self._from(complex(self.centre.real - across, offset))

    def by_crank(self, crank: float) -> Found:
        """Circle I about F through C2 and II about C2 with 2 a meet in E, and C2E prolonged leads to A.

        Raises GeometryError where the crank is out of its range, and A off its arc.
        """
        least, most = abs(self.stroke - self.middle) * math.sin(self.theta / 2), self.stroke / 2
        if not least * (1 - 1e-12) <= crank < most:
            raise GeometryError(
                f"circle II with 2 a = {2 * crank:g} mm does not lead to the arc of A; a must be at least "
                f"{least:.6g} and below {most:g} mm"
            )
        return self._through(
            _meet(complex(self.stroke), 2 * crank, self.middle, abs(self.stroke - self.middle))
        )

    def by_rod(self, rod: float) -> Found:
        """Circle III about F with b / cos(θ/2) meets the circle in A.

        Raises GeometryError where the rod is out of its range, and A off its arc.
        """
        turn = math.cos(self.theta / 2)
        least, most = self.stroke / 2, abs(self.opposite[0] - self.middle) * turn
        if not least < rod <= most * (1 + 1e-12):
            raise GeometryError(
                f"circle III with b / cos(θ/2) = {rod / turn:g} mm misses the arc of A; b must be above "
                f"{least:g} "
                f"and at most {most:.6g} mm"
            )
        return self._from(_meet(self.middle, rod / turn, self.centre, self.radius))

    def _through(self, divide: complex) -> Found:
        """A on the ray from C2 through E."""
        return self.at(cmath.phase(self.stroke - divide.conjugate()))

    def _from(self, pivot: complex) -> Found:
        """E, G and B of a pivot A."""
        down = (self.stroke - pivot) / abs(self.stroke - pivot)
        divide = pivot + abs(pivot) * down
        foot = pivot + ((self.middle - pivot) * down.conjugate()).real * down
        crank = abs(self.stroke - divide) / 2
        return Found(pivot, divide, foot, pivot * (1 + crank / abs(pivot)), self.stroke)


def _meet(one: complex, radius: float, two: complex, other: float) -> complex:
    """The intersection of two circles that lies to the left: the other one is its mirror image, or C2."""
    apart = abs(two - one)
    along = (apart**2 + radius**2 - other**2) / (2 * apart)
    across = math.sqrt(max(radius**2 - along**2, 0.0))
    unit = (two - one) / apart
    return min((one + unit * complex(along, side * across) for side in (1, -1)), key=lambda place: place.real)
