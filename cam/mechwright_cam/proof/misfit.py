"""Whether a whole program is off by a constant, as where the tool is not the one that it was made for."""

import numpy as np

from mechwright_cam.proof.bands import bands
from mechwright_cam.proof.sweep import Sweep, Sweeps
from mechwright_cam.proof.wall import Wall
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.tool import ToolKind

PLACES = 400
"""Places along the walls that are asked."""
ALIKE = 0.02
"""The path is so much off the walls everywhere, within this, mm: leads, tabs and corners aside."""
MOST = 0.6
"""And at this share of the places at least."""
LARGER = 2.1
"""A path that is further off the walls than so many radii of its tool is made for another place."""
OTHER = 0.05
"""Tools differ in radius by as much at least, mm: less is wear, or what was left."""


def misfit(sweeps: Sweeps, job: Job) -> str:
    """What is wrong where the last cutter runs as far off the walls as one of another diameter; else nothing.

    Each height is asked at its foot, where it has to be cut.
    """
    for band in bands(job):
        wall, (_, groups) = Wall(band.keep), sweeps.foot(band.bottom, job.thickness)
        if not groups or wall.length == 0:
            continue
        last = max(groups, key=_last)
        x0, y0, x1, y1 = job.stock
        points, _ = wall.at(wall.stations(wall.length / PLACES))
        x, y = points.T
        points = points[(x > x0) & (x < x1) & (y > y0) & (y < y1)]
        if not len(points):
            continue
        away = last.chords.distance(points)
        usual = float(np.median(away))
        if (
            abs(usual - last.radius) < OTHER
            or usual > LARGER * last.radius
            or np.mean(np.abs(away - usual) < ALIKE) < MOST
        ):
            continue
        tool = sweeps.paths.tools[int(sweeps.paths.run.tool[last.pieces.step.max()])]
        if tool.kind is ToolKind.TAP or last.radius < tool.radius - ALIKE:
            continue  # the core of a tap is off the wall, and a point that went less deep than it should
        return (
            f"T{tool.number} ({tool.name}) of {tool.diameter:g} mm runs {usual:.3f} mm off the walls, as one "
            f"of {2 * usual:.2f} mm would: the path is made for a tool of another diameter"
        )
    return ""


def _last(group: Sweep) -> int:
    return int(group.pieces.step.max())
