"""Finishing with cutter compensation: the program describes a contour, and the control keeps the tool beside it.

The contour is the wall as the largest tool allowed leaves it: its inside corners are arcs about which that tool
still turns. What else is asked of it stands in :mod:`mechwright_cam.planning.entry`.

Glossary
--------
hop
    A part of a contour over a tab, along which the tool is lifted.
"""

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import cached_property
from typing import Literal, NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from mechwright.errors import ToolError
from mechwright.geometry.segments import Point
from mechwright.motion import Array
from mechwright.part import Bore
from mechwright.program import Feed, FeedArc, Move
from mechwright_cam.job import Job
from mechwright_cam.planning.clearing import CLEAR
from mechwright_cam.planning.entry import Lead, bore_lead, leads, offsets_of, starts, ways
from mechwright_cam.planning.finishing import LEAD_PLAY
from mechwright_cam.planning.holes import CIRCLE_BIAS
from mechwright_cam.planning.pen import Pen, levels
from mechwright_cam.planning.zone import HEAVY, Zone, bottom_of
from mechwright_cam.toolpath.contour import contour_beside
from mechwright_cam.toolpath.leads import CANDIDATES, middle_of_longest
from mechwright_cam.toolpath.offsets import BIAS, FIT, ROUGH, densified, grow, pieces, rings
from mechwright_cam.toolpath.path import Cut, Path, arc, circle, line, rounded

TAB_GAP = 0.05
"""Air between a tab and the largest tool allowed, beside it and above it, mm."""
STEP = 0.1
"""Places at which the way along tabs is looked at, mm."""
HALVINGS = 12
"""Bisections of a lead's sweep: its start is found to a thousandth of its length."""
LEAST_PIECE = 0.1
"""A contour is not divided nearer to a node, mm."""


class CompensatedFinishing:
    """The finishing of one zone with cutter compensation, when ``left`` holds only what roughing left."""

    def __init__(self, zone: Zone, job: Job) -> None:
        self.zone, self.job, self.tool = zone, job, zone.finisher
        self.settings = job.settings
        self.offsets = offsets_of(self.tool, job.settings)
        self.side = 1 if job.settings.climb else -1
        self.leads = leads(self.offsets, self.tool.radius, job.settings.stock_to_leave)
        self.room = zone.room(self.tool.radius, finishing=True)
        self.near = grow(zone.left, self.tool.radius - CLEAR, ROUGH)
        self.wide = grow(self.room, CLEAR + self.offsets.limit, ROUGH)
        for shape in (self.room, self.near, self.wide):
            shapely.prepare(shape)

    @cached_property
    def _blocked(self) -> dict[float, shapely.Geometry]:
        """Where the centre of a tool may not be, by D of that tool."""
        play = BIAS - LEAD_PLAY
        found = {
            d: grow(self.zone.keep, self.offsets.base + d + play)
            for d in (self.offsets.least, self.offsets.planned, self.offsets.most)
        }
        for shape in found.values():
            shapely.prepare(shape)
        return found

    def write(self, pen: Pen) -> None:
        """Write the moves of all contours."""
        zone = self.zone
        heights = levels(zone.top, zone.bottom, self.settings.finish_step * self.tool.diameter)
        heights += [zone.bottom] * self.settings.spring_passes
        waiting = self._contours()
        while waiting:
            contour = waiting.pop(0)
            self._contour(pen, contour, heights)
            x, y = pen.place or (0.0, 0.0)
            waiting.sort(key=lambda other: math.hypot(other.start[0] - x, other.start[1] - y))
        pen.retract()

    def _contours(self) -> list[Path]:
        """The contours, closed ones anywhere entered yet."""
        zone, reach = self.zone, self.job.reach(self.tool)
        # Past tabs the tool is lifted: the contour is that of the wall alone.
        keep = zone.wall
        found = []
        for ring in rings(grow(keep, reach + BIAS), self.settings.climb):
            dense = densified(ring, self.tool.radius / 4)
            everywhere = np.ones(len(dense), dtype=bool)
            whole = pieces(dense, everywhere, everywhere, self.wide, 0)
            runs = [ring] if whole and whole[0].closed else [piece.points for piece in whole]
            found += [contour_beside(run, reach - self.offsets.base, self.side, FIT) for run in runs]
        return [contour for contour in found if contour.cuts]

    # -- leads ------------------------------------------------------------------------------------------

    def _world(self, places: Array, headings: Array, local: Array, *, out: bool) -> Array:
        """Local places (k, n, 2) of leads at places (k, 2) of a contour, as (k, n, 2) of the work."""
        mirror = -1.0 if out else 1.0
        t = np.column_stack((np.cos(headings), np.sin(headings)))
        n = np.column_stack((-t[:, 1], t[:, 0])) * self.side
        world: Array = (
            places[:, None] + mirror * local[..., :1] * t[:, None] + local[..., 1:] * n[:, None]
        )
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
            local = ways(shape.radius, shape.straight, sweep, d)
            x, y = self._world(places, headings, local, out=out).reshape(-1, 2).T
            free = shapely.contains_xy(self.wide, x, y) & ~shapely.contains_xy(blocked, x, y)
            # What is not on the contour yet keeps off all other walls, however they are moved.
            high = local[..., 1].ravel() > self.offsets.most + HEAVY
            free &= ~(high & shapely.contains_xy(largest, x, y))
            good &= free.reshape(len(places), -1).all(axis=1)
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
            for at, place, out in ((0, contour.start, False), (-1, contour.end, True)):
                heading = np.array([_heading(contour, at)])
                for shape, sweep, fits in self._tried(np.array([place]), heading, out=out):
                    if fits.all():
                        found.append(replace(shape, sweep=float(sweep[0])))
                        break
                else:
                    raise self._no_room(contour)
            return contour, found[0], found[1]
        at, places, headings = _candidates(contour)
        apart = np.ones(len(at), dtype=bool)
        if self.zone.tabs is not None:
            off_tab = places + self._normals(headings) * self.offsets.planned
            gap = shapely.distance(self.zone.tabs, shapely.points(off_tab))
            apart = gap > self.tool.radius + 2 * self.offsets.limit + 2 * TAB_GAP + STEP
        both = (self._tried(places, headings, out=out) for out in (False, True))
        for (shape, into, one), (_, off, two) in zip(*both, strict=True):
            fits = one & two & apart
            if fits.any():
                best = middle_of_longest(fits)
                entered = contour.entered_at(float(at[best]))
                return entered, replace(shape, sweep=float(into[best])), replace(shape, sweep=float(off[best]))
        raise self._no_room(contour)

    def _normals(self, headings: Array) -> Array:
        return np.column_stack((-np.sin(headings), np.cos(headings))) * self.side

    # -- moves ------------------------------------------------------------------------------------------

    def _contour(self, pen: Pen, contour: Path, heights: list[float]) -> None:
        path, into, off = self._entered(contour)
        one, two = self._leads_of(path, into, off)
        parts = self._parts(path)
        back = np.linspace(two[-1], one[0], 20)
        x, y = back.T
        direct = bool(
            shapely.contains_xy(self.wide, x, y).all()
            and not shapely.contains_xy(self._blocked[self.offsets.most], x, y).any()
            and not shapely.contains_xy(self.near, x, y).any()
        )
        for number, z in enumerate(heights):
            if number and direct:
                pen.straight(one[0])
            else:
                pen.above(one[0])
            pen.sink(z)
            self._around(pen, path, one, two, parts, z)

    def _leads_of(self, path: Path, into: Lead, off: Lead) -> tuple[list[Point], list[Point]]:
        """Start, end of the line and touching point of the lead in; the same of the lead out, backwards."""
        found = []
        for at, heading, lead, mirror in (
            (path.start, _heading(path, 0), into, 1.0),
            (path.end, _heading(path, -1), off, -1.0),
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
            at, places = _centres(path, self.side, self.offsets.most, d)
            reach = self.tool.radius + max(d - self.offsets.planned, 0.0) + TAB_GAP
            near = shapely.dwithin(shapely.points(places), self.zone.tabs, reach)
            over = near if not over.size else over | near
        parts: list[tuple[Path, bool]] = []
        edges = np.flatnonzero(np.diff(np.concatenate(([False], over, [False])).astype(int)))
        rest, done = path, 0.0
        for first, last in edges.reshape(-1, 2).tolist():
            for until, lifted in ((at[max(first - 1, 0)], False), (at[min(last, len(at) - 1)], True)):
                part, rest = rest.split(float(until) - done)
                done += part.length
                parts.append((part, lifted))
        parts.append((rest, False))
        if len(parts) > 1 and not self.tool.centre_cutting:
            raise ToolError(
                f"cam.compensation: {self.tool.name} is not centre-cutting, and goes down beside every tab of "
                f"{self.zone.name}; list one that is, hold the part by its bore, or use \"computer\""
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
        run = _Run(pen, self.side, self.offsets.planned)
        run.on(one[1])
        run.follow(_touching(one[1], path.start, _heading(path, 0), self.side))
        for part, lifted in parts:
            if lifted:
                pen.sink(self.zone.top + TAB_GAP)
            else:
                pen.sink(z, pen.rates.plunge)
            run.follow(part)
        run.follow(_touching(path.end, two[1], _heading(path, -1), self.side, out=True))
        run.off(two[2])


class _Run:
    """Writes a contour: what a pen writes, with the words that turn compensation on and off."""

    def __init__(self, pen: Pen, side: int, planned: float) -> None:
        self.pen, self.side, self.planned = pen, side, planned

    def on(self, end: Point) -> None:
        """The straight line that turns compensation on."""
        word: Literal["left", "right"] = "left" if self.side > 0 else "right"
        self._straight(end, word)

    def off(self, end: Point) -> None:
        """The straight line that turns it off."""
        self._straight(end, "off")

    def _straight(self, end: Point, word: Literal["left", "right", "off"]) -> None:
        self.pen.moves.append(Feed(end[0], end[1], None, self.pen.rates.feed, word))
        self.pen.place = end

    def follow(self, path: Path) -> None:
        """Along a path; on arcs with the tool inside its centre is slower, by the radius that it runs on."""
        pen, feed, here = self.pen, self.pen.rates.feed, path.start
        moves: list[Move] = []
        for cut in path.cuts:
            if cut.turn:
                i, j = cut.cx - here[0], cut.cy - here[1]
                centre = math.hypot(i, j) - self.planned
                pace = pen.rates.inside(centre, pen.tool.radius, feed) if cut.turn == self.side else feed
                moves.append(FeedArc(cut.x, cut.y, None, i, j, cut.turn > 0, pace))
            else:
                moves.append(Feed(cut.x, cut.y, None, feed))
            here = (cut.x, cut.y)
        pen.moves.extend(moves)
        pen.place = path.end


def finish_bore_compensated(job: Job, bore: Bore, pen: Pen) -> None:
    """Write the finishing circles of a bore, entered from its middle, or from as near to it as may be."""
    tool, side = pen.tool, 1 if job.settings.climb else -1
    offsets = offsets_of(tool, job.settings)
    radius = bore.diameter / 2 - CIRCLE_BIAS - offsets.base
    lead = bore_lead(offsets, radius)
    x, y = bore.centre
    turn = circle(bore.centre, radius, (x + radius, y), side > 0)
    # Seen from where the circle is touched, y leads to its middle and x along it.
    start, first, last = (
        (rounded(x + radius - v), rounded(y + side * u))
        for u, v in (lead.start, lead.turn, (-lead.turn[0], lead.turn[1]))
    )
    heading = side * math.pi / 2
    bottom = bottom_of(job, bore.top, bore.depth)
    heights = levels(-bore.top, bottom, job.settings.finish_step * tool.diameter)
    pen.above(start)
    run = _Run(pen, side, offsets.planned)
    for z in heights + [bottom] * job.settings.spring_passes:
        pen.sink(z)
        run.on(first)
        run.follow(_touching(first, turn.start, heading, side))
        run.follow(turn)
        run.follow(_touching(turn.start, last, heading, side, out=True))
        run.off(start)
    pen.retract()


def _touching(start: Point, end: Point, heading: float, side: int, *, out: bool = False) -> Path:
    """The arc between a contour and a lead's line that touches the contour under its heading.

    It ends on the contour, or with ``out`` starts there.
    """
    touch, other = (start, end) if out else (end, start)
    nx, ny = -math.sin(heading) * side, math.cos(heading) * side
    dx, dy = other[0] - touch[0], other[1] - touch[1]
    across = 2 * (dx * nx + dy * ny)
    if across <= 0:
        return Path(start, (line(start, end),))
    radius = (dx * dx + dy * dy) / across
    return Path(start, (arc(start, end, (touch[0] + radius * nx, touch[1] + radius * ny), side),))


# -- places along a contour -----------------------------------------------------------------------------------


class _Place(NamedTuple):
    """A place on a cut: length from the path's start, mm, the point, and the heading, rad."""

    at: float
    point: Point
    heading: float


def _on(start: Point, cut: Cut, share: float, done: float) -> _Place:
    """The place at a share of a cut."""
    at = done + share * cut.length
    if not cut.turn:
        x, y = (a + share * (b - a) for a, b in zip(start, (cut.x, cut.y), strict=True))
        return _Place(at, (x, y), math.atan2(cut.y - start[1], cut.x - start[0]))
    radius = math.hypot(start[0] - cut.cx, start[1] - cut.cy)
    angle = math.atan2(start[1] - cut.cy, start[0] - cut.cx) + share * cut.turn * cut.length / radius
    point = cut.cx + radius * math.cos(angle), cut.cy + radius * math.sin(angle)
    return _Place(at, point, angle + cut.turn * math.pi / 2)


def _walk(path: Path) -> Iterator[tuple[Point, Cut, float]]:
    """The cuts of a path, with their starts and the way before them."""
    here, done = path.start, 0.0
    for cut in path.cuts:
        yield here, cut, done
        here, done = (cut.x, cut.y), done + cut.length


def _heading(path: Path, at: int) -> float:
    """Direction of travel at the start (0) or at the end (-1) of a path, rad."""
    start, cut, done = list(_walk(path))[at]
    return _on(start, cut, 1.0 if at else 0.0, done).heading


def _candidates(path: Path) -> tuple[Array, Array, Array]:
    """Places at which a contour may be entered: ways (k,), points (k, 2) and headings (k,)."""
    spacing = path.length / CANDIDATES
    found: list[_Place] = []
    for start, cut, done in _walk(path):
        if cut.length >= 2 * LEAST_PIECE:
            count = max(1, math.floor(cut.length / max(spacing, 2 * LEAST_PIECE)))
            found += [_on(start, cut, (k + 0.5) / count, done) for k in range(count)]
    at, places, headings = zip(*found, strict=True) if found else ((), (), ())
    return np.array(at), np.array(places).reshape(-1, 2), np.array(headings)


def _centres(path: Path, side: int, widest: float, distance: float) -> tuple[Array, Array]:
    """Ways (n,) along a contour, and the places (n, 2) of a tool at this distance, around corners as well.

    The ways are the same for all distances up to the ``widest``.
    """
    found: list[_Place] = []
    for start, cut, done in _walk(path):
        steps = max(1, math.ceil(cut.length / STEP))
        places = [_on(start, cut, k / steps, done) for k in range(steps + 1)]
        if found:
            turn = (places[0].heading - found[-1].heading + math.pi) % math.tau - math.pi
            corner = math.ceil(abs(turn) * max(widest, STEP) / STEP)
            found += [
                places[0]._replace(heading=found[-1].heading + turn * k / corner) for k in range(1, corner)
            ]
        found += places
    at, points, headings = (np.array(column) for column in zip(*found, strict=True))
    normals = np.column_stack((-np.sin(headings), np.cos(headings))) * side
    return at, points + distance * normals
