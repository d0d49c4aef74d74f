"""Holes that a reamer brings to size, opened before by a drill or a mill with the reamer's allowance."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial

import shapely

from mechwright.contracts.details import Detail
from mechwright.contracts.part import Bore, Feature
from mechwright.errors import ToolError
from mechwright_cam.operations.bore import EXACT, alike_in, boring_mill, rough_bore, worth_one_more
from mechwright_cam.operations.choice import usable_mills
from mechwright_cam.operations.contract import Hole, Operation, Task
from mechwright_cam.operations.drilling import ON_SIZE, starting_drill, usable_drills
from mechwright_cam.operations.entry import enters
from mechwright_cam.operations.pen import Pen
from mechwright_cam.operations.steps import Steps
from mechwright_cam.operations.stock import Stock
from mechwright_cam.setup.depths import through
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.tool import REAMER_LEAD, Tool, ToolKind

ALLOWANCES = ((5.0, 0.1, 0.2), (10.0, 0.15, 0.3), (20.0, 0.2, 0.4), (100.0, 0.3, 0.5))
"""Up to a diameter, what is left for the reamer on the diameter, least and most, mm (workshop practice after
DIN reamers): less rubs, more chatters."""


@dataclass(frozen=True)
class Reaming:
    """How a hole is made: drilled with the right allowance, or milled, perhaps from a drilled hole."""

    reamer: Tool
    drill: Tool | None
    mill: Tool | None


class Ream(Operation):
    """Reams round holes through the plate, where the job has a reamer of their size."""

    name = "ream"

    def claim(self, feature: Feature | Detail, job: Job) -> Task | None:
        """A hole for which there is a reamer, and something that opens it; others are left to other ways."""
        way = reaming(job, feature) if isinstance(feature, Bore) else None
        if way is None or not isinstance(feature, Bore):
            return None
        hole = None if way.drill is None else Hole(way.drill, feature.centre)
        region = shapely.Point(feature.centre).buffer(feature.diameter / 2, quad_segs=EXACT)
        tools = (way.reamer,) if way.mill is None else (way.mill, way.reamer)
        return Task(feature, self, tools, -feature.top, job.floor, region, hole)

    def choose(self, feature: Feature | Detail, every: Job, chosen: Sequence[Tool]) -> Sequence[Tool] | None:
        """The reamer of the crib, and a mill that opens its hole where none of those chosen does."""
        way = reaming(every, feature) if isinstance(feature, Bore) else None
        if way is None or not isinstance(feature, Bore):
            return None
        if way.mill is None or way.mill in chosen:
            return [way.reamer]
        small = opened(feature, way.reamer)
        able = _opening_mills(every, small.diameter)
        more = worth_one_more(every, small, able, chosen, way.mill, alike_in(every, feature))
        return [way.mill, way.reamer] if more else [way.reamer]

    def deepest(self, task: Task, tool: Tool) -> float:
        """A reamer goes through with its lead."""
        return task.bottom - REAMER_LEAD if tool.kind is ToolKind.REAMER else task.bottom

    def cut(self, task: Task, stock: Stock, steps: Steps) -> Stock:
        """To the reamer's allowance, and down and up at its feed with the spindle turning."""
        assert isinstance(task.feature, Bore)  # noqa: S101 - nothing else is claimed
        bore, job, (*mills, reamer) = task.feature, steps.job, task.tools
        small = opened(bore, reamer)
        for mill in mills:
            drill, air = task.hole.drill if task.hole else None, stock.air_below(task.top)
            step_down = steps.step_down(mill, to_size=True)
            write = partial(rough_bore, job, small, drill, air, step_down, to_size=True)
            steps.add(f"{bore.name}: bore for the reamer", mill, write)
        steps.add(f"{bore.name}: ream", reamer, partial(_ream, bore=bore, bottom=task.bottom - REAMER_LEAD))
        return Stock(gone=stock.gone)


def _ream(pen: Pen, bore: Bore, bottom: float) -> None:
    """Down and up at the feed: drawn out fast it would score the wall."""
    pen.above(bore.centre)
    height = pen.z
    pen.sink(bottom)
    pen.sink(height)
    pen.retract()


def allowance(diameter: float) -> tuple[float, float]:
    """What is left for a reamer on the diameter, least and most, mm.

    >>> allowance(4.0), allowance(12.0)
    ((0.1, 0.2), (0.2, 0.4))
    """
    return next((least, most) for limit, least, most in ALLOWANCES if diameter <= limit)


def opened(bore: Bore, reamer: Tool) -> Bore:
    """The hole that a mill makes for a reamer: with an allowance in the middle of what is usual."""
    return replace(bore, diameter=reamer.diameter - sum(allowance(reamer.diameter)) / 2, fit=None)


def reaming(job: Job, bore: Bore) -> Reaming | None:
    """How a hole is reamed; None for one that is blind, or where there is no reamer, or nothing to open it.

    A hole of which no fit is said is reamed only by a reamer that the design names.

    A reamer follows the hole that it finds. So a mill that enters the hole brings it to its place first: a
    drill wanders by up to 0.1 mm, and is taken where no mill enters.
    """
    depth = -job.floor
    if bore.top > 0 or not through(job, bore.top + bore.depth):
        return None
    wanted = bore.fit is not None or bool(job.settings.tools)
    fitting = (tool for tool in job.tools_of(ToolKind.REAMER) if wanted and reams_to_size(tool, bore))
    reamer = next((tool for tool in fitting if tool.flute_length >= depth + REAMER_LEAD), None)
    if reamer is None:
        return None
    small = opened(bore, reamer).diameter
    if (mill := boring_mill(_opening_mills(job, small), small)) is not None:
        return Reaming(reamer, starting_drill(job, small, depth), mill)
    least, most = allowance(reamer.diameter)
    for drill in usable_drills(job, depth):
        if least - ON_SIZE <= reamer.diameter - drill.diameter <= most + ON_SIZE:
            return Reaming(reamer, drill, None)
    return None


def _opening_mills(job: Job, diameter: float) -> list[Tool]:
    """The flat mills that enter a through hole of a diameter, mm, largest first."""
    try:
        usable = usable_mills(job, -job.floor)
    except ToolError:
        return []
    return [tool for tool in usable if tool.nose == 0 and enters(tool, diameter, job.settings)]


def reams_to_size(reamer: Tool, bore: Bore) -> bool:
    """Whether a reamer makes the hole: within its fit, H7 by its nominal size, or within 5 µm without one."""
    fit = bore.fit
    if fit is None:
        return abs(reamer.diameter - bore.diameter) <= ON_SIZE
    if reamer.diameter == fit.size:
        return fit.name == "H7"
    return fit.size + fit.lower <= reamer.diameter <= fit.size + fit.upper
