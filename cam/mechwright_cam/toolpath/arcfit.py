"""Fit a polyline with lines and arcs.

Every vertex looks for the farthest vertex that one line or one arc can reach within the tolerance. All of
them look at once, by bisection, with a few samples per trial; then the chain of longest reaches is followed
from the start, and only the arcs that it uses are tested everywhere. The arc through both ends of a run has
one free number, the height k of its centre over the chord; with u along and v across the chord of half length
h, the circle is u² + v² - 2kv = h², so the least-squares k is Σ v(u² + v² - h²) / (2 Σ v²).
"""

import itertools
import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from mechwright.geometry.segments import Point
from mechwright.motion import Array
from mechwright_cam.toolpath.path import Cut, Path, arc, line, rounded

CORNER = 0.5
"""A turn of more than this at one vertex, rad, is a corner of the path; offset arcs turn by less."""
LONGEST_TURN = 3.0
"""An arc turns by less than half a circle, rad: then both its ends and its side fix it."""
LONGEST_RUN = 250
"""Edges under one arc at most: bounds the search; a longer arc comes in two pieces."""
NEAR = 1e-6
"""Vertices nearer than this are one, mm."""
SAMPLES = 12
"""Vertices tested per trial; those of the chosen arcs are all tested afterwards."""
FRACTIONS = np.linspace(0, 1, SAMPLES + 2)[1:-1, None]
"""Where they stand between both ends."""
GREATEST_RADIUS = 2000.0
"""A flatter arc, mm, is printed with too few significant digits; it becomes lines."""
LAST_DIGIT = 1e-4
"""A vertex this near to the line past it is one of rounding, mm: no bend of the path."""

Index = NDArray[np.intp]
Axes = tuple[Array, ...]
"""x and y apart: rows are taken from them much faster than from pairs."""


def fit(points: Array, tolerance: float) -> Path:
    """Give the path of lines and arcs that passes within ``tolerance`` of a polyline.

    Parameters
    ----------
    points
        (n, 2), mm; a closed polyline repeats its first point.
    tolerance
        Largest distance of a vertex or of the middle of an edge from its line or arc, mm.

    Returns
    -------
    path
        From the first point to the last, both rounded as programs print them. Corners are kept.
    """
    return fit_all([points], tolerance)[0]


def fit_all(polylines: Sequence[Array], tolerance: float) -> list[Path]:
    """Fit several polylines in one go; see :func:`fit`."""
    if not polylines:
        return []
    parts = [_distinct(np.asarray(points, dtype=float)) for points in polylines]
    points = np.concatenate(parts)
    bounds = np.cumsum([0, *(len(part) for part in parts)])
    ends = np.zeros(len(points), dtype=bool)
    ends[bounds[:-1]] = ends[bounds[1:] - 1] = True
    axes = points[:, 0].copy(), points[:, 1].copy()
    nodes, straight, height = _verified(axes, _chain(_reach(axes, ends, tolerance)), tolerance)
    at = np.searchsorted(nodes, bounds)
    return [
        _assemble(
            points[nodes[first:last]],
            straight[first : last - 1].tolist(),
            height[first : last - 1].tolist(),
        )
        for first, last in itertools.pairwise(at)
    ]


def _distinct(points: Array) -> Array:
    step = np.diff(points, axis=0)
    distinct: Array = points[np.append(True, np.hypot(step[:, 0], step[:, 1]) > NEAR)]
    return distinct


def _chain(reach: Index) -> Index:
    """The vertices met by going as far as possible each time."""
    far = reach.tolist()
    nodes = [0]
    while nodes[-1] < len(far) - 1:
        nodes.append(far[nodes[-1]])
    return np.array(nodes, dtype=np.intp)


def _verified(points: Axes, nodes: Index, tolerance: float) -> tuple[Index, NDArray[np.bool_], Array]:
    """Halve the runs that do not stay within the tolerance at every vertex and middle of an edge.

    Gives the nodes, and for each run whether it is a line and the height of its arc's centre.
    """
    while True:
        first, last = nodes[:-1], nodes[1:]
        # Vertices and middles of edges, by their position in half edges; the last one fills the column up.
        count = 2 * int((last - first).max(initial=1)) - 1
        offset = np.arange(1, count + 1)[:, None]
        most = 2 * (last - first) - 1
        here = 2 * first + np.minimum(offset, most)
        one, two = here // 2, (here + 1) // 2
        inner = tuple((axis.take(one) + axis.take(two)) / 2 for axis in points)
        straight, curved, height = _shapes(points, first, last, inner, tolerance, offset <= most)
        straight |= last - first == 1
        bad = np.flatnonzero(~(straight | curved))
        if not bad.size:
            return nodes, straight, height
        nodes = np.sort(np.concatenate((nodes, (first[bad] + last[bad]) // 2)))


def _reach(points: Axes, ends: NDArray[np.bool_], tolerance: float) -> Index:
    """The farthest vertex that one line or arc from each vertex can reach; none goes beyond an end."""
    n = len(ends)
    if n < 3:
        return np.minimum(np.arange(n) + 1, n - 1)
    dx, dy = (np.diff(axis) for axis in points)
    step = np.hypot(dx, dy)
    heading = np.arctan2(dy, dx)
    turn = (np.diff(heading) + math.pi) % math.tau - math.pi
    total = np.concatenate(([0.0], np.cumsum(np.abs(turn)), [0.0]))
    total[-1] = total[-2]
    index = np.arange(n)
    # Vertex i leaves along edge i, whose accumulated turn is total[i].
    limit = np.searchsorted(total[:-1], total + LONGEST_TURN, side="left")
    # An edge whose ends turn so much that an arc over it would stand off from it is a line of the drawing.
    bend = np.concatenate(([0.0], np.abs(turn), [0.0]))
    bend[ends] = 0.0
    straight = step * np.maximum(bend[:-1], bend[1:]) / 8 > tolerance
    corner = np.concatenate(([False], np.abs(turn) > CORNER, [True]))
    corner[:-1] |= straight
    corner[1:] |= straight
    corner |= ends
    corners = np.flatnonzero(corner)
    stop = corners[np.minimum(np.searchsorted(corners, index, side="right"), len(corners) - 1)]
    high = np.minimum.reduce([index + LONGEST_RUN, limit, stop, np.full(n, n - 1)])
    low = np.minimum(index + 1, n - 1)
    high = np.maximum(high, low)
    good = _fits(points, index, high, tolerance)
    low = np.where(good, high, low)
    open_ = np.flatnonzero(low + 1 < high)
    while open_.size:
        middle = (low[open_] + high[open_]) // 2
        good = _fits(points, open_, middle, tolerance)
        low[open_] = np.where(good, middle, low[open_])
        high[open_] = np.where(good, high[open_], middle)
        open_ = open_[low[open_] + 1 < high[open_]]
    return low


def _fits(points: Axes, first: Index, last: Index, tolerance: float) -> NDArray[np.bool_]:
    """Whether a line or an arc from ``first`` to ``last`` (k,) stays within the tolerance at its samples."""
    at = (first + 0.5 + (last - first) * FRACTIONS).astype(np.intp)
    straight, curved, _ = _shapes(points, first, last, tuple(axis.take(at) for axis in points), tolerance)
    good: NDArray[np.bool_] = straight | curved | (last - first <= 1)
    return good


def _shapes(
    points: Axes,
    first: Index,
    last: Index,
    inner: Axes,
    tolerance: float,
    weight: NDArray[np.bool_] | None = None,
) -> tuple[NDArray[np.bool_], NDArray[np.bool_], Array]:
    """Whether ``inner``, (m, k) each, is near enough to the lines, and to the best arcs, and their heights.

    A point stands off the arc of radius r by at most t if its power r' squared - r squared is between
    t² - 2rt and t² + 2rt: no root is needed.
    """
    (x0, x1), (y0, y1) = ((axis.take(first), axis.take(last)) for axis in points)
    hx, hy = (x1 - x0) / 2, (y1 - y0) / 2
    h = np.hypot(hx, hy)
    scale = 1 / np.where(h > 0, h, 1.0)
    ax, ay = hx * scale, hy * scale
    x, y = inner[0] - (x0 + hx), inner[1] - (y0 + hy)
    v = y * ax
    v -= x * ay
    x *= x
    y *= y
    power = np.add(x, y, out=x)  # of the circle over the chord as its diameter
    power -= h * h
    straight = (np.maximum(v.max(axis=0), -v.min(axis=0)) <= tolerance) & (h > 0)
    of_v = np.multiply(v, v if weight is None else weight * v, out=y)
    total = of_v.sum(axis=0)
    of_v = np.multiply(v, power if weight is None else weight * power, out=y)
    k = of_v.sum(axis=0) / np.where(total > 0, 2 * total, 1.0)
    # Of more than half a turn the centre is on the side of the arc, and it would be written the other way.
    less_than_half = k * v.sum(axis=0) < 0
    radius = np.hypot(h, k)
    v *= 2 * k
    power -= v
    most, least = tolerance * (tolerance + 2 * radius), tolerance * (tolerance - 2 * radius)
    curved = (power.max(axis=0) <= most) & (power.min(axis=0) >= least)
    return straight, curved & less_than_half & (total > 0) & (radius <= GREATEST_RADIUS) & (h > 0), k


def _assemble(points: Array, straight: list[bool], height: list[float]) -> Path:
    """The path through the chosen vertices."""
    ends = [(rounded(x), rounded(y)) for x, y in points.tolist()]
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
            dx, dy = end[0] - here[0], end[1] - here[1]
            chord = math.hypot(dx, dy)
            centre = ((here[0] + end[0]) / 2 - k * dy / chord, (here[1] + end[1]) / 2 + k * dx / chord)
            # Less than half a circle: with the centre on the left it turns to the left.
            cuts.append(arc(here, end, centre, 1 if k > 0 else -1))
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
