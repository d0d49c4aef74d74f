"""Fits of one hole or one shaft: limits of size after ISO 286-2.

A hole or shaft of basic size D in a tolerance class lies between D + lower and D + upper; what is cut aims at
the middle, so that cutter and machine may err to both sides.
"""

from dataclasses import dataclass
from typing import Literal

from mechwright.contracts.limits import grade, limits
from mechwright.errors import DesignError, GeometryError

HoleClass = Literal["F7", "H7", "N7", "P7"]
"""Of a hole that a design file asks for: F7 runs on an h6 pin, H7 locates, N7 holds with light blows, P7 is
pressed."""


ROLLING = "h9"
"""Class of the outside of a roller that runs on a wall: that of drawn bar, whose face it keeps."""


@dataclass(frozen=True)
class Fit:
    """Limits of a hole or a shaft: basic size, tolerance class, and limit deviations; mm.

    The class is empty where the limits are of no class of ISO 286, as those of a bearing's rings.

    >>> fit = hole_fit(6, "H7")
    >>> fit.text, fit.middle
    ('6 H7 (0/+0.012)', 6.006)
    """

    size: float
    name: str
    lower: float
    upper: float

    @property
    def middle(self) -> float:
        """Diameter in the middle of the tolerance, mm."""
        return round(self.size + (self.lower + self.upper) / 2, 6)

    @property
    def text(self) -> str:
        """Size, class and limit deviations, as a drawing notes them."""
        return f"{self.short} ({signed(self.lower)}/{signed(self.upper)})"

    @property
    def short(self) -> str:
        """Size and class."""
        return f"{self.size:g} {self.name}".rstrip()

    @property
    def limits(self) -> tuple[float, float]:
        """Least and greatest diameter, mm."""
        return self.size + self.lower, self.size + self.upper


def hole_fit(size: float, name: str) -> Fit:
    """The limits of a hole; raises GeometryError for a size or a class that is in no table.

    >>> hole_fit(6, "P7").text
    '6 P7 (-0.02/-0.008)'
    """
    return _fit(size, name)


def shaft_fit(size: float, name: str) -> Fit:
    """The limits of a shaft or a seat; raises GeometryError as :func:`hole_fit` does.

    >>> shaft_fit(12, "k6").text
    '12 k6 (+0.001/+0.012)'
    """
    return _fit(size, name)


def between(size: float, lower: float, upper: float) -> Fit:
    """Limits that no class gives, mm.

    >>> between(26, -0.009, 0).text
    '26 (-0.009/0)'
    """
    return Fit(size, "", lower, upper)


def running_hole(size: float, clearance: float, shaft: Fit) -> Fit:
    """The hole in which a shaft runs with a mean clearance, mm; its tolerance is IT 7.

    It has the name of a class where one has these limits.

    >>> running_hole(6, 0.03, shaft_fit(6, "h6")).text
    '6 E7 (+0.02/+0.032)'
    >>> running_hole(8, 0.03, shaft_fit(8, "h6")).text
    '8 (+0.018/+0.033)'
    """
    half = grade(size, 7) / 2000
    middle = shaft.size - size + (shaft.lower + shaft.upper) / 2 + clearance
    lower, upper = round(middle - half, 6), round(middle + half, 6)
    for name in ("D7", "E7", "F7", "G7", "H7"):
        known = _fit(size, name)
        if abs(known.lower - lower) < EXACT and abs(known.upper - upper) < EXACT:
            return known
    return between(size, lower, upper)


EXACT = 1e-6
"""mm. Limits that differ by less are the same."""


def _fit(size: float, name: str) -> Fit:
    try:
        lower, upper = limits(size, name)
    except DesignError as error:
        raise GeometryError(str(error)) from error
    return Fit(size, name, lower / 1000, upper / 1000)


def signed(value: float) -> str:
    """A limit deviation as drawings write it.

    >>> signed(0.012), signed(-0.02), signed(0.0)
    ('+0.012', '-0.02', '0')
    """
    return f"{value:+g}" if value else "0"
