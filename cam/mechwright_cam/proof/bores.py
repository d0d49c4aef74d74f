"""Bores are cut to size: what stays in one is no corner that cutters may leave, whichever they are."""

import math

import numpy as np
import shapely

from mechwright.contracts.part import Bore
from mechwright.tolerances import TOLERANCES
from mechwright_cam.proof.bands import bands
from mechwright_cam.proof.paths import NEAR
from mechwright_cam.proof.sweep import Sweeps
from mechwright_cam.setup.job import Job

AROUND = 64
"""So many places on the wall of a bore are looked at: it is a circle, and so is the path that makes it."""


def uncut_bores(sweeps: Sweeps, job: Job) -> tuple[float, tuple[float, float, float] | None, Bore | None]:
    """Thickest stock on a bore's wall, mm, its place and the bore; the diameter where nothing has cut."""
    worst, at, uncut = 0.0, None, None
    bores = [feature for feature in job.features if isinstance(feature, Bore)]
    turn = np.linspace(0.0, math.tau, AROUND, endpoint=False)
    ray = np.column_stack((np.cos(turn), np.sin(turn)))
    for band in bands(job) if bores else ():
        here = [
            bore
            for bore in bores
            if -bore.top >= band.top - NEAR and -(bore.top + bore.depth) <= band.bottom + NEAR
        ]
        if not here:
            continue
        wall = np.concatenate([bore.centre + bore.diameter / 2 * ray for bore in here])
        most = np.repeat([bore.diameter for bore in here], AROUND)
        places = shapely.points(wall)
        # Where it opens into something else, or beyond the stock, there is no wall.
        walled = shapely.dwithin(band.keep, places, TOLERANCES.leftover)
        thick = np.where(walled, most, 0.0)
        for group in sweeps.foot(band.bottom, job.thickness)[1]:
            thick = np.minimum(thick, group.chords.distance(wall) - group.radius)
        best = int(np.argmax(thick))
        if thick[best] > worst:
            worst, at = float(thick[best]), (float(wall[best, 0]), float(wall[best, 1]), band.bottom)
            uncut = here[best // AROUND]
    return worst, at, uncut
