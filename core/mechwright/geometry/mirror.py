"""Loops turned over, as a plate is on the table of a mill."""

import math
from typing import Literal

from mechwright.geometry.outline import Loop
from mechwright.geometry.segments import Arc, BSpline, Line, Point, Segment


def turned_point(point: Point, about: Literal["x", "y"]) -> Point:
    """A point of a plate that has been turned over about the X or the Y axis, seen from above.

    >>> turned_point((3.0, 4.0), "x"), turned_point((3.0, 4.0), "y")
    ((3.0, -4.0), (-3.0, 4.0))
    """
    x, y = point
    return (x, -y) if about == "x" else (-x, y)


def turned_segment(segment: Segment, about: Literal["x", "y"]) -> Segment:
    """A segment of a plate that has been turned over, seen from above, from its old start to its old end."""
    match segment:
        case Line():
            return Line(turned_point(segment.start, about), turned_point(segment.end, about), segment.tag)
        case Arc():
            # The mirror image of an angle: -a about X, pi - a about Y; it is run the other way.
            start = -segment.start_angle if about == "x" else math.pi - segment.start_angle
            centre = turned_point(segment.centre, about)
            return Arc(centre, segment.radius, start, -segment.sweep, segment.tag)
        case BSpline():
            net = tuple(turned_point(point, about) for point in segment.points)
            return BSpline(segment.degree, segment.knots, net, segment.tag)


def turned_over(loop: Loop, about: Literal["x", "y"]) -> Loop:
    """A loop of a plate that has been turned over, seen from above; it runs the way round that it did.

    Examples
    --------
    >>> from mechwright.geometry import Loop
    >>> loop = Loop.polygon([(0, 0), (4, 0), (0, 3)])
    >>> over = turned_over(loop, "x")
    >>> over.area == loop.area, min(y for _, y in over.flatten().tolist())
    (True, -3.0)
    """
    return Loop(tuple(turned_segment(segment, about) for segment in loop.segments)).reversed()
