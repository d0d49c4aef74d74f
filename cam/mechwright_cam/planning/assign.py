"""Who cuts what: decided once for each feature and detail of a job."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from mechwright.errors import DesignError, MechwrightError, PluginFaultError
from mechwright_cam.controls.contract import Control
from mechwright_cam.operations.contract import Operation, Task
from mechwright_cam.operations.drilling import spot_drill
from mechwright_cam.operations.table import job_operations
from mechwright_cam.operations.twins import Twins
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.library import Library
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import Tool, ToolKind


@dataclass(frozen=True)
class Assigned:
    """The tasks of a job, in the order of its features and details, and why there is none for some."""

    tasks: tuple[Task, ...]
    refused: tuple[MechwrightError, ...]

    def every(self) -> tuple[Task, ...]:
        """The tasks; raises the first error if a feature has none."""
        if self.refused:
            raise self.refused[0]
        return self.tasks

    @property
    def inside(self) -> tuple[Task, ...]:
        """Those about openings and recesses, which are cut first."""
        return tuple(task for task in self.tasks if not task.is_outside and not task.is_detail)

    def spot(self, job: Job) -> Tool | None:
        """What spots the holes of the job; None if nothing is drilled, or it has no spot drill."""
        return spot_drill(job) if any(task.hole is not None for task in self.inside) else None

    def depths(self) -> dict[str, float]:
        """How deep below the top of the stock each mill cuts, mm, by its name."""
        deep: dict[str, float] = {}
        for task in self.tasks:
            for mill in task.tools:
                deep[mill.name] = max(deep.get(mill.name, 0.0), -task.operation.deepest(task, mill))
        return deep


def assign(job: Job, operations: Sequence[Operation]) -> Assigned:
    """Ask the operations in turn, until one claims, for every feature and detail of a job."""
    tasks: list[Task] = []
    refused: list[MechwrightError] = []
    twins, claimed = Twins(job), dict[str, Task]()
    for feature in (*job.features, *job.details):
        try:
            twin = twins.first(feature)
            known = claimed.get(twin.name) if twin is not None else None
            task = known.operation.claim_copy(feature, job, known) if known is not None else None
            if task is None:
                claims = (operation.claim(feature, job) for operation in operations)
                task = next((claim for claim in claims if claim is not None), None)
            if task is None:
                raise DesignError(
                    f"part {job.part.name}: no operation cuts {feature.name}; draw it as a bore, a pocket, "
                    "an inside profile, or an outside through the plate"
                )
            tasks.append(task)
            claimed[feature.name] = task
        except PluginFaultError:  # of no design
            raise
        except MechwrightError as error:
            refused.append(error)
    return Assigned(tuple(tasks), tuple(refused))


class Assignments:
    """The tasks of the jobs of one build, each worked out when it is first asked for.

    Of ``more`` operations besides the built-in ones a design asks for some by name. Tools that the
    ``control`` cannot use are not chosen.
    """

    def __init__(self, more: Sequence[Operation] = (), control: Control | None = None) -> None:
        self.more, self.control = tuple(more), control
        self._known: dict[int, tuple[Job, Assigned]] = {}

    def operations(self, settings: CamSettings) -> tuple[Operation, ...]:
        """Those that a job asks; raises DesignError for a name that is not known."""
        return job_operations(settings.operations, self.more)

    def untapped(self, library: Library) -> dict[str, str]:
        """Taps of a library that the control cannot use, by name, with the reason."""
        if self.control is None:
            return {}
        taps = [tool for tool in library.tools if tool.kind is ToolKind.TAP]
        return {tap.name: why for tap in taps if (why := self.control.cannot_tap(tap))}

    def of(self, job: Job) -> Assigned:
        """Who cuts what in this very job."""
        if id(job) not in self._known:
            self._known[id(job)] = job, assign(job, self.operations(job.settings))
        return self._known[id(job)][1]

    def carry(self, job: Job, changed: Job) -> Job:
        """The changed job, of which all that was decided about the first one holds as well."""
        self._known[id(changed)] = changed, self.of(job)
        return changed

    def only(self, jobs: Iterable[Job]) -> "Assignments":
        """What is decided about some jobs, for another process."""
        found = Assignments(self.more, self.control)
        found._known = {id(job): (job, self.of(job)) for job in jobs}
        return found

    def __getstate__(self) -> dict[str, Any]:
        """Jobs are other objects in another process: none is named by its identity."""
        return {**self.__dict__, "_known": list(self._known.values())}

    def __setstate__(self, state: dict[str, Any]) -> None:
        """The same of the jobs that are here now."""
        self.__dict__.update(state, _known={id(job): (job, one) for job, one in state["_known"]})
