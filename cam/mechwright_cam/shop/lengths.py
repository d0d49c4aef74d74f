"""Lengths on a sheet: millimetres, or inches with millimetres beside metric sizes of what is bought."""

from dataclasses import dataclass

from mechwright.designs.inches import FACTORS, Units
from mechwright.output.svg import signed

FINER = 2
"""So many decimals more an inch takes: a hundredth of a millimetre is four tenths of a thousandth."""
MOST = 5
"""Decimals of an inch at most."""
FINE = 0.01
"""Below this, mm, all decimals of an inch are needed to say anything."""
SIXTY_FOURTH = FACTORS["mm"] / 64
"""What cutters and pins of inch sizes are multiples of, mm."""
SAME = 1e-4
"""A size this near to a multiple is one, mm."""


@dataclass(frozen=True)
class Lengths:
    """How lengths, given in mm, are written.

    >>> Lengths("mm").plain(6.35), Lengths("inch").plain(6.35), Lengths("inch").size(6.0)
    ('6.35', '0.25', '0.2362 (6 mm)')
    """

    units: Units = "mm"

    @property
    def unit(self) -> str:
        """Behind a number."""
        return "in" if self.units == "inch" else "mm"

    @property
    def scale(self) -> float:
        """Of the unit, mm."""
        return FACTORS["mm"] if self.units == "inch" else 1.0

    def digits(self, digits: int) -> int:
        """Decimals for what has so many in mm."""
        return digits if self.units == "mm" else min(digits + FINER, MOST)

    def signed(self, value: float, digits: int = 2) -> str:
        """A coordinate with a true minus sign."""
        return signed(value / self.scale, self.digits(digits))

    def fixed(self, value: float, digits: int = 2) -> str:
        """A length with as many decimals as that."""
        return f"{value / self.scale:.{self.digits(digits)}f}"

    def plain(self, value: float) -> str:
        """A length without needless zeros."""
        if self.units == "mm":
            return f"{value:g}"
        digits = 4 if abs(value) >= FINE else MOST
        return f"{value / self.scale:.{digits}f}".rstrip("0").rstrip(".")

    def size(self, value: float) -> str:
        """The size of something that is bought: in an inch shop with millimetres where it is metric."""
        said = self.plain(value)
        if self.units == "mm" or _multiple(value, SIXTY_FOURTH) or not _multiple(value, 0.1):
            return said
        return f"{said} ({value:g} mm)"

    def with_unit(self, value: float) -> str:
        """A plain length and its unit."""
        return f"{self.plain(value)} {self.unit}"


def _multiple(value: float, step: float) -> bool:
    return abs(value / step - round(value / step)) * step < SAME


MILLIMETRES = Lengths()
"""As lengths are kept."""
