"""The middle lines of recesses just as wide as a mill: where its centre runs.

Where such a recess leaves the part its line runs straight on, until all of the mill is out.
"""

import math

import numpy as np
import shapely

from mechwright.arrays import Array
from mechwright_cam.operations.zone import SNUG, Zone
from mechwright_plane.arcfit import fit
from mechwright_plane.offsets import FINE, FIT, ROUGH, densified, grow, polygons
from mechwright_plane.path import Path

PAST = 0.5
"""The mill runs out of an open end by this more than its radius, mm."""
FAR = 20.0
"""A slanted mouth is looked for so many radii ahead: at 87 degrees it is as long."""


def middle_lines(zone: Zone, drawn: shapely.Geometry, radius: float, climb: bool) -> list[Path]:
    """The middle lines of a groove, ``drawn`` like this, that a mill of this radius fills."""
    free, must = zone.clear, zone.clear
    if zone.must is not None:
        # Over the edge it goes on as it is drawn, until all of the mill is out.
        must = zone.must
        free = shapely.intersection(grow(drawn, SNUG - radius), grow(must, radius + PAST, ROUGH))
    found = []
    for part in polygons(shapely.difference(free, grow(zone.keep, radius - SNUG))):
        ring = shapely.get_coordinates(part.exterior)
        if bool(shapely.is_ccw(part.exterior)) != climb:
            ring = ring[::-1]
        line = ring if part.interiors else _run_out(half(ring, radius), zone.keep, must, radius)
        thin = shapely.get_coordinates(shapely.simplify(shapely.LineString(line), FINE))
        path = fit(densified(thin, radius / 4), FIT, zone.path.lines_per_arc)
        if path.cuts:
            found.append(path)
    return found


def _run_out(line: Array, keep: shapely.Geometry, must: shapely.Geometry, radius: float) -> Array:
    """The line, longer where nothing of the part is ahead of an end: until all of the mill is out."""
    for _ in range(2):
        back = line[np.hypot(*(line - line[-1]).T) > radius / 8]
        if len(back):
            ahead = (line[-1] - back[-1]) / np.hypot(*(line[-1] - back[-1]))
            more = _ahead(line[-1], ahead, must, radius)
            end = line[-1] + (more + radius + PAST) * ahead
            way = shapely.LineString([line[-1], end])
            if more > -radius and shapely.distance(way, keep) > radius - 2 * SNUG:
                line = np.concatenate((line, end[None]))
        line = line[::-1]
    return line


def _ahead(end: Array, ahead: Array, must: shapely.Geometry, radius: float) -> float:
    """How far a shape goes on from the end of a line, as wide as a mill, mm; negative if it ends before."""
    aside = radius * np.array([-ahead[1], ahead[0]])
    strip = shapely.Polygon(
        [
            *(end - radius * ahead + aside * s for s in (1, -1)),
            *(end + FAR * radius * ahead + aside * s for s in (-1, 1)),
        ]
    )
    parts = polygons(shapely.intersection(must, strip))
    near = [part for part in parts if shapely.distance(part, shapely.Point(end)) <= radius]
    if not near:
        return -math.inf
    return float(max(((shapely.get_coordinates(part) - end) @ ahead).max() for part in near))


def half(ring: Array, radius: float) -> Array:
    """One side (m, 2) of a ring (n + 1, 2) around a sliver much longer than ``radius``, from end to end.

    >>> sliver = np.array([(0, 0), (9, 0), (9, 0.002), (0, 0.002), (0, 0)], dtype=float)
    >>> np.ptp(half(sliver, 1.0), axis=0).round(2).tolist()
    [9.0, 0.0]
    """
    line = shapely.LineString(ring)
    count = max(8, math.ceil(line.length / (radius / 8)))
    at = np.arange(count) * (line.length / count)
    points = shapely.get_coordinates(shapely.line_interpolate_point(line, at))
    # At an end the ring comes back beside itself: what is ahead stands next to what lies behind.
    gap = np.hypot(*(np.roll(points, 2, axis=0) - np.roll(points, -2, axis=0)).T)
    first = int(np.argmin(gap))
    away = np.abs((np.arange(count) - first + count // 2) % count - count // 2)
    last = int(np.argmin(np.where(away > count // 4, gap, np.inf)))
    ends = sorted(_extreme(ring, points, one) for one in (first, last))
    side = ring[:-1][ends[0] : ends[1] + 1]
    clear = np.minimum(np.hypot(*(side - side[0]).T), np.hypot(*(side - side[-1]).T)) > 4 * SNUG
    clear[[0, -1]] = True
    return np.asarray(side[clear])


def _extreme(ring: Array, points: Array, end: int) -> int:
    """The vertex of a ring that is the very end of a sliver near one of some evenly spread points."""
    inwards = points[(end + 4) % len(points)]
    vertices = ring[:-1]
    near = np.hypot(*(vertices - points[end]).T) <= np.hypot(*(points[1] - points[0]))
    return int(np.argmax(np.where(near, np.hypot(*(vertices - inwards).T), -1.0)))
