"""Strips along a path: what lies within given distances to its left and right, as a loop of exact segments.

Glossary
--------
path
    Segments that follow on each other, from a start to another end.
side
    The path moved sideways, to the left by a positive distance.
"""

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import Literal

import numpy as np

from mechwright.arrays import Array
from mechwright.errors import GeometryError
from mechwright.geometry.fit import fit_curves
from mechwright.geometry.outline import Loop
from mechwright.geometry.segments import Arc, BSpline, Line, Point, Segment
from mechwright.geometry.trim import trimmed
from mechwright.tolerances import TOLERANCES

STEPS = 20
"""Newton steps to the crossing of two neighbours: each doubles the digits, four or five are enough."""
BEND_SAMPLES = 201
"""Points of a spline at which its curvature is looked at."""


def strip(
    path: Sequence[Segment], left: float, right: float, ends: Literal["round", "square"] = "square"
) -> Loop:
    """The strip from ``left`` mm on the left of an open path to ``right`` mm on its right, counter-clockwise.

    Lines and arcs stay lines and arcs; splines are fitted to half a micrometre. Round ``ends`` are half
    circles of half the width about the path's ends, as a cutter on the path leaves them. At a corner of the
    path the outer side is rounded about the corner, the inner one has the corner of its two neighbours.

    Raises
    ------
    GeometryError
        The path does not hang together, closes, bends more sharply than the distances allow, or the strip
        meets itself.

    Examples
    --------
    >>> from mechwright.geometry import Line
    >>> round(strip([Line((0, 0), (10, 0))], 3.0, 3.0, "round").area, 3)  # 10 x 6 and a circle of 6
    88.274
    """
    _check(path, left, right)
    one, two = _side(path, -right), _side(path, left)
    back = [segment.reversed() for segment in reversed(two)]
    if ends == "round":
        segments = [*one, _cap(path[-1], 1.0, left), *back, _cap(path[0].reversed(), 1.0, left)]
    else:
        segments = [*one, Line(one[-1].end, back[0].start), *back, Line(back[-1].end, one[0].start)]
    loop = Loop(tuple(segments))
    import shapely

    polygon = shapely.Polygon(loop.flatten())
    if not polygon.is_valid or loop.area <= 0:
        raise GeometryError(
            f"a strip {left + right:g} mm wide meets itself along its path "
            f"({shapely.is_valid_reason(polygon)}); keep its stretches further apart, or its bends wider"
        )
    return loop


def _check(path: Sequence[Segment], left: float, right: float) -> None:
    if not path:
        raise GeometryError("a path needs at least one segment")
    if not (left >= 0 and right >= 0 and 0 < left + right < math.inf):
        raise GeometryError(f"a strip needs a width above 0 mm, not {left + right:g} mm")
    for before, after in pairwise(path):
        gap = math.dist(before.end, after.start)
        if not gap <= TOLERANCES.closure:
            x, y = before.end
            raise GeometryError(
                f"the path is torn at ({x:.6f}, {y:.6f}): a gap of {gap:.3g} mm, "
                f"the limit is {TOLERANCES.closure:g} mm"
            )
    if math.dist(path[0].start, path[-1].end) <= TOLERANCES.closure:
        raise GeometryError("the path closes; an open one has two ends: use a pocket with an island")


def _tangent(segment: Segment, t: float) -> Array:
    direction = segment.derivative(t)[0]
    tangent: Array = direction / np.hypot(*direction)
    return tangent


def _cap(segment: Segment, t: float, radius: float) -> Arc:
    """Half a circle about the end of a segment, from its right to its left."""
    dx, dy = _tangent(segment, t)
    (x, y) = segment.at(t)[0].tolist()
    return Arc((x, y), radius, math.atan2(dy, dx) - math.pi / 2, math.pi)


def _side(path: Sequence[Segment], distance: float) -> list[Segment]:
    """The path moved to the left, its corners joined."""
    if distance == 0:
        return list(path)
    side = [moved for segment in path[:1] for moved in _moved(segment, distance)]
    for before, after in pairwise(path):
        new = _moved(after, distance)
        one, two = _tangent(before, 1.0), _tangent(after, 0.0)
        turn = math.atan2(one[0] * two[1] - one[1] * two[0], float(one @ two))
        if abs(turn * distance) > TOLERANCES.closure:
            if turn * distance < 0:
                angle = math.atan2(one[1], one[0]) + math.copysign(math.pi / 2, distance)
                side.append(Arc(before.end, abs(distance), angle, turn))
            else:
                side[-1], new[0] = _trimmed_to_each_other(side[-1], new[0], distance)
        side += new
    return side


def _moved(segment: Segment, distance: float) -> list[Segment]:
    """A segment moved to its left."""
    match segment:
        case Line():
            dx, dy = _tangent(segment, 0.0) * distance
            (x0, y0), (x1, y1) = segment.start, segment.end
            return [Line((x0 - dy, y0 + dx), (x1 - dy, y1 + dx), segment.tag)]
        case Arc():
            radius = segment.radius - math.copysign(distance, distance * segment.sweep)
            if radius <= TOLERANCES.outline:
                raise GeometryError(_too_sharp(segment.centre, segment.radius, distance))
            return [Arc(segment.centre, radius, segment.start_angle, segment.sweep, segment.tag)]
        case BSpline():
            _check_bends(segment, distance)

            def curves(t: Array) -> Array:
                rate = segment.derivative(t)
                normal = np.column_stack((-rate[:, 1], rate[:, 0])) / np.hypot(*rate.T)[:, None]
                points: Array = (segment.at(t) + distance * normal)[None]
                return points

            (chain,), _ = fit_curves(curves, 1, TOLERANCES.flatten, segment.tag)
            return list(chain)


def _too_sharp(place: Point, radius: float, distance: float) -> str:
    return (
        f"the path bends with a radius of {radius:.4g} mm about ({place[0]:.3f}, {place[1]:.3f}), too "
        f"sharply for {abs(distance):g} mm to its inner side; bend it wider"
    )


def _check_bends(spline: BSpline, distance: float) -> None:
    """Raise GeometryError if a spline bends more sharply towards the distance than that is long."""
    t = np.linspace(0.0, 1.0, BEND_SAMPLES)
    rate = spline.derivative(t)
    second = np.gradient(rate, t, axis=0)
    speed = np.hypot(*rate.T)
    cross = rate[:, 0] * second[:, 1] - rate[:, 1] * second[:, 0]
    turning = np.sign(distance) * np.inf  # where it stops, at a cusp, it bends either way
    bend = np.divide(cross, speed**3, out=np.full(BEND_SAMPLES, turning), where=speed > TOLERANCES.closure)
    worst = int(np.argmax(bend * distance))
    if bend[worst] * distance >= 1 - TOLERANCES.outline:
        x, y = spline.at(t[worst])[0].tolist()
        raise GeometryError(_too_sharp((x, y), 1 / abs(float(bend[worst])), distance))


def _trimmed_to_each_other(one: Segment, two: Segment, distance: float) -> tuple[Segment, Segment]:
    """Two neighbours on the inner side of a corner, up to where they cross."""
    import shapely

    crossing = shapely.intersection(
        shapely.LineString(one.flatten(TOLERANCES.flatten)),
        shapely.LineString(two.flatten(TOLERANCES.flatten)),
    )
    places = [part.coords[0] for part in shapely.get_parts(crossing) if part.geom_type == "Point"]
    x, y = one.end
    if not places:
        raise GeometryError(
            f"the path turns a corner near ({x:.3f}, {y:.3f}) between segments too short for "
            f"{abs(distance):g} mm to its inner side; make them longer, or round the corner"
        )
    near = min(places, key=lambda place: math.dist(place, (x, y)))
    samples = np.linspace(0.0, 1.0, BEND_SAMPLES)
    t, u = (float(samples[np.argmin(np.hypot(*(s.at(samples) - near).T))]) for s in (one, two))
    for _ in range(STEPS):
        gap = two.at(u)[0] - one.at(t)[0]
        step = np.linalg.solve(np.column_stack((one.derivative(t)[0], -two.derivative(u)[0])), gap)
        t, u = min(max(t + float(step[0]), 0.0), 1.0), min(max(u + float(step[1]), 0.0), 1.0)
    if not (t > 0 and u < 1 and math.dist(one.at(t)[0], two.at(u)[0]) <= TOLERANCES.closure):
        raise GeometryError(f"the sides of the path do not cross at its corner near ({x:.3f}, {y:.3f})")
    return (one if t == 1 else trimmed(one, 0.0, t)), (two if u == 0 else trimmed(two, u, 1.0))
