"""From a job to a program."""

import math
from collections.abc import Callable
from functools import partial

import shapely

from mechwright.details import Chamfer, Detail, Engraving, Thread
from mechwright.errors import DesignError, ToolError
from mechwright.geometry.segments import Point
from mechwright.part import Bore, OpenProfile
from mechwright.program import Move, Operation, Pause, Program, ToolSection
from mechwright.tolerances import TOLERANCES
from mechwright.tooling import Tool, ToolKind
from mechwright_cam.job import Job
from mechwright_cam.planning.centre_lines import grooves, write_groove
from mechwright_cam.planning.choice import entry_place, roughers
from mechwright_cam.planning.clearing import COARSE_FROM, SLIVER, Roughing
from mechwright_cam.planning.compensation import CompensatedFinishing, check_compensated
from mechwright_cam.planning.congruent import Copies
from mechwright_cam.planning.contour_writer import finish_bore_compensated
from mechwright_cam.planning.details import plan_detail
from mechwright_cam.planning.facing import face, is_face
from mechwright_cam.planning.finishing import Finishing
from mechwright_cam.planning.floors import floor_allowance, layers, over_openings
from mechwright_cam.planning.grooves import groove
from mechwright_cam.planning.holes import (
    BorePlan,
    drill_moves,
    finish_bore,
    plan_bore,
    rough_bore,
    spot_drill,
    spot_moves,
    starting_drill,
)
from mechwright_cam.planning.notes import clamp_message, notes
from mechwright_cam.planning.pen import Pen
from mechwright_cam.planning.rates import rates
from mechwright_cam.planning.schedule import Step, order
from mechwright_cam.planning.zone import HEAVY, Zone, check_clamp, inner_zones, outer_walls
from mechwright_cam.tabs import Tab
from mechwright_cam.threads import together
from mechwright_cam.toolpath.offsets import grow, opened, polygons

Cut = tuple[str, Tool, tuple[Move, ...]]
"""Name, cutter and moves of an operation."""

WORTH_A_TOOL = 0.25
"""An intermediate roughing mill is used if it takes this share of what is left; less does not pay."""

NEARLY = 0.9
"""Share of the heavy stock from which on a rough path through narrow places is worth its time."""


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
        self.slope = math.tan(math.radians(job.settings.ramp_angle))
        self.steps: list[Step] = []
        self.copies = Copies()

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

    def _through_with_round_ends(self) -> list[Tool]:
        """The round mills that go below the usual breakthrough."""
        lowest = self.job.floor - TOLERANCES.closure
        return [step.tool for step in self.steps if step.tool.nose > 0 and _lowest(step.moves) < lowest]

    def _moves(
        self,
        tool: Tool,
        write: Callable[[Pen], object],
        engagement: float = math.pi / 2,
        depth: float = math.inf,
        over: tuple[Tab, ...] = (),
    ) -> tuple[Move, ...]:
        """The moves that ``write`` makes; a cut is ``depth`` mm deep where that makes chips thinner."""
        settings = self.job.settings
        depth = depth if settings.chip_thinning else math.inf
        speed = rates(tool, self.job.part.material, settings.machine, engagement, depth)
        pen = Pen(tool, speed, self.clearance, self.slope, over)
        write(pen)
        return tuple(pen.moves)

    def _milled(
        self, name: str, tool: Tool, after: frozenset[int], write: Callable[[Pen], object]
    ) -> frozenset[int]:
        return self._step(name, tool, self._moves(tool, write), after)

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
                    self._recess(zone, after, leave)
                else:
                    self._wall(over_openings(job, zone), after, zone.mills)
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
            self._wall(zones, after, zones[0].mills)
        self._details(frozenset(range(len(self.steps))), outside=True)
        return frozenset(range(before, len(self.steps)))

    def _details(self, after: frozenset[int], *, outside: bool) -> None:
        for plan in (plan_detail(self.job, detail) for detail in self.job.details):
            if plan.outside == outside:
                self._milled(_named(plan.detail), plan.tool, after, plan.write)

    def _wall(self, zones: list[Zone], after: frozenset[int], mills: list[Tool]) -> None:
        """Rough, rough the rest, and finish one wall; ``zones`` are its layers from the top down.

        The layers are planned side by side, for no layer's geometry depends on another's; their cuts are
        lined up in the order of machining.
        """
        allowance = self.job.settings.stock_to_leave
        finest = zones[0].finisher
        for zone in zones:
            for written in self._cleared(zone, mills):
                after = self._step(*written, after)
        for mill in roughers(mills, finest):
            zones[0].rough_keep(allowance, mill.radius)  # the layers share it, and would ask for it at once
            cuts = together(partial(self._roughing, mill=mill, allowance=allowance), zones)
            # The layers share their cutters: the tallest one decides.
            if max(zip(zones, cuts, strict=True), key=lambda pair: pair[0].height)[1].share >= WORTH_A_TOOL:
                for written in together(self._rough, cuts):
                    after = self._step(*written, after)
        for layer in together(self._finished, zones):
            # A layer is finished before the one below is cut to the wall: nothing is sunk beside stock.
            for written in layer:
                after = self._step(*written, after)

    def _recess(self, zone: Zone, after: frozenset[int], leave: float) -> None:
        """Rough a recess to just above its floor, finish the floor, then the wall from top to bottom."""
        finest, allowance = zone.finisher, self.job.settings.stock_to_leave
        upper, floor = layers(zone, leave)
        roughs, (floor,) = over_openings(self.job, upper), over_openings(self.job, floor)
        cuts = [cut for rough in roughs for cut in self._cleared(rough, zone.mills)]
        cleared = [mill for _, mill, _ in cuts]
        for mill in roughers(zone.mills, finest):
            found = [self._roughing(rough, mill, allowance) for rough in roughs]
            if found[0].share >= WORTH_A_TOOL:
                cuts += [self._rough(cut) for cut in found]
                # Where bounded engagement left corners standing, a wide cutter would run into them.
                cuts += [] if cleared else [self._floored(floor, mill)]
        for mill in zone.last_mills:
            for rough in roughs:
                cuts += [self._rough(self._roughing(rough, mill, allowance)), *self._rough_heavy(rough, mill)]
        # What round mills left at the foot of the wall is cut in one go, down to the floor.
        if not shapely.is_empty(roughs[-1].ridges):
            floor.ridges = shapely.union(floor.ridges, roughs[-1].ridges)
            floor.ridge_height = roughs[-1].ridge_height + leave
        early = [mill for mill in cleared if mill.name not in {last.name for last in zone.last_mills}]
        cuts += [self._floored(floor, mill) for mill in [*early, *zone.last_mills]]
        cuts += self._rough_heavy(floor, finest, "finish the floor of narrow places")
        for mill in zone.last_mills:
            cuts += self._ridges(floor, mill)
        every = [*roughs, floor]
        zone.left = shapely.union_all([layer.left for layer in every])
        zone.over = max(layer.over for layer in every)
        zone.ridges = floor.ridges
        for written in [*cuts, *(self._finish(zone, mill) for mill in zone.last_mills)]:
            after = self._step(*written, after)

    def _floored(self, floor: Zone, mill: Tool) -> Cut:
        """The floor as far as a mill has roughed above it, in one even pass."""
        what = "finish the rest of the floor" if floor.begun else "finish the floor"
        # Ring for ring where it has roughed: nothing stands beside the places at which it is sunk.
        cut = self._roughing(floor, mill, self.job.settings.stock_to_leave)
        step_down = mill.cutting[self.job.part.material].step_down * mill.diameter
        deep = _pass(floor, mill, step_down)
        moves = self._moves(mill, partial(cut.write, step_down=step_down), depth=deep)
        cut.commit()
        floor.begun = True
        return f"{floor.name}: {what}", mill, moves

    def _clearing_mill(self, zone: Zone, mills: list[Tool]) -> Tool:
        """The largest mill that has room to turn, else the one that finishes."""
        from mechwright_cam.planning.adaptive import HELIX

        widest = max(entry_place(part)[1] for part in polygons(zone.clear))
        fit = [m for m in mills if m.radius >= zone.finisher.radius and HELIX * m.diameter <= 2 * widest]
        return fit[0] if fit else zone.finisher

    def _roughing(self, zone: Zone, mill: Tool, allowance: float) -> Roughing:
        data = mill.cutting[self.job.part.material]
        allowance = zone.allowance_for(mill, allowance)
        return Roughing(zone, mill, allowance, data.step_over, self.job.settings.climb)

    def _rough(self, cut: Roughing) -> Cut:
        zone, mill = cut.zone, cut.tool
        what = "rough the rest" if zone.begun else "rough"
        step_down = mill.cutting[self.job.part.material].step_down * mill.diameter
        deep = _pass(zone, mill, step_down)
        moves = self._moves(mill, partial(cut.write, step_down=step_down), depth=deep, over=zone.slopes)
        cut.commit()
        if not zone.begun:
            zone.forget_waste(mill, self.job.settings.stock_to_leave)
            zone.begun = True
        return f"{zone.name}: {what}", mill, moves

    def _cleared(self, zone: Zone, mills: list[Tool]) -> list[Cut]:
        """What bounded engagement can rough, deep and fast; the rest is for the contour passes."""
        settings = self.job.settings
        if settings.clearing != "adaptive" or zone.kind == "outside" or zone.snug:
            return []
        mill = self._clearing_mill(zone, mills)
        from mechwright_cam.planning import adaptive

        allowance = zone.allowance_for(mill, max(settings.stock_to_leave, COARSE_FROM))
        area = shapely.difference(zone.clear, zone.rough_keep(allowance))
        limit = math.radians(settings.engagement)
        wanted = [part for part in polygons(area) if shapely.intersects(part, zone.left)]
        area = shapely.union_all(wanted)
        before = zone.left.area
        cavities = self.copies.clear(zone.feature, area, mill, limit, settings.climb)
        reached = shapely.union_all([cavity.cleared for cavity in cavities])
        if before - shapely.difference(zone.left, reached).area < WORTH_A_TOOL * before:
            return []
        depth = min(settings.adaptive_depth * mill.diameter, mill.flute_length)
        moves = self._moves(
            mill,
            lambda pen: adaptive.write(cavities, pen, zone.top, zone.bottom_for(mill), depth, settings.climb),
            limit if settings.chip_thinning else math.pi / 2,
            _pass(zone, mill, depth),
        )
        zone.leave_ridges(mill, reached)
        zone.left = shapely.difference(zone.left, reached)
        zone.begun = True
        return [(f"{zone.name}: clear", mill, moves)]

    def _finished(self, zone: Zone) -> list[Cut]:
        """The last cuts of one layer, with a flat end mill before a finer round one."""
        if zone.snug:
            check_compensated(self.job, zone, zone.finisher)
            return [self._groove(zone, zone.finisher)]
        cuts: list[Cut] = []
        for mill in zone.last_mills:
            cuts.append(self._rough(self._roughing(zone, mill, self.job.settings.stock_to_leave)))
            cuts += [*self._rough_heavy(zone, mill), *self._ridges(zone, mill), self._finish(zone, mill)]
        return cuts

    def _finish(self, zone: Zone, mill: Tool) -> Cut:
        settings = self.job.settings
        deep = _pass(zone, mill, settings.finish_step * mill.diameter)
        plain = settings.compensation == "computer"
        finishing = Finishing(zone, settings, mill) if plain else CompensatedFinishing(zone, self.job, mill)
        moves = self._moves(mill, finishing.write, depth=deep, over=zone.slopes)
        if not moves:
            raise ToolError(
                f"cam.tools: {mill.name} finds no way along {zone.name} of {self.job.part.name}; "
                "list a smaller end mill"
            )
        return f"{zone.name}: finish", mill, moves

    def _groove(self, zone: Zone, mill: Tool) -> Cut:
        """All of a groove that the mill fills."""
        settings = self.job.settings
        step = mill.cutting[self.job.part.material].step_down * mill.diameter
        moves = self._moves(
            mill, lambda pen: groove(zone, settings, pen, step), depth=_pass(zone, mill, step)
        )
        if not moves:
            raise ToolError(
                f"cam.tools: {mill.name} finds no way along {zone.name} of {self.job.part.name}; draw it as "
                f"wide as the mill, {mill.diameter:g} mm, or wider"
            )
        return f"{zone.name}: groove", mill, moves

    def _ridges(self, zone: Zone, mill: Tool) -> list[Cut]:
        """Make the floor flat where round mills have left fillets or cusps on it."""
        if shapely.is_empty(zone.ridges):
            return []
        data = mill.cutting[self.job.part.material]
        allowance = zone.allowance_for(mill, self.job.settings.stock_to_leave)
        cut = Roughing(
            zone, mill, allowance, data.step_over, self.job.settings.climb, only=zone.ridges, ridges=True
        )
        step_down = data.step_down * mill.diameter
        deep = _pass(zone, mill, min(step_down, zone.ridge_height))
        moves = self._moves(mill, lambda pen: cut.write(pen, step_down), depth=deep)
        cut.commit()
        return [(f"{zone.name}: level the floor", mill, moves)]

    def _rough_heavy(self, zone: Zone, mill: Tool, what: str = "rough the narrow places") -> list[Cut]:
        """Where the allowance kept the mill out of narrow places, rough nearer to the wall, and there only.

        First as near as a path of roughing accuracy may come; up to the wall itself, with a path as exact and
        as long in the program as that of finishing, only where even that does not fit in.
        """
        data = mill.cutting[self.job.part.material]
        cuts: list[Cut] = []
        for allowance in (COARSE_FROM, 0.0):
            thick = self._heavy(zone, mill)
            if not polygons(thick):
                break
            cut = Roughing(zone, mill, allowance, data.step_over, self.job.settings.climb, only=thick)
            if allowance > 0 and cut.taken < NEARLY * thick.area:
                continue  # the exact one has to go there anyway
            write = partial(cut.write, step_down=data.step_down * mill.diameter)
            moves = self._moves(mill, write, over=zone.slopes)
            cuts.append((f"{zone.name}: {what}", mill, moves))
            near = grow(cut.core, cut.sliver + mill.radius)
            zone.left = shapely.difference(zone.left, shapely.intersection(cut.reach, near))
        return cuts

    def _heavy(self, zone: Zone, mill: Tool) -> shapely.Geometry:
        """What is left in front of a wall that is too thick for the finishing cut."""
        allowance = self.job.settings.stock_to_leave
        thick = shapely.difference(zone.left, zone.rough_keep(allowance + HEAVY))
        if zone.tabs is not None:
            # The corners at the tabs are as low as the tabs: no load worth a pass.
            thick = shapely.difference(thick, grow(zone.tabs, mill.radius + allowance))
        return opened(thick, SLIVER)

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


def _pass(zone: Zone, mill: Tool, step: float) -> float:
    """Depth of the even passes that are no deeper than ``step``, mm."""
    height = zone.top - zone.bottom_for(mill)
    return height / max(1, math.ceil(height / step - 1e-9))


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
