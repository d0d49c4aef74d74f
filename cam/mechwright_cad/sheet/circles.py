"""Circles and arcs as lines of a sheet."""

import math
from collections.abc import Iterator

from mechwright.geometry.segments import Point

_PIECES = 72
"""Straight pieces of a circle's line: 0.01 mm off a circle of 20 mm."""


def ring(centre: Point, radius: float) -> list[Point]:
    """A circle's line."""
    return list(arc(centre, radius, 0.0, math.tau))


def arc(centre: Point, radius: float, start: float, end: float) -> Iterator[Point]:
    """Points of an arc between two angles, rad, both ends included."""
    count = max(1, math.ceil(_PIECES * abs(end - start) / math.tau))
    for k in range(count + 1):
        angle = start + (end - start) * k / count
        yield centre[0] + radius * math.cos(angle), centre[1] + radius * math.sin(angle)
