"""The three kinds of curve an outline is made of.

Glossary
--------
segment
    A directed piece of plane curve with a parameter t in [0, 1].
tag
    What the segment is on the part (``"flank"``, ``"root"``, ``"tip"``); empty if it has no name.
span
    A polynomial piece of a B-spline, between two different knots.
"""

import math
from dataclasses import dataclass, replace
from functools import cache, cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mechwright.arrays import Array, turned
from mechwright.errors import GeometryError

Point = tuple[float, float]

_FULL_TURN_SLACK = 1e-12
"""A sweep this near to 2π, rad, is a full turn: thousands of times its rounding, far below a closure gap."""

_MAX_DEGREE = 25
"""Degree limit of a B-spline: what the CAD kernel takes."""


def _turned(points: Array, x: float, y: float, angle: float) -> Array:
    moved: Array = np.add(turned(points, angle), (x, y))
    return moved


def _point(row: Array) -> Point:
    return float(row[0]), float(row[1])


@dataclass(frozen=True)
class Line:
    """A straight segment between two points, mm."""

    start: Point
    end: Point
    tag: str = ""

    def at(self, t: ArrayLike) -> Array:
        """Points (n, 2), mm, at parameters t (n,) in [0, 1].

        >>> Line((0, 0), (4, 2)).at([0.5]).tolist()
        [[2.0, 1.0]]
        """
        t = np.atleast_1d(np.asarray(t, dtype=float))[:, None]
        points: Array = (1 - t) * np.asarray(self.start) + t * np.asarray(self.end)
        return points

    def derivative(self, t: ArrayLike) -> Array:
        """First derivative (n, 2) with respect to t."""
        return np.tile(np.subtract(self.end, self.start).astype(float), (np.size(t), 1))

    def flatten(self, tolerance: float) -> Array:  # noqa: ARG002 - a line is its own chord
        """The two end points, (2, 2)."""
        return np.array([self.start, self.end], dtype=float)

    def moved(self, x: float, y: float, angle: float = 0.0) -> "Line":
        """The line turned about the origin, then shifted."""
        a, b = _turned(np.array([self.start, self.end], dtype=float), x, y, angle)
        return replace(self, start=_point(a), end=_point(b))

    def reversed(self) -> "Line":
        """The same line run the other way."""
        return replace(self, start=self.end, end=self.start)

    def breaks(self) -> Array:
        """Smooth throughout."""
        return np.array([0.0, 1.0])


@dataclass(frozen=True)
class Arc:
    """A circular arc.

    Parameters
    ----------
    centre
        mm.
    radius
        Above 0, mm.
    start_angle
        Direction from the centre to the start, rad.
    sweep
        Signed turn, rad: positive is counter-clockwise, ±2π is a full circle.
    """

    centre: Point
    radius: float
    start_angle: float
    sweep: float
    tag: str = ""

    def __post_init__(self) -> None:
        good = 0 < self.radius < math.inf and 0 < abs(self.sweep) <= math.tau + _FULL_TURN_SLACK
        if not (good and math.isfinite(self.start_angle) and all(map(math.isfinite, self.centre))):
            raise GeometryError(f"an arc needs a radius above 0 and a sweep up to a full turn, not {self}")

    @property
    def is_circle(self) -> bool:
        """Whether the arc is a whole circle."""
        return abs(abs(self.sweep) - math.tau) <= _FULL_TURN_SLACK

    @property
    def start(self) -> Point:
        """First point, mm."""
        return _point(self.at(0.0)[0])

    @property
    def end(self) -> Point:
        """Last point, mm; the very start for a circle."""
        return self.start if self.is_circle else _point(self.at(1.0)[0])

    def at(self, t: ArrayLike) -> Array:
        """Points (n, 2), mm, at parameters t (n,) in [0, 1]."""
        angle = self.start_angle + self.sweep * np.atleast_1d(np.asarray(t, dtype=float))
        return np.column_stack(
            (self.centre[0] + self.radius * np.cos(angle), self.centre[1] + self.radius * np.sin(angle))
        )

    def derivative(self, t: ArrayLike) -> Array:
        """First derivative (n, 2) with respect to t."""
        angle = self.start_angle + self.sweep * np.atleast_1d(np.asarray(t, dtype=float))
        return self.radius * self.sweep * np.column_stack((-np.sin(angle), np.cos(angle)))

    def flatten(self, tolerance: float) -> Array:
        """Points on the arc whose chords stay within ``tolerance`` of it."""
        # The sagitta of a step is 2 r sin²(step / 4); this form does not cancel for a large radius.
        step = 4 * math.asin(math.sqrt(min(tolerance / (2 * self.radius), 0.5)))
        # Three chords at least for what turns noticeably, so that a circle never becomes a line.
        count = max(1 if abs(self.sweep) < 1 else 3, math.ceil(abs(self.sweep) / step))
        points = self.at(np.linspace(0, 1, count + 1))
        if self.is_circle:
            points[-1] = points[0]
        return points

    def moved(self, x: float, y: float, angle: float = 0.0) -> "Arc":
        """The arc turned about the origin, then shifted."""
        centre = _turned(np.array([self.centre], dtype=float), x, y, angle)[0]
        return replace(self, centre=_point(centre), start_angle=self.start_angle + angle)

    def reversed(self) -> "Arc":
        """The same arc run the other way."""
        return replace(self, start_angle=self.start_angle + self.sweep, sweep=-self.sweep)

    def breaks(self) -> Array:
        """Smooth throughout, but cut to quarter turns so that quadrature is exact to rounding."""
        return np.linspace(0, 1, max(1, math.ceil(abs(self.sweep) / (math.pi / 2))) + 1)


def circle(centre: Point, radius: float, *, clockwise: bool = False, tag: str = "") -> Arc:
    """A whole circle that starts at angle 0.

    >>> circle((1.0, 0.0), 2.0).start
    (3.0, 0.0)
    """
    return Arc(centre, radius, 0.0, -math.tau if clockwise else math.tau, tag)


@dataclass(frozen=True)
class BSpline:
    """A clamped, non-rational B-spline.

    Parameters
    ----------
    degree
        1 to 25.
    knots
        Non-decreasing, from 0 to 1, ``len(points) + degree + 1`` of them, end knots ``degree + 1`` fold,
        inner ones at most ``degree`` fold (one more would tear the curve).
    points
        Control points, mm.
    """

    degree: int
    knots: tuple[float, ...]
    points: tuple[Point, ...]
    tag: str = ""

    def __post_init__(self) -> None:
        k = self.degree
        clamped = k + 1
        start, inner, end = self.knots[:clamped], self.knots[clamped:-clamped], self.knots[-clamped:]
        good = (
            1 <= k <= _MAX_DEGREE
            and len(self.points) >= clamped
            and len(self.knots) == len(self.points) + clamped
            and start == (0.0,) * clamped
            and end == (1.0,) * clamped
            and (not inner or self._inner_knots_are_good())
        )
        if not good:
            raise GeometryError(
                f"a B-spline of degree {k} with {len(self.points)} points needs {len(self.points) + clamped} "
                f"knots from 0 to 1, {clamped}-fold at both ends and at most {k}-fold between, "
                f"and a degree from 1 to {_MAX_DEGREE}"
            )
        if not np.isfinite(self._net).all():
            raise GeometryError("a B-spline needs finite control points")

    def __repr__(self) -> str:
        return f"<BSpline of degree {self.degree}, {len(self.points)} points>"

    def _inner_knots_are_good(self) -> bool:
        """Whether the knots never fall, and none is so many-fold that the curve is torn."""
        knots, k = self._knots, self.degree
        return bool((knots[:-1] <= knots[1:]).all() and (knots[1 : -k - 1] < knots[k + 1 : -1]).all())

    @classmethod
    def bezier(cls, points: ArrayLike, tag: str = "") -> "BSpline":
        """The single-span spline with these control points (n, 2), mm."""
        rows = np.asarray(points, dtype=float).tolist()
        return cls(len(rows) - 1, (0.0,) * len(rows) + (1.0,) * len(rows), tuple(map(tuple, rows)), tag)

    @property
    def start(self) -> Point:
        """First point, mm."""
        return self.points[0]

    @property
    def end(self) -> Point:
        """Last point, mm."""
        return self.points[-1]

    @cached_property
    def _net(self) -> Array:
        return np.asarray(self.points, dtype=float)

    @cached_property
    def _knots(self) -> Array:
        return np.asarray(self.knots, dtype=float)

    @property
    def is_bezier(self) -> bool:
        """Whether there is a single span."""
        return len(self.points) == self.degree + 1

    def at(self, t: ArrayLike) -> Array:
        """Points (n, 2), mm, at parameters t (n,) in [0, 1].

        >>> BSpline.bezier([(0, 0), (1, 2), (2, 0)]).at([0.5]).tolist()
        [[1.0, 1.0]]
        """
        t = np.atleast_1d(np.asarray(t, dtype=float))
        if self.is_bezier:
            return bernstein(self.degree, t) @ self._net
        return _de_boor(self.degree, self._knots, self._net, t)

    def derivative(self, t: ArrayLike) -> Array:
        """First derivative (n, 2) with respect to t."""
        t = np.atleast_1d(np.asarray(t, dtype=float))
        if self.is_bezier:
            return bernstein(self.degree - 1, t) @ (self.degree * np.diff(self._net, axis=0))
        return _de_boor(
            self.degree - 1, self._knots[1:-1], _hodograph(self.degree, self._knots, self._net), t
        )

    def flatten(self, tolerance: float) -> Array:
        """Points on the curve, uniform in t on each span, whose chords stay within ``tolerance`` of it.

        The chord error of a step h is at most h² max|P''| / 8, and the second derivative lies in the convex
        hull of its control points, so the count needs no iteration.
        """
        pieces = []
        for a, b, bound in self._spans():
            count = max(1, math.ceil((b - a) * math.sqrt(bound / (8 * tolerance))))
            pieces.append(np.linspace(a, b, count + 1)[:-1])
        points = self.at(np.append(np.concatenate(pieces), 1.0))
        points[0], points[-1] = self.start, self.end
        return points

    def _spans(self) -> list[tuple[float, float, float]]:
        """Start, end and a bound of the second derivative of every span."""
        k, knots = self.degree, self._knots
        first = np.flatnonzero(knots[:-1] < knots[1:])
        if k == 1:
            return [(float(knots[i]), float(knots[i + 1]), 0.0) for i in first]
        if self.is_bezier:
            second = (k - 1) * np.diff(k * np.diff(self._net, axis=0), axis=0)
        else:
            second = _hodograph(k - 1, knots[1:-1], _hodograph(k, knots, self._net))
        size = np.hypot(second[:, 0], second[:, 1])
        # Over knots[i] to knots[i + 1] the curve of degree k - 2 depends on k - 1 of its points.
        return [(float(knots[i]), float(knots[i + 1]), float(size[i - k : i - 1].max())) for i in first]

    def moved(self, x: float, y: float, angle: float = 0.0) -> "BSpline":
        """The spline turned about the origin, then shifted."""
        return replace(self, points=tuple(_point(row) for row in _turned(self._net, x, y, angle)))

    def reversed(self) -> "BSpline":
        """The same spline run the other way."""
        return replace(self, knots=tuple(1 - k for k in self.knots[::-1]), points=self.points[::-1])

    def breaks(self) -> Array:
        """The distinct knots."""
        return np.unique(np.asarray(self.knots))


Segment = Line | Arc | BSpline
"""Every kind there is; whoever takes a segment takes all three."""


def bernstein(degree: int, t: Array) -> Array:
    """Bernstein polynomials of one degree at t (...): (..., degree + 1)."""
    k, binomial = _binomials(degree)
    values: Array = binomial * t[..., None] ** k * (1 - t[..., None]) ** (degree - k)
    return values


@cache
def _binomials(degree: int) -> tuple[NDArray[np.int_], Array]:
    """0 to the degree, and the binomial coefficients of each."""
    k = np.arange(degree + 1)
    return k, np.array([math.comb(degree, i) for i in k.tolist()], dtype=float)


def _de_boor(degree: int, knots: Array, net: Array, t: Array) -> Array:
    """Points (m, 2) of a B-spline at t (m,) by de Boor's algorithm.

    C. de Boor, A Practical Guide to Splines, chapter X. Our own, because scipy.interpolate takes 0.7 s to
    import and this is the only thing that the machining side would need it for.
    """
    span = np.clip(np.searchsorted(knots, t, side="right") - 1, degree, len(net) - 1)
    column = span[:, None] + np.arange(-degree, 1)
    values: Array = net[column]
    for level in range(1, degree + 1):
        low = knots[column[:, level:]]
        high = knots[column[:, level:] + degree + 1 - level]
        share = ((t[:, None] - low) / (high - low))[:, :, None]
        values = (1 - share) * values[:, :-1] + share * values[:, 1:]
    return values[:, 0]


def _hodograph(degree: int, knots: Array, net: Array) -> Array:
    """Control points of the derivative of a B-spline; its knots are those of the curve without the ends."""
    width = (knots[degree + 1 : -1] - knots[1 : -degree - 1])[:, None]
    # A knot of full multiplicity leaves an empty span, whose control point nothing depends on.
    points: Array = degree * np.diff(net, axis=0) / np.where(width > 0, width, np.inf)
    return points
