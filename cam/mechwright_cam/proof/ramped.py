"""Cuts into ramped tabs, whose upper side is no level.

Along the moves near a tab the cutter is asked, place by place, how far the highest of the tab that its disc
covers stands above its tip.
"""

import numpy as np
import shapely

from mechwright.arrays import Array
from mechwright_cam.controls.reading import Kind
from mechwright_cam.proof.gouge import Gouge
from mechwright_cam.proof.paths import NEAR, Paths
from mechwright_cam.setup.holding import Tab

SPACING = 0.005
"""Distance of the places, mm: between two of them a slope of 45 degrees rises by no more than the gouge
limit."""
MARGIN = 0.1
"""A move is looked at if its cutter comes so near to a tab, mm: more than the chords of arcs are off."""


def deepest_in_tab(paths: Paths, tab: Tab) -> Gouge | None:
    """The deepest cut of any move into a ramped tab; None if nothing touches it."""
    pieces = paths.below(tab.top - NEAR)
    radius = paths.radius[pieces.step]
    near = shapely.dwithin(tab.shape, paths.lines(pieces), radius + MARGIN)
    worst: Gouge | None = None
    for step in np.unique(pieces.step[near]).tolist():
        points, z = _places(paths, step)
        depth = tab.least_z(points, float(paths.radius[step])) - z
        # The tab's strips end where its shape does: beyond, and in openings, there is nothing to cut.
        depth[~shapely.dwithin(tab.shape, shapely.points(points), float(paths.radius[step]))] = -np.inf
        deep = int(np.argmax(depth))
        if depth[deep] > (worst.depth if worst else 0.0):
            x, y = points[deep].tolist()
            worst = Gouge(float(depth[deep]), int(step), (x, y, float(z[deep])))
    return worst


def _places(paths: Paths, step: int) -> tuple[Array, Array]:
    """Places (k, 2) and heights (k,) along one move."""
    run = paths.run
    start, end = paths.start[step], paths.end[step]
    arc = bool(run.kind[step] == Kind.ARC)
    length = abs(run.sweep[step]) * run.radius[step] if arc else float(np.hypot(*(end - start)[:2]))
    share = np.linspace(0.0, 1.0, max(2, int(np.ceil(length / SPACING)) + 1))
    z: Array = start[2] + share * (end[2] - start[2])
    if not arc:
        points: Array = start[:2] + share[:, None] * (end - start)[:2]
        return points, z
    centre = run.centre[step]
    spoke = start[:2] - centre
    angle = np.arctan2(spoke[1], spoke[0]) + run.sweep[step] * share
    return centre + np.hypot(*spoke) * np.column_stack((np.cos(angle), np.sin(angle))), z
