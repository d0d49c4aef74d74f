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
