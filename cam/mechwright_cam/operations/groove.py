"""Grooves just as wide as a mill: its centre runs along their middle, and both walls are cut at once.

There is no room for an allowance, a lead or a second cut: the mill goes down on a ramp along the groove, to
and fro, or round and round where the groove is closed in itself. An open profile says where its middle is; of
any other recess it is found, see :mod:`mechwright_cam.operations.middle_lines`.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
import shapely

from mechwright.contracts.details import Detail
from mechwright.contracts.finding import Finding
from mechwright.contracts.part import Feature, OpenProfile
from mechwright.errors import ToolError
from mechwright.tolerances import TOLERANCES
from mechwright_cam.operations.choice import ROOMY, radius_in, usable_mills
from mechwright_cam.operations.compensation import check_compensated
from mechwright_cam.operations.contract import Operation, Task
from mechwright_cam.operations.corners import corner_remarks
from mechwright_cam.operations.layer import Layer
from mechwright_cam.operations.middle_lines import middle_lines
from mechwright_cam.operations.pen import Pen, levels
from mechwright_cam.operations.recess import is_recess, plan_view
from mechwright_cam.operations.recess_zone import first_look, floor_mill, floor_radius, recess_zone
from mechwright_cam.operations.steps import Steps
from mechwright_cam.operations.stock import Stock
from mechwright_cam.operations.zone import SNUG, Zone
from mechwright_cam.setup.depths import bottom_of, floor_allowance
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.tool import Tool
from mechwright_plane.arcfit import fit
from mechwright_plane.offsets import FIT, densified
from mechwright_plane.path import Path

PLAY = TOLERANCES.leftover - TOLERANCES.gouge
"""A mill may be so much narrower than its groove, mm: half of it stays on either wall, and the path may be as
much off as the proof lets it."""
DENSE = 2.0
"""Distance of points on straight stretches of a centre line, mm, between which arcs are looked for."""


@dataclass(frozen=True)
class Way:
    """The way of the mill along a groove that is drawn as one."""

    path: Path


class Groove(Operation):
    """Cuts a groove in ramped passes of full width."""

    name = "groove"

    def claim(self, feature: Feature | Detail, job: Job) -> Task | None:
        """Open profiles as wide as a mill, and recesses as wide as the mill for their fillet."""
        if isinstance(feature, OpenProfile):
            mill = groove_mill(job, feature)
            if mill is not None:
                top, bottom = -feature.top, bottom_of(job, feature.top, feature.depth)
                way = Way(centre_line(feature, job.settings.path.lines_per_arc))
                return Task(feature, self, (mill,), top, bottom, plan_view(feature), data=way)
        if not is_recess(feature) or floor_radius(feature) == 0:
            return None
        mills, shapes = first_look(job, feature)
        if shapely.is_empty(shapes.must):
            return None
        mill, fills = floor_mill(job, feature, mills, shapes)
        if not fills:
            return None
        zone = recess_zone(job, feature, filler=mill)
        return Task(feature, self, (mill,), zone.top, zone.bottom, zone.clear, data=zone)

    def choose(self, feature: Feature | Detail, every: Job, chosen: Sequence[Tool]) -> Sequence[Tool] | None:
        """The mill of an open profile's width."""
        mill = groove_mill(every, feature) if isinstance(feature, OpenProfile) else None
        return None if mill is None else [mill]

    def cut(self, task: Task, stock: Stock, steps: Steps) -> Stock:
        """Along the middle, the floor in a pass of its own where an allowance is left on it."""
        (mill,), job = task.tools, steps.job
        step_down, springs = steps.step_down(mill, to_size=True), job.settings.spring_passes
        if isinstance(task.data, Way):
            leave = floor_allowance(job, task.top, task.bottom)
            heights = levels(task.top, task.bottom + leave, step_down)
            heights += [task.bottom] * (springs + (leave > 0))
            write = partial(to_and_fro, paths=[task.data.path], top=task.top, heights=heights)
            steps.add(f"{task.feature.name}: slot", mill, write)
            return stock.without(task.region)
        zone: Zone = task.data
        check_compensated(job, zone, mill, fills=True)
        heights = levels(zone.top, zone.bottom, step_down)
        heights += heights[-1:] * springs
        assert is_recess(task.feature)  # noqa: S101 - nothing else is claimed
        paths = middle_lines(zone, plan_view(task.feature), mill.radius, job.settings.climb)
        layer = Layer(zone, stock, steps, steps.cuts)
        write = partial(to_and_fro, paths=paths, top=zone.top, heights=heights)
        layer.add("groove", mill, write, depth=layer.pass_depth(mill, step_down))
        if not layer.cuts[-1].moves:
            raise ToolError(
                f"cam.tools: {mill.name} finds no way along {zone.name} of {job.part.name}; draw it as "
                f"wide as the mill, {mill.diameter:g} mm, or wider"
            )
        return stock.without(zone.clear)

    def remarks(self, task: Task, job: Job) -> list[Finding]:
        """What is narrower than its mill."""
        return [] if isinstance(task.data, Way) else corner_remarks(task.data, job, SNUG)


def groove_mill(job: Job, feature: OpenProfile) -> Tool | None:
    """The mill that cuts a groove to its width in one; None if there is none.

    Where clearing is adaptive, a narrower mill with room to turn in loops goes first. Raises ToolError where
    no mill reaches the groove's bottom.
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


def centre_line(feature: OpenProfile, lines_per_arc: int) -> Path:
    """The way of the cutter's centre."""
    rows = [segment.flatten(TOLERANCES.flatten) for segment in feature.path]
    points = np.concatenate([rows[0], *(row[1:] for row in rows[1:])])
    return fit(densified(points, DENSE), FIT, lines_per_arc)


def to_and_fro(pen: Pen, paths: Sequence[Path], top: float, heights: list[float]) -> None:
    """Passes along each groove, at one height after the other; a closed one is run round and round."""
    for path in paths:
        pen.above(path.start)
        pen.sink(top)
        for z in heights:
            pen.ramp(path, z)
            pen.follow(path)
            path = path if path.closed else path.reversed()
    pen.retract()
