"""Signs that show how parts stand to each other when they are put together."""

import math
from dataclasses import dataclass

from mechwright.errors import GeometryError
from mechwright.geometry.segments import Point

DOT = 0.5
"""Radius of the ring that a dot is engraved as, mm."""

_CORNERS = 12
"""Of that ring."""


@dataclass(frozen=True)
class FittingMark:
    """A sign on the top face of a part, and what it tells.

    Parameters
    ----------
    note
        A sentence for whoever puts the part in: which tooth goes into which space, at which position.
    dots
        Places on the top face, mm, in the part's coordinates. Without any the note alone is told.
    joins
        Whether the note is about the part that this one is fixed to: it is told as the part itself is put on.
        Else it is told as the part, or the group that it is fixed to by then, comes to its place.

    Raises
    ------
    GeometryError
        There is no note.
    """

    note: str
    dots: tuple[Point, ...] = ()
    joins: bool = False

    def __post_init__(self) -> None:
        if not self.note.strip():
            raise GeometryError("a fitting mark needs a note that says what it shows")


def rings(mark: FittingMark) -> tuple[tuple[Point, ...], ...]:
    """The dots as closed lines, mm."""
    angles = [math.tau * k / _CORNERS for k in range(_CORNERS + 1)]
    return tuple(
        tuple((round(x + DOT * math.cos(a), 6), round(y + DOT * math.sin(a), 6)) for a in angles)
        for x, y in mark.dots
    )
