"""Entities of a drawing as curves in the plane, mm. Imports ezdxf.

Lines, arcs and circles stay what they are; a spline that is no rational one stays the very curve; ellipses
and rational splines are arcs where they are round, and else polynomials within the tolerance of outlines.
"""

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from mechwright.arrays import Array
from mechwright.errors import GeometryError
from mechwright.geometry import Arc, BSpline, Line, Segment, circle
from mechwright.geometry.fit import fit_curves
from mechwright.geometry.segments import Point
from mechwright.tolerances import TOLERANCES

FLAT = 1e-6
"""A polyline's arc that rises less above its chord, mm, is a line: a thousandth of what drawings hold."""
ROUND = 1e-4
"""A piece of a spline within this of an arc, mm, is that arc: a tenth of the tolerance of outlines."""
FITTED = TOLERANCES.outline / 4
"""Deviation of polynomials from ellipses and rational splines, mm."""
LEVEL = 0.01
"""Heights of one entity that differ by less, mm, are one height."""
HIGHEST_DEGREE = 25
"""Of a spline that is taken as it is: what the CAD kernel takes."""
FARTHEST = 1e6
"""Coordinates beyond a kilometre, mm, are no plate's."""
FULLEST = 1e9
"""Bulges from here on are whole circles, whose place they do not tell."""
MOST_UNEVEN = 1e9
"""The greatest weight of a rational spline over its least one: beyond it the curve is all but cornered."""


class NoCurveError(GeometryError):
    """An entity is no curve of a plane; the message says what it is, and the remedy what to do.

    ``key`` is the key of the design that may have made it so.
    """

    def __init__(self, message: str, remedy: str, key: str = "drawing") -> None:
        super().__init__(message)
        self.remedy, self.key = remedy, key


@dataclass(frozen=True)
class Stroke:
    """One curve of a drawing.

    Parameters
    ----------
    segments
        End to end, mm.
    layer, colour
        What it shows: names and numbers of blocks and layers are resolved.
    kind, handle
        Of its entity, such as ``LINE`` and ``2F``: messages name them.
    """

    segments: tuple[Segment, ...]
    layer: str
    colour: int
    kind: str
    handle: str

    @property
    def name(self) -> str:
        """How messages name it."""
        return f"{self.kind} {self.handle} on layer {self.layer}" if self.handle else f"{self.kind}"


def curves(entity: Any, scale: float) -> tuple[list[tuple[Segment, ...]], float]:
    """The curves of an entity, mm, and its height.

    Raises
    ------
    NoCurveError
        It is drawn in space: it is tilted, or its ends stand at different heights; or its coordinates are no
        numbers, or lie farther than :data:`FARTHEST` from the origin.
    """
    from ezdxf.upright import upright

    if entity.dxf.hasattr("extrusion"):
        _flat_extrusion(entity)
        upright(entity)
    with np.errstate(over="ignore", invalid="ignore"):
        found, heights = _READERS[entity.dxftype()](entity, scale)
        _placed(heights)
        for segment in (one for segments in found for one in segments):
            _placed((*segment.start, *segment.end))
            if isinstance(segment, Arc):
                _placed(segment.at(_QUARTERS).ravel())
    low, high = (min(heights), max(heights)) if heights else (0.0, 0.0)
    if high - low > LEVEL:
        raise NoCurveError(
            f"reaches from Z{low:.3f} to Z{high:.3f}",
            "draw the plate flat, or export it as a view from above",
        )
    return found, low


_QUARTERS = (0.0, 0.25, 0.5, 0.75, 1.0)
"""Places of an arc: none of it is much farther from the origin than the farthest of them."""


def _placed(values: "Iterable[float] | Array") -> None:
    """Raise where coordinates, mm, are no numbers or too far from the origin."""
    reach = float(np.abs(np.fromiter(values, dtype=float)).max(initial=0.0))
    if not math.isfinite(reach):
        raise NoCurveError("has coordinates that are no numbers", "draw it again")
    if reach > FARTHEST:
        raise NoCurveError(
            f"stands {reach:.4g} mm from the drawing's origin; the limit is {FARTHEST:g} mm",
            "move the part to the origin, or say other units",
            "units",
        )


def _flat_extrusion(entity: Any) -> None:
    from ezdxf.math import Vec3

    try:
        normal = Vec3(entity.dxf.extrusion).normalize()
    except ZeroDivisionError:
        raise NoCurveError("has no direction of extrusion", "draw it again") from None
    if abs(abs(normal.z) - 1) > TOLERANCES.angle_rad:
        raise NoCurveError(
            "is drawn on a tilted plane", "draw the plate flat, or export it as a view from above"
        )


Found = tuple[list[tuple[Segment, ...]], list[float]]


def _line(entity: Any, scale: float) -> Found:
    a, b = entity.dxf.start, entity.dxf.end
    return [(Line(_at(a, scale), _at(b, scale)),)], [a[2] * scale, b[2] * scale]


def _arc(entity: Any, scale: float) -> Found:
    centre, radius = _at(entity.dxf.center, scale), float(entity.dxf.radius) * scale
    height = [float(entity.dxf.center[2]) * scale]
    if not radius > TOLERANCES.closure:
        return [], height
    if entity.dxftype() == "CIRCLE":
        return [(circle(centre, radius),)], height
    first = math.radians(entity.dxf.start_angle)
    sweep = (math.radians(entity.dxf.end_angle) - first) % math.tau
    return [(Arc(centre, radius, first, sweep or math.tau),)], height


def _lwpolyline(entity: Any, scale: float) -> Found:
    rows = [(float(x) * scale, float(y) * scale, float(b)) for x, y, b in entity.get_points("xyb")]
    return _bulged(rows, closed=bool(entity.closed)), [float(entity.dxf.elevation) * scale]


_FRAME = 16
"""Flag of a vertex that only frames a spline-fit polyline."""


def _polyline(entity: Any, scale: float) -> Found:
    if entity.is_polygon_mesh or entity.is_poly_face_mesh:
        raise NoCurveError("is a mesh in space", "export the plate's edges")
    vertices = [one for one in entity.vertices if not one.dxf.flags & _FRAME]
    rows, heights = [], []
    for one in vertices:
        x, y, z = one.dxf.location
        rows.append((float(x) * scale, float(y) * scale, float(one.dxf.get("bulge", 0.0))))
        heights.append(float(z) * scale)
    return _bulged(rows, closed=bool(entity.is_closed)), heights


def _bulged(rows: list[tuple[float, float, float]], *, closed: bool) -> list[tuple[Segment, ...]]:
    _placed(value for x, y, _ in rows for value in (x, y))
    if not all(abs(bulge) < FULLEST for _, _, bulge in rows):
        raise NoCurveError("has a bulge that no arc has", "draw it again")
    pairs = [*pairwise(rows), *([(rows[-1], rows[0])] if closed and len(rows) > 1 else [])]
    found = [bulged(a[:2], b[:2], a[2]) for a, b in pairs if math.dist(a[:2], b[:2]) > TOLERANCES.closure]
    return [tuple(found)] if found else []


def bulged(start: Point, end: Point, bulge: float) -> Segment:
    """The arc of a polyline, whose bulge is the tangent of a quarter of its sweep; a line where it is flat.

    >>> bulged((0.0, 0.0), (2.0, 0.0), 1.0)
    Arc(centre=(1.0, 0.0), radius=1.0, start_angle=3.141592653589793, sweep=3.141592653589793, tag='')
    """
    chord = math.dist(start, end)
    if abs(bulge) * chord / 2 < FLAT:
        return Line(start, end)
    sweep = 4 * math.atan(bulge)
    lift = chord / 2 * (1 - bulge * bulge) / (2 * bulge)  # of the centre, to the left of the chord
    ux, uy = (end[0] - start[0]) / chord, (end[1] - start[1]) / chord
    centre = (start[0] + end[0]) / 2 - uy * lift, (start[1] + end[1]) / 2 + ux * lift
    first = math.atan2(start[1] - centre[1], start[0] - centre[0])
    return Arc(centre, math.dist(centre, start), first, sweep)


def _ellipse(entity: Any, scale: float) -> Found:
    centre = np.array(tuple(entity.dxf.center)[:2], dtype=float) * scale
    major, minor = (
        np.array(tuple(axis)[:2], dtype=float) * scale for axis in (entity.dxf.major_axis, entity.minor_axis)
    )
    heights = [float(entity.dxf.center[2]) * scale]
    heights.append(heights[0] + float(entity.dxf.major_axis[2]) * scale)
    _placed((*centre, *major, *minor))
    first = float(entity.dxf.start_param)
    sweep = (float(entity.dxf.end_param) - first) % math.tau
    sweep = sweep if sweep > TOLERANCES.angle_rad else math.tau
    if not np.hypot(*minor) > TOLERANCES.closure:
        return [], heights

    def at(t: Array) -> Array:
        angle = (first + sweep * t)[:, None]
        return np.asarray(centre + np.cos(angle) * major + np.sin(angle) * minor)

    return [_pieces(at, np.linspace(0, 1, math.ceil(sweep / (math.pi / 2) - 1e-9) + 1))], heights


def _spline(entity: Any, scale: float) -> Found:
    try:
        tool = entity.construction_tool()
    except Exception as error:  # what ezdxf says of nets and knots that do not go together
        raise NoCurveError(f"cannot be computed ({error})", "draw it again") from error
    net = np.array([tuple(point) for point in tool.control_points], dtype=float) * scale
    if len(net) < 2 or not np.isfinite(net).all():
        raise NoCurveError("has no control points", "draw it again")
    _placed(net.ravel())
    heights = [float(net[:, 2].min()), float(net[:, 2].max())]
    degree, knots = int(tool.order) - 1, np.asarray(tool.knots(), dtype=float)
    weights = np.asarray(tool.weights() or np.ones(len(net)), dtype=float)
    low, high = knots[degree], knots[len(net)]
    even = (weights > 0).all() and weights.max() <= MOST_UNEVEN * weights.min()
    if not 0 < high - low < math.inf or not 1 <= degree <= HIGHEST_DEGREE or not even:
        raise NoCurveError("has knots or weights that are none", "draw it again")
    if degree == 1:
        points = [(float(x), float(y)) for x, y in net[:, :2]]
        lines = [Line(a, b) for a, b in pairwise(points) if math.dist(a, b) > TOLERANCES.closure]
        return ([tuple(lines)] if lines else []), heights
    breaks = np.unique(np.clip((knots - low) / (high - low), 0, 1))
    breaks = breaks[np.append(True, np.diff(breaks) > 1e-9)]  # rounding has parted some
    breaks[-1] = 1.0
    from scipy.interpolate import BSpline as Curve

    homogeneous = Curve(knots, np.column_stack((net[:, :2] * weights[:, None], weights)), degree)

    def at(t: Array) -> Array:
        rows = homogeneous(low + (high - low) * t)
        return np.asarray(rows[:, :2] / rows[:, 2:])

    own = _own(degree, knots, net[:, :2], weights)
    if own is not None:
        arc = _round(at, 0.0, 1.0)
        return [(arc or own,)], heights
    return [_pieces(at, breaks)], heights


def _own(degree: int, knots: Array, net: Array, weights: Array) -> BSpline | None:
    """A spline as it is, if it is clamped, not rational and nowhere has a corner."""
    clamped = knots[0] == knots[degree] and knots[-1] == knots[-1 - degree]
    inner = knots[degree + 1 : -degree - 1]
    corners = any(np.count_nonzero(inner == knot) >= degree for knot in np.unique(inner))
    if not clamped or corners or np.ptp(weights) > 1e-12 * weights.max():
        return None
    unit = (knots - knots[0]) / (knots[-1] - knots[0])
    try:
        return BSpline(degree, tuple(unit.tolist()), tuple((float(x), float(y)) for x, y in net))
    except GeometryError:
        return None


def _pieces(at: Callable[[Array], Array], breaks: Array) -> tuple[Segment, ...]:
    """A curve as arcs where it is round between two breaks, and else as polynomials."""
    whole = _round(at, float(breaks[0]), float(breaks[-1]))
    if whole is not None:
        return (whole,)
    found: list[Segment] = []
    for a, b in pairwise(breaks.tolist()):
        ends = at(np.array([a, (a + b) / 2, b]))
        if np.hypot(*np.ptp(ends, axis=0)) <= TOLERANCES.closure:
            continue
        arc = _round(at, a, b)
        if arc is not None:
            found.append(arc)
            continue

        def piece(t: Array, a: float = a, b: float = b) -> Array:
            return at((1 - t) * a + t * b)[None]

        found += fit_curves(piece, 1, FITTED)[0][0]
    return tuple(found)


_LOOKS = 33
"""Points at which a curve is held against an arc."""


def _round(at: Callable[[Array], Array], a: float, b: float) -> Segment | None:
    """The arc or line that a curve is between two parameters; None if it is neither."""
    points = at(np.linspace(a, b, _LOOKS))
    start, end = points[0], points[-1]
    closed = math.dist(start, end) <= ROUND
    if not closed:
        along = (end - start) / math.dist(start, end)
        rise = (points - start) @ np.array([-along[1], along[0]])
        run = (points - start) @ along
        if np.abs(rise).max() <= FLAT and (np.diff(run) > 0).all():
            return Line(_pair(start), _pair(end))
    fitted = fitted_circle(points)
    if fitted is None or fitted[2] > ROUND:
        return None
    centre = np.array(fitted[0])
    angle = np.unwrap(np.arctan2(*(points - centre).T[::-1]))
    steps = np.diff(angle)
    if not ((steps > 0).all() or (steps < 0).all()):
        return None
    sweep = float(angle[-1] - angle[0])
    if closed:
        if abs(abs(sweep) - math.tau) > 1e-3:
            return None
        return Arc(_pair(centre), fitted[1], float(angle[0]), math.copysign(math.tau, sweep))
    return bulged(_pair(start), _pair(end), math.tan(sweep / 4)) if abs(sweep) < 6 else None


def fitted_circle(points: Array) -> tuple[Point, float, float] | None:
    """Centre, radius and largest deviation, mm, of the circle through points (n, 2); None if in line.

    Least squares of x² + y² + a x + b y + c (Kåsa), about the points' middle.
    """
    middle = points.mean(axis=0)
    x, y = (points - middle).T
    size = float(np.hypot(x, y).max())
    if not size > 0:
        return None
    matrix = np.column_stack((x / size, y / size, np.ones(len(x))))
    solution, _, rank, _ = np.linalg.lstsq(matrix, -(x * x + y * y) / size**2, rcond=1e-10)
    if rank < 3:
        return None
    cx, cy = -solution[0] / 2 * size, -solution[1] / 2 * size
    square = cx * cx + cy * cy - solution[2] * size**2
    if not square > 0:
        return None
    radius = math.sqrt(square)
    off = float(np.abs(np.hypot(x - cx, y - cy) - radius).max())
    return (float(middle[0] + cx), float(middle[1] + cy)), radius, off


def _at(point: Iterable[float], scale: float) -> Point:
    x, y, *_ = point
    return float(x) * scale, float(y) * scale


def _pair(row: Array) -> Point:
    return float(row[0]), float(row[1])


_READERS: Mapping[str, Callable[[Any, float], Found]] = {
    "LINE": _line,
    "ARC": _arc,
    "CIRCLE": _arc,
    "LWPOLYLINE": _lwpolyline,
    "POLYLINE": _polyline,
    "ELLIPSE": _ellipse,
    "SPLINE": _spline,
}
CURVES = frozenset(_READERS)
"""Kinds of entities that are curves."""
