"""Finishing with cutter compensation: the program describes a contour, the control keeps the tool beside it.

The contour is the wall as the largest tool allowed leaves it: its inside corners are arcs about which that
tool still turns. What else is asked of it stands in :mod:`mechwright_cam.operations.entry`.

Glossary
--------
hop
    A part of a contour over a tab, along which the tool is lifted.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import cached_property

import numpy as np
import shapely
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.errors import DesignError, ToolError
from mechwright.geometry.prepared import prepared
from mechwright.geometry.segments import Point
from mechwright.tolerances import TOLERANCES
from mechwright_cam.operations.choice import HEAVY
from mechwright_cam.operations.clearing import CLEAR
from mechwright_cam.operations.contour_writer import ContourWriter, touching
from mechwright_cam.operations.entry import Lead, lead_length, leads, offsets_of, starts, ways
from mechwright_cam.operations.finishing import finish_heights
from mechwright_cam.operations.pen import Pen
from mechwright_cam.operations.stock import Stock
from mechwright_cam.operations.zone import Zone
from mechwright_cam.setup.job import LEAST_TURN, Job
from mechwright_cam.shop.tool import Tool
from mechwright_plane.contour import offset_contour
from mechwright_plane.leads import middle_of_longest
from mechwright_plane.offsets import ROUGH, densified, fit_tolerance, grow, pieces, rings
from mechwright_plane.path import Path, rounded
from mechwright_plane.places import STEP, candidates, centres, heading_at

TAB_GAP = 0.05
"""Air between a tab and the largest tool allowed, beside it and above it, mm."""
LEAD_PLAY = TOLERANCES.flatten
"""Leads touch the contour they lead to, and may come this much into the wall, mm, as chords do."""
HALVINGS = 12
"""Bisections of a lead's sweep: its start is found to a thousandth of its length."""


def check_compensated(job: Job, zone: Zone, mill: Tool, *, fills: bool = False) -> None:
    """Refuse what D cannot move.

    Raises ToolError for a groove that the mill ``fills``, or walls of a round-ended mill; DesignError for
    ramped tabs, whose slopes are planned for the way of the cutter's centre, and for next to no stock to
    leave: the channel around a part is no wider than the cutter that roughs it.
    """
    if job.settings.compensation == "computer":
        return
    if zone.slopes:
        raise DesignError(
            f"cam.hold.tab_shape: ramped tabs of part {job.part.name} are not cut with compensation = "
            f'"{job.settings.compensation}"; use "rectangular" tabs, or compensation = "computer"'
        )
    leave = job.settings.stock_to_leave
    if zone.channel is not None and leave < LEAST_TURN:
        raise DesignError(
            f"cam.stock_to_leave: {leave:g} mm leave no room to move {mill.name} by D in the channel around "
            f'part {job.part.name}; use at least {LEAST_TURN:g} mm, or compensation = "computer"'
        )
    why = "fills it" if fills else "has a round end" if mill.nose > 0 else ""
    if why:
        raise ToolError(
            f"cam.compensation: {zone.name} of part {job.part.name} cannot be brought to size by D, since "
            f'{mill.name} {why}; list a flat end mill with room, or use "computer"'
        )


def has_entries(job: Job, zone: Zone, stock: Stock, mills: Sequence[Tool]) -> bool:
    """Whether mills that finish a zone have room to enter all of its contours, once it is roughed.

    It is what planning asks in the end, but that corners which wider mills leave count as roughed.
    """
    if job.settings.compensation == "computer" or zone.slopes:  # slopes are refused, whatever the mill
        return True
    for mill in mills:
        reach = mill.radius + job.settings.stock_to_leave
        free = shapely.difference(zone.room(mill.radius), grow(zone.keep, reach, ROUGH))
        if zone.kind != "outside":
            free = shapely.intersection(free, grow(zone.clear, -mill.radius, ROUGH))
        roughed = stock.without(grow(free, mill.radius, ROUGH))
        try:
            CompensatedFinishing(zone, roughed, job, mill).enter()
        except ToolError:
            return False
    return True


def entering(
    job: Job,
    zones: Sequence[tuple[Zone, shapely.Geometry]],
    mills: Sequence[Tool],
    finishers: tuple[Tool, ...],
    choose: Callable[[list[Tool]], list[Tool]],
) -> tuple[Tool, ...]:
    """Where compensation leaves the mills that finish a wall no room for their entry, finer ones.

    ``zones`` are its layers, each with the stock in it. ``choose`` gives those that finish of some ``mills``.
    The finest is not asked: if it has no room, planning says so.
    """
    while finer := [mill for mill in mills if mill.diameter < finishers[-1].diameter]:
        if all(has_entries(job, zone, Stock(left), finishers) for zone, left in zones):
            break
        finishers = tuple(choose(finer))
    return finishers


class CompensatedFinishing:
    """The finishing of one zone with cutter compensation, whose stock is only what roughing left."""

    def __init__(self, zone: Zone, stock: Stock, job: Job, mill: Tool) -> None:
        self.zone, self.job, self.tool, self.settings = zone, job, mill, job.settings
        self.heights = finish_heights(job, mill, zone.top, zone.bottom, stock.fillet)
        check_compensated(job, zone, mill)
        self.offsets = offsets_of(mill, job.settings)
        self.side = 1 if job.settings.climb else -1
        self.leads = leads(self.offsets, self.tool.radius, job.settings.stock_to_leave)
        self.near = prepared(grow(stock.left, self.tool.radius - CLEAR, ROUGH))
        room = zone.room(self.tool.radius, finishing=True)
        self.wide = prepared(grow(room, CLEAR + self.offsets.limit, ROUGH))
        self.air = prepared(self._air() if zone.must is not None else self.wide)

    def _air(self) -> shapely.Geometry:
        """Where leads to an open recess may be: past the end of its wall, in what roughing has cleared."""
        past = self.tool.radius + self.settings.stock_to_leave + HEAVY + lead_length(self.tool, self.settings)
        cleared = shapely.intersection(self.zone.clear, grow(self.zone.must, past, ROUGH))
        return shapely.union(cleared, self.wide)

    @cached_property
    def _blocked(self) -> dict[float, shapely.Geometry]:
        """Where the centre of a tool may not be, by D of that tool."""
        return {
            d: prepared(grow(self.zone.keep, self.offsets.base + d - LEAD_PLAY))
            for d in (self.offsets.least, self.offsets.planned, self.offsets.most)
        }

    def write(self, pen: Pen) -> None:
        """Write the moves of all contours."""
        waiting = self._contours()
        while waiting:
            contour = waiting.pop(0)
            self._contour(pen, contour, self.heights)
            x, y = pen.place or (0.0, 0.0)
            waiting.sort(key=lambda other: math.hypot(other.start[0] - x, other.start[1] - y))
        pen.retract()

    def enter(self) -> None:
        """Look for the entries of all contours; raises ToolError where there is no room for one."""
        for contour in self._contours():
            self._entered(contour)

    def _contours(self) -> list[Path]:
        """The contours, closed ones anywhere entered yet."""
        zone, reach = self.zone, self.job.reach(self.tool)
        inset, tolerance = reach - self.offsets.base, fit_tolerance(zone.path)
        found = []
        # Past tabs the tool is lifted: the contour is that of the wall alone.
        for ring in rings(grow(zone.wall, reach + zone.path.bias), self.settings.climb):
            dense = densified(ring, self.tool.radius / 4)
            everywhere = np.ones(len(dense), dtype=bool)
            whole = pieces(dense, everywhere, everywhere, self.wide, 0)
            runs = [ring] if whole and whole[0].closed else [piece.points for piece in whole]
            found += [offset_contour(run, inset, self.side, tolerance, LEAST_TURN) for run in runs]
        return [contour for contour in found if contour.cuts]

    # -- leads ------------------------------------------------------------------------------------------

    def _world(self, places: Array, headings: Array, local: Array, *, out: bool) -> Array:
        """Local places (k, n, 2) of leads at places (k, 2) of a contour, as (k, n, 2) of the work."""
        mirror = -1.0 if out else 1.0
        t = np.column_stack((np.cos(headings), np.sin(headings)))
        n = np.column_stack((-t[:, 1], t[:, 0])) * self.side
        world: Array = places[:, None] + mirror * local[..., :1] * t[:, None] + local[..., 1:] * n[:, None]
        return world

    def _fits(
        self, places: Array, headings: Array, shape: Lead, sweep: Array, *, out: bool
    ) -> NDArray[np.bool_]:
        """Whether leads of these sweeps onto (or with ``out`` off) the contour have room, (k,)."""
        begin = starts(shape.radius, shape.straight, sweep)[:, None]
        x, y = self._world(places, headings, begin, out=out)[:, 0].T
        good = ~shapely.contains_xy(self.near, x, y)
        largest = self._blocked[self.offsets.most]
        for d, blocked in self._blocked.items():
            left = np.flatnonzero(good)  # most places fail at the first question
            local = ways(shape.radius, shape.straight, sweep[left], d)
            x, y = self._world(places[left], headings[left], local, out=out).reshape(-1, 2).T
            free = shapely.contains_xy(self.air, x, y)
            free[free] = ~shapely.contains_xy(blocked, x[free], y[free])
            # What is not on the contour yet keeps off all other walls, however they are moved.
            high = free & (local[..., 1].ravel() > self.offsets.most + HEAVY)
            free[high] = ~shapely.contains_xy(largest, x[high], y[high])
            good[left] = free.reshape(local.shape[:2]).all(axis=1)
        return np.asarray(good)

    def _tried(
        self, places: Array, headings: Array, *, out: bool
    ) -> Iterator[tuple[Lead, Array, NDArray[np.bool_]]]:
        """Leads to try, with their sweeps (k,) and whether they have room (k,); roomy ones first.

        Where none of them has, each place gets the sweep that brings the start just outside of what roughing
        has left: a channel may be hardly wider than the cutter.
        """
        for lead in self.leads:
            sweep = np.full(len(places), lead.sweep)
            yield lead, sweep, self._fits(places, headings, lead, sweep, out=out)
        away = self.tool.radius + self.settings.stock_to_leave + CLEAR / 2
        for shape in dict.fromkeys(Lead(lead.radius, 0.0, lead.straight) for lead in self.leads):
            low, high = np.zeros(len(places)), np.full(len(places), math.pi / 2)
            for _ in range(HALVINGS):
                sweep = (low + high) / 2
                local = starts(shape.radius, shape.straight, sweep)[:, None]
                spots = shapely.points(self._world(places, headings, local, out=out)[:, 0])
                near = shapely.distance(self.zone.wall, spots) < away
                low, high = np.where(near, sweep, low), np.where(near, high, sweep)
            yield shape, high, self._fits(places, headings, shape, high, out=out)

    def _no_room(self, contour: Path) -> ToolError:
        other = '"computer"' if self.settings.compensation == "wear" else '"wear" or "computer"'
        x, y = contour.start
        return ToolError(
            f"cam.compensation: {self.tool.name} has no room for a straight entry of "
            f"{self.offsets.straight:.2f} mm with a tangential arc to {self.zone.name} of part "
            f"{self.job.part.name}, near X{x:.1f} Y{y:.1f}; use {other}, or list a smaller end mill"
        )

    def _entered(self, contour: Path) -> tuple[Path, Lead, Lead]:
        """The contour from the best place to enter it on, with its leads."""
        if not contour.closed:
            found = []
            for end, place, out in ((0, contour.start, False), (-1, contour.end, True)):
                heading = np.array([heading_at(contour, end)])
                for shape, sweep, fits in self._tried(np.array([place]), heading, out=out):
                    if fits.all():
                        found.append(replace(shape, sweep=float(sweep[0])))
                        break
                else:
                    raise self._no_room(contour)
            return contour, found[0], found[1]
        at, places, headings = candidates(contour)
        apart = np.ones(len(at), dtype=bool)
        if self.zone.tabs is not None:
            normals = np.column_stack((-np.sin(headings), np.cos(headings))) * self.side
            off_tab = places + normals * self.offsets.planned
            gap = shapely.distance(self.zone.tabs, shapely.points(off_tab))
            apart = gap > self.tool.radius + 2 * self.offsets.limit + 2 * TAB_GAP + STEP
        both = (self._tried(places, headings, out=out) for out in (False, True))
        for (shape, into, one), (_, off, two) in zip(*both, strict=True):
            fits = one & two & apart
            if fits.any():
                best = middle_of_longest(fits)
                before, after = contour.split(float(at[best]))
                entered = after + before if after.cuts else contour
                one_way, other = (replace(shape, sweep=float(sweep[best])) for sweep in (into, off))
                return entered, one_way, other
        raise self._no_room(contour)

    # -- moves ------------------------------------------------------------------------------------------

    def _contour(self, pen: Pen, contour: Path, heights: list[float]) -> None:
        path, into, off = self._entered(contour)
        one, two = self._leads_of(path, into, off)
        parts = self._parts(path)
        back = np.linspace(two[-1], one[0], 20)
        x, y = back.T
        direct = bool(
            shapely.contains_xy(self.air, x, y).all()
            and not shapely.contains_xy(self._blocked[self.offsets.most], x, y).any()
            and not shapely.contains_xy(self.near, x, y).any()
        )
        for number, z in enumerate(heights):
            pen.go(one[0], number > 0 and direct)
            pen.sink(z)
            self._around(pen, path, one, two, parts, z)

    def _leads_of(self, path: Path, into: Lead, off: Lead) -> tuple[list[Point], list[Point]]:
        """Start, end of the line and touching point of the lead in; the same of the lead out, backwards."""
        found = []
        for at, heading, lead, mirror in (
            (path.start, heading_at(path, 0), into, 1.0),
            (path.end, heading_at(path, -1), off, -1.0),
        ):
            tx, ty = mirror * math.cos(heading), mirror * math.sin(heading)
            nx, ny = -ty * self.side * mirror, tx * self.side * mirror
            way = [
                (rounded(at[0] + x * tx + y * nx), rounded(at[1] + x * ty + y * ny))
                for x, y in (lead.start, lead.turn)
            ]
            found.append([*way, at] if mirror > 0 else [at, *way[::-1]])
        return found[0], found[1]

    def _parts(self, path: Path) -> list[tuple[Path, bool]]:
        """The parts of a contour, and whether the tool is lifted over a tab there."""
        if self.zone.tabs is None:
            return [(path, False)]
        over = np.zeros(0, dtype=bool)
        for d in self._blocked:
            at, places = centres(path, self.side, self.offsets.most, d)
            reach = self.tool.radius + max(d - self.offsets.planned, 0.0) + TAB_GAP
            near = shapely.dwithin(shapely.points(places), self.zone.tabs, reach)
            over = near if not over.size else over | near
        parts: list[tuple[Path, bool]] = []
        edges = np.flatnonzero(np.diff(np.concatenate(([False], over, [False])).astype(int)))
        rest, done = path, 0.0
        for first, last in edges.reshape(-1, 2).tolist():
            # Around a corner of the contour the tool goes with the move that follows: only then it is past.
            past = max(last, int(np.searchsorted(at, at[last - 1], side="right")))
            for until, lifted in ((at[max(first - 1, 0)], False), (at[min(past, len(at) - 1)], True)):
                part, rest = rest.split(float(until) - done)
                done += part.length
                parts.append((part, lifted))
        parts.append((rest, False))
        if len(parts) > 1 and not self.tool.centre_cutting:
            raise ToolError(
                f"cam.compensation: {self.tool.name} is not centre-cutting, and goes down beside every tab "
                f'of {self.zone.name}; list one that is, use method = "bore", or use "computer"'
            )
        return [(part, lifted) for part, lifted in parts if part.cuts]

    def _around(
        self,
        pen: Pen,
        path: Path,
        one: list[Point],
        two: list[Point],
        parts: list[tuple[Path, bool]],
        z: float,
    ) -> None:
        """Once along the contour at a height, with the leads."""
        run = ContourWriter(pen, self.side, self.offsets.planned)
        run.on(one[1])
        run.follow(touching(one[1], path.start, heading_at(path, 0), self.side))
        for part, lifted in parts:
            pen.sink(*(self.zone.top + TAB_GAP,) if lifted else (z, pen.rates.plunge))
            run.follow(part)
        run.follow(touching(path.end, two[1], heading_at(path, -1), self.side, out=True))
        run.off(two[2])
