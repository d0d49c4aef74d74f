"""The outside of a part: roughed in a channel, or out to the edges of the stock, and finished."""

import math
from collections.abc import Sequence
from functools import partial
from typing import ClassVar

import shapely

from mechwright.contracts.details import Detail
from mechwright.contracts.finding import Finding
from mechwright.contracts.part import Feature, Profile, is_outside
from mechwright.errors import DesignError
from mechwright_cam.operations.channel import channel_of, fills_a_slot, outside_mills, roughing_mills
from mechwright_cam.operations.choice import HANDY, finest_needed, last_mills, usable_mills
from mechwright_cam.operations.compensation import entering
from mechwright_cam.operations.contract import Operation, Task
from mechwright_cam.operations.corners import corner_remarks
from mechwright_cam.operations.ladder import ladder
from mechwright_cam.operations.layer import Layer, cut_layers
from mechwright_cam.operations.steps import Steps
from mechwright_cam.operations.stock import Stock
from mechwright_cam.operations.zone import Zone
from mechwright_cam.setup.depths import through
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.holding import Stock as Plate
from mechwright_cam.shop.tool import Tool
from mechwright_plane.nest import Nest
from mechwright_plane.path import DECIMALS, NOISE
from mechwright_plane.reach import closing

ROUGHING_SHARE = 0.15
"""Largest roughing mill in shares of the part's narrow side: a larger one turns too much stock into chips."""


class Contour(Operation):
    """Cuts an outside in one layer, or with tabs in two: above and below their tops."""

    name = "contour"
    wide: ClassVar[float] = 1.0
    """Width of the channel, in diameters of the mill that opens it."""

    def claim(self, feature: Feature | Detail, job: Job) -> Task | None:
        """Any outside through the plate; without zones where all of its edges are those of the stock."""
        if not is_outside(feature):
            return None
        zones = _zones(job, feature, self.wide)
        tools, region = (zones[0].tools, zones[0].clear) if zones else ((), shapely.Polygon())
        return Task(feature, self, tools, -feature.top, job.floor, region, data=zones)

    def choose(self, feature: Feature | Detail, every: Job, chosen: Sequence[Tool]) -> Sequence[Tool] | None:
        """The mills that make it in the least time; none is as wide as a slot of it, if there is a choice."""
        if not is_outside(feature):
            return None
        shape, settings = shapely.Polygon(feature.loop.flatten()), every.settings
        fit = usable_mills(every, -every.floor)
        boxes = [outline.bounds for outline in every.part.outlines]
        narrow = min(min(x1 - x0, y1 - y0) for x0, y0, x1, y1 in boxes)
        widest = max(HANDY, ROUGHING_SHARE * narrow)
        mills = [mill for mill in fit if mill.diameter <= widest] or fit[-1:]
        if settings.stock != Plate() or isinstance(every.part, Nest):  # else it is made large enough
            framed = settings.hold.method == "tabs"
            mills = roughing_mills(every, mills, shape, framed=framed, wide=self.wide)

        def fits(mill: Tool) -> bool:
            slot = fills_a_slot(mill.radius, shape, settings.stock_to_leave, settings.path.bias)
            return mill is mills[-1] or not slot

        finest = finest_needed(mills, shape, settings, fits=fits)
        return ladder(every, shape, list(filter(fits, mills)), finest)[1]

    def cut(self, task: Task, stock: Stock, steps: Steps) -> Stock:
        """Layer by layer, from the top down."""
        layers = [Layer(zone, Stock(zone.clear, stock.gone), steps) for zone in task.data]
        if not layers:
            return stock
        for layer in layers:
            self.open_up(layer)
        steps.cuts += cut_layers(layers)
        return layers[-1].stock

    def open_up(self, layer: Layer) -> None:
        """What comes before the passes along the wall."""

    def deepest(self, task: Task, tool: Tool) -> float:
        """Out of the plate with all of a rounded corner."""
        return float(min(zone.bottom_for(tool) for zone in task.data))

    def edge(self, task: Task, job: Job) -> shapely.Geometry | None:
        """The part as the finest mill leaves it."""
        return closing(task.data[0].wall, job.reach(task.data[0].finisher)) if task.data else None

    def remarks(self, task: Task, job: Job) -> list[Finding]:
        """Corners that its mills do not reach."""
        return corner_remarks(task.data[0], job) if task.data else []


def _zones(job: Job, feature: Profile, wide: float) -> list[Zone]:
    """The layers of an outside, from the top down; its channel is so many diameters ``wide``."""
    if not through(job, feature.top + feature.depth):
        raise DesignError(
            f"part {job.part.name}: the outside {feature.name} ends {feature.depth:g} mm below "
            f"{feature.top:g} mm and not at the underside; only outsides through the plate can be cut"
        )
    part, path = shapely.Polygon(feature.loop.flatten()), job.settings.path
    own = [tab for tab in job.tabs if shapely.intersects(tab.shape, part)]
    able = usable_mills(job, -job.floor)
    if own and own[0].ramped:
        able = _flat_mills(job, able)
    # A mill too wide for the frame is as good as none, for finishing as well.
    mills = roughing_mills(job, able, part, wide=wide)
    mills = outside_mills(mills, part, job.settings.stock_to_leave, path.bias)
    clear, channel = channel_of(job, part, mills[0], wide)
    if shapely.is_empty(clear):
        return []  # all of its edges are those of the stock
    choose = partial(last_mills, keep=part, settings=job.settings)

    def layers(finishers: Sequence[Tool]) -> list[Zone]:
        layer = partial(
            Zone,
            wall=part,
            kind="outside",
            mills=tuple(mills),
            finishers=tuple(finishers),
            path=path,
            channel=channel,
        )
        whole = partial(layer, feature.name, clear=clear, top=-feature.top)
        if not own:
            return [whole(bottom=job.floor, below=True)]
        # Rounded upwards: a decimal too low would already cut the tabs.
        height = math.ceil(max(tab.top for tab in own) * 10**DECIMALS - NOISE) / 10**DECIMALS
        low = partial(layer, top=height, bottom=job.floor, below=True)
        if wide > 1:  # so low a layer is cut with the full width of the mill
            under, narrow = channel_of(job, part, mills[0])
            low = partial(low, channel=narrow)
        else:
            under = clear
        if own[0].ramped:
            lower = low(name=f"{feature.name} over the tabs", clear=under, slopes=tuple(own))
        else:
            tabs = shapely.union_all([tab.shape for tab in own])
            lower = low(name=f"{feature.name} below the tabs", clear=under.difference(tabs), tabs=tabs)
        return [whole(bottom=height, below=False), lower]

    last = tuple(choose(mills))
    zones = layers(last)
    finishers = entering(job, [(zone, zone.clear) for zone in zones], mills, last, choose)
    return zones if finishers == last else layers(finishers)


def _flat_mills(job: Job, mills: list[Tool]) -> list[Tool]:
    """The flat end mills: the round end of another would go into the slopes of ramped tabs."""
    flat = [mill for mill in mills if mill.nose == 0]
    if not flat:
        raise DesignError(
            f"cam.hold.tab_shape: ramped tabs of part {job.part.name} are for flat end mills, and "
            f'{mills[-1].name} has a round end; list a flat one, or use "rectangular" tabs'
        )
    return flat
