"""Parallel pins (dowels) of class m6: ISO 2338, unhardened, and ISO 8734, hardened."""

from dataclasses import dataclass
from typing import Literal, get_args

from mechwright.contracts.bought import Bought
from mechwright.contracts.fits import shaft_fit
from mechwright.contracts.shape import Shape, ring
from mechwright.errors import DesignError
from mechwright.standards.table import table

DowelStandard = Literal["ISO 2338", "ISO 8734"]
STANDARDS = frozenset(get_args(DowelStandard))
"""Of dowels: soft ones and hard ones."""

LENGTHS = (
    3, 4, 5, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30, 32, 35, 40, 45, 50, 55, 60, 65, 70, 75, 80, 85,
    90, 95, 100, 120, 140, 160, 180, 200,
)  # fmt: skip
"""In which dowels are sold, mm."""


@dataclass(frozen=True)
class DowelSize:
    """Diameter and chamfer, mm, and the ranges of length of both standards."""

    diameter: float
    chamfer: float
    soft: tuple[float, float]
    hard: tuple[float, float]

    def lengths(self, standard: DowelStandard) -> list[int]:
        """In which it is sold."""
        least, most = self.hard if standard == "ISO 8734" else self.soft
        return [one for one in LENGTHS if least <= one <= most]


@dataclass(frozen=True)
class Dowel:
    """A dowel of one length, mm."""

    standard: DowelStandard
    diameter: float
    length: float
    chamfer: float

    @property
    def bought(self) -> Bought:
        """How it is ordered; it stands on z = 0."""
        body = ring(0.0, self.diameter, self.length, chamfer=self.chamfer)
        steel = "m6" if self.standard == "ISO 2338" else "A"
        size = f"{self.diameter:g} x {self.length:g}"
        words = f"{self.diameter:g} {steel} x {self.length:g} - St" if steel == "m6" else size
        fits = (shaft_fit(self.diameter, "m6"),)
        return Bought(f"{self.standard} - {words}", self.standard, None, Shape((body,)), fits=fits)


def dowels() -> tuple[DowelSize, ...]:
    """All sizes, by diameter."""
    return table("dowels").of(DowelSize)


def dowel(diameter: float, length: float, standard: DowelStandard = "ISO 8734") -> Dowel | None:
    """The dowel of exactly this size, mm; None if none is sold.

    >>> dowel(4, 16).bought.designation, dowel(4, 17)
    ('ISO 8734 - 4 x 16', None)
    """
    size = next((one for one in dowels() if one.diameter == diameter), None)
    if size is None or length not in size.lengths(standard):
        return None
    return Dowel(standard, diameter, length, size.chamfer)


def dowel_for(diameter: float, room: float, standard: DowelStandard = "ISO 8734") -> Dowel:
    """The longest dowel of a diameter that is at most ``room`` long, mm.

    Raises DesignError where the diameter is no standard one, or its shortest dowel is longer.

    >>> dowel_for(4, 17.5).length
    16
    """
    sizes = {one.diameter: one for one in dowels()}
    if diameter not in sizes:
        raise DesignError(f"{standard} has no {diameter:g} mm; one of: {', '.join(f'{d:g}' for d in sizes)}")
    size = sizes[diameter]
    fitting = [one for one in size.lengths(standard) if one <= room]
    if not fitting:
        raise DesignError(
            f"the shortest {standard} of {diameter:g} mm is {size.lengths(standard)[0]:g} mm long; "
            f"there are {room:g} mm"
        )
    return Dowel(standard, diameter, fitting[-1], size.chamfer)
