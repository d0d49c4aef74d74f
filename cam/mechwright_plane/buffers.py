"""Parallel curves of polygons, without the rings that GEOS leaves, or leaves out, by mistake.

Where an opening is a little too narrow for the distance, its offset curve turns inside out and should vanish.
GEOS (3.14 and before) tells by a test that such a ring fails at times, and keeps it: as an opening, or for
shrunk shapes as a piece, all of whose points are nearer to the shape's edge than the distance. A cutter's
centre would be sent there. Of rings with few corners the same test drops true ones: an opening that is only
just wide enough would be taken for closed, and stock would stay in its middle. It does not ask rings of more
corners, so these get some on their edges.

Before all that GEOS leaves out corners of concave stretches, in order to be quick. Where an edge is shorter
than a hundredth of the distance it takes the corner at its end for none, and goes on so, backwards from
corner to corner, as long as they look concave from the far end of the next edge. If that is a long one, a
straight line over centimetres of the shape comes of it. So long edges beside short ones get points near their
ends: from those next to nothing looks concave.
"""

import math
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

THINNING = 0.01
"""GEOS leaves out corners of the shape that matter less than this part of the distance."""

SHORT = 0.0102
"""Of the distance: GEOS leaves out corners beside edges shorter than a hundredth."""
HIGH = 0.005
"""A single short edge matters from so much of its limit on: half of a ten-thousandth of the distance."""

FEW = 9
"""Rings with fewer points than this are tested by GEOS."""


def buffered(shape: Any, distance: float, quad_segs: int) -> Any:
    """The shape, or an array of lines or points, grown by ``distance``, mm, or shrunk if that is negative.

    At corners there are ``quad_segs`` chords per quarter circle.

    Examples
    --------
    A ring of 1 mm radius is closed by more than that:

    >>> ring = shapely.Point(0, 0).buffer(3).difference(shapely.Point(0, 0).buffer(1))
    >>> [len(buffered(ring, by, 16).interiors) for by in (0.5, 1.5)]
    [1, 0]

    A shape whose inscribed circle of 2.044 mm is a little wider than the distance keeps its middle:

    >>> corners = [(-2.75, 3.24), (3.26, 3.99), (3.46, 4.29), (-0.11, 8.12), (-1.66, 8.27), (-2.93, 5.09)]
    >>> [buffered(shapely.Polygon(corners), -by, 16).is_empty for by in (2.03, 2.05)]
    [False, True]
    """
    if not isinstance(shape, np.ndarray):
        if distance < 0 and shape.geom_type == "GeometryCollection":
            # Overlays leave specks of lines; shrunk they are gone, and with them there is no boundary.
            shape = _joined(np.array([p for p in shapely.get_parts(shape) if p.geom_type == "Polygon"]))
        shape = _with_corners(_with_stops(shape, distance), distance)
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


def _with_stops(shape: Any, distance: float) -> Any:
    """The same shape, with points where GEOS stops leaving out corners."""
    step = np.diff(shapely.get_coordinates(shape), axis=0)
    if (step * step).sum(axis=1).min(initial=np.inf) >= (SHORT * distance) ** 2:
        return shape
    rings, part = shapely.get_rings(shapely.get_parts(shape), return_index=True)
    points, owner = shapely.get_coordinates(rings, return_index=True)
    if not len(points):
        return shape
    inner = np.append(False, part[1:] == part[:-1])
    # Along a ring with the material on its right a concave bend is one to the left; shrunk, one to the right.
    left = np.where(shapely.is_ccw(rings) == (inner == (distance > 0)), 1.0, -1.0)
    dense, owner = _stopped(points, owner, left, SHORT * abs(distance))
    if len(dense) == len(points):
        return shape
    number = np.unique(part, return_inverse=True)[1]  # not all parts need be polygons
    pieces = shapely.polygons(shapely.linearrings(dense, indices=owner), indices=number)
    others = [piece for piece in shapely.get_parts(shape).tolist() if piece.geom_type != "Polygon"]
    return shapely.geometrycollections([*pieces, *others]) if others else _joined(pieces)


def _stopped(points: Any, owner: Any, left: Any, stop: float) -> tuple[Any, Any]:
    """Points (n, 2) of rings, and whose they are, with more of them on long edges beside short ones.

    Of the corner between the two only such matter as bend to the side that ``left`` has for the ring.
    """
    step = np.diff(points, axis=0)
    length = np.hypot(step[:, 0], step[:, 1])
    own = owner[1:] == owner[:-1]
    # The edge before the first one of a ring is its last one.
    count = np.bincount(owner)
    first = np.cumsum(count) - count
    before = np.arange(len(step)) - 1
    before[first] = first + count - 2
    cross = step[before, 0] * step[:, 1] - step[before, 1] * step[:, 0]
    concave = own & (cross * left[owner[:-1]] > 0)
    long, short = length >= 2 * stop, length < stop
    # One short edge alone matters by as much as it stands up beside the long one.
    high = cross * left[owner[:-1]] > HIGH * stop * np.maximum(length, length[before])
    chain = short[before] & short
    after = concave & long & short[before] & (high | chain[before])
    ahead = np.zeros(len(step), dtype=np.bool_)
    following = np.roll(chain, -1)
    turned = np.flatnonzero(concave & short & long[before] & (high | following))
    ahead[before[turned]] = True
    if not (after.any() or ahead.any()):
        return points, owner
    extra = []
    for edges, reach in (
        (after, stop),
        (after, 2 * stop),
        (ahead, length - 2 * stop),
        (ahead, length - stop),
    ):
        at = np.flatnonzero(edges & (length > 4 * stop))
        extra.append((at, (np.broadcast_to(reach, length.shape)[at] / length[at])))
    at = np.flatnonzero((after | ahead) & (length <= 4 * stop))
    extra.append((at, np.full(len(at), 0.5)))
    edge, share = (np.concatenate(rows) for rows in zip(*extra, strict=True))
    order = np.lexsort((share, edge))
    edge, share = edge[order], share[order]
    new = points[edge] + share[:, None] * step[edge]
    return np.insert(points, edge + 1, new, axis=0), np.insert(owner, edge + 1, owner[edge])


def _with_corners(shape: Any, distance: float) -> Any:
    """The same shape, with points on the edges of those rings that may vanish and have few corners."""
    parts = shapely.get_parts(shape)
    if distance > 0:
        parts = parts[shapely.get_num_interior_rings(parts) > 0]
    elif distance == 0 or shapely.get_num_coordinates(parts).min(initial=FEW + 1) > FEW:
        return shape
    if not parts.size or (shapely.get_num_coordinates(shapely.get_rings(parts)) > FEW).all():
        return shape
    pieces = [_dotted(piece, distance > 0) for piece in shapely.get_parts(shape).tolist()]
    if all(piece.geom_type == "Polygon" for piece in pieces):
        return _joined(np.array(pieces, dtype=object))
    return shapely.geometrycollections(pieces)


def _dotted(piece: Any, inside: bool) -> Any:
    """One piece with points on the edges of its openings, or of its outer ring, if they have few corners."""
    rings = shapely.get_rings(piece)
    if not len(rings):
        return piece
    few = (shapely.get_num_coordinates(rings) <= FEW) & ((np.arange(len(rings)) > 0) == inside)
    loops = shapely.segmentize(rings, np.where(few, shapely.length(rings) / FEW, np.inf)).tolist()
    return shapely.Polygon(loops[0], loops[1:])


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
    return np.asarray(shapely.points(points[:: max(1, len(points) // 3)]))


def _apart(points: NDArray[Any], shape: Any, distance: float, quad_segs: int) -> NDArray[np.bool_]:
    """Which points are ``distance`` away from the shape, as nearly as GEOS has it."""
    least = distance * (math.cos(math.pi / (4 * quad_segs)) - THINNING)
    return np.asarray(shapely.distance(points, shape) >= least)


def _joined(pieces: NDArray[Any]) -> Any:
    if pieces.size == 1:
        return pieces[0]
    return shapely.multipolygons(pieces) if pieces.size else shapely.Polygon()
