"""Words that programs of all controls share."""

import re

from mechwright.geometry.segments import Point
from mechwright_cut.jobs import CutJob
from mechwright_plane.path import DECIMALS, Cut, Path

LONGEST = 58
"""Characters of a comment that every sender lets pass."""


def number(value: float) -> str:
    """A number without a tail of zeros.

    >>> number(-0.00001), number(12.5), number(600)
    ('0', '12.5', '600')
    """
    return f"{round(value, DECIMALS) + 0.0:.{DECIMALS}f}".rstrip("0").rstrip(".")


def at(point: Point) -> str:
    """X and Y."""
    return f"X{number(point[0])} Y{number(point[1])}"


def move(here: Point, cut: Cut) -> str:
    """A line, or an arc with its centre from its start."""
    if not cut.turn:
        return f"G1 {at((cut.x, cut.y))}"
    word = "G3" if cut.turn > 0 else "G2"
    return f"{word} {at((cut.x, cut.y))} I{number(cut.cx - here[0])} J{number(cut.cy - here[1])}"


def moves(path: Path) -> list[str]:
    """All moves of a path."""
    return [move(here, cut) for here, cut, _ in path.walk()]


def comment(text: str) -> str:
    """A comment that every sender lets pass: short, and of plain characters.

    >>> comment("wheel (2): 3 mm × 5")
    '(wheel  2 : 3 mm   5)'
    """
    return f"({re.sub(r'[^A-Za-z0-9 .,:=/+_$-]', ' ', text)[:LONGEST]})"


def title(job: CutJob) -> list[str]:
    """What is cut, of what, with which kerf, and where the zero is."""
    return [
        comment(f"{job.name}: {job.process.words}"),
        comment(f"{job.material} {job.thickness:g} mm, kerf {job.kerf.width:g} mm"),
        comment(f"X0 Y0: lower left corner of the sheet {job.size[0]:g} x {job.size[1]:g}"),
    ]
