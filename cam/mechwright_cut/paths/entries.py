"""Where a contour begins, and the way in and out: in the waste, off flanks, clear of every other piece."""

import math
from collections.abc import Sequence

import numpy as np
import shapely
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.errors import GeometryError
from mechwright.geometry import Loop
from mechwright.geometry.segments import Point
from mechwright_cut.cuts import WORKING
from mechwright_cut.jobs import PIERCE
from mechwright_cut.paths.parallels import headings, onward, turned_to
from mechwright_plane.leads import half_circles
from mechwright_plane.path import Path, arc, line, printed
from mechwright_plane.places import candidates

SHORTER = (1.0, 0.6, 0.4, 0.25, 0.15)
"""Leads are tried in these shares of the wanted radius, the roomy ones first."""
CLOSE = 1e-3
"""A lead may come nearer to a wall than half the kerf by so much, mm, where it meets the contour."""
STEPS = 12
"""Pieces of a lead that is looked at."""


class Waste:
    """Where a beam may go in: the sheet without what is kept.

    Parameters
    ----------
    kept
        All pieces on the sheet, mm.
    sheet
        The sheet.
    kerf
        mm.
    """

    def __init__(self, kept: shapely.Geometry, sheet: shapely.Polygon, kerf: float) -> None:
        self.kept, self.half = kept, kerf / 2
        self._rim = shapely.buffer(sheet, -kerf)
        shapely.prepare(self.kept)
        shapely.prepare(self._rim)

    def takes(self, points: Array) -> bool:
        """Whether the beam may cut along points (n, 2): it leaves walls alone and stays on the sheet."""
        way = shapely.LineString(points)
        if not shapely.covers(self._rim, way):
            return False
        return not shapely.dwithin(way, self.kept, self.half - CLOSE)

    def room(self, at: Point) -> float:
        """Distance of a point from every wall, mm."""
        return float(shapely.distance(shapely.Point(at), self.kept))


def working(loop: Loop, points: Array) -> NDArray[np.bool_]:
    """Whether points (n, 2) are beside a segment that works; all False where all of the loop does."""
    lines = [shapely.LineString(segment.flatten(0.01)) for segment in loop.segments]
    flags = np.array([segment.tag in WORKING for segment in loop.segments])
    if flags.all() or not flags.any() or not len(points):
        return np.zeros(len(points), dtype=bool)
    nearest = shapely.STRtree(lines).nearest(shapely.points(points))
    found: NDArray[np.bool_] = flags[nearest]
    return found


def entered(path: Path, loop: Loop, waste: Waste, radius: float, overcut: float, name: str) -> Path:
    """The closed path with a way in, a way past its start, and a way out.

    Of all places the roomiest is taken that is beside no working segment. Raises GeometryError where there is
    no room to pierce.
    """
    ways, points, angles = candidates(path)
    able = np.flatnonzero(~working(loop, points))
    for share in SHORTER:
        rho = share * radius
        best: tuple[float, int] | None = None
        for number in able.tolist():
            lead = _quarter(_point(points[number]), float(angles[number]), rho, -1)
            room = waste.room(_point(lead[0]))
            if room < 2 * PIERCE * waste.half or not waste.takes(lead):
                continue
            rated = (-round(min(room, 4 * radius), 3), number)
            best = rated if best is None else min(best, rated)
        if best is not None:
            return _led(path, float(ways[best[1]]), rho, waste, overcut)
    return _from_middle(path, loop, waste, overcut, name)


def _point(row: Array) -> Point:
    return float(row[0]), float(row[1])


def _quarter(place: Point, heading: float, rho: float, way: int) -> Array:
    """Points of a quarter of a circle on the left of the contour, in order of travel; ``way`` -1 leads in."""
    a = np.linspace(0.0, math.pi / 2, STEPS + 1)[:, None]
    along = np.array((math.cos(heading), math.sin(heading)))
    left = np.array((-along[1], along[0]))
    points: Array = np.array(place) + rho * (way * np.sin(a) * along + (1 - np.cos(a)) * left)
    return points[::-1] if way < 0 else points


def _left(place: Point, heading: float, rho: float) -> Point:
    return place[0] - rho * math.sin(heading), place[1] + rho * math.cos(heading)


def _led(path: Path, at: float, rho: float, waste: Waste, overcut: float) -> Path:
    whole = turned_to(path, at)
    heading, _ = headings(whole)
    begin = printed(_point(_quarter(whole.start, heading, rho, -1)[0]))
    into = Path(begin, (arc(begin, whole.start, _left(whole.start, heading, rho), 1),))
    return into + _out(whole, rho, waste, overcut)


def _out(whole: Path, rho: float, waste: Waste, overcut: float) -> Path:
    """The closed path, past its start, and off the wall where there is room."""
    done = whole + onward(whole, overcut)
    _, heading = headings(done)
    off = _quarter(done.end, heading, rho / 2, 1)
    if not waste.takes(off):
        return done
    end = printed(_point(off[-1]))
    return done + Path(done.end, (arc(done.end, end, _left(done.end, heading, rho / 2), 1),))


def _from_middle(path: Path, loop: Loop, waste: Waste, overcut: float, name: str) -> Path:
    """From the middle of a small opening: on half a circle in a round one, else straight to a near place."""
    opening = shapely.Polygon(loop.flatten())
    if loop.area > 0:
        raise GeometryError(f"{name}: there is no room for a lead beside it; set a greater cut.sheet.gap")
    if loop.is_circle:
        into, _ = half_circles((opening.centroid.x, opening.centroid.y), path)
        if waste.takes(into.points(waste.half / 4)):
            return into + path + onward(path, min(overcut, path.length / 2))
    begin = printed(_point(shapely.get_coordinates(shapely.maximum_inscribed_circle(opening))[0]))
    ways, points, _ = candidates(path)
    for number in np.lexsort((np.hypot(*(points - begin).T), working(loop, points))).tolist():
        whole = turned_to(path, float(ways[number]))
        if math.dist(begin, whole.start) > CLOSE and waste.takes(np.array([begin, whole.start])):
            return Path(begin, (line(begin, whole.start),)) + whole + onward(whole, overcut)
    raise GeometryError(f"{name}: there is no room to pierce in it; make it larger")


def joint_places(path: Path, loop: Loop, count: int, gap: float) -> list[float]:
    """Ways along a closed path at which micro-joints begin, spread, beside no working segment.

    Raises GeometryError where there is no room for them.
    """
    ways, points, _ = candidates(path)
    free = ways[~working(loop, points)]
    free = free[(free > 3 * gap) & (free < path.length - 6 * gap)]
    found: list[float] = []
    for number in range(count):
        wanted = (number + 0.5) / count * path.length
        able = [at for at in free.tolist() if all(abs(at - other) > 3 * gap for other in found)]
        if not able:
            raise GeometryError(f"there is room for {len(found)} micro-joints, and not for {count}")
        found.append(min(able, key=lambda at: abs(at - wanted)))
    return sorted(found)


def divided(path: Path, places: Sequence[float], gap: float) -> list[Path]:
    """The stretches of a path between micro-joints, each ``gap`` mm of the way long."""
    found, left, done = [], path, 0.0
    for at in places:
        before, rest = left.split(at - done)
        _, left = rest.split(gap)
        found.append(before)
        done = at + gap
    return [one for one in (*found, left) if one.cuts]
