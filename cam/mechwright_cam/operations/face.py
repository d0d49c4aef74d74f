"""Facing: a recess without walls, all over the part, is taken off in straight rows."""

import math
from functools import partial

import numpy as np
import shapely

from mechwright.contracts.details import Detail
from mechwright.contracts.finding import Finding
from mechwright.contracts.part import Feature
from mechwright_cam.operations.clearing import TIGHT
from mechwright_cam.operations.contract import Operation, Task
from mechwright_cam.operations.corners import corner_remarks
from mechwright_cam.operations.pen import Pen, levels
from mechwright_cam.operations.recess import is_recess
from mechwright_cam.operations.recess_zone import first_look, recess_zone
from mechwright_cam.operations.steps import Steps
from mechwright_cam.operations.stock import Stock
from mechwright_cam.operations.zone import CUSP, Zone
from mechwright_cam.setup.depths import floor_allowance
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.cutter import cutter
from mechwright_plane.path import line, polyline, rounded

ROW = 0.7
"""Distance of rows in cutter diameters: the edge that leaves the work then still cuts with its side."""
PAST = 1.0
"""The cutter runs out so far past the part, mm, before it turns to the next row."""


class Face(Operation):
    """Takes a face off in rows, to and fro."""

    name = "face"

    def claim(self, feature: Feature | Detail, job: Job) -> Task | None:
        """A recess beside which nothing of the part stands."""
        if not is_recess(feature):
            return None
        _, shapes = first_look(job, feature)
        if not shapes.open or shapely.is_empty(shapes.must) or not shapely.is_empty(shapes.keep):
            return None
        zone = recess_zone(job, feature)
        region = shapely.intersection(zone.clear, shapely.box(*job.stock))
        return Task(feature, self, zone.tools, zone.top, zone.bottom, region, data=zone)

    def cut(self, task: Task, stock: Stock, steps: Steps) -> Stock:
        """Level by level, with the largest mill."""
        zone: Zone = task.data
        mill, plate = zone.mills[0], shapely.box(*steps.job.stock)
        leave = floor_allowance(steps.job, zone.top, zone.bottom)
        write = partial(face, zone, stock=plate, step_down=steps.step_down(mill), leave=leave)
        steps.add(f"{zone.name}: face", mill, write)
        return stock.without(task.region)

    def remarks(self, task: Task, job: Job) -> list[Finding]:
        """What its mills do not reach."""
        return corner_remarks(task.data, job)


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
        pen.enter(first, above, z, clear)
        pen.follow(path)
        above = z
    pen.retract()
