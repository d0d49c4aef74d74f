"""Fits of holes: limits of size after ISO 286-2.

A hole of basic size D in a tolerance class lies between D + lower and D + upper; what is cut aims at the
middle, so that cutter and machine may err to both sides.
"""

from dataclasses import dataclass
from typing import Literal

from mechwright.errors import GeometryError

HoleClass = Literal["F7", "H7", "N7", "P7"]
"""F7 runs on an h6 pin, H7 locates, N7 holds with light blows, P7 is pressed."""

_STEPS = (3.0, 6.0, 10.0, 18.0, 30.0, 50.0, 80.0, 120.0, 180.0)
"""Ranges of basic sizes, over the one and up to and including the next, mm (ISO 286-1)."""

_GRADE_7 = (10, 12, 15, 18, 21, 25, 30, 35, 40)
"""Standard tolerance IT7 of each range, micrometres (ISO 286-1)."""

_LOWER: dict[HoleClass, tuple[int, ...]] = {
    "F7": (6, 10, 13, 16, 20, 25, 30, 36, 43),
    "H7": (0, 0, 0, 0, 0, 0, 0, 0, 0),
    "N7": (-14, -16, -19, -23, -28, -33, -39, -45, -52),
    "P7": (-16, -20, -24, -29, -35, -42, -51, -59, -68),
}
"""Lower limit deviation EI of each range, micrometres (ISO 286-2)."""


@dataclass(frozen=True)
class Fit:
    """Limits of a hole: basic size, tolerance class, and limit deviations; mm.

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
        return f"{self.size:g} {self.name} ({_signed(self.lower)}/{_signed(self.upper)})"


def hole_fit(size: float, name: HoleClass) -> Fit:
    """The limits of a hole; raises GeometryError for a size above 180 mm, where this table ends.

    >>> hole_fit(6, "P7").text
    '6 P7 (-0.02/-0.008)'
    """
    if not 0 < size <= _STEPS[-1]:
        raise GeometryError(f"no fit for a hole of {size:g} mm; the table goes up to {_STEPS[-1]:g} mm")
    row = next(i for i, most in enumerate(_STEPS) if size <= most)
    lower = _LOWER[name][row]
    return Fit(size, name, lower / 1000, (lower + _GRADE_7[row]) / 1000)


def _signed(value: float) -> str:
    return f"{value:+g}" if value else "0"
