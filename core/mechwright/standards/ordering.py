"""How bought parts are ordered: in words, with grade and finish, and what is sold in inches."""

import re
from dataclasses import dataclass
from fractions import Fraction
from functools import cache

from mechwright.contracts.bought import Bought
from mechwright.standards.table import table

_SCREW = re.compile(r"ISO (?:4762|10642|4026) - M([\d.]+) x ([\d.]+) - (\S+)")

UNIFIED = {
    2.0: "#2-56", 2.5: "#3-48", 3.0: "#4-40", 4.0: "#8-32", 5.0: "#10-32", 6.0: "1/4-20", 8.0: "5/16-18",
    10.0: "3/8-16", 12.0: "1/2-13",
}  # fmt: skip
"""Metric thread, mm, to the nearest unified one that is sold everywhere (ASME B1.1)."""

SHORT = 12.7
"""Inch screws are sold by sixteenths up to this length, mm, and by eighths above."""


@dataclass(frozen=True)
class Kind:
    """How parts of a standard are ordered."""

    standard: str
    words: str
    grade: str
    finish: str
    american: str


@dataclass(frozen=True)
class Order:
    """How one part is ordered."""

    text: str
    grade: str = ""
    finish: str = ""
    inch: str = ""


@cache
def kinds() -> dict[str, Kind]:
    """All of them, by standard."""
    return {one.standard: one for one in table("ordering").of(Kind)}


def order_of(what: Bought) -> Order:
    """How a bought part is ordered; by its designation alone where no table knows its standard.

    >>> from mechwright.standards.screws import screw
    >>> found = order_of(screw(5, 12).bought)
    >>> found.text
    'hexagon socket head cap screw ISO 4762 M5 x 12, class 8.8'
    >>> found.inch
    'ASME B18.3.1M of the same size; or #10-32 x 1/2 in holes tapped for it'
    """
    kind = kinds().get(what.standard)
    if kind is None:
        return Order(what.designation, inch=what.inch)
    match = _SCREW.fullmatch(what.designation)
    if match is None:
        name = what.designation.replace(" - ", " ")
        inch = "; ".join(one for one in (kind.american, what.inch) if one)
        return Order(f"{kind.words} {name}".strip(), kind.grade, kind.finish, inch)
    size, length, grade = float(match[1]), float(match[2]), match[3]
    text = f"{kind.words} {kind.standard} M{size:g} x {length:g}, class {grade}"
    inch = f"{kind.american} of the same size"
    if size in UNIFIED:
        inch += f"; or {UNIFIED[size]} x {inch_length(length)} in holes tapped for it"
    return Order(text, f"class {grade}", kind.finish, inch)


def inch_length(length: float) -> str:
    """The nearest length of an inch screw, in words of inches.

    >>> inch_length(12), inch_length(8), inch_length(25), inch_length(30)
    ('1/2', '5/16', '1', '1 1/8')
    """
    step = 16 if length < SHORT else 8
    value = Fraction(max(round(length / 25.4 * step), 1), step)
    whole, rest = divmod(value, 1)
    return " ".join(str(one) for one in (whole, rest) if one)
