"""The contract of operations: who cuts a feature, with what and how deep, is decided once, in a task.

A whole operation is one class in one file. This one plunges a mill as wide as the hole::

    class Plunge(Operation):
        name = "plunge"

        def claim(self, feature, job):
            if not isinstance(feature, Bore):
                return None
            fit = [mill for mill in job.end_mills if abs(mill.diameter - feature.diameter) < 0.005]
            region = plan_view(feature)
            return Task(feature, self, tuple(fit[:1]), -feature.top, job.floor, region) if fit else None

        def cut(self, task, stock, steps):
            def write(pen):
                pen.above(task.feature.centre)
                pen.sink(task.bottom, pen.rates.plunge)
                pen.retract()

            steps.add(f"{task.feature.name}: plunge", task.tools[0], write)
            return stock.without(task.region)

A design asks for it by its name, ``[cam] operations = ["plunge"]``, and it is asked before the built-in ones.
"""

from abc import abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Annotated, Any, get_args

import shapely

from mechwright.contracts.declared import Declared
from mechwright.contracts.details import Detail
from mechwright.contracts.finding import Finding
from mechwright.contracts.guard import UnsoundError, is_foreign, now
from mechwright.contracts.part import Feature
from mechwright.contracts.plugin import Plugin
from mechwright.geometry.segments import Point
from mechwright_cam.operations.steps import Cut, Steps
from mechwright_cam.operations.stock import Stock
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.tool import Tool


@dataclass(frozen=True)
class Hole:
    """A hole that is drilled before the mills come."""

    drill: Tool
    place: Point
    deep: float | None = None
    """Depth to which it has its full diameter, mm; None for one through the plate."""


@dataclass(frozen=True, eq=False)
class Task:
    """What is done about one feature or detail of a job."""

    feature: Feature | Detail
    operation: "Operation"
    tools: tuple[Tool, ...]
    """The mills in the order of their work; none where a drill makes all of it."""
    top: float
    """Where the cut begins, z in mm."""
    bottom: float
    """Where it ends."""
    region: shapely.Geometry = field(default_factory=shapely.Polygon)
    """What has to go, seen from above; empty for details."""
    hole: Hole | None = None
    """What is drilled first."""
    data: Any = None
    """Whatever else the operation has worked out when it claimed the feature."""

    @property
    def is_detail(self) -> bool:
        """Whether it works on edges and faces that other tasks make."""
        return isinstance(self.feature, get_args(Detail))

    @property
    def is_outside(self) -> bool:
        """Whether it is about the rim of the part, which is cut last."""
        return getattr(self.feature, "side", "") == "outside"


def _hold_task(task: Task | None, feature: Feature | Detail, job: Job, *_: object) -> None:
    """Raise UnsoundError where a task is of something else, or wants tools that the job has not."""
    if task is None:
        return
    if task.feature.name != feature.name:
        raise UnsoundError(f"claims {task.feature.name!r}; it is asked about {feature.name!r}")
    for tool in (*task.tools, *([task.hole.drill] if task.hole else [])):
        if tool not in job.tools:
            raise UnsoundError(
                f"takes {tool.name!r}, which is no tool of the job, or another one of that name"
            )
    if is_foreign(now()) and not shapely.is_valid(task.region):
        raise UnsoundError(f"region of what it gives is no area: {shapely.is_valid_reason(task.region)}")


def _hold_cuts(left: Stock, task: Task, stock: Stock, steps: Steps) -> None:  # noqa: ARG001
    """Raise UnsoundError where something else than cuts was added, or some of before are gone.

    Of our own operations no move is looked at: there are thousands, and the proof looks at all.
    """
    if len(steps.cuts) < steps.held:
        raise UnsoundError(f"takes away {steps.held - len(steps.cuts)} of the cuts that are not its own")
    added, steps.held = steps.cuts[steps.held :], len(steps.cuts)
    if is_foreign(now()) and (found := Declared().fault(added, list[Cut])):
        where, said = found
        raise UnsoundError(f"cut {where.lstrip('.')} of those it adds {said}")


Claim = Annotated[Task | None, _hold_task]
"""A task of the feature that was asked about, with tools of the job."""
StockLeft = Annotated[Stock, _hold_cuts]
"""What cuts leave, which were added to those of before."""


class Operation(Plugin):
    """A way to cut features; it keeps nothing between calls."""

    kind = "operation"
    plural = "operations"
    limited = True
    finite = True

    @abstractmethod
    def claim(self, feature: Feature | Detail, job: Job) -> Claim:
        """Decide who cuts a feature, and how deep; None leaves it to the next operation.

        Raises ToolError where it is this operation's, and the cutters of the job cannot make it; DesignError
        where the feature, the holding or the stock is wrong.
        """

    def claim_copy(self, feature: Feature | Detail, job: Job, known: Task) -> Claim:
        """The same for a turned copy of a feature whose task is ``known``: what was decided there holds."""
        return self.claim(feature, job)

    @abstractmethod
    def cut(self, task: Task, stock: Stock, steps: Steps) -> StockLeft:
        """Add the cuts of a task, each waiting for the one before, and give what they leave of the stock."""

    def choose(self, feature: Feature | Detail, every: Job, chosen: Sequence[Tool]) -> Sequence[Tool] | None:
        """The mills that a feature asks for where the design names none; None if it is not this operation's.

        ``every`` is the part in ample stock with all flat mills of the library at hand; the mills that other
        features have asked for are ``chosen``.
        """
        return None

    def deepest(self, task: Task, tool: Tool) -> float:
        """How deep one of the tools goes, z in mm."""
        return task.bottom

    def edge(self, task: Task, job: Job) -> shapely.Geometry | None:
        """What the cutters really open through the plate, or for an outside leave of it; None if nothing."""
        return task.region if task.bottom <= job.floor else None

    def remarks(self, task: Task, job: Job) -> list[Finding]:
        """What the cutters of a task do not reach."""
        return []
