"""Splines in simpler terms, for drawings whose readers know no splines of any degree.

Glossary
--------
biarc
    Two arcs that join two points with given directions and share a tangent where they meet.
bulge
    Tangent of a quarter of an arc's sweep, positive if counter-clockwise: what DXF polylines hold.
"""

import math
from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright.errors import GeometryError
from mechwright.geometry import Arc, BSpline, Line, Segment

MOST_PIECES = 4096
"""Pieces of one segment at which a fit is given up: no readable drawing has as many."""

CHECK_POINTS = 16
"""Points of each piece that are held against the exact curve."""


@dataclass(frozen=True)
class Vertex:
    """A corner of a polyline, mm, and the bulge of the piece that leaves it."""

    x: float
    y: float
    bulge: float = 0.0


def vertices(segment: Segment, tolerance: float) -> list[Vertex]:
    """A segment as pieces of line and arc, its last point left out.

    Lines and arcs are exact; a spline becomes biarcs within ``tolerance``, mm.
    """
    match segment:
        case Line():
            return [Vertex(*segment.start)]
        case Arc():
            # Half a turn at most per piece: the bulge grows without limit towards a whole one.
            count = math.ceil(abs(segment.sweep) / math.pi - 1e-12)
            bulge = math.tan(segment.sweep / count / 4)
            points = segment.at(np.arange(count) / count)
            points[0] = segment.start
            return [Vertex(x, y, bulge) for x, y in points.tolist()]
        case _:
            return _biarcs(segment, tolerance)


def cubic(spline: BSpline, tolerance: float) -> BSpline:
    """A spline of degree 3 within ``tolerance``, mm, of one of any degree.

    Each piece takes place and derivative of the curve at both ends (cubic Hermite interpolation, error
    proportional to the fourth power of the step), so the result is smooth and neighbours still meet exactly.

    Raises
    ------
    GeometryError
        The tolerance cannot be met.

    Examples
    --------
    >>> quartic = BSpline.bezier([(0, 0), (1, 2), (2, -1), (3, 2), (4, 0)])
    >>> simple = cubic(quartic, 1e-3)
    >>> simple.degree, simple.start, simple.end
    (3, (0.0, 0.0), (4.0, 0.0))
    """
    if spline.degree == 3:
        return spline
    grid = spline.breaks()
    while len(grid) - 1 <= MOST_PIECES:
        fitted = _hermite(spline, grid)
        check = _between(grid)
        if _worst(fitted, spline, check) <= tolerance:
            return fitted
        grid = _halved(grid)
    raise GeometryError(
        f"a {spline.tag or 'spline'} segment cannot be had in degree 3 within {tolerance:g} mm"
    )


def _hermite(spline: BSpline, grid: Array) -> BSpline:
    points, rates = spline.at(grid), spline.derivative(grid)
    points[0], points[-1] = spline.start, spline.end
    third = np.diff(grid)[:, None] / 3
    inner = np.stack([points[:-1] + third * rates[:-1], points[1:] - third * rates[1:]], axis=1).reshape(
        -1, 2
    )
    poles = np.concatenate([points[:1], inner, points[-1:]])
    # Double inner knots: the derivative is continuous, so no pole sits on the curve between pieces.
    knots = np.concatenate([np.zeros(4), np.repeat(grid[1:-1], 2), np.ones(4)])
    return BSpline(3, tuple(knots.tolist()), tuple((x, y) for x, y in poles.tolist()), spline.tag)


def _worst(fitted: BSpline, spline: BSpline, t: Array) -> float:
    """Largest distance at equal parameters, mm: an upper bound of the distance between the curves."""
    return float(np.linalg.norm(fitted.at(t) - spline.at(t), axis=1).max())


def _between(grid: Array) -> Array:
    inner = (np.arange(CHECK_POINTS) + 0.5) / CHECK_POINTS
    between: Array = (grid[:-1, None] + np.diff(grid)[:, None] * inner).ravel()
    return between


def _halved(grid: Array) -> Array:
    return np.sort(np.concatenate([grid, (grid[:-1] + grid[1:]) / 2]))


def _biarcs(segment: Segment, tolerance: float) -> list[Vertex]:
    grid = segment.breaks()
    while len(grid) - 1 <= MOST_PIECES:
        ends, tangents = segment.at(grid), _unit(segment.derivative(grid))
        ends[0], ends[-1] = segment.start, segment.end
        joints, bulges = _biarc(ends, tangents)
        points = segment.at(_between(grid)).reshape(len(grid) - 1, CHECK_POINTS, 2)
        bad = ~(_biarc_distance(points, ends, joints, tangents, bulges).max(axis=1) <= tolerance)
        if not bad.any():
            corners = np.stack([ends[:-1], joints], axis=1).reshape(-1, 2).tolist()
            return [
                Vertex(x, y, bulge) for (x, y), bulge in zip(corners, bulges.ravel().tolist(), strict=True)
            ]
        # Only the pieces that are off are halved, so that few arcs suffice.
        grid = np.sort(np.concatenate([grid, ((grid[:-1] + grid[1:]) / 2)[bad]]))
    raise GeometryError(f"a {segment.tag or 'spline'} segment cannot be had in arcs within {tolerance:g} mm")


def _unit(vectors: Array) -> Array:
    unit: Array = vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)
    return unit


def _cross(a: Array, b: Array) -> Array:
    cross: Array = a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
    return cross


def _dot(a: Array, b: Array) -> Array:
    dot: Array = np.einsum("...i,...i->...", a, b)
    return dot


def _biarc(ends: Array, tangents: Array) -> tuple[Array, Array]:
    """Joints (n, 2) and bulges (n, 2) of the biarcs between n + 1 points with unit tangents.

    With v from start to end and t the sum of the tangents, the control points lie at equal distance d on both
    tangents, where 2 d² (1 - T0·T1) + 2 d v·t = v·v; the joint is in the middle between them.
    """
    v, t0, t1 = np.diff(ends, axis=0), tangents[:-1], tangents[1:]
    b, vv = _dot(v, t0 + t1), _dot(v, v)
    d = vv / (b + np.sqrt(b * b + 2 * (1 - _dot(t0, t1)) * vv))
    joints = (ends[:-1] + ends[1:] + d[:, None] * (t0 - t1)) / 2
    one, two = joints - ends[:-1], ends[1:] - joints
    first = np.arctan2(_cross(t0, one), _dot(t0, one))
    second = np.arctan2(_cross(two, t1), _dot(two, t1))
    return joints, np.tan(np.stack([first, second], axis=1) / 2)


def _biarc_distance(points: Array, ends: Array, joints: Array, tangents: Array, bulges: Array) -> Array:
    """Distances (n, k), mm, of points (n, k, 2) from n biarcs."""
    one, two = joints - ends[:-1], ends[1:] - joints
    # The tangent at the joint is that of the first arc's start, mirrored at the first chord.
    chord, start = _unit(one), tangents[:-1]
    across = 2 * _dot(chord, start)[:, None] * chord - start
    late = _dot(points - joints[:, None], across[:, None]) > 0
    return np.where(
        late,
        _arc_distance(points, joints, two, bulges[:, 1]),
        _arc_distance(points, ends[:-1], one, bulges[:, 0]),
    )


def _arc_distance(points: Array, start: Array, chord: Array, bulge: Array) -> Array:
    """Distance from circles through ``start`` along ``chord``: of first order, and right for straight ones.

    In the frame of the chord, with half length h and rise s = bulge h, the circle is
    s (u² + w² - h²) - w (h² - s²) = 0, which stays finite as the radius grows.
    """
    h = np.linalg.norm(chord, axis=1)[:, None] / 2
    along = (chord / (2 * h))[:, None]
    local = points - (start + chord / 2)[:, None]
    u, w = _dot(local, along), _cross(along, local)
    s = bulge[:, None] * h
    value = s * (u * u + w * w - h * h) - w * (h * h - s * s)
    slope = np.hypot(2 * s * u, 2 * s * w - (h * h - s * s))
    distance: Array = np.abs(value) / slope
    return distance
