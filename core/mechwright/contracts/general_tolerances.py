"""Tolerances of dimensions that have none of their own: ISO 2768."""

import math
from bisect import bisect_left
from typing import Literal

from mechwright.errors import DesignError

Grade = Literal["fine", "medium", "coarse"]

_LENGTHS = (3.0, 6.0, 30.0, 120.0, 400.0, 1000.0, 2000.0, 4000.0)
"""Ranges of nominal lengths, up to and including, mm."""

_LINEAR: dict[Grade, tuple[float, ...]] = {
    "fine": (0.05, 0.05, 0.1, 0.15, 0.2, 0.3, 0.5),
    "medium": (0.1, 0.1, 0.2, 0.3, 0.5, 0.8, 1.2, 2.0),
    "coarse": (0.2, 0.3, 0.5, 0.8, 1.2, 2.0, 3.0, 4.0),
}
"""Permissible deviations, plus and minus, mm: ISO 2768-1, classes f, m and c; f ends at 2000 mm."""

_LEGS = (10.0, 50.0, 120.0, 400.0)
"""Ranges of the shorter leg of an angle, up to and including, mm; the last class has no end."""

_ANGULAR: dict[Grade, tuple[int, ...]] = {
    "fine": (60, 30, 20, 10, 5),
    "medium": (60, 30, 20, 10, 5),
    "coarse": (90, 60, 30, 15, 10),
}
"""Permissible deviations of angles, minutes: ISO 2768-1."""

_RUN_OUT: dict[Grade, float] = {"fine": 0.1, "medium": 0.2, "coarse": 0.5}
"""Circular run-out, total reading, mm: ISO 2768-2, classes H, K and L, which go with f, m and c."""


def general_length(nominal: float, of: Grade) -> float:
    """Permissible deviation of a length, plus and minus, mm; raises DesignError where the table ends.

    >>> general_length(80.0, "fine"), general_length(30.0, "medium")
    (0.15, 0.2)
    """
    row, table = bisect_left(_LENGTHS, abs(nominal)), _LINEAR[of]
    if row >= len(table):
        raise DesignError(
            f"ISO 2768-1 {of} ends at {_LENGTHS[len(table) - 1]:g} mm, and a length is {nominal:g} mm; "
            "give tolerances.length"
        )
    return table[row]


def general_angle(leg: float, of: Grade) -> float:
    """Permissible deviation of an angle, plus and minus, rad; ``leg`` is its shorter leg, mm.

    >>> round(math.degrees(general_angle(60.0, "fine")) * 60, 9)
    20.0
    """
    return math.radians(_ANGULAR[of][bisect_left(_LEGS, leg)] / 60)


def general_eccentricity(of: Grade) -> float:
    """Half the permissible run-out, mm."""
    return _RUN_OUT[of] / 2
