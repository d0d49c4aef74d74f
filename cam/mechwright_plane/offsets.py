"""Offsets of plan views, and the pieces of their rings that a cutter has to run.

Glossary
--------
ring
    A closed polyline (n + 1, 2) on which the cutter's centre keeps a constant distance from a wall, first
    point repeated. Its direction is that of climb milling: the wall on the right.
piece
    A run of a ring, open or the whole of it.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Protocol

import numpy as np
import shapely
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.tolerances import TOLERANCES
from mechwright_plane.buffers import buffered

FINE = 0.0003
"""Chord error of an offset, mm: a part of the arc-fit tolerance that does not show in its result."""
BIAS = TOLERANCES.outline + TOLERANCES.flatten
"""How far paths beside what is no wall, such as chamfers, keep off it, mm: by what path and polygon can be
wrong, so that nothing is cut deeper than the outline itself may be wrong."""
ROUGH = 0.005
"""Chord error of a roughing offset, mm, where it leaves stock: half of what its arcs may deviate."""


class Exactness(Protocol):
    """How exact a path has to be."""

    @property
    def tolerance(self) -> float:
        """How far a path may stray from the parallel of the flattened outline, mm."""


def fit_tolerance(path: Exactness) -> float:
    """What is left of the tolerance for the fit, mm, after the chords of the offset and their thinning."""
    return path.tolerance - 2 * FINE


FIT = TOLERANCES.arc_fit - 2 * FINE
"""The same for paths that finish no wall, mm."""

LEAST_CORNERS = 4
"""Of a quarter circle: fewer make corners that fitting takes for those of the drawing."""


def corners(radius: float, tolerance: float) -> int:
    """Corners per quarter circle whose chords stay within ``tolerance``."""
    if radius <= tolerance:
        return LEAST_CORNERS
    return max(LEAST_CORNERS, math.ceil(math.pi / 4 / math.acos(1 - tolerance / radius)))


def grow(shape: shapely.Geometry, distance: float, tolerance: float = FINE) -> shapely.Geometry:
    """Everything within ``distance`` (shrink if negative), arcs within ``tolerance``, mm."""
    return buffered(shape, distance, corners(abs(distance), tolerance))


def swept(room: shapely.Geometry, radius: float, tolerance: float = ROUGH) -> shapely.Geometry:
    """All of a room that a disc gets to without leaving it."""
    return grow(grow(room, -radius, tolerance), radius, tolerance)


def areas(shape: shapely.Geometry) -> shapely.Geometry:
    """The shape without the lines and points that overlays leave, and which others fail on."""
    if shape.geom_type in ("Polygon", "MultiPolygon"):
        return shape
    return shapely.union_all(polygons(shape))


def valid_shape(shape: shapely.Geometry) -> shapely.Geometry:
    """The shape as overlays take it: a buffer crosses itself now and then, by no more than rounding."""
    return shape if shapely.is_valid(shape) else areas(shapely.make_valid(shape))


def opened(shape: shapely.Geometry, width: float) -> shapely.Geometry:
    """The shape without what is thinner than twice ``width``."""
    return buffered(buffered(shape, -width, 2), width, 2)


@lru_cache(maxsize=16)
def thinned(shape: shapely.Geometry) -> shapely.Geometry:
    """The shape for roughing, within ROUGH; every layer and every mill asks for the same ones."""
    return simplified(shape, ROUGH)


def simplified(shape: shapely.Geometry, tolerance: float) -> shapely.Geometry:
    """The shape with fewer corners, its boundary within ``tolerance``.

    Watching over topology takes ten times as long, and is needed only in the rare shape whose walls come as
    near to each other: there something would be lost, and it shows in rings and area.
    """
    simple = shapely.simplify(shape, tolerance, preserve_topology=False)
    if _rings(simple) == _rings(shape) and abs(simple.area - shape.area) <= tolerance * shape.length:
        return simple
    return shapely.simplify(shape, tolerance)


def _rings(shape: shapely.Geometry) -> list[int]:
    return [1 + len(part.interiors) for part in polygons(shape)]


def filled(shape: shapely.Geometry) -> shapely.Geometry:
    """The shape with its openings closed."""
    return shapely.union_all([shapely.Polygon(part.exterior) for part in polygons(shape)])


def polygons(shape: shapely.Geometry) -> list[shapely.Polygon]:
    """The polygons of a shape, none if it is empty."""
    return [
        part
        for part in shapely.get_parts(shape)
        if part.geom_type == "Polygon" and not shapely.is_empty(part)
    ]


def without_slits(shape: shapely.Geometry, tolerance: float) -> shapely.Geometry:
    """The shape without the holes that :func:`rings` thins to nothing: no path leads through them."""
    whole = []
    for part in polygons(shape):
        kept = [ring for ring in part.interiors if len(_thinned_ring(ring, tolerance)) >= LEAST_RING]
        whole.append(part if len(kept) == len(part.interiors) else shapely.Polygon(part.exterior, kept))
    return shapely.multipolygons(whole) if len(whole) != 1 else whole[0]


LEAST_RING = 4
"""Points of the least ring: a triangle, closed."""


def _thinned_ring(ring: shapely.LinearRing, tolerance: float) -> Array:
    # Nothing but a line follows from it, so its topology need not be watched: that takes most time.
    return np.asarray(shapely.get_coordinates(shapely.simplify(ring, tolerance, preserve_topology=False)))


def rings(shape: shapely.Geometry, climb: bool, tolerance: float = FINE) -> list[Array]:
    """The rings (n + 1, 2) around and in a shape that must not be entered, thinned, in cutting direction."""
    found = []
    for part in polygons(shape):
        for number, loop in enumerate((part.exterior, *part.interiors)):
            points = _thinned_ring(loop, tolerance)
            # Wall on the right: clockwise around the part, counter-clockwise in an opening.
            if len(points) >= LEAST_RING:
                ccw = bool(shapely.is_ccw(loop))
                found.append(points if ccw == ((number > 0) == climb) else points[::-1])
    return found


def densified(ring: Array, step: float) -> Array:
    """The ring with edges of at most ``step``."""
    return np.asarray(shapely.get_coordinates(shapely.segmentize(shapely.LineString(ring), step)))


BISECTIONS = 12
"""Bisections of an edge where it leaves the room: a thousandth of the edge is exact enough."""


@dataclass(frozen=True, eq=False)
class Piece:
    """A run of the ring of order ``order``: 0 at the wall, counted away from it."""

    points: Array
    order: int

    @property
    def closed(self) -> bool:
        """Whether it is a whole ring."""
        return bool(np.all(self.points[0] == self.points[-1]))


def pieces(
    ring: Array,
    wanted: NDArray[np.bool_],
    near: NDArray[np.bool_],
    room: shapely.Geometry,
    order: int,
    around: Sequence[shapely.Geometry] = (),
) -> list[Piece]:
    """The runs of a ring (n + 1, 2), mm, densified, that have to be cut; ``order`` goes into the pieces.

    Per vertex ``wanted`` (n + 1,) tells that it cuts something, ``near`` that it is near something to cut. A
    run goes on while it is near, so that it starts and ends in the clear, and has a wanted vertex. ``room``,
    prepared, is where the centre may be; a run that leaves it ends on its edge. With shapes
    ``around``, prepared, a run ends as soon as it is out of all of them, else at the next vertex.
    """
    inside = shapely.contains_xy(room, ring[:, 0], ring[:, 1])
    go = (near & inside)[:-1]
    if go.all():
        return [Piece(ring, order)] if wanted.any() else []
    if not go.any():
        return []
    # Start at a vertex that is left out, so that no run crosses the seam; it stands at both ends.
    shift = int(np.flatnonzero(~go)[0])
    turned = [np.roll(rows[:-1], -shift, axis=0) for rows in (ring, wanted, inside)]
    points, want, inside = (np.concatenate((rows, rows[:1])) for rows in turned)
    go = np.append(np.roll(go, -shift), False)
    edges = np.diff(go.astype(int))
    found = []
    for first, last in zip(np.flatnonzero(edges == 1) + 1, np.flatnonzero(edges == -1), strict=True):
        if want[first : last + 1].any():
            # One vertex more at each end: it is clear of everything, or it is where the room ends.
            begin = _beyond(points[first::-1], inside[first::-1], around)
            end = _beyond(points[last:], inside[last:], around)
            first, last = first - begin, last + end
            before = _last_inside(points[first], points[first - 1], inside[first - 1], room)
            after = _last_inside(points[last], points[last + 1], inside[last + 1], room)
            if around:
                before = _first_outside(points[first], before, around)
                after = _first_outside(points[last], after, around)
            run = np.concatenate((before[None], points[first : last + 1], after[None]))
            found.append(Piece(run, order))
    return found


SPARE = 0.02
"""A run goes on by this much behind what it must be out of, mm: its fitted path ends as near as that."""
FARTHER = 6
"""A run may begin or end so many vertices farther away for the sake of being out of everything."""


def _beyond(points: Array, inside: NDArray[np.bool_], shapes: Sequence[shapely.Geometry]) -> int:
    """How many vertices farther along points (n, 2) a run has to go so that the next is out of the shapes.

    It is 0 where none near enough is ``inside`` the room, (n,): then more of the way would be for nothing.
    """
    for farther, (x, y) in enumerate(points[1 : FARTHER + 2]):
        if not inside[farther + 1]:
            return 0
        if not any(shapely.contains_xy(shape, x, y) for shape in shapes):
            return farther
    return 0


def _first_outside(a: Array, b: Array, shapes: Sequence[shapely.Geometry]) -> Array:
    """The first point outside some shapes on the way from a, in one of them, to b; b if that is in one."""

    def within(place: Array) -> bool:
        return any(shapely.contains_xy(shape, *place) for shape in shapes)

    if within(b):
        return b
    low, high = 0.0, 1.0
    for _ in range(BISECTIONS):
        middle = (low + high) / 2
        low, high = (middle, high) if within(a + middle * (b - a)) else (low, middle)
    return a + min(high + SPARE / max(float(np.hypot(*(b - a))), SPARE), 1.0) * (b - a)


def _last_inside(a: Array, b: Array, whole: bool, room: shapely.Geometry) -> Array:
    """The last point in the room on the way from a, which is in it, to b; b if ``whole``."""
    if whole:
        return b
    low, high = 0.0, 1.0
    for _ in range(BISECTIONS):
        middle = (low + high) / 2
        x, y = a + middle * (b - a)
        low, high = (middle, high) if shapely.contains_xy(room, x, y) else (low, middle)
    return a + low * (b - a)
