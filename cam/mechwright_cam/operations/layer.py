"""One layer of a wall while it is cut: roughed, roughed again where stock is left, and finished."""

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from operator import methodcaller

import shapely

from mechwright.errors import ToolError
from mechwright.tolerances import TOLERANCES
from mechwright.worker_pool.budget import threaded_map
from mechwright_cam.operations.choice import HEAVY, roughers
from mechwright_cam.operations.clearing import COARSE_FROM, SLIVER, TIGHT, Roughing
from mechwright_cam.operations.compensation import CompensatedFinishing
from mechwright_cam.operations.deeper import join
from mechwright_cam.operations.finishing import Finishing, finish_depth, finish_engagement
from mechwright_cam.operations.ladder import change_time, rest_time
from mechwright_cam.operations.pen import Pen
from mechwright_cam.operations.steps import Cut, Steps
from mechwright_cam.operations.stock import Stock
from mechwright_cam.operations.whole_wall import WholeWall
from mechwright_cam.operations.zone import CUSP, Zone
from mechwright_cam.shop.cutter import cutter
from mechwright_cam.shop.tool import Tool
from mechwright_plane.offsets import areas, grow, opened, polygons

WORTH_A_TOOL = 0.25
"""An intermediate roughing mill is used if it takes this share of what is left; less does not pay."""

NEARLY = 0.9
"""Share of the heavy stock from which on a rough path through narrow places is worth its time."""


class Layer:
    """A zone, what its cuts have left of the stock so far, and those cuts, which may go among other ``cuts``.

    Layers of one wall may be cut side by side: none then changes what another one holds.
    """

    def __init__(self, zone: Zone, stock: Stock, steps: Steps, cuts: list[Cut] | None = None) -> None:
        self.zone, self.stock, self.steps = zone, stock, steps
        self.settings = steps.job.settings
        self.cuts: list[Cut] = [] if cuts is None else cuts

    def taken(self) -> list[Cut]:
        """The cuts since they were last asked for."""
        cuts, self.cuts = self.cuts, []
        return cuts

    def add(
        self,
        what: str,
        mill: Tool,
        write: Callable[[Pen], object],
        engagement: float = math.pi / 2,
        depth: float = math.inf,
    ) -> None:
        """Add a cut of this zone, ``depth`` mm deep."""
        moves = self.steps.moves(mill, write, engagement, depth, self.zone.slopes)
        self.cuts.append(Cut(f"{self.zone.name}: {what}", mill, moves))

    def pass_depth(self, mill: Tool, step: float) -> float:
        """Depth of the even passes that are no deeper than ``step``, mm."""
        height = self.zone.top - self.zone.bottom_for(mill)
        return height / max(1, math.ceil(height / step - TOLERANCES.noise))

    def roughing(self, mill: Tool) -> Roughing:
        """What roughing with a mill would cut now."""
        allowance = self.zone.allowance_for(mill, self.settings.stock_to_leave)
        return self._roughing(mill, allowance)

    def _roughing(
        self, mill: Tool, allowance: float, only: shapely.Geometry | None = None, *, ridges: bool = False
    ) -> Roughing:
        step_over = mill.cutting[self.steps.job.part.material].step_over
        climb = self.settings.climb
        return Roughing(self.zone, self.stock, mill, allowance, step_over, climb, only, ridges=ridges)

    def _rings(self, what: str, cut: Roughing, depth: float = math.inf) -> None:
        """Add the rings of a cut, which is no deeper than ``depth`` and than its mill may cut, mm."""
        step_down = self.steps.step_down(cut.tool)
        deep = self.pass_depth(cut.tool, min(step_down, depth))
        self.add(what, cut.tool, self._writing(cut, step_down), depth=deep)

    def _writing(self, cut: Roughing, step_down: float) -> Callable[[Pen], object]:
        return partial(cut.write, step_down=step_down, thinning=self.settings.chip_thinning)

    def rough(self, cut: Roughing) -> None:
        """Rough with one mill."""
        what = "rough the rest" if self.stock.begun else "rough"
        self._rings(what, cut)
        begun, self.stock = self.stock.begun, cut.after()
        if not begun:
            waste = self.zone.waste(cut.tool, self.settings.stock_to_leave)
            self.stock = replace(self.stock, waste=waste, begun=True)

    def saves(self, cut: Roughing) -> bool:
        """Whether a cut takes so much off the finest mill that this pays for a change of tool."""
        job, deep, places = self.steps.job, self.zone.height, len(polygons(cut.core))
        times = (rest_time(job, mill, deep, cut.taken, places) for mill in (self.zone.finisher, cut.tool))
        return next(times) > next(times) + change_time(job)

    def floored(self, mill: Tool, above: Roughing | None) -> None:
        """The floor as far as a mill has roughed ``above`` it, in one even pass."""
        what = "finish the rest of the floor" if self.stock.begun else "finish the floor"
        # Ring for ring where it has roughed: nothing stands beside the places at which it is sunk.
        served = above is not None and above.serves(self.stock)
        cut = above.at(self.zone, self.stock) if above is not None and served else self.roughing(mill)
        self._rings(what, cut)
        self.stock = replace(cut.after(), begun=True)

    def rough_heavy(self, mill: Tool, what: str = "rough the narrow places") -> None:
        """Where the allowance kept the mill out of narrow places, rough nearer to the wall, and there only.

        First as near as a path of roughing accuracy may come; up to the wall itself, with a path as exact and
        as long in the program as that of finishing, only where even that does not fit in.
        """
        for allowance in (COARSE_FROM, 0.0):
            thick = self._heavy(mill)
            if not polygons(thick):
                break
            cut = self._roughing(mill, allowance, thick)
            if allowance > 0 and cut.taken < NEARLY * thick.area:
                continue  # the exact one has to go there anyway
            self.add(what, mill, self._writing(cut, self.steps.step_down(mill, to_size=True)))
            self.stock = cut.after_core()

    def _heavy(self, mill: Tool) -> shapely.Geometry:
        """What is left in front of a wall that is too thick for the finishing cut."""
        allowance = self.settings.stock_to_leave
        thick = areas(shapely.difference(self.stock.left, self.zone.rough_keep(allowance + HEAVY)))
        if self.zone.tabs is not None:
            # The corners at the tabs are as low as the tabs: no load worth a pass.
            thick = shapely.difference(thick, grow(self.zone.tabs, mill.radius + allowance))
        return opened(thick, SLIVER)

    def level(self, mill: Tool) -> None:
        """Make the floor flat where round mills have left fillets or cusps on it."""
        if shapely.is_empty(self.stock.ridges):
            return
        # The next ring towards the wall is that of finishing.
        ring = 2 * TIGHT * float(cutter(mill).radius_at(CUSP))
        allowance = self.zone.allowance_for(mill, min(self.settings.stock_to_leave, ring))
        cut = self._roughing(mill, allowance, self.stock.ridges, ridges=True)
        self._rings("level the floor", cut, self.stock.ridge_height)
        self.stock = cut.after()

    def finish(self, mill: Tool) -> None:
        """Along the wall."""
        settings, job, zone = self.settings, self.steps.job, self.zone
        high, foot = zone.top - zone.bottom_for(mill), -zone.bottom_for(mill)
        deep = self.pass_depth(mill, finish_depth(job, mill, high, foot))
        if settings.compensation == "computer":
            write = Finishing(zone, self.stock, job, mill, self.steps.step_down(mill, to_size=True)).write
        else:
            write = CompensatedFinishing(zone, self.stock, job, mill).write
        # Up and down the slopes of tabs the mill takes more than the allowance.
        engagement = math.pi / 2 if zone.slopes else finish_engagement(settings, mill.radius)
        self.add("finish", mill, write, engagement, deep)
        if not self.cuts[-1].moves and mill is zone.finisher:
            raise ToolError(
                f"cam.tools: {mill.name} finds no way along {zone.name} of {job.part.name}; "
                "list a smaller end mill"
            )

    def finished(self, *, roughed: bool) -> None:
        """The last cuts of a layer, with a flat end mill before a finer round one.

        What the first of them has to rough may be done already.
        """
        for number, mill in enumerate(self.zone.finishers):
            if number or not roughed:
                self.rough(self.roughing(mill))
            self.rough_heavy(mill)
            self.level(mill)
            self.finish(mill)


def cut_layers(layers: Sequence[Layer]) -> list[Cut]:
    """Rough, rough the rest, and finish one wall; its ``layers`` go from the top down.

    They are planned side by side, for no layer's geometry depends on another's; their cuts are lined up in
    the order of machining.
    """
    first = layers[0].zone
    found = [cut for layer in layers for cut in layer.taken()]
    for mill in roughers(first.mills, first.finishers):
        allowance = first.allowance_for(mill, layers[0].settings.stock_to_leave)
        first.rough_keep(allowance, mill.radius)  # the layers share it, and would ask for it at once
        cuts = threaded_map(methodcaller("roughing", mill), layers)
        # The layers share their cutters: the tallest one decides.
        tallest, cut = max(zip(layers, cuts, strict=True), key=lambda pair: pair[0].zone.height)
        if not tallest.stock.begun or cut.share >= WORTH_A_TOOL or tallest.saves(cut):
            found += _roughed(layers, cuts)
    # Places that layers of an outside have in common are roughed before the first of them is finished.
    whole = _may_be_whole(layers)
    if at_once := whole or (first.kind == "outside" and layers[0].stock.begun):
        found += _roughed(layers, threaded_map(methodcaller("roughing", first.finishers[0]), layers))
        if whole and _finished_whole(*layers):
            return found + [cut for layer in layers for cut in layer.taken()]
    # A layer is finished before the one below is cut to the wall: nothing is sunk beside stock.
    threaded_map(methodcaller("finished", roughed=at_once), layers)
    return found + [cut for layer in layers for cut in layer.taken()]


def _may_be_whole(layers: Sequence[Layer]) -> bool:
    """Whether these are a wall with tabs that a flat end mill finishes along the way of its centre."""
    zone, settings = layers[0].zone, layers[0].settings
    flat = [mill.nose for mill in zone.finishers] == [0.0]
    return (
        flat
        and settings.compensation == "computer"
        and [layer.zone.tabs is None for layer in layers] == [True, False]
    )


def _finished_whole(upper: Layer, lower: Layer) -> bool:
    """Finish a roughed wall above and below the tops of its tabs at once, if there is room for it."""
    mill, job, settings = upper.zone.finisher, upper.steps.job, upper.settings
    before = [(layer, layer.stock, list(layer.cuts)) for layer in (upper, lower)]
    for layer in (upper, lower):
        layer.rough_heavy(mill)
    pairs = [(layer.zone, layer.stock) for layer in (upper, lower)]
    whole = WholeWall(pairs[0], pairs[1], job, mill, upper.steps.step_down(mill, to_size=True))
    if upper.stock.fillet or lower.stock.fillet or not whole.fits():
        for layer, stock, cuts in before:
            layer.stock, layer.cuts = stock, cuts
        return False
    moves = upper.steps.moves(mill, whole.write, finish_engagement(settings, mill.radius))  # its end is flat
    lower.cuts.append(Cut(f"{upper.zone.name}: finish", mill, moves))  # behind all that is roughed
    return True


def _roughed(layers: Sequence[Layer], cuts: list[Roughing]) -> list[Cut]:
    """Rough each layer with its cut; places of an outside that layers have in common are cut at once."""
    if layers[0].zone.kind == "outside" and layers[0].stock.begun:
        threaded_map(lambda cut: cut.cavities, cuts)
        join(cuts)
    threaded_map(lambda pair: pair[0].rough(pair[1]), zip(layers, cuts, strict=True))
    return [cut for layer in layers for cut in layer.taken()]
