"""Fit a polyline with lines and arcs, as few as :mod:`mechwright_plane.runs` finds."""

import itertools
import math
from collections.abc import Sequence

import numpy as np

from mechwright.arrays import Array
from mechwright.geometry.segments import Point
from mechwright_plane.path import Cut, Path, arc, line, printed
from mechwright_plane.runs import over_chord, prepared_polylines, runs_of

LAST_DIGIT = 1e-4
"""A vertex this near to the line past it is one of rounding, mm: no bend of the path."""


def fit(points: Array, tolerance: float, lines_per_arc: int = 1) -> Path:
    """Give the path of lines and arcs that passes within ``tolerance`` of a polyline (n, 2), mm.

    So near are all vertices, and middles of edges, to their lines and arcs. An arc is taken where it stands
    for at least ``lines_per_arc`` lines; 1 gives the fewest moves. Corners are kept. The path leads from the
    first point to the last, both rounded as programs print them.
    """
    return fit_all([points], tolerance, lines_per_arc)[0]


def fit_all(polylines: Sequence[Array], tolerance: float, lines_per_arc: int = 1) -> list[Path]:
    """Fit several polylines in one go; see :func:`fit`."""
    if not polylines:
        return []
    way = prepared_polylines(polylines, tolerance)
    runs = runs_of(way, tolerance, lines_per_arc)
    places = np.column_stack([axis[runs.nodes] for axis in way.points])
    straight, height = runs.straight.tolist(), runs.height.tolist()
    return [
        _assemble(places[first:last], straight[first : last - 1], height[first : last - 1])
        for first, last in itertools.pairwise(np.searchsorted(runs.nodes, way.bounds).tolist())
    ]


def _assemble(points: Array, straight: list[bool], height: list[float]) -> Path:
    """The path through the chosen vertices."""
    ends = [printed(place) for place in points.tolist()]
    cuts: list[Cut] = []
    here = ends[0]
    line_from: Point | None = None
    passed: list[Point] = []  # what the present line has left out since then
    for is_line, k, end in zip(straight, height, ends[1:], strict=True):
        if end == here:
            continue
        if is_line:
            if line_from is not None and _straight_on(line_from, [*passed, here], end):
                passed.append(here)
                here = line_from
                cuts.pop()
            else:
                line_from, passed = here, []
            cuts.append(line(here, end))
        else:
            # Less than half a circle: with the centre on the left it turns to the left.
            cuts.append(arc(here, end, over_chord(here, end, k), 1 if k > 0 else -1))
            line_from = None
        here = end
    return Path(ends[0], tuple(cuts))


def _straight_on(first: Point, passed: Sequence[Point], last: Point) -> bool:
    """Whether one line serves: what it passes stands off by rounding only, and it never turns back."""
    dx, dy = last[0] - first[0], last[1] - first[1]
    length, before = math.hypot(dx, dy), 0.0
    for x, y in ((x - first[0], y - first[1]) for x, y in passed):
        along = x * dx + y * dy
        if along < before or abs(x * dy - y * dx) > LAST_DIGIT * length:
            return False
        before = along
    return 0 < before <= length * length
