"""Limits of size after ISO 286: the one table of standard tolerances and deviations.

The letter of a class says where a tolerance zone begins, the number how wide it is. Holes have capitals, E
to H above the basic size or at it, J, K, M, N, P about it or below; shafts have small letters, e to h below
the basic size or at it, j, k, m, n, p, r about it or above. Other modules make fits of these, and none has
numbers of its own. Micrometres.
"""

import re

from mechwright.errors import DesignError

_STEPS = (3.0, 6.0, 10.0, 18.0, 30.0, 50.0, 80.0, 120.0, 180.0, 250.0, 315.0, 400.0)
"""Ranges of basic sizes, over the one and up to and including the next, mm (ISO 286-1)."""

LARGEST = _STEPS[-1]
"""Basic size at which the table ends, mm."""

_GRADES = {
    4: (3, 4, 4, 5, 6, 7, 8, 10, 12, 14, 16, 18),
    5: (4, 5, 6, 8, 9, 11, 13, 15, 18, 20, 23, 25),
    6: (6, 8, 9, 11, 13, 16, 19, 22, 25, 29, 32, 36),
    7: (10, 12, 15, 18, 21, 25, 30, 35, 40, 46, 52, 57),
    8: (14, 18, 22, 27, 33, 39, 46, 54, 63, 72, 81, 89),
    9: (25, 30, 36, 43, 52, 62, 74, 87, 100, 115, 130, 140),
}
"""Standard tolerances IT of each range (ISO 286-1)."""

_AWAY = {
    "e": (14, 20, 25, 32, 40, 50, 60, 72, 85, 100, 110, 125),
    "f": (6, 10, 13, 16, 20, 25, 30, 36, 43, 50, 56, 62),
    "g": (2, 4, 5, 6, 7, 9, 10, 12, 14, 15, 17, 18),
    "h": (0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0),
}
"""By how much a shaft's upper limit is below the basic size, and a hole's lower one above it."""

_INTO = {
    "k": (0, 1, 1, 1, 2, 2, 2, 3, 3, 4, 4, 4),
    "m": (2, 4, 6, 7, 8, 9, 11, 13, 15, 17, 20, 21),
    "n": (4, 8, 10, 12, 15, 17, 20, 23, 27, 31, 34, 37),
    "p": (6, 12, 15, 18, 22, 26, 32, 37, 43, 50, 56, 62),
}
"""By how much a shaft's lower limit is above the basic size, grades 4 to 7; of holes see :func:`limits`."""

_R_STEPS = (3, 6, 10, 18, 30, 50, 65, 80, 100, 120, 140, 160, 180, 200, 225, 250, 280, 315, 355, 400)
_R_SHAFT = (10, 15, 19, 23, 28, 34, 41, 43, 51, 54, 63, 65, 68, 77, 80, 84, 94, 98, 108, 114)
"""By how much the lower limit of r4 to r7 is above the basic size, which has finer ranges beyond 50 mm."""

_J_SHAFT = (2, 2, 2, 3, 4, 5, 7, 9, 11, 13, 16, 18)
"""By how much the lower limit of j5 and j6 is below the basic size."""

_J7_HOLE = (4, 6, 8, 10, 12, 14, 18, 22, 26, 30, 36, 39)
"""By how much the upper limit of J7 is above the basic size."""

SHAFT_CLASS = r"[efgh][5-9]|j[56]|[kmnpr][4-7]"
HOLE_CLASS = r"[EFGH][5-9]|J7|[KMNP][5-7]"
"""Classes that the table holds, as regular expressions."""

_CLASS = re.compile(f"({SHAFT_CLASS})|({HOLE_CLASS})")


def grade(size: float, number: int) -> int:
    """Standard tolerance IT of a basic size; raises DesignError above 400 mm, where the table ends.

    >>> grade(8, 6)
    9
    """
    return _GRADES[number][_row(size)]


def limits(size: float, name: str) -> tuple[int, int]:
    """Lower and upper limit deviation of a class, holes with capitals.

    A hole of class K to P has the upper limit of its shaft's lower one, turned over, raised by the step from
    the next finer grade to its own, where the size is above 3 mm (ISO 286-1).

    Raises
    ------
    DesignError
        The table does not hold the class, or the size is not above 0 and at most 400 mm.

    >>> limits(8, "H7"), limits(8, "P7"), limits(8, "g6"), limits(8, "j6")
    ((0, 15), (-24, -9), (-14, -5), (-2, 7))
    """
    if not _CLASS.fullmatch(name):
        raise DesignError(
            f"{name!r} is no tolerance class that is known; shafts: e to h 5 to 9, j5, j6, "
            "k, m, n, p, r 4 to 7; holes: E to H 5 to 9, J7, K, M, N, P 5 to 7"
        )
    row, letter, number = _row(size), name[0], int(name[1])
    width = _GRADES[number][row]
    if letter in _AWAY:
        return -_AWAY[letter][row] - width, -_AWAY[letter][row]
    if letter in _INTO:
        return _INTO[letter][row], _INTO[letter][row] + width
    if letter == "r":
        lower = _R_SHAFT[next(i for i, most in enumerate(_R_STEPS) if size <= most)]
        return lower, lower + width
    if letter == "j":
        return -_J_SHAFT[row], width - _J_SHAFT[row]
    if letter == "J":
        return _J7_HOLE[row] - width, _J7_HOLE[row]
    if letter.lower() in _AWAY:
        return _AWAY[letter.lower()][row], _AWAY[letter.lower()][row] + width
    raised = width - _GRADES[number - 1][row] if size > _STEPS[0] else 0
    upper = raised - _INTO[letter.lower()][row]
    return upper - width, upper


def _row(size: float) -> int:
    if not 0 < size <= LARGEST:
        raise DesignError(f"no fit for a diameter of {size:g} mm; the table goes up to {LARGEST:g} mm")
    return next(i for i, most in enumerate(_STEPS) if size <= most)
