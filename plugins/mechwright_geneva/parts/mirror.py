"""Segments seen in a mirror."""

import cmath
from dataclasses import replace

from mechwright import Arc, BSpline, Line, Point, Segment


def mirrored(segment: Segment, angle: float) -> Segment:
    """A segment reflected in the line through the origin at ``angle``, rad, and run the other way.

    >>> mirrored(Line((1.0, 1.0), (2.0, 3.0)), 0.0)
    Line(start=(2.0, -3.0), end=(1.0, -1.0), tag='')
    """
    turn = cmath.exp(2j * angle)

    def image(point: Point) -> Point:
        z = turn * complex(*point).conjugate()
        return z.real, z.imag

    match segment:
        case Line():
            return replace(segment, start=image(segment.end), end=image(segment.start))
        case Arc():
            end = 2 * angle - segment.start_angle - segment.sweep
            return replace(segment, centre=image(segment.centre), start_angle=end)
        case BSpline():
            knots = tuple(1 - knot for knot in segment.knots[::-1])
            return replace(segment, knots=knots, points=tuple(map(image, segment.points[::-1])))
    raise TypeError(f"a segment of type {type(segment).__name__} has no mirror image")
