"""Loops moved by a distance: the exact parallel where there is one, else a polygon within the tolerance."""

import math
from collections.abc import Sequence

import shapely

from mechwright.errors import GeometryError
from mechwright.geometry import Arc, Loop
from mechwright.geometry.parallel import MITRE, Parallel
from mechwright.tolerances import TOLERANCES

_SAME = 6
"""Digits to which centres and radii of arcs of one circle agree, mm."""


def thickened(loop: Loop, more: float) -> Loop:
    """The loop with ``more`` mm of material on its wall, less where it is negative; material on its left.

    Segment by segment where none of them vanishes; else straight lines within the tolerance of polygons.
    Raises GeometryError where nothing is left of it, or it falls to pieces.

    >>> square = Loop.polygon([(0, 0), (4, 0), (4, 4), (0, 4)])
    >>> round(thickened(square, 0.5).area, 6), round(thickened(square.reversed(), 0.5).area, 6)
    (25.0, -9.0)
    """
    if abs(more) <= TOLERANCES.closure:
        return loop
    try:
        return Parallel(loop, -1 if more > 0 else 1).at(abs(more))
    except GeometryError:
        return _polygon(loop, more)


def _polygon(loop: Loop, more: float) -> Loop:
    outside = loop.area > 0
    region = shapely.Polygon(loop.flatten())
    moved = shapely.buffer(region, more if outside else -more, join_style="mitre", mitre_limit=MITRE)
    pieces = shapely.get_parts(moved).tolist()
    x, y = loop.segments[0].start
    if len(pieces) != 1 or pieces[0].is_empty:
        raise GeometryError(
            f"the wall at ({x:.3f}, {y:.3f}) cannot be moved by {more:g} mm: its loop falls into "
            f"{len(pieces)} pieces"
        )
    ring = shapely.simplify(pieces[0].exterior, TOLERANCES.flatten)
    found = Loop.polygon([(x, y) for x, y in ring.coords[:-1]])
    return found if (found.area > 0) == outside else found.reversed()


def thickened_each(loop: Loop, more: Sequence[float]) -> Loop:
    """The loop with ``more`` mm of material on the wall of each segment; material on its left.

    Segments that go on in one direction take the same. Raises GeometryError as :func:`thickened` does.

    >>> square = Loop.polygon([(0, 0), (4, 0), (4, 4), (0, 4)])
    >>> round(thickened_each(square, [0.5, 0.0, -0.5, 0.0]).area, 6)
    16.0
    """
    if max(more) - min(more) <= TOLERANCES.closure:
        return thickened(loop, more[0])
    return Parallel(loop, -1, tuple(more)).at(1.0)


def material_left(loop: Loop, *, opening: bool) -> Loop:
    """The loop run with the material on its left: clockwise around an opening."""
    return loop if (loop.area < 0) == opening else loop.reversed()


def rounded_by(loop: Loop) -> tuple[tuple[float, float], float] | None:
    """Centre and diameter of the circle that makes up more than half a turn of a loop, as a keyed bore has.

    >>> from mechwright.geometry import circle
    >>> rounded_by(Loop((circle((1.0, 2.0), 3.0),)))
    ((1.0, 2.0), 6.0)
    """
    turns: dict[tuple[float, float, float], float] = {}
    for segment in loop.segments:
        if isinstance(segment, Arc):
            (x, y), radius = segment.centre, segment.radius
            key = (round(x, _SAME), round(y, _SAME), round(radius, _SAME))
            turns[key] = turns.get(key, 0.0) + abs(segment.sweep)
    for (x, y, radius), turn in turns.items():
        if turn > math.pi * (1 + TOLERANCES.slack):
            return (x, y), 2 * radius
    return None
