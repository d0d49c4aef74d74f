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
GREATEST_RADIUS = 2000.0
"""A flatter arc, mm, is printed with too few significant digits; it becomes lines."""

Index = NDArray[np.intp]


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
    nodes, across, height = _verified(points, _chain(_reach(points, ends, tolerance)), tolerance)
    at = np.searchsorted(nodes, bounds)
    return [
        _assemble(
            points[nodes[first:last]],
            (across[first : last - 1] <= tolerance).tolist(),
            height[first : last - 1].tolist(),
        )
        for first, last in itertools.pairwise(at)
    ]


def spans(points: Array, tolerance: float, corner: float) -> tuple[Array, Index, NDArray[np.bool_], Array]:
    """The runs of one polyline that a line or an arc each can follow.

    Parameters
    ----------
    points, tolerance
        As for :func:`fit`.
    corner
        A turn of more than this at one vertex, rad, ends a run.

    Returns
    -------
    points
        (n, 2), those that are distinct.
    nodes
        (k + 1,) index of the ends of the runs.
    straight
        (k,) whether a line will do.
    height
        (k,) of the centre over the chord, to the left of it, mm.
    """
    points = _distinct(np.asarray(points, dtype=float))
    ends = np.zeros(len(points), dtype=bool)
    ends[[0, -1]] = True
    nodes, across, height = _verified(points, _chain(_reach(points, ends, tolerance, corner)), tolerance)
    return points, nodes, across <= tolerance, height


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


def _verified(points: Array, nodes: Index, tolerance: float) -> tuple[Index, Array, Array]:
    """Halve the runs that do not stay within the tolerance at every vertex and middle of an edge.

    Gives the nodes, and for each run its largest distance from a line and the height of its arc's centre.
    """
    while True:
        first, last = nodes[:-1], nodes[1:]
        # Vertices and middles of edges, by their position in half edges; the last one fills the row up.
        count = 2 * int((last - first).max(initial=1)) - 1
        offset = np.arange(1, count + 1)
        most = 2 * (last - first)[:, None] - 1
        here = 2 * first[:, None] + np.minimum(offset, most)
        inner = (points[here // 2] + points[(here + 1) // 2]) / 2
        across, deviation, height = _deviations(points[first], points[last], inner, offset <= most)
        across = np.where(last - first > 1, across, 0.0)
        bad = np.flatnonzero((across > tolerance) & (deviation > tolerance))
        if not bad.size:
            return nodes, across, height
        nodes = np.sort(np.concatenate((nodes, (first[bad] + last[bad]) // 2)))


def _reach(points: Array, ends: NDArray[np.bool_], tolerance: float, sharp: float = CORNER) -> Index:
    """The farthest vertex that one line or arc from each vertex can reach; none goes beyond an end."""
    n = len(points)
    if n < 3:
        return np.minimum(np.arange(n) + 1, n - 1)
    edge = np.diff(points, axis=0)
    step = np.hypot(edge[:, 0], edge[:, 1])
    heading = np.arctan2(edge[:, 1], edge[:, 0])
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
    corner = np.concatenate(([False], np.abs(turn) > sharp, [True]))
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


def _fits(points: Array, first: Index, last: Index, tolerance: float) -> NDArray[np.bool_]:
    """Whether a line or an arc from ``first`` to ``last`` (k,) stays within the tolerance at its samples."""
    fraction = np.linspace(0, 1, SAMPLES + 2)[1:-1]
    inner = points[first[:, None] + np.rint((last - first)[:, None] * fraction).astype(np.intp)]
    across, deviation, _ = _deviations(points[first], points[last], inner)
    good: NDArray[np.bool_] = (across <= tolerance) | (deviation <= tolerance)
    return good | (last - first <= 1)


def _deviations(
    start: Array, end: Array, inner: Array, weight: NDArray[np.bool_] | float = 1.0
) -> tuple[Array, Array, Array]:
    """Largest distance of ``inner`` (k, m, 2) from the lines and from the best arcs, and their heights."""
    half = (end - start) / 2
    h = np.hypot(half[:, 0], half[:, 1])
    h_safe = np.where(h > 0, h, 1.0)
    along = half / h_safe[:, None]
    rel = inner - (start + half)[:, None, :]
    u = rel[..., 0] * along[:, None, 0] + rel[..., 1] * along[:, None, 1]
    v = rel[..., 1] * along[:, None, 0] - rel[..., 0] * along[:, None, 1]
    across = np.abs(v).max(axis=1)
    square = (weight * v * v).sum(axis=1)
    power = u * u + v * v - (h * h)[:, None]
    k = (weight * v * power).sum(axis=1) / np.where(square > 0, 2 * square, 1.0)
    radius = np.hypot(h, k)
    deviation = np.abs(np.hypot(u, v - k[:, None]) - radius[:, None]).max(axis=1)
    bad = (square <= 0) | (radius > GREATEST_RADIUS) | (h <= 0) | ~np.isfinite(deviation)
    return np.where(h > 0, across, np.inf), np.where(bad, np.inf, deviation), k


def _assemble(points: Array, straight: list[bool], height: list[float]) -> Path:
    """The path through the chosen vertices."""
    ends = [(rounded(x), rounded(y)) for x, y in points.tolist()]
    cuts: list[Cut] = []
    here = ends[0]
    for is_line, k, end in zip(straight, height, ends[1:], strict=True):
        if end == here:
            continue
        if is_line:
            cuts.append(line(here, end))
        else:
            dx, dy = end[0] - here[0], end[1] - here[1]
            chord = math.hypot(dx, dy)
            centre = ((here[0] + end[0]) / 2 - k * dy / chord, (here[1] + end[1]) / 2 + k * dx / chord)
            # Less than half a circle: with the centre on the left it turns to the left.
            cuts.append(arc(here, end, centre, 1 if k > 0 else -1))
        here = end
    return Path(ends[0], tuple(cuts))
