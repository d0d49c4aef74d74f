"""The outline: the single truth about a plate part.

An outline is one outer loop (counter-clockwise) and any number of inner loops (clockwise), with the largest
deviation of its segments from the exact curve. The solid is its extrusion, the drawing its segments, the
toolpath its offset and the mass its area.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from mechwright.arrays import Array, on_grid
from mechwright.errors import GeometryError
from mechwright.geometry.beziers import by_degree, flattened, sampled
from mechwright.geometry.segments import Arc, Line, Point, Segment
from mechwright.tolerances import TOLERANCES

if TYPE_CHECKING:
    import shapely

# Gauss points per smooth piece. Twenty are exact for polynomials of degree 39: second moments of splines
# up to degree 10 (4 k - 1), their area up to degree 20 (2 k - 1); for quarter arcs the rest is rounding.
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(20)
_OF_LINES = np.polynomial.legendre.leggauss(2)
"""Nodes and weights of a line: along it the integrands are cubic, for which two are exact."""


def _at_nodes(segment: Segment) -> tuple[Array, Array]:
    """Points (n, 2) and weighted rates (n, 2) at the Gauss points of every smooth piece."""
    breaks = segment.breaks()
    half = np.diff(breaks) / 2
    t = ((breaks[:-1] + half)[:, None] + half[:, None] * _NODES).ravel()
    return segment.at(t), segment.derivative(t) * (half[:, None] * _WEIGHTS).ravel()[:, None]


def _straight(segments: Sequence[Segment]) -> list[tuple[list[int], Array]]:
    """Places of the lines among segments, and their ends (n, 2, 2), mm, as nets of degree 1."""
    places = [place for place, segment in enumerate(segments) if isinstance(segment, Line)]
    ends = [(segments[place].start, segments[place].end) for place in places]
    return [(places, np.array(ends, dtype=float))] if places else []


_ROUNDING = 1e-14
"""Share of the square about a loop that rounding makes of no area."""


@dataclass(frozen=True)
class Loop:
    """A closed chain of segments.

    Parameters
    ----------
    segments
        Each starts where the one before ends, the first where the last ends, within the closure tolerance.

    Raises
    ------
    GeometryError
        Two neighbours do not meet; the message gives the place and the gap.

    Examples
    --------
    >>> from mechwright.geometry import circle
    >>> round(Loop((circle((0, 0), 1.0),)).area, 9)
    3.141592654
    """

    segments: tuple[Segment, ...]

    def __post_init__(self) -> None:
        if not self.segments:
            raise GeometryError("a loop needs at least one segment")
        for one, two in zip(self.segments, (*self.segments[1:], self.segments[0]), strict=True):
            gap = math.dist(one.end, two.start)
            if not gap <= TOLERANCES.closure:
                raise GeometryError(
                    f"the outline is open at ({one.end[0]:.6f}, {one.end[1]:.6f}): "
                    f"a gap of {gap:.3g} mm, the limit is {TOLERANCES.closure:g} mm"
                )

    def __repr__(self) -> str:
        return f"<Loop of {len(self.segments)} segments, area {self.area:.6g} mm²>"

    @classmethod
    def polygon(cls, points: Iterable[Point], tag: str = "") -> "Loop":
        """The loop of straight lines through these corners, mm."""
        corners = [(float(x), float(y)) for x, y in points]
        return cls(tuple(Line(a, b, tag) for a, b in zip(corners, corners[1:] + corners[:1], strict=True)))

    @property
    def is_circle(self) -> bool:
        """Whether the loop is one whole circle."""
        return len(self.segments) == 1 and isinstance(self.segments[0], Arc)

    def flatten(self, tolerance: float = TOLERANCES.flatten) -> Array:
        """Corners (n, 2), mm, of a polygon within ``tolerance`` of the loop; the first is not repeated."""
        if tolerance == TOLERANCES.flatten:
            return self._corners
        return self._flattened(tolerance)

    @cached_property
    def _corners(self) -> Array:
        """Corners at the usual tolerance, asked for many times; read-only."""
        corners = self._flattened(TOLERANCES.flatten)
        corners.flags.writeable = False
        return corners

    def _flattened(self, tolerance: float) -> Array:
        found: dict[int, Array] = {}
        for places, nets in by_degree(self.segments):
            found |= zip(places, flattened(nets, tolerance), strict=True)
        every = (
            found[i] if i in found else segment.flatten(tolerance) for i, segment in enumerate(self.segments)
        )
        corners = np.concatenate([points[:-1] for points in every])
        # A segment of next to no length would fold the polygon back on itself by a rounding error.
        apart = np.hypot(*(corners - np.roll(corners, 1, axis=0)).T) > TOLERANCES.closure
        if not apart.any():
            raise GeometryError(
                f"the outline has no size: all its corners are within {TOLERANCES.closure:g} mm; "
                "lengths are in mm"
            )
        return on_grid(corners if apart.all() else corners[apart])

    def moved(self, x: float, y: float, angle: float = 0.0) -> "Loop":
        """The loop turned about the origin, then shifted."""
        if x == 0 and y == 0 and angle == 0:
            return self
        return Loop(tuple(segment.moved(x, y, angle) for segment in self.segments))

    def reversed(self) -> "Loop":
        """The same loop run the other way."""
        return Loop(tuple(segment.reversed() for segment in self.segments[::-1]))

    @cached_property
    def moments(self) -> Array:
        """Integrals (6,) of 1, x, y, x², y², xy over the inside, by Green's theorem.

        All change sign where the loop runs clockwise.
        """
        pieces: list[tuple[Array, Array]] = []
        at_once: set[int] = set()
        alike = [(*group, _NODES, _WEIGHTS) for group in by_degree(self.segments)]
        alike += [(*group, *_OF_LINES) for group in _straight(self.segments)]
        for places, nets, nodes, weights in alike:
            points, rates = sampled(nets, 0.5 + 0.5 * nodes)
            pieces.append((points.reshape(-1, 2), (rates * (0.5 * weights)[:, None]).reshape(-1, 2)))
            at_once.update(places)
        pieces += [_at_nodes(one) for place, one in enumerate(self.segments) if place not in at_once]
        x, y = np.ascontiguousarray(np.concatenate([points for points, _ in pieces]).T)
        dx, dy = np.ascontiguousarray(np.concatenate([rates for _, rates in pieces]).T)
        return np.array(
            [
                (x @ dy - y @ dx) / 2,
                (x * x) @ dy / 2,
                -(y * y) @ dx / 2,
                (x**3) @ dy / 3,
                -(y**3) @ dx / 3,
                (x * x * y) @ dy / 2,
            ]
        )

    @property
    def area(self) -> float:
        """Signed area, mm²: positive if counter-clockwise."""
        return float(self.moments[0])

    @property
    def bounds(self) -> tuple[float, float, float, float]:
        """Least x, least y, greatest x, greatest y, mm, to the flattening tolerance."""
        points = self.flatten()
        (x0, y0), (x1, y1) = points.min(axis=0), points.max(axis=0)
        return float(x0), float(y0), float(x1), float(y1)


@dataclass(frozen=True)
class Outline:
    """A plate part seen from above, mm.

    Parameters
    ----------
    outer
        The outside, counter-clockwise.
    inner
        The openings, clockwise each.
    deviation
        Largest distance of any segment from the exact curve, mm.

    Raises
    ------
    GeometryError
        A loop runs the wrong way.
    """

    outer: Loop
    inner: tuple[Loop, ...] = ()
    deviation: float = 0.0
    _polygons: dict[float, "shapely.Polygon"] = field(
        default_factory=dict, init=False, repr=False, compare=False, hash=False
    )

    def __post_init__(self) -> None:
        x0, y0, x1, y1 = self.outer.bounds
        if abs(self.outer.area) <= _ROUNDING * ((x1 - x0) ** 2 + (y1 - y0) ** 2):
            raise GeometryError("the outer loop encloses no area: it cuts itself, or goes back where it came")
        if not self.outer.area > 0:
            raise GeometryError(
                f"the outer loop has a signed area of {self.outer.area:.6g} mm²; it must run "
                "counter-clockwise around an area above 0: reverse it"
            )
        for number, loop in enumerate(self.inner, start=1):
            if not loop.area < 0:
                raise GeometryError(
                    f"inner loop {number} has a signed area of {loop.area:.6g} mm²; it must run clockwise "
                    "around an area below 0: reverse it"
                )

    def __repr__(self) -> str:
        x0, y0, x1, y1 = self.bounds
        return f"<Outline {x1 - x0:.6g} × {y1 - y0:.6g} mm, {len(self.inner)} openings, {self.area:.6g} mm²>"

    @property
    def loops(self) -> tuple[Loop, ...]:
        """The outer loop, then the inner ones."""
        return (self.outer, *self.inner)

    @property
    def moments(self) -> Array:
        """Integrals (6,) of 1, x, y, x², y², xy over the material."""
        total: Array = np.sum([loop.moments for loop in self.loops], axis=0)
        return total

    @property
    def area(self) -> float:
        """Area of the material, mm²."""
        return float(self.moments[0])

    @property
    def centroid(self) -> Point:
        """Centre of area, mm."""
        m = self.moments
        return float(m[1] / m[0]), float(m[2] / m[0])

    @property
    def polar_moment(self) -> float:
        """Second moment of area about the origin, mm⁴."""
        m = self.moments
        return float(m[3] + m[4])

    @property
    def bounds(self) -> tuple[float, float, float, float]:
        """Least x, least y, greatest x, greatest y, mm."""
        return self.outer.bounds

    def moved(self, x: float, y: float, angle: float = 0.0) -> "Outline":
        """The outline turned about the origin, then shifted."""
        return Outline(
            self.outer.moved(x, y, angle),
            tuple(loop.moved(x, y, angle) for loop in self.inner),
            self.deviation,
        )

    def polygon(self, tolerance: float = TOLERANCES.flatten) -> "shapely.Polygon":
        """The outline as a polygon within ``tolerance``, mm; raises GeometryError where it cuts itself."""
        if tolerance not in self._polygons:
            import shapely

            polygon = shapely.Polygon(
                self.outer.flatten(tolerance), [loop.flatten(tolerance) for loop in self.inner]
            )
            if not polygon.is_valid:
                raise GeometryError(f"the outline cuts itself: {shapely.is_valid_reason(polygon)}")
            self._polygons[tolerance] = polygon
        return self._polygons[tolerance]
