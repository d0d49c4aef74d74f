"""Sizes that a finished part is measured by, beside its overall sizes and its bores."""

from dataclasses import dataclass

from mechwright.errors import GeometryError
from mechwright.tolerances import TOLERANCES


@dataclass(frozen=True)
class Measure:
    """A size that tells whether a part is right.

    Parameters
    ----------
    what
        What is measured, and how, in a few words: ``"over pins ⌀3.5 at 4.6° and 184.6°"``.
    nominal
        mm.
    least, greatest
        Limits, mm; None where nothing is said.
    by
        What the limits follow from, in a few words.

    Raises
    ------
    GeometryError
        The nominal size is not within the limits.
    """

    what: str
    nominal: float
    least: float | None = None
    greatest: float | None = None
    by: str = ""

    def __post_init__(self) -> None:
        least = self.nominal if self.least is None else self.least
        greatest = self.nominal if self.greatest is None else self.greatest
        if not least <= self.nominal <= greatest:
            raise GeometryError(
                f"measure {self.what!r}: {self.nominal:g} mm is not within {least:g} to {greatest:g} mm"
            )


def between_walls(what: str, nominal: float, walls: int) -> Measure:
    """A size between milled walls, within what the proof of a program lets pass.

    ``walls`` counts those of which stock that is left makes the size larger; negative, smaller.

    >>> found = between_walls("width of the slot", 12.08, -2)
    >>> found.least, found.greatest
    (12.06, 12.09)
    """
    deep, left = TOLERANCES.gouge * abs(walls), TOLERANCES.leftover * abs(walls)
    below, above = (deep, left) if walls > 0 else (left, deep)
    nominal = round(nominal, 4)
    return Measure(what, nominal, round(nominal - below, 4), round(nominal + above, 4), "walls as proven")
