"""The parallel of a loop at a distance, corners mitred: where a broken edge ends on the top face.

Every segment moves along its normal, and neighbours are lengthened or cut until they meet. As long as no
segment vanishes, each segment of the loop has one of the parallel.

Glossary
--------
joint
    The place where a segment meets the next one. Its parameters on both follow the distance.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from mechwright.arrays import Array
from mechwright.errors import GeometryError
from mechwright.geometry.fit import HIGHEST_DEGREE, interpolation
from mechwright.geometry.outline import Loop
from mechwright.geometry.segments import Arc, BSpline, Line, Point, Segment, bernstein
from mechwright.tolerances import TOLERANCES

FITTED = TOLERANCES.closure
"""Deviation of a spline's fitted parallel, mm: the CAD kernel sees none; its ends are exact."""
DEGREE = HIGHEST_DEGREE
"""Degree of fitted parallels."""
MOST_HALVINGS = 6
"""A span that 64 pieces do not fit is not smooth, or the distance is above its radius of curvature."""
BETWEEN = np.linspace(0.02, 0.98, 2 * DEGREE + 5)
"""Where a piece is held against the exact parallel: between all nodes."""
STEP = 1e-6
"""Difference of parameters for the slopes of Newton's method."""
ITERATIONS = 30
"""Steps of Newton's method; a joint that is not found by then has vanished."""
MITRE = 100.0
"""Corners run out so many times the distance at most."""
MET = 1e-10
"""Offset segments meet if their ends are so near, mm."""
SETTLED = TOLERANCES.closure / 10
"""Neighbours that go on in all but one direction, as fitted splines do, come so near to each other at least,
mm: a kink of 0.005 degrees leaves a gap of 4e-9 of the distance."""


@dataclass(frozen=True)
class Parallel:
    """The parallels of a loop.

    Parameters
    ----------
    loop
        Run either way.
    side
        1 for parallels on its left, -1 on its right.
    shares
        Of every segment, how much of a distance it moves; below 0 it moves to the other side. Neighbours
        that go on in one direction have the same. Default: all move by the whole of it.
    """

    loop: Loop
    side: int = 1
    shares: tuple[float, ...] = ()

    @property
    def _shares(self) -> tuple[float, ...]:
        return self.shares or (1.0,) * len(self.loop.segments)

    def point(self, segment: Segment, t: ArrayLike, distance: ArrayLike) -> Array:
        """Points (n, 2) at parameters t (n,), mm, moved by distances (n,); t may lie beyond 0 and 1."""
        rate = segment.derivative(t)
        normal = np.column_stack((-rate[:, 1], rate[:, 0])) / np.hypot(rate[:, 0], rate[:, 1])[:, None]
        moved: Array = segment.at(t) + self.side * np.atleast_1d(distance)[:, None] * normal
        return moved

    def joints(self, distances: Array) -> tuple[Array, Array]:
        """Parameters of every joint at distances (m,) above 0, rising.

        Gives those (n, m) on segment i where it ends, and on segment i + 1 where that begins. Raises
        GeometryError where two neighbours do not meet any more.
        """
        segments = self.loop.segments
        moved = [share * distances for share in self._shares]
        pairs = zip(segments, (*segments[1:], segments[0]), moved, (*moved[1:], moved[0]), strict=True)
        found = np.array([self._joint(*pair) for pair in pairs])
        return found[:, 0], found[:, 1]

    def _joint(self, one: Segment, two: Segment, distances: Array, others: Array) -> Array:
        """Parameters on ``one``, moved by ``distances`` (m,), and on ``two``, moved by ``others``."""
        a, b = np.ones(len(distances)), np.zeros(len(distances))
        if self.loop.is_circle:
            return np.array([a, b])

        start = np.subtract(one.end, two.start)
        of_one, of_two = np.tile(distances, 2), np.tile(others, 2)
        for _ in range(ITERATIONS):
            p = self.point(one, np.concatenate((a, a + STEP)), of_one).reshape(2, -1, 2)
            q = self.point(two, np.concatenate((b, b + STEP)), of_two).reshape(2, -1, 2)
            off = p[0] - q[0] - start  # what the loop itself leaves open stays
            if np.abs(off).max() <= MET:
                return np.array([a, b])
            slopes = np.stack((p[1] - p[0], q[0] - q[1]), axis=2) / STEP
            # Least squares of least norm: smooth joints have parallel slopes.
            step = np.einsum("kij,kj->ki", np.linalg.pinv(slopes, rcond=1e-5), -off)
            a, b = a + step[:, 0], b + step[:, 1]
        if np.abs(off).max() <= SETTLED:
            return np.array([a, b])
        x, y = one.end
        raise GeometryError(
            f"the edge at ({x:.3f}, {y:.3f}) is too short or too round to be moved by {distances[-1]:g} mm"
        )

    def strip(self, segment: Segment, first: float, last: float, distance: float) -> tuple[Array, Array]:
        """A spline between two parameters, and the same moved, as Bézier pieces of one parameter.

        Gives the parameters (n + 1,) at which pieces end, and control points (2, n, DEGREE + 1, 2), mm, of
        the spline and of its parallel. Raises GeometryError for a parallel that is not smooth.
        """
        breaks = segment.breaks()
        grid = np.concatenate(([first], breaks[(breaks > first) & (breaks < last)], [last]))

        def moved(t: Array) -> Array:
            return self.point(segment, t, np.full(t.shape, distance))

        for _ in range(MOST_HALVINGS + 1):
            poles = interpolated(moved, grid)
            seen = np.einsum("sj,kji->ksi", bernstein(DEGREE, BETWEEN), poles).reshape(-1, 2)
            if np.abs(seen - moved(_spread(grid, BETWEEN))).max() <= FITTED:
                return grid, np.stack((interpolated(segment.at, grid), poles))
            grid = np.sort(np.concatenate((grid, (grid[:-1] + grid[1:]) / 2)))
        x, y = segment.start
        raise GeometryError(
            f"the edge at ({x:.3f}, {y:.3f}) turns too sharply to be moved by {distance:g} mm"
        )

    def at(self, distance: float) -> Loop:
        """The parallel, one segment for each of the loop.

        Raises GeometryError where a segment vanishes or turns back: the distance is too large for the loop.

        >>> square = Loop.polygon([(0, 0), (4, 0), (4, 4), (0, 4)])
        >>> round(Parallel(square).at(1.0).area, 6), round(Parallel(square, -1).at(1.0).area, 6)
        (4.0, 36.0)
        """
        before, after = self.joints(np.array([distance]))
        return self.between(np.roll(after[:, -1], 1), before[:, -1], distance)

    def between(self, starts: Array, ends: Array, distance: float) -> Loop:
        """The parallel whose segments begin and end at parameters (n,) that :meth:`joints` has given."""
        segments = self.loop.segments
        moved = [
            self._moved(segment, a, b, share * distance)
            for segment, a, b, share in zip(
                segments, starts.tolist(), ends.tolist(), self._shares, strict=True
            )
        ]
        loop = Loop(tuple(moved))
        self._check(loop, distance)
        return loop

    def _moved(self, segment: Segment, first: float, last: float, distance: float) -> Segment:
        if last - first <= 0:
            x, y = segment.start
            raise GeometryError(f"the edge at ({x:.3f}, {y:.3f}) is too short to be moved by {distance:g} mm")
        match segment:
            case Line():
                a, b = self.point(segment, [first, last], [distance, distance]).tolist()
                return Line((a[0], a[1]), (b[0], b[1]), segment.tag)
            case Arc():
                radius = self.radius(segment, distance)
                start = segment.start_angle + segment.sweep * first
                return Arc(segment.centre, radius, start, segment.sweep * (last - first), segment.tag)
            case _:
                grid, (_, poles) = self.strip(segment, first, last, distance)
                return _joined(poles, (grid - first) / (last - first), segment.tag)

    def radius(self, arc: Arc, distance: float) -> float:
        """Radius of a moved arc, mm; raises GeometryError where nothing of it is left."""
        radius = arc.radius - self.side * (distance if arc.sweep > 0 else -distance)
        if radius <= FITTED:
            x, y = arc.centre
            raise GeometryError(
                f"the arc of {arc.radius:g} mm about ({x:.3f}, {y:.3f}) cannot be moved inwards by "
                f"{distance:g} mm"
            )
        return radius

    def _check(self, moved: Loop, distance: float) -> None:
        """Refuse a parallel that crosses itself, or, of one distance, that is not what polygons say."""
        import shapely

        ring, edge = shapely.LinearRing(moved.flatten()), shapely.LinearRing(self.loop.flatten())
        if self.shares and ring.is_simple and ring.is_ccw == edge.is_ccw:
            return
        inwards = self.side if edge.is_ccw else -self.side
        wanted = shapely.buffer(
            shapely.Polygon(edge), -inwards * distance, join_style="mitre", mitre_limit=MITRE
        )
        off = abs(shapely.Polygon(ring).area - wanted.area)
        if not ring.is_simple or ring.is_ccw != edge.is_ccw or off > 4 * TOLERANCES.flatten * ring.length:
            x, y = edge.centroid.coords[0]
            raise GeometryError(
                f"edges of the loop about ({x:.3f}, {y:.3f}) meet each other when they are moved by "
                f"{distance:g} mm"
            )


def _spread(grid: Array, share: Array) -> Array:
    spread: Array = (grid[:-1, None] + np.diff(grid)[:, None] * share).ravel()
    return spread


def interpolated(curve: Callable[[Array], Array], grid: Array) -> Array:
    """Control points (pieces, DEGREE + 1, d) of a curve between the places of a grid."""
    at, inverse = interpolation(DEGREE)
    values = curve(_spread(grid, at)).reshape(len(grid) - 1, DEGREE + 1, -1)
    poles: Array = np.einsum("ij,kjd->kid", inverse, values)
    # Ends exactly: neighbours share them.
    poles[:, 0], poles[:, -1] = values[:, 0], values[:, -1]
    return poles


def _joined(poles: Array, grid: Array, tag: str) -> BSpline:
    points: list[Point] = [(x, y) for x, y in poles[0].tolist()]
    for piece in poles[1:]:
        points += [(x, y) for x, y in piece[1:].tolist()]
    inner = np.repeat(grid[1:-1], DEGREE).tolist()
    ends = DEGREE + 1
    return BSpline(DEGREE, (*(0.0,) * ends, *inner, *(1.0,) * ends), tuple(points), tag)
