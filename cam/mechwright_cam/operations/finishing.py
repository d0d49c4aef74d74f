"""Finishing: along the wall in depth passes, entered and left on tangential arcs."""

import math

import numpy as np
import shapely
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.contracts.part import Bore
from mechwright.geometry.prepared import prepared
from mechwright.tolerances import TOLERANCES
from mechwright_cam.operations.bending import MOST, borne_wall, wall_bending
from mechwright_cam.operations.choice import HEAVY
from mechwright_cam.operations.clearing import CLEAR
from mechwright_cam.operations.pen import Pen, levels
from mechwright_cam.operations.stock import Stock
from mechwright_cam.operations.wedges import into_wedges
from mechwright_cam.operations.zone import Zone
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import Tool
from mechwright_plane.arcfit import fit
from mechwright_plane.leads import best_start, lead_shapes, led, with_leads
from mechwright_plane.offsets import ROUGH, Piece, densified, fit_tolerance, grow, pieces, rings
from mechwright_plane.path import CIRCLE_BIAS, Path

LEAST_ENGAGEMENT = math.pi / 6
"""A wall is finished with twice the feed of a full cut at most, however little is left: with more, the cusps
along the path show."""


FINISH_STEP = 2.0
"""Depth of a finishing pass in diameters, where the design says none and the mill does not bear more."""
EASE = 0.08
"""A finishing pass is deeper by this share rather than that there is one more."""


def finish_depth(job: Job, tool: Tool, high: float, deep: float, inside: float = math.inf) -> float:
    """Depth of a finishing pass, mm, of a wall so ``high`` whose foot is ``deep`` mm below the stock's top.

    It is as deep as the wall where that bends the mill next to nothing: a pass that is half as deep bends its
    end hardly less, for the load is nearer to the end, and leaves a line. Else it is :data:`FINISH_STEP`
    diameters; or what ``finish_step`` says. A pass has no larger section than a slot as deep as
    ``step_down``: its width is that of the allowance, and more in a bore of radius ``inside``. A tooth takes
    no more than what a light machine bears.
    """
    settings = job.settings
    wide = finish_width(settings, tool.radius, inside)
    section = min(_slot(tool, job.part.material) / max(wide, TOLERANCES.noise), borne_wall(job, tool))
    if settings.finish_step is not None:
        return min(settings.finish_step * tool.diameter, section)
    usual = FINISH_STEP * tool.diameter
    for count in range(1, math.ceil(high / usual)):
        if high / count <= section and wall_bending(job, tool, deep, high / count) <= MOST:
            return high / count
    return min(usual, section)


def finish_engagement(settings: CamSettings, radius: float, inside: float = math.inf) -> float:
    """Engagement, rad, for which a finishing pass is fed, of a mill of this radius, mm.

    On a circle ``inside`` a bore of that radius, mm, more of the mill is in the cut. Where chips get thicker
    all the same the feed is lowered move by move.
    """
    wide = finish_width(settings, radius, inside)
    if not settings.chip_thinning or wide >= radius:
        return math.pi / 2
    return max(math.acos(1 - wide / radius), LEAST_ENGAGEMENT)


def allowance_in(job: Job, diameter: float, tool: Tool) -> float:
    """What roughing leaves for the finishing of a bore, mm; 0 where it is too narrow, and roughed to size."""
    allowance = max(job.settings.stock_to_leave, CIRCLE_BIAS)
    final = diameter / 2 - tool.radius - CIRCLE_BIAS
    return allowance if diameter / 2 - tool.radius - allowance >= final / 2 else 0.0


def bore_heights(job: Job, tool: Tool, bore: Bore, bottom: float) -> list[float]:
    """Heights of the finishing passes of a bore, z in mm."""
    inside = bore.diameter / 2 if allowance_in(job, bore.diameter, tool) else math.inf
    return finish_heights(job, tool, -bore.top, bottom, inside=inside)


def finish_width(settings: CamSettings, radius: float, inside: float = math.inf) -> float:
    """Width of cut of a finishing pass, mm: the allowance, and more on a circle ``inside`` a bore."""
    wide = settings.stock_to_leave
    return cut_width(inside - radius, radius, inside - wide) if math.isfinite(inside) else wide


def cut_width(radius: float, mill: float, opened: float) -> float:
    """Width of cut, mm, of a mill whose centre goes round at ``radius`` in a hole of radius ``opened``.

    Its edge leaves the hole's wall at an angle φ from the direction outwards, which the triangle of both
    centres and that place has: opened² = radius² + mill² + 2 radius mill cos φ. The width is
    mill (1 - cos φ), more than what is taken off the wall.

    >>> round(cut_width(2.8, 3.0, 5.0), 3)  # 0.8 mm off the wall
    1.543
    """
    inner = (opened**2 - radius**2 - mill**2) / (2 * radius * mill)
    return mill * (1 - max(inner, -1.0))


def _slot(tool: Tool, material: str) -> float:
    """Section of a slot as deep as ``step_down``, mm²."""
    return tool.cutting[material].step_down * tool.diameter * tool.diameter


def finish_heights(
    job: Job, tool: Tool, top: float, bottom: float, fillet: float = 0.0, inside: float = math.inf
) -> list[float]:
    """Heights of the finishing passes, z in mm, with the repeats of the last one.

    They are closer where a round mill has left a ``fillet`` of this height at the foot of the wall, mm, and
    in a bore whose radius ``inside`` is little more than the mill's.
    """
    deep = (1 + EASE) * finish_depth(job, tool, top - bottom, -bottom, inside)
    closer = _slot(tool, job.part.material) / max(fillet, TOLERANCES.noise)
    foot = min(bottom + max(fillet, 0.0), top)
    if closer < deep and foot > bottom:
        heights = (levels(top, foot, deep) if foot < top else []) + levels(foot, bottom, closer)
    else:
        heights = levels(top, bottom, deep)
    return heights + heights[-1:] * job.settings.spring_passes


class Finishing:
    """The finishing of one zone, whose stock is only what roughing left on walls.

    Where nothing has roughed, it goes down by ``step_down`` at a time, mm.
    """

    def __init__(self, zone: Zone, stock: Stock, job: Job, tool: Tool, step_down: float) -> None:
        self.zone, self.tool, self.settings = zone, tool, job.settings
        self.heights = finish_heights(job, tool, zone.top, zone.bottom_for(tool), stock.fillet)
        self.step_down = step_down
        self.radius = radius = zone.radius_of(tool)
        self.blocked = zone.blocked(tool, zone.path.bias)
        room = zone.room(radius, finishing=True)
        if zone.tabs is not None:
            # Along a tab only as far as the finishing of the wall needs it.
            near = grow(zone.thinned, radius + job.settings.stock_to_leave + HEAVY, ROUGH)
            room = shapely.intersection(room, near)
        self.room = prepared(room)
        self.near = prepared(grow(stock.remaining_area, radius + stock.over - CLEAR, ROUGH))
        # Where all of the plate goes, there is nothing but air beyond it.
        beyond = radius + job.settings.stock_to_leave if zone.in_the_open else 0.0
        # Leads touch the path they lead to: between that and the wall they may be as wrong as it.
        wide = grow(room, CLEAR + beyond, ROUGH)
        self.free = prepared(shapely.difference(wide, zone.blocked(tool, 0.0)))

    def write(self, pen: Pen) -> None:
        """Write the moves of all rings."""
        waiting = self._pieces()
        while waiting:
            piece = waiting.pop(0)
            if piece.closed:
                self._ring(pen, piece.points)
            else:
                self._stretch(pen, self._led(piece.points))
            here = pen.place
            waiting.sort(key=lambda other: float(np.hypot(*(other.points[0] - here))))
        pen.retract()

    def _pieces(self) -> list[Piece]:
        found = []
        for ring in rings(self.blocked, self.settings.climb):
            if len(self.zone.walls) < 2 or self.radius == self.tool.radius:
                ring = into_wedges(ring, self.zone.keep, self.radius, self.zone.path.bias)
            dense = densified(ring, self.radius / 4)
            everywhere = np.ones(len(dense), dtype=bool)
            found.extend(pieces(dense, everywhere, everywhere, self.room, 0))
        return found

    def _fitted(self, points: Array) -> Path:
        path = self.zone.path
        return fit(points, fit_tolerance(path), path.lines_per_arc)

    def _is_clear(self, points: Array) -> NDArray[np.bool_]:
        return np.asarray(~shapely.contains_xy(self.near, points[:, 0], points[:, 1]))

    def _is_free(self, points: Array) -> NDArray[np.bool_]:
        return np.asarray(shapely.contains_xy(self.free, points[:, 0], points[:, 1]))

    def _led(self, points: Array) -> Path:
        """An open stretch; in the open it is entered from the air and left into it on arcs."""
        path = self._fitted(points)
        if not self.zone.in_the_open or not path.cuts:
            return path
        first, last = points[1] - points[0], points[-1] - points[-2]
        headings = math.atan2(first[1], first[0]), math.atan2(last[1], last[0])
        shapes = lead_shapes(self.tool.radius, self.settings.stock_to_leave)
        return led(path, headings, shapes, self.settings.climb, self._is_air)

    def _is_air(self, points: Array) -> NDArray[np.bool_]:
        return self._is_free(points) & self._is_clear(points)

    def _may_run(self, way: Array) -> bool:
        return bool(shapely.covers(self.free, shapely.LineString(way)))

    def _ring(self, pen: Pen, ring: Array) -> None:
        least = self.settings.stock_to_leave
        shapes = lead_shapes(self.tool.radius, least)
        found = best_start(ring, shapes, self.settings.climb, self._is_free, self._is_clear, self._may_run)
        if found is None:
            clear = np.flatnonzero(self._is_clear(ring[:-1]))
            points = _from(ring, int(clear[0]) if clear.size else 0)
            self._loop(pen, self._fitted(points), clear.size > 0)
            return
        at, rho, sweep = found
        points = _from(ring, at)
        first, last = points[1] - points[0], points[0] - points[-2]
        one, two = math.atan2(first[1], first[0]), math.atan2(last[1], last[0])
        heading = one - ((one - two + math.pi) % math.tau - math.pi) / 2
        path = with_leads(self._fitted(points), heading, rho, sweep, self.settings.climb)
        self._stretch(pen, path)

    def _stretch(self, pen: Pen, path: Path) -> None:
        """A path that starts and ends in the clear, at every height."""
        if not path.cuts:
            return
        # The whole way counts, not points of it: a corner of the wall may stand between any two.
        back = shapely.LineString([path.end, path.start])
        direct = bool(shapely.covers(self.free, back) and not shapely.intersects(self.near, back))
        is_open = bool(self._is_clear(np.array([path.start]))[0])
        above = self.zone.top
        for number, z in enumerate(self.heights):
            pen.go(path.start, number > 0 and direct)
            pen.enter(path, above, z, is_open)
            self._follow(pen, path, z, again=z == above)
            above = z

    def _feed(self, pen: Pen, *, again: bool) -> float | None:
        """Feed of a pass, mm/min; None for the usual one. Made again it takes what the mill has bent."""
        return pen.thin(LEAST_ENGAGEMENT) if again and self.settings.chip_thinning else None

    def _follow(self, pen: Pen, path: Path, z: float, *, again: bool) -> None:
        """Along the wall in a pass at a height, which may be made ``again``."""
        pen.follow(path, self._feed(pen, again=again), inside=1 if self.settings.climb else -1)

    def _loop(self, pen: Pen, path: Path, is_open: bool) -> None:
        """A closed path without room for leads: sunk where it is clear, else ramped along itself."""
        if not path.cuts:
            return
        pen.above(path.start)
        pen.sink(self.zone.top)
        above = self.zone.top
        for z in self.heights:
            if is_open:
                pen.sink(z)
            else:
                # Where only this mill gets in nothing has roughed: no lap is deeper than its passes.
                for height in levels(pen.z, z, self.step_down) if pen.z > z else ():
                    pen.ramp(path, height)
            pen.follow(path, self._feed(pen, again=z == above), inside=1 if self.settings.climb else -1)
            above = z


def _from(ring: Array, at: int) -> Array:
    """A closed ring that starts at another vertex."""
    return np.concatenate((ring[at:-1], ring[: at + 1]))
