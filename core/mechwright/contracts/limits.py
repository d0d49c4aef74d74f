"""Limits of size after ISO 286: the one table of standard tolerances and deviations.

The letter of a class says where a tolerance zone begins, the number how wide it is. Holes have capitals:
D to H lie above the basic size or at it, JS on both sides, J to S about it or below. Shafts have small
letters: d to h lie below the basic size or at it, js on both sides, j to s about it or above. Other modules
make fits of these, and none has numbers of its own. Micrometres.
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
    10: (40, 48, 58, 70, 84, 100, 120, 140, 160, 185, 210, 230),
    11: (60, 75, 90, 110, 130, 160, 190, 220, 250, 290, 320, 360),
    12: (100, 120, 150, 180, 210, 250, 300, 350, 400, 460, 520, 570),
    13: (140, 180, 220, 270, 330, 390, 460, 540, 630, 720, 810, 890),
}
"""Standard tolerances IT of each range (ISO 286-1)."""

_AWAY = {
    "d": (20, 30, 40, 50, 65, 80, 100, 120, 145, 170, 190, 210),
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
"""By how much a shaft's lower limit is above the basic size; of holes see :func:`limits`."""

_FINE_STEPS = (3, 6, 10, 18, 30, 50, 65, 80, 100, 120, 140, 160, 180, 200, 225, 250, 280, 315, 355, 400)
_FINE = {
    "r": (10, 15, 19, 23, 28, 34, 41, 43, 51, 54, 63, 65, 68, 77, 80, 84, 94, 98, 108, 114),
    "s": (14, 19, 23, 28, 35, 43, 53, 59, 71, 79, 92, 100, 108, 122, 130, 140, 158, 170, 190, 208),
}
"""The same of r and s, which have finer ranges beyond 50 mm."""

_J_SHAFT = (2, 2, 2, 3, 4, 5, 7, 9, 11, 13, 16, 18)
"""By how much the lower limit of j5 and j6 is below the basic size."""

_J_HOLE = {
    6: (2, 5, 5, 6, 8, 10, 13, 16, 18, 22, 25, 29),
    7: (4, 6, 8, 10, 12, 14, 18, 22, 26, 30, 36, 39),
}
"""By how much the upper limit of J6 and J7 is above the basic size."""

SHAFT_CLASS = r"d(?:[5-9]|1[0-3])|[efg][5-9]|h(?:[5-9]|1[0-3])|js(?:[5-9]|1[0-3])|j[56]|[kmnprs][4-7]"
HOLE_CLASS = (
    r"D(?:[5-9]|1[0-3])|[EFG][5-9]|H(?:[5-9]|1[0-3])|JS(?:[5-9]|1[0-3])|J[67]|[KM][5-8]|[NP][5-9]|[RS][5-7]"
)
"""Classes that the table holds, as regular expressions."""

KNOWN = (
    "shafts: d, h, js 5 to 13, e, f, g 5 to 9, j5, j6, k, m, n, p, r, s 4 to 7; "
    "holes: D, H, JS 5 to 13, E, F, G 5 to 9, J6, J7, K, M 5 to 8, N, P 5 to 9, R, S 5 to 7"
)
"""The same in words."""

_CLASS = re.compile(f"(?:{SHAFT_CLASS})|(?:{HOLE_CLASS})")


def grade(size: float, number: int) -> int:
    """Standard tolerance IT of a basic size; raises DesignError above 400 mm, where the table ends.

    >>> grade(8, 6)
    9
    """
    return _GRADES[number][_row(size)]


def limits(size: float, name: str) -> tuple[float, float]:
    """Lower and upper limit deviation of a class, holes with capitals.

    A hole of class K to S has the upper limit of its shaft's lower one, turned over. Where the size is above
    3 mm it is raised by the step from the next finer grade to its own: K, M and N to grade 8, P, R and S to
    grade 7. N9 has the upper limit 0 there (ISO 286-1).

    Raises
    ------
    DesignError
        The table does not hold the class, or the size is not above 0 and at most 400 mm.

    >>> limits(8, "H7"), limits(8, "P7"), limits(8, "g6"), limits(8, "j6"), limits(8, "JS7")
    ((0, 15), (-24, -9), (-14, -5), (-2, 7), (-7.5, 7.5))
    """
    if not _CLASS.fullmatch(name):
        raise DesignError(f"{name!r} is no tolerance class that is known; {KNOWN}")
    letter, number = name.rstrip("0123456789"), int(name.lstrip("DEFGHJSKMNPRdefghjskmnpr"))
    width = grade(size, number)
    if letter.lower() == "js":
        return -width / 2, width / 2
    if letter in {"j", "J"}:
        row = _row(size)
        lower = -_J_SHAFT[row] if letter == "j" else _J_HOLE[number][row] - width
        return lower, lower + width
    if letter.lower() in _AWAY:
        away = _AWAY[letter.lower()][_row(size)]
        return (-away - width, -away) if letter.islower() else (away, away + width)
    into = _into(size, letter.lower())
    if letter.islower():
        return into, into + width
    upper = _raised(size, letter, number) - into
    if letter == "N" and number > 8 and size > _STEPS[0]:
        upper = 0
    return upper - width, upper


def _into(size: float, letter: str) -> int:
    """By how much a shaft's lower limit is above the basic size."""
    row = _row(size)
    if letter in _FINE:
        return _FINE[letter][next(i for i, most in enumerate(_FINE_STEPS) if size <= most)]
    return _INTO[letter][row]


def _raised(size: float, letter: str, number: int) -> int:
    """By how much the upper limit of a hole of class K to S is raised above its shaft's."""
    if size <= _STEPS[0] or number > (8 if letter in "KMN" else 7):
        return 0
    return grade(size, number) - grade(size, number - 1)


def _row(size: float) -> int:
    if not 0 < size <= LARGEST:
        raise DesignError(f"no fit for a diameter of {size:g} mm; the table goes up to {LARGEST:g} mm")
    return next(i for i, most in enumerate(_STEPS) if size <= most)
