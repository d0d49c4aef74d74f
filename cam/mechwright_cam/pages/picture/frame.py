"""The region of a picture, and sizes that follow from it."""

from dataclasses import dataclass

DETAIL = 0.02
"""Chord error of outlines in pictures, mm."""

LETTERS = 0.026
"""Height of letters as a share of the picture's larger side."""


@dataclass(frozen=True)
class Frame:
    """The drawn region, work coordinates, mm, and sizes that follow from it."""

    x0: float
    y0: float
    x1: float
    y1: float

    @property
    def letters(self) -> float:
        """Height of letters, mm."""
        return LETTERS * max(self.x1 - self.x0, self.y1 - self.y0)
