"""Random plates for tests of cutter compensation: polygons with round and sharp corners, both ways."""

import math

import numpy as np
from hypothesis import strategies as st

from mechwright.geometry import Arc, Line, Loop


def filleted(points: list[tuple[float, float]], radii: list[float]) -> Loop:
    """A polygon, counter-clockwise, whose corners are rounded; radius 0 leaves one sharp.

    A radius is made as small as the sides beside the corner ask.
    """
    n = len(points)
    at = np.array(points)
    segments: list[Line | Arc] = []
    first = last = None
    for i in range(n):
        back, ahead = at[i - 1] - at[i], at[(i + 1) % n] - at[i]
        a, b = np.linalg.norm(back), np.linalg.norm(ahead)
        back, ahead = back / a, ahead / b
        half = math.acos(float(np.clip(back @ ahead, -1, 1))) / 2
        cut = min(radii[i] / math.tan(half), 0.45 * a, 0.45 * b)
        radius = cut * math.tan(half)
        if radius < 0.05 or abs(half - math.pi / 2) < 0.02:
            start = end = tuple(at[i].tolist())
            corner = None
        else:
            start, end = tuple((at[i] + cut * back).tolist()), tuple((at[i] + cut * ahead).tolist())
            middle = (back + ahead) / np.linalg.norm(back + ahead)
            centre = at[i] + middle * radius / math.sin(half)
            one = math.atan2(start[1] - centre[1], start[0] - centre[0])
            two = math.atan2(end[1] - centre[1], end[0] - centre[0])
            sweep = (two - one + math.pi) % math.tau - math.pi
            corner = Arc(tuple(centre.tolist()), radius, one, sweep)
            start, end = corner.start, corner.end
        if last is not None:
            segments.append(Line(last, start))
        else:
            first = start
        if corner is not None:
            segments.append(corner)
        last = end
    segments.append(Line(last, first))
    return Loop(tuple(segments))


@st.composite
def plates(draw: st.DrawFn) -> Loop:
    """A star-shaped polygon of 4 to 9 corners with radii of 0 to 8 mm, about 50 mm wide."""
    n = draw(st.integers(4, 9))
    tilt = draw(st.floats(0, 1))
    points, radii = [], []
    for i in range(n):
        angle = (i + tilt + draw(st.floats(-0.25, 0.25))) * math.tau / n
        reach = draw(st.floats(12, 30))
        points.append((reach * math.cos(angle), reach * math.sin(angle)))
        radii.append(draw(st.sampled_from([0.0, 0.5, 1.2, 2.0, 3.0, 3.1, 5.0, 8.0])))
    return filleted(points, radii)
