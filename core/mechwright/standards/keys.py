"""Parallel keys as one buys them: DIN 6885-1, form B; their sections stand in ``geometry.keyway``."""

from dataclasses import dataclass

from mechwright.contracts.bought import Bought
from mechwright.contracts.shape import Prism, Shape
from mechwright.geometry.keyway import KeySize, key_of_width

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


@dataclass(frozen=True)
class Key:
    """A key with square ends, its length along z, on the shaft's side towards +x; mm."""

    size: KeySize
    length: float

    def bought(self, shaft: float) -> Bought:
        """How it is ordered; its solid stands on z = 0 in the seat of a shaft of this diameter, mm."""
        low = shaft / 2 - self.size.shaft_depth
        high, half, c = low + self.size.height, self.size.width / 2, self.size.chamfer
        section = (
            (low + c, -half), (high - c, -half), (high, c - half), (high, half - c), (high - c, half),
            (low + c, half), (low, half - c), (low, c - half),
        )  # fmt: skip
        words = f"DIN 6885 - B {self.size.width:g} x {self.size.height:g} x {self.length:g}"
        return Bought(words, "DIN 6885-1", None, Shape((Prism(section, 0.0, self.length),)))


def key(width: float, length: float) -> Key | None:
    """The key of exactly this width and length, mm; None if none is sold.

    >>> key(4, 10).bought(12).designation, key(4, 11), key(4.2, 10)
    ('DIN 6885 - B 4 x 4 x 10', None, None)
    """
    size = key_of_width(width)
    least, most = RANGES.get(round(width), (0, 0))
    if size is None or length not in LENGTHS or not least <= length <= most:
        return None
    return Key(size, length)
