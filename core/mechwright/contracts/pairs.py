"""Fits of a pin in a hole: both limits of size after ISO 286-2, such as H7/g6."""

import re
from dataclasses import dataclass

from mechwright.contracts import limits
from mechwright.errors import DesignError

_PAIR = re.compile(f"({limits.HOLE_CLASS})/({limits.SHAFT_CLASS})")


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
    """Standard tolerance of a basic size, mm; raises DesignError above 400 mm, where the table ends.

    >>> grade(8, 6)
    0.009
    """
    return limits.grade(size, number) / 1000


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
        raise DesignError(
            f"{text!r} is no fit; write one such as 'H7/g6', a hole and a shaft of these: {limits.KNOWN}"
        )
    (low, high), (least, most) = (limits.limits(size, name) for name in match.groups())
    return Pair((low / 1000, high / 1000), (least / 1000, most / 1000))
