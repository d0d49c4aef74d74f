"""Names of threads: metric after ISO 261, unified inch threads after ASME B1.1, right- and left-handed."""

import re
from dataclasses import dataclass

from mechwright.contracts.details import Thread
from mechwright.errors import GeometryError

COARSE = {
    1.6: 0.35, 2: 0.4, 2.5: 0.45, 3: 0.5, 3.5: 0.6, 4: 0.7, 5: 0.8, 6: 1, 7: 1, 8: 1.25, 10: 1.5, 12: 1.75,
    14: 2, 16: 2, 18: 2.5, 20: 2.5, 22: 2.5, 24: 3, 27: 3, 30: 3.5, 33: 3.5, 36: 4, 39: 4, 42: 4.5, 45: 4.5,
    48: 5, 52: 5, 56: 5.5, 60: 5.5, 64: 6,
}  # fmt: skip
"""Nominal diameter to coarse pitch, mm (ISO 261)."""

UNIFIED = {
    "UNC": {
        "#2": 56, "#4": 40, "#5": 40, "#6": 32, "#8": 32, "#10": 24, "#12": 24, "1/4": 20, "5/16": 18,
        "3/8": 16, "7/16": 14, "1/2": 13, "9/16": 12, "5/8": 11, "3/4": 10, "7/8": 9, "1": 8,
    },
    "UNF": {
        "#2": 64, "#4": 48, "#5": 44, "#6": 40, "#8": 36, "#10": 32, "#12": 28, "1/4": 28, "5/16": 24,
        "3/8": 24, "7/16": 20, "1/2": 20, "9/16": 18, "5/8": 18, "3/4": 16, "7/8": 14, "1": 12,
    },
}  # fmt: skip
"""Series to size to threads per inch (ASME B1.1)."""

INCH = 25.4
_METRIC = re.compile(r"M(\d+(?:\.\d+)?)(?:\s*[x×]\s*(\d+(?:\.\d+)?))?")
_UNIFIED = re.compile(r"(#\d+|\d+(?:/\d+)?)\s*-\s*(\d+)(?:\s*(UNC|UNF))?")
_LEFT = re.compile(r"[\s-]*LH$")
EXAMPLES = "write M6, M6x0.75 for a fine pitch, or 1/4-20 UNC; LH behind it for a left-hand one"


@dataclass(frozen=True)
class Named:
    """What a name says of a thread; lengths in mm."""

    diameter: float
    pitch: float
    left: bool = False
    inch: str = ""
    """Size, threads per inch and series of a unified one."""


def named(designation: str) -> Named:
    """A thread by its name; the coarse pitch of a metric one if none is said.

    Raises GeometryError for what is no such name, has no coarse pitch, or too coarse a one.

    >>> named("M8x1").pitch, named("1/4-20").inch, round(named("#10-32 UNF LH").diameter, 3)
    (1.0, '1/4-20 UNC', 4.826)
    """
    text, left = _LEFT.subn("", designation.strip())
    if found := _METRIC.fullmatch(text):
        made = _metric(designation, found[1], found[2], bool(left))
    elif found := _UNIFIED.fullmatch(text):
        made = _unified(designation, found[1], int(found[2]), found[3], bool(left))
    else:
        raise GeometryError(f"{designation!r} is no metric thread, and no unified one; {EXAMPLES}")
    Thread("thread", (0.0, 0.0), made.diameter, made.pitch, 1.0)  # says what is wrong with the pitch
    return made


def _metric(designation: str, size: str, pitch: str | None, left: bool) -> Named:
    diameter = float(size)
    if pitch is None and diameter not in COARSE:
        raise GeometryError(f"{designation} has no coarse pitch in ISO 261; say which, as M{diameter:g}x1")
    return Named(diameter, float(pitch or COARSE[diameter]), left)


def _unified(designation: str, size: str, per_inch: int, series: str | None, left: bool) -> Named:
    fitting = [name for name, sizes in UNIFIED.items() if sizes.get(size) == per_inch]
    if not fitting or (series is not None and series not in fitting):
        known = [f"{size}-{sizes[size]} {name}" for name, sizes in UNIFIED.items() if size in sizes]
        raise GeometryError(
            f"{designation!r} is no thread of ASME B1.1; there is {' and '.join(known) or 'no such size'}"
        )
    return Named(_inches(size) * INCH, INCH / per_inch, left, f"{size}-{per_inch} {fitting[0]}")


def _inches(size: str) -> float:
    """A size in inches: a fraction, or of a number n 0.060 + 0.013 n (ASME B1.1)."""
    if size.startswith("#"):
        return 0.060 + 0.013 * int(size[1:])
    top, _, bottom = size.partition("/")
    return int(top) / int(bottom or 1)
