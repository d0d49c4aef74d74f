"""Cuts into ramped tabs, whose upper side is no level.

Along the moves near a tab the cutter is asked, place by place, how far the highest of the tab that its disc
covers stands above its tip.
"""

import numpy as np
import shapely

from mechwright_cam.proof.gouge import Gouge
from mechwright_cam.proof.paths import NEAR, Paths
from mechwright_cam.setup.holding import Tab

RAMP_SPACING = 0.005
"""Distance of the places, mm: between two of them a slope of 45 degrees rises by no more than the gouge
limit."""
RAMP_MARGIN = 0.1
"""A move is looked at if its cutter comes so near to a tab, mm: more than the chords of arcs are off."""


def deepest_in_tab(paths: Paths, tab: Tab) -> Gouge | None:
    """The deepest cut of any move into a ramped tab; None if nothing touches it."""
    pieces = paths.below(tab.top - NEAR)
    radius = paths.radius[pieces.step]
    near = shapely.dwithin(tab.shape, paths.lines(pieces), radius + RAMP_MARGIN)
    worst: Gouge | None = None
    for step in np.unique(pieces.step[near]).tolist():
        points, z, _ = paths.samples(np.array([step]), RAMP_SPACING)
        depth = tab.least_z(points, float(paths.radius[step])) - z
        # The tab's strips end where its shape does: beyond, and in openings, there is nothing to cut.
        depth[~shapely.dwithin(tab.shape, shapely.points(points), float(paths.radius[step]))] = -np.inf
        deep = int(np.argmax(depth))
        if depth[deep] > (worst.depth if worst else 0.0):
            x, y = points[deep].tolist()
            worst = Gouge(float(depth[deep]), int(step), (x, y, float(z[deep])))
    return worst
