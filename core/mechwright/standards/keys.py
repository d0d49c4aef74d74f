"""Parallel keys as one buys them: DIN 6885-1; their sections stand in ``geometry.keyway``.

Glossary
--------
form A
    With round ends: for a seat that an end mill sinks between the ends of the shaft. Seat and key are as long
    as each other.
form B
    With square ends: for a seat that is open at the end of the shaft. The other end of such a seat is the
    mill's half circle, so it is half a width longer than its key.
"""

import math
from dataclasses import dataclass
from typing import Literal

from mechwright.contracts.bought import Bought
from mechwright.contracts.shape import Prism, Shape, slot
from mechwright.geometry.keyway import KeySize, key_of_width

STANDARD = "DIN 6885-1"
"""Of parallel keys."""

LENGTHS = (
    6, 8, 10, 12, 14, 16, 18, 20, 22, 25, 28, 32, 36, 40, 45, 50, 56, 63, 70, 80, 90, 100, 110, 125, 140, 160,
    180, 200,
)  # fmt: skip
"""In which keys are sold, mm."""

RANGES = {
    2: (6, 20), 3: (6, 36), 4: (8, 45), 5: (10, 56), 6: (14, 70), 8: (18, 90), 10: (22, 110), 12: (28, 140),
    14: (36, 160), 16: (45, 180), 18: (50, 200), 20: (56, 200),
}  # fmt: skip
"""Width of a key to its least and greatest length, mm; handbook, unchecked."""


Form = Literal["A", "B"]

_TOLERANCES = ((28.0, 0.2), (80.0, 0.3), (400.0, 0.5))
"""Lengths up to and including, and by how much a key may be shorter and its seat longer, mm; handbook."""

DEPTH = ((6.0, 0.1), (32.0, 0.2), (math.inf, 0.3))
"""Widths up to and including, and by how much seats may be deeper, mm (DIN 6885-1, and beyond)."""


def length_tolerance(length: float) -> float:
    """By how much a key may be shorter than its length, and its closed seat longer, mm.

    >>> length_tolerance(8), length_tolerance(32)
    (0.2, 0.3)
    """
    return next(over for most, over in _TOLERANCES if length <= most)


def depth_tolerance(width: float) -> float:
    """By how much the seats of a key of this width may be deeper than t1 and t2, mm.

    >>> depth_tolerance(6), depth_tolerance(8), depth_tolerance(36)
    (0.1, 0.2, 0.3)
    """
    return next(over for most, over in DEPTH if width <= most)


def bearing_length(length: float, width: float, form: Form) -> float:
    """Length over which the straight sides of a key bear, mm.

    >>> bearing_length(8, 4, "A"), bearing_length(8, 4, "B")
    (4, 8)
    """
    return length - width if form == "A" else length


@dataclass(frozen=True)
class Key:
    """A key of a form, its length along z, on the shaft's side towards +x; mm."""

    size: KeySize
    length: float
    form: Form = "A"

    @property
    def bears(self) -> float:
        """Length over which its straight sides bear, mm."""
        return bearing_length(self.length, self.size.width, self.form)

    @property
    def seat_length(self) -> float:
        """Length of its seat over all, mm: of form B in a seat that is open at one end."""
        return self.length if self.form == "A" else self.length + self.size.width / 2

    def bought(self, shaft: float) -> Bought:
        """How it is ordered; its solid stands on z = 0 in the seat of a shaft of this diameter, mm."""
        low = shaft / 2 - self.size.shaft_depth
        high, half, c = low + self.size.height, self.size.width / 2, self.size.chamfer
        section = (
            (low + c, -half), (high - c, -half), (high, c - half), (high, half - c), (high - c, half),
            (low + c, half), (low, half - c), (low, c - half),
        )  # fmt: skip
        words = f"DIN 6885 - {self.form} {self.size.width:g} x {self.size.height:g} x {self.length:g}"
        if self.form == "A":
            shape = Shape((slot((low, high), self.size.width, (0.0, self.length)),))
            return Bought(words, STANDARD, None, shape)
        return Bought(words, STANDARD, None, Shape((Prism(section, 0.0, self.length),)))


def key(width: float, length: float, form: Form = "A") -> Key | None:
    """The key of exactly this width and length, mm; None if none is sold.

    >>> key(4, 10).bought(12).designation, key(4, 11), key(4.2, 10)
    ('DIN 6885 - A 4 x 4 x 10', None, None)
    """
    size = key_of_width(width)
    least, most = RANGES.get(round(width), (0, 0))
    if size is None or length not in LENGTHS or not least <= length <= most:
        return None
    return Key(size, length, form)
