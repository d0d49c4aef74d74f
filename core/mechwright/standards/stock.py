"""Plates and round bars as dealers have them.

Glossary
--------
sold
    A thickness or a diameter that is in the tables, in millimetres or in inches.
drawn
    Of a bar: pulled to a class of limits, so that its outside needs no turning.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache

from mechwright.contracts.materials import entry
from mechwright.errors import DesignError
from mechwright.standards.table import table

INCH = 25.4

AS_THICK = 0.005
"""Sizes that differ by less are the same, mm: 3/8 inch is written as 9.525 or 9.53."""

CLEAN_UP = 0.4
"""About what a bar has at least more than a diameter that is turned, mm: a cut of 0.2 mm on a drawn bar."""


@dataclass(frozen=True)
class InchSize:
    """A size by the inch, and in mm."""

    name: str

    @property
    def size(self) -> float:
        """Mm.

        >>> InchSize("1 1/4").size, InchSize("3/8").size
        (31.75, 9.525)
        """
        return round(INCH * float(sum(Fraction(one) for one in self.name.split())), 6)


@dataclass(frozen=True)
class PlateStock:
    """Plates of a material: thicknesses, mm and inches."""

    material: str
    thicknesses: tuple[float, ...]
    inch: tuple[str, ...]


@dataclass(frozen=True)
class BarStock:
    """Round bars of a material: diameters, mm and inches, and the class of drawn ones, empty if none are."""

    material: str
    diameters: tuple[float, ...]
    drawn: str
    inch: tuple[str, ...]


@cache
def plate_stock(name: str) -> PlateStock:
    """Plates of a material; raises DesignError for one that the tables do not have."""
    found = entry({one.material: one for one in table("plates").of(PlateStock)}, name)
    assert found is not None  # noqa: S101 - every group has some
    return found


@cache
def bar_stock(name: str) -> BarStock:
    """Round bars of a material; raises DesignError for one that the tables do not have."""
    found = entry({one.material: one for one in table("round-bars").of(BarStock)}, name)
    assert found is not None  # noqa: S101 - every group has some
    return found


def is_sold(thickness: float, name: str) -> bool:
    """Whether plates of a material are sold so thick, mm, metric or by the inch.

    >>> is_sold(12, "aluminium"), is_sold(9.525, "aluminium"), is_sold(10.5, "aluminium")
    (True, True, False)
    """
    stock = plate_stock(name)
    sizes = (*stock.thicknesses, *(InchSize(one).size for one in stock.inch))
    return any(abs(one - thickness) <= AS_THICK for one in sizes)


def plate_for(wanted: float, name: str, in_hand: Sequence[float] = ()) -> float:
    """The least plate that is at least so thick, mm: one in hand, or as sold where none of these is.

    Raises DesignError that says the thickest.

    >>> plate_for(11, "aluminium"), plate_for(11, "aluminium", (9.525, 19.05, 12.7))
    (12.0, 12.7)
    """
    sold = plate_stock(name).thicknesses
    for sizes in (sorted(in_hand), sold):
        fitting = [float(one) for one in sizes if one >= wanted - AS_THICK]
        if fitting:
            return fitting[0]
    raise DesignError(f"no plate of {name} is {wanted:g} mm thick; the thickest is {sold[-1]:g} mm")


def plate_or_block(wanted: float, name: str) -> float:
    """The same, mm; whole millimetres of a sawn block where no plate is so thick.

    >>> plate_or_block(11, "aluminium"), plate_or_block(82.3, "aluminium")
    (12.0, 83.0)
    """
    if wanted <= plate_stock(name).thicknesses[-1]:
        return plate_for(wanted, name)
    return float(math.ceil(wanted))


def plate_within(most: float, name: str) -> float | None:
    """The thickest plate that is sold at most so thick, mm; None if even the thinnest is thicker.

    >>> plate_within(11.5, "aluminium"), plate_within(0.5, "steel")
    (10.0, None)
    """
    fitting = [float(one) for one in plate_stock(name).thicknesses if one <= most + AS_THICK]
    return fitting[-1] if fitting else None


def bar_for(diameter: float, name: str, *, turned: bool = True) -> float:
    """The diameter of the least round bar, mm, from which a part of a diameter is made.

    ``turned``: whether the outside is turned; else the bar may have the diameter itself if bars are drawn.
    Above the thickest that is sold, whole centimetres: a forging or a disc of plate.

    >>> bar_for(12, "steel", turned=False), bar_for(12, "steel"), bar_for(9.6, "steel"), bar_for(12, "pom")
    (12.0, 14.0, 10.0, 15.0)
    """
    stock = bar_stock(name)
    if not turned and stock.drawn and diameter in stock.diameters:
        return float(diameter)
    wanted = diameter + CLEAN_UP - AS_THICK
    fitting = [float(one) for one in stock.diameters if one >= wanted]
    return fitting[0] if fitting else 10.0 * -(-wanted // 10)


def inch_size(names: Sequence[str], least: float) -> InchSize | None:
    """The least size by the inch that is at least so much, mm; None if none is."""
    sizes = sorted((InchSize(one) for one in names), key=lambda one: one.size)
    return next((one for one in sizes if one.size >= least - AS_THICK), None)
