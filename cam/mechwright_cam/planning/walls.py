"""The cuts of one wall or recess: cleared, roughed, roughed again where stock is left, and finished."""

import math
from collections.abc import Callable
from functools import partial

import shapely

from mechwright.cores import together
from mechwright.errors import ToolError
from mechwright.tolerances import TOLERANCES
from mechwright_cam.operations.cavity import write_cavities
from mechwright_cam.operations.choice import entry_place, roughers
from mechwright_cam.operations.clearing import COARSE_FROM, SLIVER, TIGHT, Roughing
from mechwright_cam.operations.compensation import CompensatedFinishing, check_compensated
from mechwright_cam.operations.congruent import Copies
from mechwright_cam.operations.finishing import Finishing, finish_depth
from mechwright_cam.operations.floors import layers, over_openings
from mechwright_cam.operations.grooves import groove
from mechwright_cam.operations.pen import Pen
from mechwright_cam.operations.rates import rates
from mechwright_cam.operations.zone import CUSP, HEAVY, Zone
from mechwright_cam.plane.offsets import ROUGH, areas, grow, opened, polygons
from mechwright_cam.program.moves import Move
from mechwright_cam.setup.holding import Tab
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.cutter import cutter
from mechwright_cam.shop.tool import Tool

Cut = tuple[str, Tool, tuple[Move, ...]]
"""Name, cutter and moves of an operation."""

WORTH_A_TOOL = 0.25
"""An intermediate roughing mill is used if it takes this share of what is left; less does not pay."""

NEARLY = 0.9
"""Share of the heavy stock from which on a rough path through narrow places is worth its time."""


class Walls:
    """Writes the cuts of a job's walls; planning a wall leaves its zones as the cutters leave the stock."""

    def __init__(self, job: Job, clearance: float) -> None:
        self.job, self.clearance = job, clearance
        self.slope = math.tan(math.radians(job.settings.ramp_angle))
        self.copies = Copies()

    def moves(
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

    def cuts(self, zones: list[Zone], mills: list[Tool]) -> list[Cut]:
        """Rough, rough the rest, and finish one wall; ``zones`` are its layers from the top down.

        The layers are planned side by side, for no layer's geometry depends on another's; their cuts are
        lined up in the order of machining.
        """
        allowance = self.job.settings.stock_to_leave
        found = [cut for zone in zones for cut in self._cleared(zone, mills)]
        for mill in roughers(mills, zones[0].last_mills):
            zones[0].rough_keep(allowance, mill.radius)  # the layers share it, and would ask for it at once
            cuts = together(partial(self._roughing, mill=mill, allowance=allowance), zones)
            # The layers share their cutters: the tallest one decides.
            if max(zip(zones, cuts, strict=True), key=lambda pair: pair[0].height)[1].share >= WORTH_A_TOOL:
                found += together(self._rough, cuts)
        # A layer is finished before the one below is cut to the wall: nothing is sunk beside stock.
        return found + [cut for layer in together(self._finished, zones) for cut in layer]

    def recess(self, zone: Zone, leave: float) -> list[Cut]:
        """Rough a recess to just above its floor, finish the floor, then the wall from top to bottom."""
        finest, allowance = zone.finisher, self.job.settings.stock_to_leave
        upper, floor = layers(zone, leave)
        roughs, (floor,) = over_openings(self.job, upper), over_openings(self.job, floor)
        cuts = [cut for rough in roughs for cut in self._cleared(rough, zone.mills, floored=True)]
        cleared = [mill for _, mill, _ in cuts]
        above: dict[str, Roughing] = {}
        for mill in roughers(zone.mills, zone.last_mills):
            found = [self._roughing(rough, mill, allowance) for rough in roughs]
            if found[0].share >= WORTH_A_TOOL:
                cuts += [self._rough(cut) for cut in found]
                # Where bounded engagement left corners standing, a wide cutter would run into them.
                cuts += [] if cleared else [self._floored(floor, mill, found[-1])]
        for mill in zone.last_mills:
            for rough in roughs:
                above[mill.name] = self._roughing(rough, mill, allowance)
                cuts += [self._rough(above[mill.name]), *self._rough_heavy(rough, mill)]
        # What round mills left at the foot of the wall is cut in one go, down to the floor.
        if not shapely.is_empty(roughs[-1].ridges):
            floor.ridges = shapely.union(floor.ridges, roughs[-1].ridges)
            floor.ridge_height = roughs[-1].ridge_height + leave
        early = [mill for mill in cleared if mill.name not in {last.name for last in zone.last_mills}]
        cuts += [self._floored(floor, mill, above.get(mill.name)) for mill in [*early, *zone.last_mills]]
        cuts += self._rough_heavy(floor, finest, "finish the floor of narrow places")
        for mill in zone.last_mills:
            cuts += self._ridges(floor, mill)
        every = [*roughs, floor]
        zone.left = shapely.union_all([layer.left for layer in every])
        zone.over = max(layer.over for layer in every)
        zone.ridges = floor.ridges
        return [*cuts, *(self._finish(zone, mill) for mill in zone.last_mills)]

    def _floored(self, floor: Zone, mill: Tool, above: Roughing | None) -> Cut:
        """The floor as far as a mill has roughed ``above`` it, in one even pass."""
        what = "finish the rest of the floor" if floor.begun else "finish the floor"
        # Ring for ring where it has roughed: nothing stands beside the places at which it is sunk.
        if above is not None and above.serves(floor):
            cut = above.at(floor)
        else:
            cut = self._roughing(floor, mill, self.job.settings.stock_to_leave)
        step_down = mill.cutting[self.job.part.material].step_down * mill.diameter
        deep = _pass(floor, mill, step_down)
        moves = self.moves(mill, partial(cut.write, step_down=step_down), depth=deep)
        cut.commit()
        floor.begun = True
        return f"{floor.name}: {what}", mill, moves

    def _clearing_mill(self, zone: Zone, mills: list[Tool]) -> Tool:
        """The largest mill that has room to turn, else the one that finishes."""
        from mechwright_cam.operations.adaptive import HELIX

        widest = max(entry_place(part)[1] for part in polygons(zone.clear))
        large = [m for m in mills if m.radius >= zone.finisher.radius or zone.finisher not in mills]
        fit = [m for m in large if HELIX * m.diameter <= 2 * widest]
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
        moves = self.moves(mill, partial(cut.write, step_down=step_down), depth=deep, over=zone.slopes)
        cut.commit()
        if not zone.begun:
            zone.forget_waste(mill, self.job.settings.stock_to_leave)
            zone.begun = True
        return f"{zone.name}: {what}", mill, moves

    def _cleared(self, zone: Zone, mills: list[Tool], *, floored: bool = False) -> list[Cut]:
        """What bounded engagement can rough, deep and fast; the rest is for the contour passes.

        If the zone is ``floored`` a pass over all of its floor comes afterwards.
        """
        settings = self.job.settings
        if settings.clearing != "adaptive" or zone.kind == "outside" or zone.snug:
            return []
        mill = self._clearing_mill(zone, mills)
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
        moves = self.moves(
            mill,
            lambda pen: write_cavities(cavities, pen, zone.top, zone.bottom_for(mill), depth, settings.climb),
            limit if settings.chip_thinning else math.pi / 2,
            _pass(zone, mill, depth),
        )
        foot = float(cutter(mill).radius_at(CUSP))
        closely = grow(reached, foot - mill.radius, ROUGH)
        if not floored and mill.nose > 0:
            closely = shapely.intersection(closely, shapely.union_all([c.swept(foot) for c in cavities]))
        zone.leave_ridges(mill, reached, closely)
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
        settings, material = self.job.settings, self.job.part.material
        deep = _pass(zone, mill, finish_depth(settings, mill, material))
        plain = settings.compensation == "computer"
        finishing = (
            Finishing(zone, settings, mill, material) if plain else CompensatedFinishing(zone, self.job, mill)
        )
        moves = self.moves(mill, finishing.write, depth=deep, over=zone.slopes)
        if not moves and mill is zone.finisher:
            raise ToolError(
                f"cam.tools: {mill.name} finds no way along {zone.name} of {self.job.part.name}; "
                "list a smaller end mill"
            )
        return f"{zone.name}: finish", mill, moves

    def _groove(self, zone: Zone, mill: Tool) -> Cut:
        """All of a groove that the mill fills."""
        settings = self.job.settings
        step = mill.cutting[self.job.part.material].step_down * mill.diameter
        moves = self.moves(mill, lambda pen: groove(zone, settings, pen, step), depth=_pass(zone, mill, step))
        if not moves and mill is zone.finisher:
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
        # The next ring towards the wall is that of finishing.
        ring = 2 * TIGHT * float(cutter(mill).radius_at(CUSP))
        allowance = zone.allowance_for(mill, min(self.job.settings.stock_to_leave, ring))
        cut = Roughing(
            zone, mill, allowance, data.step_over, self.job.settings.climb, only=zone.ridges, ridges=True
        )
        step_down = data.step_down * mill.diameter
        deep = _pass(zone, mill, min(step_down, zone.ridge_height))
        moves = self.moves(mill, lambda pen: cut.write(pen, step_down), depth=deep)
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
            moves = self.moves(mill, write, over=zone.slopes)
            cuts.append((f"{zone.name}: {what}", mill, moves))
            cut.commit_core()
        return cuts

    def _heavy(self, zone: Zone, mill: Tool) -> shapely.Geometry:
        """What is left in front of a wall that is too thick for the finishing cut."""
        allowance = self.job.settings.stock_to_leave
        thick = areas(shapely.difference(zone.left, zone.rough_keep(allowance + HEAVY)))
        if zone.tabs is not None:
            # The corners at the tabs are as low as the tabs: no load worth a pass.
            thick = shapely.difference(thick, grow(zone.tabs, mill.radius + allowance))
        return opened(thick, SLIVER)


def _pass(zone: Zone, mill: Tool, step: float) -> float:
    """Depth of the even passes that are no deeper than ``step``, mm."""
    height = zone.top - zone.bottom_for(mill)
    return height / max(1, math.ceil(height / step - TOLERANCES.noise))
