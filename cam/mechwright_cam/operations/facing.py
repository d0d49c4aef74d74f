"""Facing: a recess without walls, all over the part, is taken off in straight rows."""

import math

import numpy as np
import shapely

from mechwright_cam.operations.clearing import TIGHT
from mechwright_cam.operations.pen import Pen, levels
from mechwright_cam.operations.zone import CUSP, Zone
from mechwright_cam.plane.path import line, polyline, rounded
from mechwright_cam.shop.cutter import cutter

ROW = 0.7
"""Distance of rows in cutter diameters: the edge that leaves the work then still cuts with its side."""
PAST = 1.0
"""The cutter runs out so far past the part, mm, before it turns to the next row."""


def is_face(zone: Zone) -> bool:
    """Whether nothing of the part stands beside the zone."""
    return zone.must is not None and bool(shapely.is_empty(zone.keep))


def face(zone: Zone, pen: Pen, stock: shapely.Polygon, step_down: float, leave: float) -> None:
    """Write the rows to and fro, level by level; entered beside the stock, or by a ramp along a row.

    The last level takes what is left on the floor, ``leave`` mm.
    """
    radius = pen.tool.radius
    x0, y0, x1, y1 = zone.must.bounds if zone.must is not None else stock.bounds
    wide = min(ROW * pen.tool.diameter, 2 * TIGHT * 2 * float(cutter(pen.tool).radius_at(CUSP)))
    count = math.ceil((y1 - y0) / wide)
    rows = y0 + (np.arange(count) + 0.5) * (y1 - y0) / count
    left, right = x0 - radius - PAST, x1 + radius + PAST
    points = []
    for number, y in enumerate(rows.tolist()):
        points += [(left, y), (right, y)] if number % 2 == 0 else [(right, y), (left, y)]
    path = polyline(points)
    clear = shapely.distance(stock, shapely.Point(path.start)) > radius
    first = type(path)(path.start, (line(path.start, (path.cuts[0].x, path.cuts[0].y)),))
    above = zone.top
    heights = levels(zone.top, zone.bottom + leave, step_down)
    for z in heights if leave == 0 else [*heights, rounded(zone.bottom)]:
        pen.above(path.start)
        if clear:
            pen.sink(z)
        else:
            pen.sink(above)
            pen.ramp(first, z)
        pen.follow(path)
        above = z
    pen.retract()
