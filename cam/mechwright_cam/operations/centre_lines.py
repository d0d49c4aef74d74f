"""Grooves as wide as a mill: its centre runs on the groove's centre line, and both walls are cut at once."""

import math

import numpy as np

from mechwright.contracts.part import OpenProfile
from mechwright.tolerances import TOLERANCES
from mechwright_cam.operations.choice import ROOMY, radius_in, usable_mills
from mechwright_cam.operations.grooves import to_and_fro
from mechwright_cam.operations.pen import Pen, levels
from mechwright_cam.plane.arcfit import fit
from mechwright_cam.plane.offsets import FIT, densified
from mechwright_cam.plane.path import Path
from mechwright_cam.setup.depths import bottom_of
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.tool import Tool

PLAY = TOLERANCES.leftover - TOLERANCES.gouge
"""A mill may be so much narrower than its groove, mm: half of it stays on either wall, and the path may be as
much off as the proof lets it."""
DENSE = 2.0
"""Distance of points on straight stretches of a centre line, mm, between which arcs are looked for."""


def groove_mill(job: Job, feature: OpenProfile) -> Tool | None:
    """The mill that cuts a groove to its width in one; None if there is none.

    Where clearing is adaptive, a narrower mill with room to turn in loops goes first.

    Raises
    ------
    ToolError
        No mill reaches the groove's bottom.
    """
    if feature.side != "on" or feature.floor_radius > 0:
        return None
    bottom = bottom_of(job, feature.top, feature.depth)
    mills = usable_mills(job, -bottom)
    if job.settings.clearing == "adaptive" and mills[-1].diameter <= ROOMY * feature.width:
        return None
    high = math.inf if bottom == job.floor else feature.depth
    gaps = [(feature.width - 2 * radius_in(mill, high), mill) for mill in mills]
    fit = [mill for gap, mill in gaps if -TOLERANCES.noise <= gap <= PLAY]
    best = min(fit, key=lambda mill: mill.nose, default=None)
    # A mill with a sharper nose makes more of the floor.
    if best is not None and any(gap > 0 and mill.nose < best.nose for gap, mill in gaps):
        return None
    return best


def grooves(job: Job) -> dict[str, Tool]:
    """The grooves that are cut in one, by name, each with its mill."""
    every = [feature for feature in job.features if isinstance(feature, OpenProfile)]
    chosen = {feature.name: groove_mill(job, feature) for feature in every}
    return {name: mill for name, mill in chosen.items() if mill is not None}


def centre_line(feature: OpenProfile, lines_per_arc: int) -> Path:
    """The way of the cutter's centre."""
    rows = [segment.flatten(TOLERANCES.flatten) for segment in feature.path]
    points = np.concatenate([rows[0], *(row[1:] for row in rows[1:])])
    return fit(densified(points, DENSE), FIT, lines_per_arc)


def write_groove(job: Job, feature: OpenProfile, pen: Pen, leave: float) -> None:
    """Write ramped passes of full width along the centre line, to and fro, and the last over the floor."""
    path = centre_line(feature, job.settings.path.lines_per_arc)
    top, bottom = -feature.top, bottom_of(job, feature.top, feature.depth)
    step_down = pen.tool.cutting[job.part.material].step_down * pen.tool.diameter
    heights = levels(top, bottom + leave, step_down)
    heights += [bottom] * (job.settings.spring_passes + (leave > 0))
    to_and_fro(pen, path, top, heights)
    pen.retract()
