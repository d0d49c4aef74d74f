"""Recesses and openings: cleared along their walls, level by level, then their floors, then their walls."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

import shapely

from mechwright.contracts.details import Detail
from mechwright.contracts.finding import Finding
from mechwright.contracts.part import Feature, Pocket
from mechwright_cam.operations.choice import (
    HANDY,
    ROOMY,
    entry_place,
    finest_needed,
    roomy_mills,
    roughers,
    usable_mills,
)
from mechwright_cam.operations.clearing import Roughing
from mechwright_cam.operations.contract import Hole, Operation, Task
from mechwright_cam.operations.corners import corner_remarks
from mechwright_cam.operations.drilling import starting_drill
from mechwright_cam.operations.ladder import recess_ladder
from mechwright_cam.operations.layer import WORTH_A_TOOL, Layer, cut_layers
from mechwright_cam.operations.recess import is_recess, recess
from mechwright_cam.operations.recess_zone import recess_zone
from mechwright_cam.operations.steps import Cut, Steps
from mechwright_cam.operations.stock import Stock, combined_stock
from mechwright_cam.operations.zone import Zone
from mechwright_cam.setup.depths import bottom_of, floor_allowance
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.tool import Tool
from mechwright_plane.offsets import ROUGH, areas, grow, polygons, swept
from mechwright_plane.reach import PRECISION

OPENED = 0.05
"""Share of a recess that has to be open from below before it is cut in two layers for it."""
THIN = 0.2
"""A layer that begins or ends so near to an opening, mm, is not divided there."""


class Clear(Operation):
    """Clears a recess ring by ring from its middle to its wall, and finishes it."""

    name = "clear"

    def claim(self, feature: Feature | Detail, job: Job) -> Task | None:
        """Any opening that is not round, and any pocket."""
        return self.task(recess_zone(job, feature), feature, job) if is_recess(feature) else None

    def claim_copy(self, feature: Feature | Detail, job: Job, known: Task) -> Task | None:
        """With the same mills, but where the room for entries under compensation has to be looked for."""
        assert is_recess(feature)  # noqa: S101 - nothing else is claimed
        if job.settings.compensation != "computer":
            return self.claim(feature, job)
        return self.task(recess_zone(job, feature, like=known.data), feature, job)

    def task(self, zone: Zone, feature: Feature | Detail, job: Job) -> Task:
        """The task of a recess, with the hole that an opening is entered through."""
        region, hole = zone.clear, None
        if zone.must is not None:
            region = areas(shapely.intersection(zone.clear, shapely.box(*job.stock)))
        if zone.kind == "inside" and zone.below:
            place, radius = entry_place(zone.clear)
            drill = starting_drill(job, 2 * radius, -zone.bottom)
            hole = None if drill is None else Hole(drill, place)
        return Task(feature, self, zone.tools, zone.top, zone.bottom, region, hole, zone)

    def choose(self, feature: Feature | Detail, every: Job, chosen: Sequence[Tool]) -> Sequence[Tool] | None:
        """The largest mill that gets into all corners, and wider ones before it that save time.

        There is none if the feature takes nothing of the plate.
        """
        if not is_recess(feature):
            return None
        bottom = bottom_of(every, feature.top, feature.depth)
        able = usable_mills(every, -bottom)
        shapes = recess(every, feature, able, roomy=True)
        if shapely.is_empty(shapes.must):
            return []
        if isinstance(feature, Pocket) and feature.floor_radius > 0:
            # The wall is for a round mill; a flat one clears what is further away, if there is room.
            inner = polygons(grow(shapes.must, -feature.floor_radius, ROUGH))
            width = 2 * max((entry_place(part)[1] for part in inner), default=0.0)
            return [mill for mill in able if mill.diameter <= min(ROOMY * width, HANDY)][:1]
        able = roomy_mills(able, shapes.must, every.settings.stock_to_leave)
        finest = finest_needed(able, shapes.keep, every.settings, shapes.must if shapes.open else None)
        return recess_ladder(every, shapes.must, able, finest, -bottom)[1]

    def open_up(self, layer: Layer, feature: Feature | Detail, *, floored: bool) -> None:
        """What comes before the contour passes; ``floored``: a pass over all of the floor comes after it."""

    def cut(self, task: Task, stock: Stock, steps: Steps) -> Stock:
        """In layers, or where a floor stays to just above it, the floor, and the wall from top to bottom."""
        zone: Zone = task.data
        leave = floor_allowance(steps.job, zone.top, zone.bottom)
        if leave > 0:
            return self._cut_with_floor(task, stock, steps, leave)
        layers = [Layer(*pair, steps) for pair in over_openings(zone, stock)]
        for layer in layers:
            self.open_up(layer, task.feature, floored=False)
        steps.cuts += cut_layers(layers)
        return combined_stock([layer.stock for layer in layers])

    def _cut_with_floor(self, task: Task, stock: Stock, steps: Steps, leave: float) -> Stock:
        zone: Zone = task.data
        height = zone.bottom + leave
        ((below, under),) = over_openings(replace(zone, top=height), stock)
        cuts: list[Cut] = []
        floor = Layer(below, under, steps, cuts)
        above_it = over_openings(replace(zone, bottom=height), stock)
        roughs = [Layer(*pair, steps, cuts) for pair in above_it]
        for rough in roughs:
            self.open_up(rough, task.feature, floored=True)
        cleared = [mill for _, mill, _ in cuts]
        for mill in roughers(zone.mills, zone.finishers):
            found = [rough.roughing(mill) for rough in roughs]
            if found[0].share >= WORTH_A_TOOL:
                for rough, one in zip(roughs, found, strict=True):
                    rough.rough(one)
                if not cleared:  # where bounded engagement left corners standing a wide cutter would hit them
                    floor.floored(mill, found[-1])
        above: dict[str, Roughing] = {}
        for mill in zone.finishers:
            for rough in roughs:
                above[mill.name] = rough.roughing(mill)
                rough.rough(above[mill.name])
                rough.rough_heavy(mill)
        # What round mills left at the foot of the wall is cut in one go, down to the floor.
        last = roughs[-1].stock
        if not shapely.is_empty(last.ridges):
            ridges = shapely.union(floor.stock.ridges, last.ridges)
            floor.stock = replace(floor.stock, ridges=ridges, ridge_height=last.ridge_height + leave)
        for mill in [*(mill for mill in cleared if mill not in zone.finishers), *zone.finishers]:
            floor.floored(mill, above.get(mill.name))
        floor.rough_heavy(zone.finisher, "finish the floor of narrow places")
        for mill in zone.finishers:
            floor.level(mill)
        whole = Layer(zone, combined_stock([*(rough.stock for rough in roughs), floor.stock]), steps, cuts)
        for mill in zone.finishers:
            whole.finish(mill)
        steps.cuts += cuts
        return whole.stock

    def deepest(self, task: Task, tool: Tool) -> float:
        """Out of the plate with all of a rounded corner."""
        return float(task.data.bottom_for(tool))

    def edge(self, task: Task, job: Job) -> shapely.Geometry | None:
        """The opening, its corners as round as the finest mill."""
        zone: Zone = task.data
        return swept(zone.clear, job.reach(zone.finisher), PRECISION) if zone.below else None

    def remarks(self, task: Task, job: Job) -> list[Finding]:
        """Corners and passages that its mills do not reach."""
        return corner_remarks(task.data, job)


def over_openings(zone: Zone, stock: Stock) -> list[tuple[Zone, Stock]]:
    """A recess in layers from the top down, each without what earlier setups have opened from below."""
    inside = [
        air.top
        for air in stock.gone
        if zone.bottom + THIN < air.top < zone.top - THIN
        and shapely.intersection(air.shape, stock.left).area > OPENED * stock.left.area
    ]
    heights = [zone.top, *sorted(set(inside), reverse=True), zone.bottom]
    found = []
    for place, (top, bottom) in enumerate(pairwise(heights)):
        name = zone.name if place == 0 else f"{zone.name} around the opening"
        layer = replace(zone, name=name, top=top, bottom=bottom)
        found.append((layer, stock.without(stock.air_below(top)) if stock.gone else stock))
    return found
