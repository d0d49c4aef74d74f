"""Fits of one hole or one shaft: limits of size after ISO 286-2.

A hole or shaft of basic size D in a tolerance class lies between D + lower and D + upper; what is cut aims at
the middle, so that cutter and machine may err to both sides.
"""

from dataclasses import dataclass
from typing import Literal

from mechwright.contracts.limits import limits
from mechwright.errors import DesignError, GeometryError

HoleClass = Literal["F7", "H7", "N7", "P7"]
"""F7 runs on an h6 pin, H7 locates, N7 holds with light blows, P7 is pressed."""

ShaftClass = Literal["f7", "g6", "h6", "j6", "k6", "m6", "r6"]
"""In H7 f7 and g6 run, h6 slides, j6 and k6 carry a bearing's inner ring or a hub, m6 is a dowel's, r6
a bush's."""


@dataclass(frozen=True)
class Fit:
    """Limits of a hole or a shaft: basic size, tolerance class, and limit deviations; mm.

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
        return f"{self.size:g} {self.name} ({signed(self.lower)}/{signed(self.upper)})"


def hole_fit(size: float, name: HoleClass) -> Fit:
    """The limits of a hole; raises GeometryError for a size above 400 mm, where the table ends.

    >>> hole_fit(6, "P7").text
    '6 P7 (-0.02/-0.008)'
    """
    return _fit(size, name)


def shaft_fit(size: float, name: ShaftClass) -> Fit:
    """The limits of a shaft or a seat; raises GeometryError as :func:`hole_fit` does.

    >>> shaft_fit(12, "k6").text
    '12 k6 (+0.001/+0.012)'
    """
    return _fit(size, name)


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
