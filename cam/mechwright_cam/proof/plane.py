"""Polygons: buffers of known accuracy, the closing, and distances to a boundary."""

from collections.abc import Callable
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.geometry.prepared import prepared
from mechwright_cam.controls.reading.run import Ints
from mechwright_cam.proof.point_segment_distance import Chords
from mechwright_cam.setup.views import ROUND, Shape, quarter
from mechwright_plane.buffers import buffered

SNAP = 1e-6
"""Grid for shapes that GEOS cannot put together without one, mm: far below a program's last decimal."""


def grow(shape: Any, distance: float, error: float = ROUND) -> Shape:
    """The shape and all within ``distance`` of it; shrunk if that is negative."""
    return buffered(shape, distance, quarter(distance, error))


def overlay(operation: Callable[..., Any], one: Any, other: Any) -> Shape:
    """What an operation of shapely makes of two shapes.

    Shapes that have been put together many times may have edges so nearly in line that GEOS 3.14 finds no
    place where they cross; with all corners on a grid of :data:`SNAP` it does.
    """
    try:
        found: Shape = operation(one, other)
    except shapely.errors.GEOSException:
        found = operation(one, other, grid_size=SNAP)
    return found


def without_specks(shape: Shape) -> Shape:
    """The parts of a shape that are anywhere wider than :data:`SNAP`: what is thinner is rounding of numbers.

    Examples
    --------
    >>> speck = shapely.Polygon([(0, 0), (1, 1), (0.5, 0.5 - 1e-15)])
    >>> without_specks(shapely.union(speck, shapely.box(2, 0, 3, 0.001))).bounds
    (2.0, 0.0, 3.0, 0.001)
    """
    parts = shapely.get_parts(shape)
    return shapely.union_all(parts[shapely.area(parts) > SNAP * shapely.length(parts)])


def closing(keep: Shape, radius: float) -> Shape:
    """What a round cutter leaves of the surroundings of ``keep``: keep, and the corners it cannot enter.

    Examples
    --------
    A cutter of radius 1 leaves 1 - π/4 in the inner corner of an L.

    >>> corner = shapely.Polygon([(0, 0), (9, 0), (9, 3), (3, 3), (3, 9), (0, 9)])
    >>> round(closing(corner, 1.0).area - corner.area, 3)
    0.215
    """
    return grow(grow(keep, radius), -radius)


CHUNK = 32
"""Corners of a path that are buffered at a time: a long path that crosses itself takes four times as long."""

BACK = -0.999
"""Cosine of the turn at which a path runs back on itself, as a slot does that is cut to and fro. GEOS 3.14
leaves holes in the buffer of such a line."""


def _turns_back(points: Array) -> Ints:
    """Indices of the inner corners of a line at which it turns back."""
    step = np.diff(points, axis=0)
    length = np.hypot(*step.T)
    cosine = (step[:-1] * step[1:]).sum(axis=1)
    return np.flatnonzero(cosine < BACK * length[:-1] * length[1:]) + 1


def swept(chains: NDArray[Any], radius: float, error: float) -> Shape:
    """What a disc sweeps along chains, within ``error``; the chains may be points."""
    pieces: list[Any] = []
    for chain in shapely.simplify(chains, error / 2).tolist():
        points = shapely.get_coordinates(chain)
        turns = _turns_back(points)
        if len(points) <= CHUNK and turns.size == 0:
            pieces.append(chain)
            continue
        for first, last in pairwise([0, *turns.tolist(), len(points) - 1]):
            stretch = points[first : last + 1]
            pieces += [
                shapely.LineString(stretch[i : i + CHUNK]) for i in range(0, len(stretch) - 1, CHUNK - 1)
            ]
    discs = shapely.buffer(np.array(pieces, dtype=object), radius, quad_segs=quarter(radius, error))
    return shapely.union_all(discs)


class Boundary:
    """The edge of a shape, ready for many questions about distance."""

    def __init__(self, shape: Shape) -> None:
        self.shape = prepared(shape)

    @cached_property
    def _edges(self) -> Chords:
        rings = shapely.get_rings(shapely.get_parts(self.shape))
        return Chords.along(*shapely.get_coordinates(rings, return_index=True))

    def distance(self, shapes: NDArray[Any], within: float | None = None) -> Array:
        """Distance (m,) of each shape to the edge, mm; inf where it is beyond ``within``."""
        return self._edges.nearest(shapes, within)

    def inside(self, shapes: NDArray[Any]) -> Ints:
        """Indices of the shapes that touch the inside."""
        return np.flatnonzero(shapely.intersects(self.shape, shapes))

    def nearest(self, shape: Any) -> tuple[float, float]:
        """The point of the edge that is nearest to one shape."""
        line = shapely.shortest_line(self.shape.boundary, shape)
        x, y = line.coords[0]
        return float(x), float(y)


__all__ = ["ROUND", "Boundary", "Shape", "closing", "grow"]
