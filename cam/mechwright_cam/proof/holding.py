"""What holds the part when everything is cut, and what does not hold at all."""

import numpy as np
import shapely

from mechwright_cam.job import Job
from mechwright_cam.proof.bands import stock_shape
from mechwright_cam.proof.leftover import ROUNDING, sweeps
from mechwright_cam.proof.paths import NEAR, Geometries, Paths
from mechwright_cam.proof.plane import grow
from mechwright_cam.proof.report import Check

ROUGHLY = 0.02
"""Accuracy of the areas here, mm: a bridge thinner than that holds nothing."""
JAMS = 1.0
"""A loose piece wider than this is worth a remark, mm: it can be caught between cutter and part."""


def holding(paths: Paths, job: Job) -> tuple[Check, list[str]]:
    """Whether the tabs join the part to a frame, and remarks on pieces that come loose.

    At the underside, what is left of the plate falls into pieces. Without the tabs and the scraps beside
    them, the piece at the outer end of each has to be one that another tab ends in as well: that is a frame.
    """
    plate = stock_shape(job)
    swept = []
    cut = sweeps(paths, -job.thickness + ROUNDING, -job.thickness)
    for sweep in cut:
        thin = shapely.simplify(sweep.chains, ROUGHLY)
        swept += np.atleast_1d(grow(thin, sweep.radius, ROUGHLY)).tolist()
    scrap = max((sweep.radius for sweep in cut), default=0.0)  # the round end of a cut beside a tab
    tabs = [grow(tab.shape, scrap, ROUGHLY) for tab in job.tabs]
    pieces = shapely.get_parts(shapely.difference(plate, shapely.union_all([*swept, *tabs])))
    of_part = shapely.intersects(pieces, job.target.representative_point())
    others = pieces[~of_part]
    ends = np.array([shapely.dwithin(others, tab, ROUGHLY) for tab in tabs]).reshape(len(tabs), len(others))
    frame = ends.sum(axis=0) >= 2
    free = [number for number, row in enumerate(ends) if not (row & frame).any()]
    if free:
        x, y = tabs[free[0]].centroid.coords[0]
        message = (
            f"the tab at X{x:.1f} Y{y:.1f} leads to no frame: the cut around the part leaves none; "
            "give the stock a larger margin"
        )
        return Check("holding", False, message), []
    how = "the tabs join the part to the frame" if tabs else "the part is held by a clamp or from below"
    return Check("holding", True, how), _remarks(others[shapely.distance(others, plate.exterior) > NEAR])


def _remarks(loose: Geometries) -> list[str]:
    wide = loose[~shapely.is_empty(shapely.buffer(loose, -JAMS / 2, quad_segs=4))]
    return [
        f"a piece of {piece.area:.1f} mm² comes loose at X{at.x:.1f} Y{at.y:.1f}; stop to take it out"
        for piece, at in zip(wide.tolist(), shapely.point_on_surface(wide).tolist(), strict=True)
    ]
