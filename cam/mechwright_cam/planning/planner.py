"""From a job to a program."""

import math
from collections.abc import Callable
from functools import partial

import shapely

from mechwright.contracts.details import Chamfer, Detail, Engraving, Thread
from mechwright.contracts.part import Bore, OpenProfile
from mechwright.errors import DesignError
from mechwright.geometry.segments import Point
from mechwright.tolerances import TOLERANCES
from mechwright_cam.operations.centre_lines import grooves, write_groove
from mechwright_cam.operations.choice import entry_place
from mechwright_cam.operations.contour_writer import finish_bore_compensated
from mechwright_cam.operations.details import plan_detail
from mechwright_cam.operations.facing import face, is_face
from mechwright_cam.operations.floors import floor_allowance, over_openings
from mechwright_cam.operations.holes import (
    BorePlan,
    drill_moves,
    finish_bore,
    plan_bore,
    rough_bore,
    spot_drill,
    spot_moves,
    starting_drill,
)
from mechwright_cam.operations.pen import Pen
from mechwright_cam.operations.rates import rates
from mechwright_cam.operations.zone import Zone
from mechwright_cam.planning.notes import clamp_message, notes
from mechwright_cam.planning.schedule import Step, order
from mechwright_cam.planning.walls import Cut, Walls
from mechwright_cam.planning.zones import check_clamp, inner_zones, outer_walls
from mechwright_cam.program.moves import Move, Operation, Pause, Program, ToolSection
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.tool import Tool, ToolKind


def plan(job: Job) -> Program:
    """Plan the whole machining of a plate part.

    Raises
    ------
    ToolError
        The cutters of the job cannot make the part.
    DesignError
        The holding or the stock is in the way.
    """
    return _Planner(job).program()


def clearance_height(job: Job) -> float:
    """Height of rapids over stock and clamp, z in mm."""
    return job.settings.clearance + (job.clamp.top if job.clamp else 0.0)


class _Planner:
    """Collects the steps of a job in an order that makes sense, each waiting for those it depends on."""

    def __init__(self, job: Job) -> None:
        self.job = job
        self.clearance = clearance_height(job)
        self.steps: list[Step] = []
        self.walls = Walls(job, self.clearance)

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
            sections[-1] = _with_operation(
                sections[-1], Operation("clamp", (Pause(clamp_message(self.job)),))
            )
            sections += self._sections(outer)
        else:
            sections = self._sections(inner | outer)
        drills = [step.tool for step in self.steps if step.tool.kind is ToolKind.DRILL]
        return Program(
            job.part.name,
            job.settings.work_offset,
            self.clearance,
            _merged(sections),
            notes(self.job, drills, self._through_with_round_ends()),
            compensation=job.settings.compensation,
            wear_limit=job.settings.wear_limit,
        )

    def _step(self, name: str, tool: Tool, moves: tuple[Move, ...], after: frozenset[int]) -> frozenset[int]:
        if not moves:
            return after
        spindle = rates(tool, self.job.part.material, self.job.settings.machine).spindle
        self.steps.append(Step(name, tool, spindle, moves, after))
        return frozenset({len(self.steps) - 1})

    def _chain(self, cuts: list[Cut], after: frozenset[int]) -> None:
        """Steps that wait for each other."""
        for cut in cuts:
            after = self._step(*cut, after)

    def _through_with_round_ends(self) -> list[Tool]:
        """The round mills that go below the usual breakthrough."""
        lowest = self.job.floor - TOLERANCES.closure
        return [step.tool for step in self.steps if step.tool.nose > 0 and _lowest(step.moves) < lowest]

    def _milled(
        self, name: str, tool: Tool, after: frozenset[int], write: Callable[[Pen], object]
    ) -> frozenset[int]:
        return self._step(name, tool, self.walls.moves(tool, write), after)

    def _inner(self) -> frozenset[int]:
        job = self.job
        bores = [plan_bore(job, feature) for feature in job.features if isinstance(feature, Bore)]
        zones = inner_zones(job, skip=grooves(job))
        entries = {
            zone.name: self._entry(zone)
            for zone in zones
            if zone.kind == "inside" and zone.bottom == job.floor
        }
        holes: list[tuple[Tool, Point, str]] = [
            (plan.drill, plan.bore.centre, plan.bore.name) for plan in bores if plan.drill is not None
        ]
        holes += [(drill, place, name) for name, (drill, place) in entries.items() if drill is not None]
        drilled = self._drilled(holes)
        after = drilled
        # What starts on the floor of a recess waits until all recesses above are cut.
        for top in sorted({-feature.top for feature in job.features}, reverse=True):
            for plan in bores:
                if -plan.bore.top == top:
                    self._bore(plan, after)
            self._slots(top, after)
            for zone in zones:
                if zone.top != top:
                    continue
                if is_face(zone):
                    self._face(zone, after)
                    continue
                drill, place = entries.get(zone.name, (None, (0.0, 0.0)))
                if drill is not None:
                    hole = shapely.Point(place).buffer(drill.radius, quad_segs=32)
                    zone.left = shapely.difference(zone.left, hole)
                leave = floor_allowance(job, zone.top, zone.bottom)
                if leave > 0 and not zone.snug:
                    self._chain(self.walls.recess(zone, leave), after)
                else:
                    self._chain(self.walls.cuts(over_openings(job, zone), zone.mills), after)
            after = frozenset(range(len(self.steps)))
        self._details(after, outside=False)
        return frozenset(range(len(self.steps)))

    def _face(self, zone: Zone, after: frozenset[int]) -> None:
        mill, stock = zone.mills[0], shapely.box(*self.job.stock)
        depth = mill.cutting[self.job.part.material].step_down * mill.diameter
        leave = floor_allowance(self.job, zone.top, zone.bottom)
        self._milled(f"{zone.name}: face", mill, after, lambda pen: face(zone, pen, stock, depth, leave))

    def _slots(self, top: float, after: frozenset[int]) -> None:
        """Grooves as wide as a mill that begin at this height."""
        mills = grooves(self.job)
        for feature in self.job.features:
            if isinstance(feature, OpenProfile) and feature.name in mills and -feature.top == top:
                leave = floor_allowance(self.job, top, -feature.top - feature.depth)
                write = partial(write_groove, self.job, feature, leave=leave)
                self._milled(f"{feature.name}: slot", mills[feature.name], after, write)

    def _entry(self, zone: Zone) -> tuple[Tool | None, Point]:
        place, radius = entry_place(zone.clear)
        return starting_drill(self.job, 2 * radius, -zone.bottom), place

    def _drilled(self, holes: list[tuple[Tool, Point, str]]) -> frozenset[int]:
        job = self.job
        after: frozenset[int] = frozenset()
        spot = spot_drill(job)
        if spot is not None and holes:
            places = [(place, drill.diameter) for drill, place, _ in holes]
            after = self._step("spot drill", spot, spot_moves(job, spot, places, self.clearance), after)
        done = after
        for drill in {drill.number: drill for drill, _, _ in holes}.values():
            places_of = [place for other, place, _ in holes if other is drill]
            moves = drill_moves(job, drill, places_of, -job.floor, self.clearance)
            done = done | self._step(f"drill {drill.diameter:g}", drill, moves, after)
        return done

    def _bore(self, plan: BorePlan, after: frozenset[int]) -> None:
        if plan.mill is None:
            return
        name, job = plan.bore.name, self.job
        after = self._milled(f"{name}: bore", plan.mill, after, lambda pen: rough_bore(job, plan, pen))
        write = partial(finish_bore, job, plan)
        if job.settings.compensation != "computer":
            write = partial(finish_bore_compensated, job, plan.bore)
        self._milled(f"{name}: finish", plan.mill, after, write)

    def _outer(self, after: frozenset[int]) -> frozenset[int]:
        check_clamp(self.job)
        before = len(self.steps)
        for zones in outer_walls(self.job):
            self._chain(self.walls.cuts(zones, zones[0].mills), after)
        self._details(frozenset(range(len(self.steps))), outside=True)
        return frozenset(range(before, len(self.steps)))

    def _details(self, after: frozenset[int], *, outside: bool) -> None:
        for plan in (plan_detail(self.job, detail) for detail in self.job.details):
            if plan.outside == outside:
                self._milled(_named(plan.detail), plan.tool, after, plan.write)

    def _sections(self, wanted: frozenset[int]) -> list[ToolSection]:
        """The wanted steps in runs of one tool; steps outside count as done."""
        chosen = sorted(wanted)
        place = {old: new for new, old in enumerate(chosen)}
        steps = [
            Step(
                step.name,
                step.tool,
                step.spindle,
                step.moves,
                frozenset(place[i] for i in step.after if i in place),
            )
            for step in (self.steps[i] for i in chosen)
        ]
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


def _named(detail: Detail) -> str:
    what = {Chamfer: "chamfer", Thread: "thread", Engraving: "engrave"}[type(detail)]
    return f"{detail.name}: {what}"


def _with_operation(section: ToolSection, operation: Operation) -> ToolSection:
    return ToolSection(section.tool, section.spindle, section.coolant, (*section.operations, operation))


def _merged(sections: list[ToolSection]) -> tuple[ToolSection, ...]:
    """Neighbours with one tool become one section."""
    merged: list[ToolSection] = []
    for section in sections:
        if merged and merged[-1].tool == section.tool:
            last = merged[-1]
            merged[-1] = ToolSection(
                last.tool, last.spindle, last.coolant, last.operations + section.operations
            )
        else:
            merged.append(section)
    return tuple(merged)
