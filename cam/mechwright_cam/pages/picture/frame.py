"""The region of a picture, and sizes that follow from it."""

from dataclasses import dataclass

from mechwright.designs.inches import FACTORS, Units
from mechwright.output import svg
from mechwright_cam.setup.job import Job

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
    units: Units = "mm"
    """Of the dimensions."""

    def words(self, value: float, digits: int) -> str:
        """A dimension, mm, in those units."""
        if self.units == "inch":
            return f"{value / FACTORS['mm']:.{digits + 2}f}"
        return f"{value:.{digits}f}"

    @property
    def letters(self) -> float:
        """Height of letters, mm."""
        return LETTERS * max(self.x1 - self.x0, self.y1 - self.y0)


def outline_data(job: Job) -> str:
    """Path data of what a job makes."""
    placed = [outline.moved(-job.origin[0], -job.origin[1]) for outline in job.part.outlines]
    return "".join(svg.path(loop.flatten(DETAIL), close=True) for one in placed for loop in one.loops)
