"""The way of a wire: net contours, start holes, passes forth and back, and the tab that holds to the last.

The control moves the wire aside, by D; the contour is that of the part. It is made of the parallel at the
largest D, so that the control finds no corner too narrow.
"""

import math

import numpy as np
import shapely

from mechwright.errors import GeometryError
from mechwright.geometry import Arc, Loop
from mechwright.geometry.segments import Point
from mechwright_cut.cuts import Role, WireContour, WirePass
from mechwright_cut.jobs import BESIDE, CutJob, target
from mechwright_cut.paths.entries import working
from mechwright_cut.paths.parallels import FIT, headings, turned_to, unreached
from mechwright_plane.contour import offset_contour
from mechwright_plane.offsets import grow, polygons, rings
from mechwright_plane.path import Path, circle, line, printed
from mechwright_plane.places import candidates

NARROW = 0.5
"""In a small opening the start hole stands in the middle, and keeps at least so far off, mm."""
LEAST_DRILL = 0.3
"""Least start hole that is drilled, or eroded by a starter, mm."""
OFF = 3.0
"""The wire leaves the wall by so many of the largest D between two passes."""
LEFT, RIGHT = 41, 42
"""G words with the wire on the left of its way, and on the right."""


def wire_contours(job: CutJob) -> list[WireContour]:
    """All contours of a sheet: openings before outsides, small before large.

    Raises GeometryError where one cannot be cut.
    """
    kept = shapely.union_all([target(piece) for piece in job.pieces])
    shapely.prepare(kept)
    rows: list[tuple[bool, float, Loop, str]] = []
    for piece in job.pieces:
        for number, loop in enumerate(piece.outline.inner, start=1):
            rows.append((False, abs(loop.area), loop, f"{piece.label} opening {number}"))
        rows.append((True, piece.outline.outer.area, piece.outline.outer, f"{piece.label} outside"))
    rows.sort(key=lambda row: (row[0], round(row[1], 6)))
    return [
        _contour(job, loop, "outside" if outer else "inside", name, kept) for outer, _, loop, name in rows
    ]


def net_contour(loop: Loop, reach: float, outside: bool, name: str) -> Path:
    """The contour of a wall, run with the wall on its right; parallels up to ``reach`` mm exist.

    Raises GeometryError where the wire does not go into an opening or a slot.
    """
    first = loop.segments[0]
    if loop.is_circle and isinstance(first, Arc):
        if not outside and first.radius <= reach:
            raise GeometryError(
                f"{name}: the wire needs {2 * reach:g} mm, and the hole has {2 * first.radius:g}"
            )
        start = (first.centre[0] + first.radius, first.centre[1])
        return circle(first.centre, first.radius, start, ccw=not outside)
    shape = grow(shapely.Polygon(loop.flatten()), reach if outside else -reach)
    found = rings(shape, climb=outside)
    if len(found) != 1 or len(polygons(shape)) != 1:
        raise GeometryError(f"{name}: the wire needs {2 * reach:g} mm, and a slot is narrower")
    if at := unreached(loop, found[0], 2 * reach):
        x, y = at
        raise GeometryError(
            f"{name}: the wire needs {2 * reach:g} mm, and the slot at ({x:.2f}, {y:.2f}) has less"
        )
    return offset_contour(found[0], reach, 1, FIT)


def _contour(job: CutJob, loop: Loop, role: Role, name: str, kept: shapely.Geometry) -> WireContour:
    settings = job.settings
    registers = settings.registers(job.kerf.width)
    whole = net_contour(loop, registers[0], role == "outside", name)
    room = settings.start_hole / 2 + BESIDE
    if role == "inside":
        hole, at = _inside(whole, loop, settings.start_hole / 2 + NARROW, name)
    else:
        hole, at = _outside(job, whole, loop, room, kept, name)
    ring = turned_to(whole, at)
    main, tab = ring.split(ring.length - min(settings.tab, ring.length / 4))
    return _passed(name, role, hole, main, tab, OFF * registers[0], len(registers))


def widest_circle(loop: Loop) -> shapely.LineString:
    """From the middle of the widest circle in an opening to its wall."""
    return shapely.maximum_inscribed_circle(shapely.Polygon(loop.flatten()))


def _inside(whole: Path, loop: Loop, room: float, name: str) -> tuple[Point, float]:
    """The middle of an opening, and the place on its contour that is next to it."""
    widest = widest_circle(loop)
    if widest.length < room:
        raise GeometryError(f"{name}: a start hole needs {2 * room:g} mm across, and it has less")
    x, y = shapely.get_coordinates(widest)[0].tolist()
    ways, points, _ = candidates(whole)
    order = np.lexsort((np.round(np.hypot(*(points - (x, y)).T), 6), working(loop, points)))
    return printed((x, y)), float(ways[order[0]])


def _outside(
    job: CutJob, whole: Path, loop: Loop, room: float, kept: shapely.Geometry, name: str
) -> tuple[Point, float]:
    """A place in the waste beside the contour, square to it, clear of every part."""
    ways, points, angles = candidates(whole)
    able = ~working(loop, points)
    sheet = shapely.buffer(shapely.box(0, 0, *job.size), -job.settings.start_hole)
    for number in np.flatnonzero(able).tolist():
        heading = float(angles[number])
        x, y = points[number].tolist()
        hole = printed((x - room * math.sin(heading), y + room * math.cos(heading)))
        if not shapely.contains_xy(sheet, *hole):
            continue
        if shapely.distance(shapely.Point(hole), kept) >= room - 1e-3:
            return hole, float(ways[number])
    raise GeometryError(f"{name}: there is no room for a start hole beside it; set a greater cut.sheet.gap")


def _passed(name: str, role: Role, hole: Point, main: Path, tab: Path, off: float, count: int) -> WireContour:
    """Passes forth and back along all but the tab, and the tab from where they end."""
    begin, end = _beside(main.start, hole, off), _aside(main, off)
    passes, here = [], hole
    for number in range(1, count + 1):
        forth = number % 2 == 1
        way, leave = (main, end) if forth else (main.reversed(), begin)
        passes.append(WirePass(LEFT if forth else RIGHT, number, _led(here, way, leave)))
        here = leave
    if count % 2:
        last = WirePass(LEFT, count, _led(end, tab, begin))
    else:
        last = WirePass(RIGHT, count, _led(begin, tab.reversed(), end))
    return WireContour(name, role, hole, tuple(passes), last)


def _led(begin: Point, way: Path, leave: Point) -> Path:
    return Path(begin, (line(begin, way.start), *way.cuts, line(way.end, leave)))


def _beside(start: Point, hole: Point, off: float) -> Point:
    """On the way from the contour to the start hole, which the first pass has cut."""
    far = math.dist(start, hole)
    share = min(off / far, 1.0)
    return printed((start[0] + share * (hole[0] - start[0]), start[1] + share * (hole[1] - start[1])))


def _aside(main: Path, off: float) -> Point:
    """Square to the contour where the tab begins, in the waste on its left."""
    _, heading = headings(main)
    x, y = main.end
    return printed((x - off * math.sin(heading), y + off * math.cos(heading)))
