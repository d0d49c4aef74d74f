"""Stretches of segments: a segment between two parameters, and what of a loop lies inside a region."""

from dataclasses import replace
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from mechwright.arrays import Array
from mechwright.errors import GeometryError
from mechwright.geometry.outline import Loop
from mechwright.geometry.segments import Arc, BSpline, Line, Segment
from mechwright.tolerances import TOLERANCES

if TYPE_CHECKING:
    import shapely

SPAN_SAMPLES = 65
"""Points of each smooth piece between which a crossing is looked for: shorter stretches are not seen."""
HALVINGS = 40
"""Bisections of a crossing: to rounding."""


def trimmed(segment: Segment, first: float, last: float) -> Segment:
    """The stretch of a segment between two parameters, 0 <= first < last <= 1; the same curve exactly.

    Examples
    --------
    >>> trimmed(Line((0.0, 0.0), (8.0, 4.0)), 0.25, 0.5)
    Line(start=(2.0, 1.0), end=(4.0, 2.0), tag='')
    >>> parabola = BSpline.bezier([(0, 0), (1, 2), (2, 0)])
    >>> trimmed(parabola, 0.0, 0.5).points
    ((0.0, 0.0), (0.5, 1.0), (1.0, 1.0))
    """
    if not 0 <= first < last <= 1:
        raise GeometryError(f"a stretch runs from 0 <= first < last <= 1, not from {first} to {last}")
    match segment:
        case Line():
            (x0, y0), (x1, y1) = segment.at([first, last]).tolist()
            return replace(segment, start=(x0, y0), end=(x1, y1))
        case Arc():
            return replace(
                segment,
                start_angle=segment.start_angle + segment.sweep * first,
                sweep=segment.sweep * (last - first),
            )
        case BSpline():
            return _part_of_spline(segment, first, last)


def _part_of_spline(spline: BSpline, first: float, last: float) -> BSpline:
    """By knot insertion (W. Boehm) until both ends are points of the net."""
    degree = spline.degree
    knots, net = np.asarray(spline.knots, dtype=float), np.asarray(spline.points, dtype=float)
    for value in (first, last):
        for _ in range(degree - int(np.sum(knots == value))):
            knots, net = _inserted(degree, knots, net, value)
    begin = 0 if first == 0 else int(np.searchsorted(knots, first, side="left")) - 1
    end = len(net) - 1 if last == 1 else int(np.searchsorted(knots, last, side="left")) - 1
    inner = knots[(knots > first) & (knots < last)]
    scaled = (inner - first) / (last - first)
    clamped = (*(0.0,) * (degree + 1), *scaled.tolist(), *(1.0,) * (degree + 1))
    points = tuple((float(x), float(y)) for x, y in net[begin : end + 1])
    return BSpline(degree, clamped, points, spline.tag)


def _inserted(degree: int, knots: Array, net: Array, value: float) -> tuple[Array, Array]:
    """One more knot, the same curve."""
    span = int(np.searchsorted(knots, value, side="right")) - 1
    rows = np.arange(span - degree + 1, span + 1)
    low, high = knots[rows], knots[rows + degree]
    share = ((value - low) / (high - low))[:, None]
    new = (1 - share) * net[rows - 1] + share * net[rows]
    points = np.concatenate((net[: span - degree + 1], new, net[span:]))
    return np.insert(knots, span + 1, value), points


def stretches(loop: Loop, region: "shapely.Geometry", *, outside: bool = False) -> list[Segment]:
    """The stretches of a loop that run inside a region or along its edge, in order; or those ``outside``.

    A segment that lies there as a whole comes as it is.
    """
    import shapely

    grown = shapely.buffer(region, 2 * TOLERANCES.flatten)
    shapely.prepare(grown)

    def inside(points: Array) -> Array:
        found: Array = shapely.contains_xy(grown, points[:, 0], points[:, 1])
        return np.not_equal(found, outside)

    found: list[Segment] = []
    for segment in loop.segments:
        breaks = segment.breaks()
        t = np.unique(np.concatenate([np.linspace(a, b, SPAN_SAMPLES) for a, b in pairwise(breaks)]))
        within = inside(segment.at(t))
        if within.all():
            found.append(segment)
            continue
        change = np.flatnonzero(within[:-1] != within[1:])
        low, high = t[change].copy(), t[change + 1].copy()
        for _ in range(HALVINGS):
            middle = (low + high) / 2
            same = inside(segment.at(middle)) == within[change] if middle.size else middle
            low, high = np.where(same, middle, low), np.where(same, high, middle)
        edges = np.concatenate(([0.0], (low + high) / 2, [1.0]))
        state = bool(within[0])
        for a, b in pairwise(edges.tolist()):
            if state and b - a > 1e-9:
                found.append(trimmed(segment, a, b))
            state = not state
    return found
