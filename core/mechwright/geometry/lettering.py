"""A font of single lines, for part numbers and index marks: what an engraving cutter follows.

Every letter stands on a grid 4 wide and 6 high; a letter is a list of strokes, a stroke a run of grid points
written as two digits, x then y.
"""

import math

from mechwright.errors import DesignError
from mechwright.geometry.segments import Point

LETTERS = {
    "0": "10 01 05 16 36 45 41 30 10/14 32",
    "1": "14 26 20",
    "2": "05 16 36 45 44 00 40",
    "3": "06 46 24 43 41 30 10 01",
    "4": "40 46 02 42",
    "5": "46 06 04 34 43 41 30 00",
    "6": "36 16 05 01 10 30 41 42 33 03",
    "7": "06 46 10",
    "8": "13 04 05 16 36 45 44 33 13 02 01 10 30 41 42 33",
    "9": "10 30 41 45 36 16 05 04 13 43",
    "A": "00 03 26 43 40/02 42",
    "B": "00 06 36 45 44 33 03/33 42 41 30 00",
    "C": "45 36 16 05 01 10 30 41",
    "D": "00 06 26 44 42 20 00",
    "E": "46 06 00 40/03 33",
    "F": "46 06 00/03 33",
    "G": "45 36 16 05 01 10 30 41 43 23",
    "H": "00 06/40 46/03 43",
    "I": "20 26",
    "J": "46 41 30 10 01",
    "K": "00 06/46 03 40",
    "L": "06 00 40",
    "M": "00 06 23 46 40",
    "N": "00 06 40 46",
    "O": "10 01 05 16 36 45 41 30 10",
    "P": "00 06 36 45 44 33 03",
    "Q": "10 01 05 16 36 45 41 30 10/22 40",
    "R": "00 06 36 45 44 33 03/23 40",
    "S": "01 10 30 41 42 33 13 04 05 16 36 45",
    "T": "06 46/26 20",
    "U": "06 01 10 30 41 46",
    "V": "06 20 46",
    "W": "06 10 23 30 46",
    "X": "00 46/06 40",
    "Y": "06 23 46/23 20",
    "Z": "06 46 00 40",
    "-": "13 33",
    "_": "00 40",
    ".": "20 21",
    "/": "00 46",
    "+": "13 33/22 24",
    ":": "21 22/24 25",
    " ": "",
}
_WIDE, _HIGH, _NEXT = 4, 6, 6
"""Width and height of a letter, and from one letter to the next, in grid units."""

Strokes = tuple[tuple[Point, ...], ...]


def lettering(text: str, height: float, at: Point = (0.0, 0.0), angle: float = 0.0) -> Strokes:
    """The strokes of a line of text, mm: letters (as capitals), digits, and ``- _ . / + :``.

    ``height`` is that of capitals, mm, ``at`` the middle of the line, at half its height, ``angle`` that from
    the x axis, rad. Raises DesignError that lists the font for a character that is not in it.

    >>> lettering("I", 6.0)
    (((0.0, -3.0), (0.0, 3.0)),)
    >>> len(lettering("M6-1", 3.5, (10.0, 0.0)))
    4
    """
    unknown = sorted(set(text.upper()) - set(LETTERS))
    if unknown:
        raise DesignError(
            f"no letter {unknown[0]!r} to engrave; there are {''.join(sorted(LETTERS)).strip()}"
        )
    scale = height / _HIGH
    width = (len(text) - 1) * _NEXT + _WIDE
    cos, sin = math.cos(angle), math.sin(angle)
    strokes = []
    for place, letter in enumerate(text.upper()):
        for stroke in filter(None, LETTERS[letter].split("/")):
            points = []
            for node in stroke.split():
                u = (int(node[0]) + place * _NEXT - width / 2) * scale
                v = (int(node[1]) - _HIGH / 2) * scale
                points.append((at[0] + u * cos - v * sin, at[1] + u * sin + v * cos))
            strokes.append(tuple(points))
    return tuple(strokes)
