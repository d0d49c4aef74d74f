"""The way of the beam's middle beside a loop: half a kerf off, in the waste, the wall on its right."""

import math

import shapely

from mechwright.arrays import Array
from mechwright.errors import GeometryError
from mechwright.geometry import Arc, Loop
from mechwright.geometry.segments import Point
from mechwright.tolerances import TOLERANCES
from mechwright_plane.arcfit import fit
from mechwright_plane.offsets import grow, polygons, rings
from mechwright_plane.path import Path, circle
from mechwright_plane.places import heading_at

FIT = TOLERANCES.arc_fit
"""Deviation of lines and arcs from the parallel, mm. With the chords of outline and parallel, 1.1 µm, and
rounding it stays below the 5 µm that the proof lets pass."""
LEAST_RADIUS = 0.005
"""A smaller circle cannot be printed with its centre, mm."""


def beam_path(loop: Loop, kerf: float, outside: bool, name: str) -> Path:
    """The closed way of the beam around a part, or along an opening from inside.

    Raises GeometryError where the kerf is wider than the opening, or than a slot in it.

    >>> from mechwright.geometry import circle as full
    >>> path = beam_path(Loop((full((0, 0), 10.0),)), 0.2, True, "disc")
    >>> round(path.length / math.tau, 6), path.cuts[0].turn  # clockwise around a part
    (10.1, -1)
    """
    first = loop.segments[0]
    half = kerf / 2 if outside else -kerf / 2
    if loop.is_circle and isinstance(first, Arc):
        radius = first.radius + half
        if radius < LEAST_RADIUS:
            hole = 2 * first.radius
            raise GeometryError(f"{name}: the kerf of {kerf:g} mm is as wide as the hole of {hole:g} mm")
        start = (first.centre[0] + radius, first.centre[1])
        return circle(first.centre, radius, start, ccw=not outside)
    return fit(beam_ring(loop, kerf, outside, name), FIT)


def beam_ring(loop: Loop, kerf: float, outside: bool, name: str) -> Array:
    """The same way as a closed polyline (n + 1, 2), of a loop that is no circle.

    Raises GeometryError as :func:`beam_path` does.
    """
    shape = grow(shapely.Polygon(loop.flatten()), kerf / 2 if outside else -kerf / 2)
    found = rings(shape, climb=outside)
    if len(found) != 1 or len(polygons(shape)) != 1:
        what = "a slot around it" if outside else "it, or a slot in it"
        raise GeometryError(f"{name}: the kerf of {kerf:g} mm is wider than {what}")
    if at := unreached(loop, found[0], kerf):
        x, y = at
        raise GeometryError(f"{name}: the kerf of {kerf:g} mm is wider than the slot at ({x:.2f}, {y:.2f})")
    return found[0]


def unreached(loop: Loop, ring: Array, kerf: float) -> Point | None:
    """A place of a loop to which a beam that runs along a ring (n, 2) does not come; None if there is none.

    In a corner of angle a it stays off by k / 2 (1 / sin(a / 2) - 1). What is deeper than the kerf is no
    corner but a slot.
    """
    points = loop.flatten()
    off = shapely.distance(shapely.points(points), shapely.LinearRing(ring))
    x, y = points[int(off.argmax())].tolist()
    return (x, y) if off.max() > 1.5 * kerf else None


def turned_to(path: Path, at: float) -> Path:
    """The closed path with its start ``at`` mm along the way."""
    before, after = path.split(at)
    return after + before if after.cuts and before.cuts else path


def onward(path: Path, way: float) -> Path:
    """The first ``way`` mm of a path."""
    return path.split(min(way, path.length))[0] if way > 0 else Path(path.start, ())


def headings(path: Path) -> tuple[float, float]:
    """Directions of travel at the start and at the end, rad."""
    return heading_at(path, 0) % math.tau, heading_at(path, -1) % math.tau
