"""Which tool does what: the tasks of a job, by tool."""

from dataclasses import dataclass

from mechwright_cam.planning.assign import Assigned
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.tool import Tool


@dataclass(frozen=True)
class Use:
    """One thing that a tool does in a job."""

    tool: Tool
    feature: str
    """Name of the feature or detail."""
    doing: str
    """``spot``, ``drill``, or the name of the operation."""


def uses(job: Job, assigned: Assigned) -> list[Use]:
    """What the tools of a job do, in the order of its tasks; raises the first error if a feature has none."""
    found: list[Use] = []
    spot = assigned.spot(job)
    for task in assigned.every():
        name = task.feature.name
        if task.hole is not None and task in assigned.inside:
            if spot is not None:
                found.append(Use(spot, name, "spot"))
            found.append(Use(task.hole.drill, name, "drill"))
        found += [Use(tool, name, task.operation.name) for tool in task.tools]
    return found
