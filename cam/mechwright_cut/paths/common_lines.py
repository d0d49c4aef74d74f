"""The ways of a beam where parts share edges: the common lines first, then what is left around each part.

While a common line is cut both of its parts hang in the sheet. What is left around a part begins and ends in
the cut of a common line, and runs away from its neighbour: nothing is pierced there, and nothing overcut.
"""

import math
from collections.abc import Sequence

import numpy as np
import shapely

from mechwright.arrays import Array
from mechwright.errors import GeometryError
from mechwright.geometry.segments import Point
from mechwright_cut.cuts import Contour
from mechwright_cut.jobs import PIERCE, CommonLine, CutJob, lead_radius, target
from mechwright_cut.paths.entries import Waste
from mechwright_cut.paths.parallels import FIT, beam_ring
from mechwright_plane.arcfit import fit
from mechwright_plane.path import polyline

LEADS = (1.0, 0.6, 1.5, 2.0, 3.0)
"""Shares of the radius of leads by which a common line begins before the parts."""
UNSHARED = "set cut.common_lines = false"
"""What helps wherever edges cannot be shared."""


def common_contours(job: CutJob, waste: Waste) -> list[Contour]:
    """The common lines of a sheet; raises GeometryError where there is no room to pierce before one."""
    return [_common(job, one, waste) for one in job.common]


def outside_contour(job: CutJob, number: int, lines: Sequence[CommonLine]) -> Contour:
    """What is cut around a piece besides its common lines."""
    piece = job.pieces[number]
    name, loop = f"{piece.label} outside", piece.outline.outer
    ring = beam_ring(loop, job.kerf.width, True, name)
    inside = target(piece).centroid
    ways = [_along(*one.of(number), (inside.x, inside.y)) for one in lines]
    strokes = tuple(fit(points, FIT) for points in _between(ring, ways))
    return Contour(name, "outside", tuple(one for one in strokes if one.cuts), opened=True)


def _along(start: Point, end: Point, inside: Point) -> tuple[Point, Point]:
    """The ends of a line in the order in which a ring passes them that has the part on its right."""
    (x0, y0), (x1, y1), (x, y) = start, end, inside
    return (start, end) if (x1 - x0) * (y - y0) - (y1 - y0) * (x - x0) < 0 else (end, start)


def _between(ring: Array, ways: Sequence[tuple[Point, Point]]) -> list[Array]:
    """The stretches (n, 2) of a closed ring between lines on it, each from the end of one to the next."""
    whole = shapely.LineString(ring)
    places = [[shapely.line_locate_point(whole, shapely.Point(point)) for point in way] for way in ways]
    order = sorted(range(len(ways)), key=lambda k: places[k][1])
    found = []
    for one, two in zip(order, [*order[1:], order[0]], strict=True):
        begin, end = places[one][1], places[two][0]
        points = _stretch(ring, begin, end)
        found.append(np.vstack((ways[one][1], points, ways[two][0])))
    return found


def _stretch(ring: Array, begin: float, end: float) -> Array:
    """The corners of a closed ring between two places along it, mm; past its start if ``end`` comes first."""
    steps = np.hypot(*np.diff(ring, axis=0).T)
    along = np.concatenate(([0.0], np.cumsum(steps)[:-1]))
    length = float(steps.sum())
    past = (along - begin) % length
    able = np.flatnonzero((past > FIT) & (past < (end - begin) % length - FIT))
    points: Array = ring[:-1][able[np.argsort(past[able])]]
    return points


def _common(job: CutJob, one: CommonLine, waste: Waste) -> Contour:
    """The line from the end with more room, on which it is pierced, to past the other one."""
    first, second = (job.pieces[number].label for number in one.pieces)
    name = f"{first} and {second} common line"
    ends = one.whole
    begins = [_begin(job, end, other, waste) for end, other in (ends, ends[::-1])]
    able = [(room, k, begin) for k, (room, begin) in enumerate(begins) if begin is not None]
    if not able:
        raise GeometryError(f"{name}: there is no room to pierce before it; {UNSHARED}")
    _, k, begin = max(able, key=lambda row: (round(row[0], 3), -row[1]))
    start, end = ends[:: 1 - 2 * k]
    past = _beyond(end, start, job.settings.overcut)
    if not waste.takes(np.array([end, past])):
        past = end
    return Contour(name, "common", (polyline([begin, past]),))


def _begin(job: CutJob, end: Point, other: Point, waste: Waste) -> tuple[float, Point | None]:
    """A place on the line, before an end of it, with room to pierce; and its distance from the walls, mm."""
    for share in LEADS:
        at = _beyond(end, other, share * lead_radius(job.settings, job.kerf.width))
        room = waste.room(at)
        if room >= PIERCE * job.kerf.width and waste.takes(np.array([at, end])):
            return room, at
    return 0.0, None


def _beyond(end: Point, other: Point, way: float) -> Point:
    """So far on from an end of a line, mm, off its other end."""
    share = way / math.dist(end, other)
    return end[0] + share * (end[0] - other[0]), end[1] + share * (end[1] - other[1])
