"""Fits of a pin in a hole: both limits of size after ISO 286-2, such as H7/g6.

The letter says where a tolerance zone begins, the number how wide it is. Holes have capitals: their lower
limit is above (E, F, G) or at (H) the basic size. Shafts have small letters: their upper limit is below (e,
f, g) or at (h) the basic size, or their lower limit above it (k, m, n, p).
"""

import re
from dataclasses import dataclass

from mechwright.errors import DesignError

_STEPS = (3.0, 6.0, 10.0, 18.0, 30.0, 50.0, 80.0, 120.0, 180.0, 250.0, 315.0, 400.0)
"""Ranges of basic sizes, over the one and up to and including the next, mm (ISO 286-1)."""

_GRADES = {
    5: (4, 5, 6, 8, 9, 11, 13, 15, 18, 20, 23, 25),
    6: (6, 8, 9, 11, 13, 16, 19, 22, 25, 29, 32, 36),
    7: (10, 12, 15, 18, 21, 25, 30, 35, 40, 46, 52, 57),
    8: (14, 18, 22, 27, 33, 39, 46, 54, 63, 72, 81, 89),
    9: (25, 30, 36, 43, 52, 62, 74, 87, 100, 115, 130, 140),
}
"""Standard tolerances IT of each range, micrometres (ISO 286-1)."""

_BELOW = {
    "e": (14, 20, 25, 32, 40, 50, 60, 72, 85, 100, 110, 125),
    "f": (6, 10, 13, 16, 20, 25, 30, 36, 43, 50, 56, 62),
    "g": (2, 4, 5, 6, 7, 9, 10, 12, 14, 15, 17, 18),
    "h": (0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0),
}
"""By how much a shaft's upper limit is below the basic size, and a hole's lower one above it, micrometres."""

_ABOVE = {
    "k": (0, 1, 1, 1, 2, 2, 2, 3, 3, 4, 4, 4),
    "m": (2, 4, 6, 7, 8, 9, 11, 13, 15, 17, 20, 21),
    "n": (4, 8, 10, 12, 15, 17, 20, 23, 27, 31, 34, 37),
    "p": (6, 12, 15, 18, 22, 26, 32, 37, 43, 50, 56, 62),
}
"""By how much a shaft's lower limit is above the basic size, micrometres; grades 5 to 7."""

_PAIR = re.compile(r"([EFGH])([5-9])/(?:([efgh])([5-9])|([kmnp])([5-7]))")


@dataclass(frozen=True)
class Pair:
    """Limit deviations of a hole and of the pin in it, mm.

    Examples
    --------
    >>> pair = pair_of(8, "H7/g6")
    >>> pair.hole, pair.shaft, (round(pair.least, 6), round(pair.greatest, 6))
    ((0.0, 0.015), (-0.014, -0.005), (0.005, 0.029))
    """

    hole: tuple[float, float]
    shaft: tuple[float, float]

    @property
    def least(self) -> float:
        """Least clearance, on the diameter; below 0 the pin may have to be pressed in."""
        return self.hole[0] - self.shaft[1]

    @property
    def greatest(self) -> float:
        """Greatest clearance, on the diameter."""
        return self.hole[1] - self.shaft[0]


def grade(size: float, number: int) -> float:
    """Standard tolerance of a basic size, mm; raises DesignError above 400 mm, where this table ends.

    >>> grade(8, 6)
    0.009
    """
    return _GRADES[number][_row(size)] / 1000


def pair_of(size: float, text: str) -> Pair:
    """The limits of a fit.

    Raises
    ------
    DesignError
        The text is no fit, or the size is above 400 mm.

    >>> round(pair_of(8, "F8/h6").least, 6)
    0.013
    """
    match = _PAIR.fullmatch(text.strip())
    if match is None:
        raise DesignError(f"{text!r} is no fit; write one such as 'H7/g6': E to H, then e to h or k, m, n, p")
    row = _row(size)
    letter, number, loose, loose_grade, tight, tight_grade = match.groups()
    lower = _BELOW[letter.lower()][row]
    hole = (lower, lower + _GRADES[int(number)][row])
    if loose:
        upper = -_BELOW[loose][row]
        shaft = (upper - _GRADES[int(loose_grade)][row], upper)
    else:
        shaft = (_ABOVE[tight][row], _ABOVE[tight][row] + _GRADES[int(tight_grade)][row])
    return Pair((hole[0] / 1000, hole[1] / 1000), (shaft[0] / 1000, shaft[1] / 1000))


def _row(size: float) -> int:
    if not 0 < size <= _STEPS[-1]:
        raise DesignError(f"no fit for a diameter of {size:g} mm; the table goes up to {_STEPS[-1]:g} mm")
    return next(i for i, most in enumerate(_STEPS) if size <= most)
