"""Milling on trial: what cutters find of plates, and about how long they take, without a program.

Plates that another process makes are prepared as if they were milled.
"""

from collections.abc import Sequence
from functools import cached_property

from mechwright.contracts.finding import Finding, errors
from mechwright.pipeline import Build
from mechwright.pipeline.process import plates_of
from mechwright_cam.machining import Machining
from mechwright_cam.operations.contract import Task
from mechwright_cam.operations.ladder import change_time, ladder, recess_ladder
from mechwright_cam.operations.rates import rates
from mechwright_cam.planning.assign import Assignments
from mechwright_cam.planning.prepare import prepare
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.tool import MILLS
from mechwright_plane.nest import Nest
from mechwright_plane.offsets import polygons


class MillingTrial:
    """The plates of a build as jobs of the mill, whatever process the design has chosen."""

    def __init__(self, build: Build) -> None:
        self._build = build

    @cached_property
    def _prepared(self) -> tuple[Sequence[Finding], Sequence[Job], Assignments]:
        plates, machining = plates_of(self._build.parts), self._build.made(Machining)
        if machining.plates == plates:
            return machining.findings, machining.jobs, machining.assignments
        return *prepare(self._build.design, plates, machining.assignments), machining.assignments

    def _jobs(self, name: str) -> list[Job]:
        return [job for job in self._prepared[1] if name in _names(job)]

    def findings(self, name: str) -> Sequence[Finding]:
        """Errors that keep a plate from being milled; none where it has a job."""
        if self._jobs(name):
            return ()
        wrong = errors(self._prepared[0])
        own = [one for one in wrong if name in one.message or name in one.parameter]
        return own or wrong

    def seconds(self, name: str) -> float | None:
        """How long one piece takes, s, without marks and edges: mostly 0.6 to 1.2 of the proof's time.

        A nest is milled at once: each of its copies has its share.
        """
        jobs = self._jobs(name)
        if not jobs:
            return None
        return sum(self._work(job) / max(len(_names(job)), 1) for job in jobs)

    def _work(self, job: Job) -> float:
        tasks = [task for task in self._prepared[2].of(job).tasks if not task.is_detail]
        holes = [task.hole.drill for task in tasks if task.hole is not None]
        used = {tool.name for tool in (*holes, *(tool for task in tasks for tool in task.tools))}
        return len(used) * change_time(job) + sum(_task_time(task, job) for task in tasks)


def _names(job: Job) -> list[str]:
    if isinstance(job.part, Nest):
        return [one.part.name for one in job.part.placed]
    return [job.part.name]


def _task_time(task: Task, job: Job) -> float:
    """Drills and reamers go straight down, s; mills as the planner estimates them, and once along walls."""
    material, machine, depth = job.part.material, job.settings.machine, task.top - task.bottom
    mills = [tool for tool in task.tools if tool.kind in MILLS]
    straight = [tool for tool in task.tools if tool not in mills]
    straight += [] if task.hole is None else [task.hole.drill]
    total = sum(60 * depth / rates(tool, material, machine).feed for tool in straight)
    if mills:
        finest = min(mills, key=lambda mill: mill.diameter)
        if task.is_outside:
            plates = polygons(job.target)
            total += sum(ladder(job, plate, mills, finest, 0.0)[0] for plate in plates)
        else:
            total += recess_ladder(job, task.region, mills, finest, depth, 0.0)[0]
        total += 60 * task.region.length / 2 / rates(finest, material, machine).feed
    return total
