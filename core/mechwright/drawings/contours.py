"""Contours: closed loops that do not cross themselves, and circles that were drawn otherwise."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from mechwright.drawings.chains import loops
from mechwright.drawings.doubles import single
from mechwright.drawings.fault import Told, at
from mechwright.drawings.strokes import Stroke, fitted_circle
from mechwright.geometry import Arc, Line, Loop, circle
from mechwright.geometry.segments import Point
from mechwright.tolerances import TOLERANCES

SPECK = 0.05
"""Contours smaller than this, mm, are dust of the export: no cutter is."""
ROUNDED = 4
"""Decimals of a circle that is fitted: what drawings hold."""


@dataclass(frozen=True)
class Contour:
    """A closed loop, counter-clockwise, with the stroke that messages name it by."""

    loop: Loop
    stroke: Stroke

    @property
    def circle(self) -> Arc | None:
        """Its circle, if it is one."""
        arc = self.loop.segments[0]
        return arc if self.loop.is_circle and isinstance(arc, Arc) else None

    @property
    def name(self) -> str:
        """How messages name it."""
        return f"{self.stroke.name} at {at(self.place)}"

    @property
    def place(self) -> Point:
        """The centre of a circle, or where the loop begins."""
        return self.circle.centre if self.circle is not None else self.loop.segments[0].start

    @property
    def shape(self) -> shapely.Polygon:
        """What it surrounds."""
        return shapely.Polygon(self.loop.flatten())


def contours(strokes: Sequence[Stroke], join: float, told: Told) -> list[Contour]:
    """The contours that strokes of one meaning make."""
    pieces = single([(segment, stroke) for stroke in strokes for segment in stroke.segments], told)
    found = []
    for loop, stroke in loops(pieces, join, told):
        x0, y0, x1, y1 = loop.bounds
        if max(x1 - x0, y1 - y0) < SPECK:
            place = at(loop.segments[0].start)
            told.note(f"{stroke.name} at {place} is a speck of less than {SPECK:g} mm; left out")
            continue
        shape = shapely.Polygon(loop.flatten())
        if not shape.is_valid:
            reason = shapely.is_valid_reason(shape)
            where = reason.partition("[")[2].rstrip("]").split()
            place = at((float(where[0]), float(where[1]))) if len(where) == 2 else at(loop.segments[0].start)
            told.fault(
                "contour",
                f"the contour of {stroke.name} crosses itself at {place}",
                "draw it as one simple loop",
            )
            continue
        made = rounded(loop)
        found.append(Contour(made if made.area > 0 else made.reversed(), stroke))
    return found


def rounded(loop: Loop, chords: float = 0.0) -> Loop:
    """The loop as one circle if it is one; with ``chords``, mm, corners that stand so near to one will do.

    >>> half = Arc((1.0, 2.0), 3.0, 0.0, math.pi)
    >>> rounded(Loop((half, Arc((1.0, 2.0), 3.0, math.pi, math.pi)))).is_circle
    True
    """
    first = loop.segments[0]
    if loop.is_circle and isinstance(first, Arc):
        turn = math.copysign(1, first.sweep)
        return Loop((circle(first.centre, first.radius, clockwise=turn < 0, tag=first.tag),))
    if not chords and all(isinstance(segment, Line) for segment in loop.segments):
        return loop
    points = (
        np.array([segment.start for segment in loop.segments])
        if chords
        else np.concatenate([segment.at(np.linspace(0, 1, 9)) for segment in loop.segments])
    )
    if len(points) < 6:
        return loop
    fitted = fitted_circle(points)
    if fitted is None or fitted[2] > (chords or TOLERANCES.outline):
        return loop
    (x, y), radius, _ = fitted
    # A bean whose points lie on a circle has less area than the circle.
    if abs(abs(loop.area) - math.pi * radius**2) > (0.2 if chords else 0.01) * math.pi * radius**2:
        return loop
    centre = round(x, ROUNDED), round(y, ROUNDED)
    return Loop((circle(centre, round(2 * radius, ROUNDED) / 2, clockwise=loop.area < 0),))
