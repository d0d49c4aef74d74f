"""What the operations of details share: their tools, and how wide the pointed ones are."""

import math
from abc import abstractmethod
from collections.abc import Sequence
from typing import Any, ClassVar

from mechwright.contracts.details import Detail
from mechwright.contracts.part import Feature
from mechwright_cam.operations.contract import Operation, Task
from mechwright_cam.operations.steps import Steps
from mechwright_cam.operations.stock import Stock
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.tool import Tool


def spread(tool: Tool, height: float) -> float:
    """Radius of a pointed tool at a height above its tip, mm."""
    return tool.tip_diameter / 2 + height * math.tan(math.radians(tool.point_angle / 2))


class DetailOperation(Operation):
    """Cuts one kind of detail with one tool; the data of its task write the moves."""

    detail: ClassVar[type]
    """The details that it claims."""

    @abstractmethod
    def task(self, detail: Any, job: Job) -> Task:
        """Choose the tool of a detail; raises ToolError if there is none, and says what it needs."""

    def claim(self, feature: Feature | Detail, job: Job) -> Task | None:
        """All details of its kind."""
        return self.task(feature, job) if isinstance(feature, self.detail) else None

    def choose(self, feature: Feature | Detail, every: Job, chosen: Sequence[Tool]) -> Sequence[Tool] | None:
        """The tool."""
        return self.task(feature, every).tools if isinstance(feature, self.detail) else None

    def cut(self, task: Task, stock: Stock, steps: Steps) -> Stock:
        """In one go; the stock in front of walls stays as it is."""
        steps.add(f"{task.feature.name}: {self.name}", task.tools[0], task.data)
        return stock
