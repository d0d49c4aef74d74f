"""What is on a sheet, in mm of the paper: strokes, filled areas, texts, and dimensions made of them."""

import math
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Literal

from mechwright.geometry.segments import Point

Layer = Literal["OUTLINE", "HIDDEN", "DIM", "CENTRE", "HATCH", "TEXT", "FRAME"]

THICK, THIN = 0.5, 0.25
"""Widths of lines, mm (ISO 128: one group)."""

WIDTH: dict[Layer, float] = {
    "OUTLINE": THICK,
    "HIDDEN": THIN,
    "DIM": THIN,
    "CENTRE": THIN,
    "HATCH": THIN,
    "TEXT": THIN,
    "FRAME": THICK,
}

DASHES: dict[Layer, tuple[float, ...]] = {"CENTRE": (6.0, 1.5, 0.5, 1.5), "HIDDEN": (2.0, 1.0)}
"""Dash, gap and so on of lines that are not full, mm: centre lines, hidden edges."""

HEIGHT = 3.5
"""Of letters, mm (ISO 3098)."""

ARROW = (3.0, 1.0)
"""Length and width of an arrow, mm."""

_WIDTHS = {
    **dict.fromkeys("0123456789?$#_abdeghnopquL", 556),
    **dict.fromkeys(" !,./:;I[]ft\\", 278),
    **dict.fromkeys("()-r`", 333),
    **dict.fromkeys("+<=>~±×", 584),
    **dict.fromkeys("ABEKPSVXY&", 667),
    **dict.fromkeys("CDHNRUw", 722),
    **dict.fromkeys("FTZ", 611),
    **dict.fromkeys("GOQ⌀", 778),
    **dict.fromkeys("Jckszvxy", 500),
    **dict.fromkeys("ijl", 222),
    **dict.fromkeys("Mm", 833),
    "W": 944,
    "%": 889,
    "@": 1015,
    "*": 389,
    '"': 355,
    "'": 191,
    "°": 400,
    "|": 260,
    "^": 469,
}
"""Advance of letters of Helvetica in thousandths of their size (its public font metrics)."""

_CAP = 0.718
"""Height of capitals of Helvetica in its size."""

SIZE = 1 / _CAP
"""Size of the font whose capitals are one high."""

Align = Literal["left", "middle"]


@dataclass(frozen=True)
class Stroke:
    """A line through points."""

    points: tuple[Point, ...]
    layer: Layer = "OUTLINE"


@dataclass(frozen=True)
class Fill:
    """A filled polygon."""

    points: tuple[Point, ...]
    layer: Layer = "DIM"


@dataclass(frozen=True)
class Text:
    """A line of text whose foot begins at a place, or has its middle there."""

    at: Point
    text: str
    layer: Layer = "TEXT"
    height: float = HEIGHT
    align: Align = "left"

    @property
    def left(self) -> Point:
        """Where its foot begins."""
        shift = 0.0 if self.align == "left" else width_of(self.text, self.height) / 2
        return self.at[0] - shift, self.at[1]


@dataclass(frozen=True)
class Dimension:
    """A measured distance between two points, along the ``direction`` of x or y, and how it is drawn."""

    first: Point
    second: Point
    line: Point
    direction: Literal["x", "y"]
    text: Text
    strokes: tuple[Stroke, ...]
    fills: tuple[Fill, ...]

    @property
    def pieces(self) -> "tuple[Stroke | Fill | Text, ...]":
        """All that is drawn of it."""
        return (*self.strokes, *self.fills, self.text)


Item = Stroke | Fill | Text | Dimension


@dataclass
class Sheet:
    """A sheet of paper: its size, the scale of its views, and what is on it."""

    width: float
    height: float
    scale: float
    items: list[Item] = field(default_factory=list)

    def add(self, *items: Item) -> None:
        """Draw something."""
        self.items += items

    def lines(self, points: Iterable[Point], layer: Layer = "OUTLINE") -> None:
        """Draw a line through points."""
        self.add(Stroke(tuple(points), layer))


def width_of(text: str, height: float = HEIGHT) -> float:
    """Width of a line of text, mm.

    >>> round(width_of("100"), 2)
    8.13
    """
    return sum(_WIDTHS.get(letter, 556) for letter in text) / 1000 * height * SIZE


def arrow(tip: Point, towards: Point) -> Fill:
    """An arrow's head at ``tip`` that points away from ``towards``."""
    length, width = ARROW
    x, y = tip
    if towards[0] != x and towards[1] != y:
        far = math.dist(tip, towards)
        u, v = (towards[0] - x) / far, (towards[1] - y) / far
        foot, out = (x + length * u, y + length * v), (-v * width / 2, u * width / 2)
        return Fill(((x, y), (foot[0] + out[0], foot[1] + out[1]), (foot[0] - out[0], foot[1] - out[1])))
    if towards[1] == y:
        back = x + (length if towards[0] > x else -length)
        return Fill(((x, y), (back, y + width / 2), (back, y - width / 2)))
    back = y + (length if towards[1] > y else -length)
    return Fill(((x, y), (x + width / 2, back), (x - width / 2, back)))
