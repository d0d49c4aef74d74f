"""A program that probes, of no control yet."""

from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True)
class Touch:
    """One move along one axis, work coordinates, mm."""

    axis: Literal["X", "Y", "Z"]
    to: float
    kind: Literal["rapid", "guarded", "touch"] = "rapid"
    value: float = 0.0
    """What the axis is set to where the ball meets the stock."""
    upward: bool = False
    """Whether a touch goes towards greater values."""


@dataclass(frozen=True)
class Touches:
    """The moves in order; the first two are made at the machine's upper end."""

    name: str
    offset: str
    tool: int
    first: tuple[float, float]
    high: float
    steps: tuple[Touch, ...]
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class ToolTouches:
    """Tools that are measured on a setter, one after the other.

    Parameters
    ----------
    name
        Stem of the program's file.
    offsets
        The work offsets of the job; lengths are from the Z0 of the first.
    tools
        T number and name of each.
    place
        Machine X and Y of the setter's middle, mm.
    over
        Height of its top in the work offset, mm.
    start, travel
        Machine Z before each touch, None for the upper end, and how far down it goes at most, mm.
    fast, slow
        Feeds of the two touches, mm/min.
    """

    name: str
    offsets: tuple[str, ...]
    tools: tuple[tuple[int, str], ...]
    place: tuple[float, float]
    over: float
    start: float | None
    travel: float
    fast: float
    slow: float
