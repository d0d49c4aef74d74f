"""Parallel curves of polygons, without the rings that GEOS leaves by mistake.

Where an opening is a little too narrow for the distance, its offset curve turns inside out and should vanish.
GEOS (3.14 and before) tells by a test that such a ring fails at times, and keeps it: as an opening, or for
shrunk shapes as a piece, all of whose points are nearer to the shape's edge than the distance. A cutter's
centre would be sent there.
"""

import math
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

THINNING = 0.01
"""GEOS leaves out corners of the shape that matter less than this part of the distance."""


def buffered(shape: Any, distance: float, quad_segs: int) -> Any:
    """The shape grown by ``distance``, mm, or shrunk if that is negative.

    Parameters
    ----------
    shape
        A geometry, or an array of lines or points.
    distance
        mm.
    quad_segs
        Chords per quarter circle at corners.

    Examples
    --------
    A ring of 1 mm radius is closed by more than that:

    >>> ring = shapely.Point(0, 0).buffer(3).difference(shapely.Point(0, 0).buffer(1))
    >>> [len(buffered(ring, by, 16).interiors) for by in (0.5, 1.5)]
    [1, 0]
    """
    grown = shapely.buffer(shape, distance, quad_segs=quad_segs)
    if isinstance(shape, np.ndarray):
        return grown  # of lines, which have no inside to turn out
    if distance > 0 and shapely.get_num_interior_rings(shapely.get_parts(grown)).any():
        return _without_false_openings(grown, shape, distance, quad_segs)
    if distance < 0:
        pieces = shapely.get_parts(grown)
        true = _apart(shapely.point_on_surface(pieces), shapely.boundary(shape), -distance, quad_segs)
        return grown if true.all() else _joined(pieces[true])
    return grown


def _without_false_openings(grown: Any, shape: Any, distance: float, quad_segs: int) -> Any:
    pieces = []
    for piece in shapely.get_parts(grown).tolist():
        rings = list(piece.interiors)
        kept = [ring for ring in rings if _apart(_corners(ring), shape, distance, quad_segs).all()]
        pieces.append(piece if len(kept) == len(rings) else shapely.Polygon(piece.exterior, kept))
    return _joined(np.array(pieces, dtype=object))


def _corners(ring: Any) -> NDArray[Any]:
    """A few corners of a ring: of a true one every corner is far enough, of a false one none."""
    points = shapely.get_coordinates(ring)
    found: NDArray[Any] = shapely.points(points[:: max(1, len(points) // 3)])
    return found


def _apart(points: NDArray[Any], shape: Any, distance: float, quad_segs: int) -> NDArray[np.bool_]:
    """Which points are ``distance`` away from the shape, as nearly as GEOS has it."""
    least = distance * (math.cos(math.pi / (4 * quad_segs)) - THINNING)
    apart: NDArray[np.bool_] = shapely.distance(points, shape) >= least
    return apart


def _joined(pieces: NDArray[Any]) -> Any:
    if pieces.size == 1:
        return pieces[0]
    return shapely.multipolygons(pieces) if pieces.size else shapely.Polygon()
