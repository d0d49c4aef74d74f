"""From a job to a program."""

import math
from dataclasses import replace
from itertools import groupby

import shapely

from mechwright.errors import DesignError
from mechwright.tolerances import TOLERANCES
from mechwright_cam.operations.contract import Hole, Task
from mechwright_cam.operations.drilling import drill_moves, spot_moves
from mechwright_cam.operations.rates import rates
from mechwright_cam.operations.steps import Steps
from mechwright_cam.operations.stock import Stock
from mechwright_cam.planning.assign import Assignments
from mechwright_cam.planning.notes import clamp_message, notes
from mechwright_cam.planning.schedule import Step, order
from mechwright_cam.program.moves import Move, Operation, Pause, Program, ToolSection
from mechwright_cam.setup.job import Job
from mechwright_cam.setup.lay_out import check_clamp
from mechwright_cam.shop.tool import Tool, ToolKind


def plan(job: Job, assignments: Assignments | None = None) -> Program:
    """Plan the whole machining of a plate part; ``assignments`` keeps who cuts what.

    Raises ToolError where the cutters of the job cannot make the part, DesignError where the holding or the
    stock is in the way.
    """
    return _Planner(job, assignments or Assignments()).program()


def clearance_height(job: Job) -> float:
    """Height of rapids over stock and clamp, z in mm."""
    return job.settings.clearance + job.highest


class _Planner:
    """Collects the steps of a job in an order that makes sense, each waiting for those it depends on."""

    def __init__(self, job: Job, assignments: Assignments) -> None:
        self.job = job
        self.steps: list[Step] = []
        self.clearance = clearance_height(job)
        self.assigned = assignments.of(job)
        self.tasks = self.assigned.every()
        self.turns = [one.name for one in assignments.operations(job.settings)]
        self.cuts = Steps(job, self.clearance, self.assigned.depths())

    def program(self) -> Program:
        job = self.job
        inner = self._inner()
        outer = self._outer(inner)
        if not self.steps:
            raise DesignError(f"part {job.part.name} has no feature to machine; its program would be empty")
        if job.clamp and outer:
            sections = self._sections(inner) if inner else []
            if not sections:
                raise DesignError(
                    f"cam.hold.method: part {job.part.name} has no opening to clamp through before its "
                    'outside is cut; use method = "tabs"'
                )
            stop = Operation("clamp", (Pause(clamp_message(job)),))
            sections[-1] = replace(sections[-1], operations=(*sections[-1].operations, stop))
            sections += self._sections(outer)
        else:
            sections = self._sections(inner | outer)
        through = {task.hole.drill.name for task in self.tasks if task.hole and task.hole.deep is None}
        drills = [step.tool for step in self.steps if step.tool.name in through]
        low = [
            t for t in self.tasks for tool in t.tools if tool.kind is ToolKind.TAP and t.bottom < job.floor
        ]
        reamers = any(step.tool.kind is ToolKind.REAMER for step in self.steps)
        return Program(
            job.part.name,
            job.settings.work_offset,
            self.clearance,
            _merged(sections),
            notes(
                self.job,
                drills,
                self._through_with_round_ends(),
                reamers=reamers,
                tapped=max((-task.bottom - job.thickness for task in low), default=0.0),
            ),
            compensation=job.settings.compensation,
            wear_limit=job.settings.wear_limit,
            more_offsets=job.settings.more_offsets,
        )

    def _step(self, name: str, tool: Tool, moves: tuple[Move, ...], after: frozenset[int]) -> frozenset[int]:
        if not moves:
            return after
        spindle = rates(tool, self.job.part.material, self.job.settings.machine).spindle
        self.steps.append(Step(name, tool, spindle, moves, after))
        return frozenset({len(self.steps) - 1})

    def _cut(self, task: Task, after: frozenset[int]) -> None:
        """The steps of a task, which wait for each other."""
        stock = Stock(task.region, self.job.gone)
        if task.hole is not None and task.tools:
            opened = shapely.Point(task.hole.place).buffer(task.hole.drill.radius, quad_segs=32)
            stock = stock.without(opened)
        done = len(self.cuts.cuts)
        task.operation.cut(task, stock, self.cuts)
        for cut in self.cuts.cuts[done:]:
            after = self._step(*cut, after)

    def _through_with_round_ends(self) -> list[Tool]:
        """The round mills that go below the usual breakthrough."""
        lowest = self.job.floor - TOLERANCES.closure
        return [step.tool for step in self.steps if step.tool.nose > 0 and _lowest(step.moves) < lowest]

    def _inner(self) -> frozenset[int]:
        inside = sorted(
            self.assigned.inside, key=lambda task: (-task.top, self.turns.index(task.operation.name))
        )
        after = self._drilled([task.hole for task in inside if task.hole is not None])
        # What starts on the floor of a recess waits until all recesses above are cut.
        for _, level in groupby(inside, key=lambda task: task.top):
            for task in level:
                self._cut(task, after)
            after = frozenset(range(len(self.steps)))
        self._details(after, outside=False)
        return frozenset(range(len(self.steps)))

    def _drilled(self, holes: list[Hole]) -> frozenset[int]:
        job = self.job
        after: frozenset[int] = frozenset()
        spot = self.assigned.spot(job)
        if spot is not None:
            places = [(hole.place, hole.drill.diameter) for hole in holes]
            after = self._step("spot drill", spot, spot_moves(job, spot, places, self.clearance), after)
        done = after
        for drill, deep in {
            (hole.drill.number, hole.deep): (hole.drill, hole.deep) for hole in holes
        }.values():
            same = [hole.place for hole in holes if hole.drill is drill and hole.deep == deep]
            name = f"drill {drill.diameter:g}" + ("" if deep is None else f" to {deep:.4g}")
            moves = drill_moves(job, drill, same, -job.floor if deep is None else deep, self.clearance)
            done = done | self._step(name, drill, moves, after)
        return done

    def _outer(self, after: frozenset[int]) -> frozenset[int]:
        check_clamp(self.job)
        before = len(self.steps)
        for task in self.tasks:
            if task.is_outside and not task.is_detail:
                self._cut(task, after)
        self._details(frozenset(range(len(self.steps))), outside=True)
        return frozenset(range(before, len(self.steps)))

    def _details(self, after: frozenset[int], *, outside: bool) -> None:
        for task in self.tasks:
            if task.is_detail and task.is_outside == outside:
                self._cut(task, after)

    def _sections(self, wanted: frozenset[int]) -> list[ToolSection]:
        """The wanted steps in runs of one tool; steps outside count as done."""
        chosen = sorted(wanted)
        place = {old: new for new, old in enumerate(chosen)}
        known = (self.steps[i] for i in chosen)
        steps = [replace(step, after=frozenset(place[i] for i in step.after if i in place)) for step in known]
        return [
            ToolSection(
                steps[run[0]].tool,
                steps[run[0]].spindle,
                self.job.settings.coolant,
                tuple(Operation(steps[i].name, steps[i].moves) for i in run),
            )
            for run in order(steps)
        ]


def _lowest(moves: tuple[Move, ...]) -> float:
    """Lowest z of some moves, mm."""
    heights = (getattr(move, "z", None) for move in moves)
    return min((z for z in heights if z is not None), default=math.inf)


def _merged(sections: list[ToolSection]) -> tuple[ToolSection, ...]:
    """Neighbours with one tool become one section."""
    runs = (list(run) for _, run in groupby(sections, key=lambda section: section.tool))
    return tuple(replace(run[0], operations=sum((one.operations for one in run), ())) for run in runs)
