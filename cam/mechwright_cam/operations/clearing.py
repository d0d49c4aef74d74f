"""Roughing: remove what is left in front of a wall, ring by ring from the far side to the wall.

Of the stock to take a cut looks at the core only: what is left when a sliver is shaved off all round. What is
thinner than two slivers has none, and grown by the sliver the core is the stock again.

Coverage: a point that the cutter can reach lies within one step of the next ring towards the wall, because
the way to the nearest wall point crosses that ring. So with steps up to the radius, the rings leave nothing.
"""

import math
from copy import copy
from dataclasses import replace
from functools import cached_property

import numpy as np
import shapely

from mechwright.arrays import Array
from mechwright.geometry.prepared import prepared
from mechwright.geometry.segments import Point
from mechwright.tolerances import TOLERANCES
from mechwright_cam.operations.pen import Pen, levels
from mechwright_cam.operations.runs import Cavity, Run, write_levels, write_ring
from mechwright_cam.operations.stock import Stock
from mechwright_cam.operations.thin_cuts import Stretch, split_by_engagement
from mechwright_cam.operations.zone import CUSP, SLACK, Zone
from mechwright_cam.shop.cutter import cutter
from mechwright_cam.shop.tool import Tool
from mechwright_plane.arcfit import fit_all
from mechwright_plane.buffers import buffered
from mechwright_plane.offsets import (
    FINE,
    ROUGH,
    Piece,
    areas,
    densified,
    fit_tolerance,
    grow,
    pieces,
    polygons,
    rings,
    without_slits,
)
from mechwright_plane.path import Path

SLIVER = 0.02
"""Half the width of stock that roughing does not bother with, mm: a tenth of the usual allowance."""
FLOOR_SLIVER = TOLERANCES.leftover / 4
"""The same where the stock would stay on a floor that nothing goes over again, mm: half of what may stay."""
FRINGE = 0.05
"""What the far side of a channel keeps, mm, belongs to the frame. Exact rings that reach just as far would
leave hundreds of threads there, and to grow them takes longer than all the rest."""
CLEAR = 0.01
"""A cutter this far from uncut stock runs in the clear, mm."""
OVERLAP = 1.5 * ROUGH
"""What a cut takes is made larger by this than by the cut before, mm: then their chords keep apart along
walls, where shapes that all but coincide would cross at every corner. Tests of what is clear allow for it."""
COARSE_FIT = 2 * ROUGH
"""How far arcs of a thinned path may stand off, mm: twice the chord error, or the chords would come out as
lines again."""
COARSE_FROM = 8 * ROUGH
"""From this allowance on the wall is far enough away for thinned paths, mm: twice of what outline, offset,
thinning and fit may be off together."""
NEXT_RING = 1.5
"""The next ring is beside the present one if its start is within this many steps."""
TIGHT = 0.49
"""Steps up to half a diameter cover everything, see above; a wider step_over is cut back to this."""
MANY = 0.5
"""A round mill that would need more than twice its rings to make a floor roughs with its own step first."""


class Roughing:
    """One tool's roughing of one zone, in rings ``step_over`` diameters apart.

    On the wall it leaves the ``allowance``, mm, and at least what its accuracy asks for. ``only`` is the
    stock worth an effort, by default all that is left; with ``ridges`` only the floor of that is to be cut:
    what stands there is no higher than the zone's ridges.
    """

    def __init__(
        self,
        zone: Zone,
        stock: Stock,
        tool: Tool,
        allowance: float,
        step_over: float,
        climb: bool,
        only: shapely.Geometry | None = None,
        *,
        ridges: bool = False,
    ) -> None:
        self.zone, self.stock, self.tool, self.climb, self.only = zone, stock, tool, climb, only
        coarse = allowance >= COARSE_FROM
        self.chord = ROUGH if coarse else FINE
        self.fit = COARSE_FIT if coarse else fit_tolerance(zone.path)
        self.coarse, self.allowance, self.ridges = coarse, allowance, ridges
        self.radius = zone.radius_of(tool)
        self.foot = self.radius if zone.through else float(cutter(tool).radius_at(CUSP))
        self.step = min(step_over, TIGHT) * tool.diameter
        fine = min(self.step, 2 * TIGHT * self.foot)
        self.smooth = ridges or fine >= MANY * self.step
        if self.smooth:
            self.step = fine
        self.blocked = without_slits(self._blocked(0), self.chord)
        self.room = zone.room(self.radius, SLACK)
        self.free = shapely.difference(self.room, self.blocked)
        self.wide = self.foot if self.smooth else self.radius
        self.sliver = SLIVER if zone.kind == "outside" or zone.through else FLOOR_SLIVER
        self.over = stock.over + min(OVERLAP, self.sliver / 2)
        # On a floor with ridges nothing may be taken for cut that is not.
        self.touch = self.foot if ridges else self.radius
        self.reach = grow(self.free, self.foot if ridges else self.radius + self.over, ROUGH)
        take = areas(shapely.intersection(stock.left if only is None else only, self.reach))
        if zone.channel is not None and not coarse:
            take = shapely.intersection(take, grow(zone.channel, -FRINGE, ROUGH))
        self.core = buffered(take, -self.sliver, 2)
        if not shapely.is_empty(stock.waste):
            self.core = shapely.difference(self.core, grow(stock.waste, self.sliver, ROUGH))

    def _blocked(self, order: int) -> shapely.Geometry:
        """Where the centre must not be on the ring of this order."""
        ring = order * self.step
        if self.coarse:
            return self.zone.blocked(self.tool, ring, self.allowance)
        return self.zone.blocked(self.tool, max(self.allowance, self.zone.path.bias) + ring)

    def serves(self, stock: Stock) -> bool:
        """Whether another layer of the same recess, with this stock in it, is cut alike."""
        same = stock.left is self.stock.left and stock.over == self.stock.over
        return same and shapely.is_empty(stock.ridges) and not self.ridges

    def at(self, zone: Zone, stock: Stock) -> "Roughing":
        """The same cut of another layer that it serves."""
        other = copy(self)
        other.zone, other.stock = zone, stock
        return other

    @property
    def taken(self) -> float:
        """Area of what the cut is for, mm²: that of the core grown back, by Steiner's formula."""
        count, margin = len(polygons(self.core)), self.sliver
        return float(self.core.area + margin * self.core.length + math.pi * margin**2 * count)

    @property
    def share(self) -> float:
        """Part of what is left that this cut takes."""
        left = self.stock.left.area
        return self.taken / left if left > 0 else 0.0

    def after(self) -> Stock:
        """What this cut leaves of the stock."""
        if self.ridges:
            return replace(self.stock, ridges=areas(shapely.difference(self.stock.ridges, self.reach)))
        return replace(self._without(self.reach), over=self.over)

    def after_core(self) -> Stock:
        """The same for a cut that is only for its core: what it cuts elsewhere does not count."""
        return self._without(
            areas(shapely.intersection(self.reach, grow(self.core, self.sliver + self.radius)))
        )

    def _without(self, reach: shapely.Geometry) -> Stock:
        stock = self.stock
        if self.foot < self.radius:
            taken = areas(shapely.intersection(stock.left, reach))
            if self.smooth:
                taken = areas(shapely.difference(taken, grow(self.free, self.foot, ROUGH)))
            ridges = areas(shapely.union(stock.ridges, taken))
            stock = stock.with_ridges(ridges, min(self.tool.nose, self.zone.height))
        elif self.tool.nose > 0:
            above = self.tool.nose - (self.zone.bottom - self.zone.bottom_for(self.tool))
            stock = replace(stock, fillet=max(stock.fillet, min(above, self.zone.height)))
        return replace(stock, left=areas(shapely.difference(stock.left, reach)))

    @cached_property
    def cavities(self) -> list[Cavity]:
        """The runs, grouped by the connected stock they remove, each cavity from its far side to the wall."""
        parts = polygons(self.core)
        found = self._pieces() if parts else []
        if not found:
            return []
        middles = shapely.points([piece.points[len(piece.points) // 2] for piece in found])
        owner = shapely.STRtree(parts).query_nearest(middles, all_matches=False)[1]
        near = self._near
        groups: dict[int, list[Piece]] = {}
        for piece, part in zip(found, owner.tolist(), strict=True):
            groups.setdefault(part, []).append(piece)
        waiting = [(part, self._ordered(group, near)) for part, group in groups.items()]
        ordered = [waiting.pop(0)]
        while waiting:
            here = ordered[-1][1][-1][-1]
            starts = np.array([runs[0][0] for _, runs in waiting])
            ordered.append(waiting.pop(int(np.argmin(np.hypot(*(starts - here).T)))))
        every = [points for _, runs in ordered for points in runs]
        paths = iter(fit_all(every, self.fit, self.zone.path.lines_per_arc))
        # Slack for rounding: a link along a ring's chord may cut its corner by this much.
        free = prepared(grow(self.free, 2 * self.chord + self.fit, ROUGH))
        cavities = []
        for part, runs in ordered:
            shapes = [path for path in (next(paths) for _ in runs) if path.cuts]
            if shapes:
                cavities.append(self._linked(shapes, parts[part], near, free))
        return cavities

    def _linked(
        self, paths: list[Path], core: shapely.Polygon, near: shapely.Geometry, free: shapely.Geometry
    ) -> Cavity:
        """Find out which runs may be entered from the one before without lifting the cutter."""
        radius, stock = self.radius, None
        swept: shapely.Geometry = shapely.Polygon()
        trails = [shapely.LineString(path.points(radius / 3)) for path in paths]
        starts = np.array([path.start for path in paths])
        is_open = ~shapely.contains_xy(near, starts[:, 0], starts[:, 1])
        returns: tuple[Stretch, ...] = ()
        beside = np.zeros(len(paths), dtype=bool)
        if self._thick is not None:
            beside = ~shapely.contains_xy(self._thick, starts[:, 0], starts[:, 1])
        runs = [Run(paths[0], bool(is_open[0]), linked=False, beside=bool(beside[0]))]
        entries = zip(is_open[1:].tolist(), beside[1:].tolist(), strict=True)
        for last, path, (clear, thin) in zip(paths, paths[1:], entries, strict=False):
            linked = stays_inside(free, last.end, path.start)
            far = linked and math.dist(last.end, path.start) > NEXT_RING * self.step
            if far:
                # A longer way must go through what is cleared, or is being cleared by the runs so far.
                stock = grow(core, self.sliver, ROUGH) if stock is None else stock
                swept = shapely.union(swept, shapely.buffer(trails[len(runs) - 1], radius, quad_segs=6))
                way = shapely.buffer(shapely.linestrings([last.end, path.start]), radius - CLEAR, quad_segs=4)
                uncut = shapely.difference(shapely.intersection(way, stock), swept)
                linked = bool(uncut.area <= SLIVER * self.tool.diameter)
            way_there = last.end, path.start
            cleared = far and linked and self._is_cleared(*way_there, trails[: len(runs)], near)
            runs.append(Run(path, clear, linked, cleared, thin))
        if self.stock.begun and not self.ridges:
            around = grow(shapely.MultiLineString(trails), 3 * radius, ROUGH).bounds
            here = shapely.clip_by_rect(self.stock.remaining_area, *around)
            parts = split_by_engagement(paths, grow(here, self.stock.over, ROUGH), radius)
            runs = [replace(run, parts=part) for run, part in zip(runs, parts, strict=True)]
            if (
                len(runs) == 1
                and runs[0].open
                and not paths[0].closed
                and not shapely.contains_xy(near, *paths[0].end)
            ):
                (returns,) = split_by_engagement(
                    [paths[0].reversed()], grow(here, self.stock.over, ROUGH), radius
                )
        ends = paths[-1].end, paths[0].start
        back = stays_inside(free, *ends)
        cleared = back and self._is_cleared(*ends, trails, near)
        return Cavity(core, tuple(runs), back, cleared, returns=returns)

    def _is_cleared(
        self, a: Point, b: Point, trails: list[shapely.LineString], near: shapely.Geometry
    ) -> bool:
        """Whether the cutter meets nothing on a straight way, after some ``trails`` at the same height."""
        line = shapely.LineString([a, b])
        if not shapely.intersects(near, line):
            return True
        way = shapely.buffer(line, self.radius - CLEAR, quad_segs=4)
        x0, y0, x1, y1 = way.bounds
        box = x0 - self.radius, y0 - self.radius, x1 + self.radius, y1 + self.radius
        gone = shapely.buffer(shapely.clip_by_rect(trails, *box), self.radius, quad_segs=6)
        left = shapely.intersection(way, shapely.clip_by_rect(self.stock.remaining_area, x0, y0, x1, y1))
        return bool(shapely.difference(left, shapely.union_all(gone)).area <= SLIVER * self.tool.diameter)

    @cached_property
    def _near(self) -> shapely.Geometry:
        """Where the cutter meets what stands, prepared."""
        return prepared(grow(self.stock.remaining_area, self.radius + self.stock.over - CLEAR, ROUGH))

    @cached_property
    def _thick(self) -> shapely.Geometry | None:
        """Where the mill would meet more than the allowance of walls, prepared; None if it may not plunge.

        All cavities share it: there are as many as corners, and each would look at all of the stock.
        """
        if self.only is None or self.ridges or not self.tool.centre_cutting:
            return None
        return prepared(grow(self.only, self.radius - CLEAR, ROUGH))

    def _pieces(self) -> list[Piece]:
        radius = self.radius
        self.room = prepared(self.room)
        found: list[Piece] = []
        blocked, core = self.blocked, self.core
        wanted = grow(core, self.touch, ROUGH)
        near = prepared(grow(wanted, radius - self.touch + self.sliver + CLEAR, ROUGH))
        around = (near, self._near) if self.stock.begun else ()
        order = 0
        while True:
            if order:
                # The ring before reaches a radius far; this ring is for what lies beyond.
                core = shapely.difference(core, grow(blocked, self.wide - CLEAR + self.sliver, ROUGH))
                if not polygons(core):
                    return found
                blocked = self._blocked(order)
                wanted = grow(core, self.touch, ROUGH)
            wanted = prepared(wanted)
            for ring in rings(blocked, self.climb, self.chord):
                dense = densified(ring, radius / 2)
                x, y = dense.T
                inside = shapely.contains_xy(near, x, y)
                if not inside.any():
                    continue
                cuts = shapely.contains_xy(wanted, x, y)
                found.extend(pieces(dense, cuts, inside, self.room, order, around))
            order += 1

    def _ordered(self, group: list[Piece], near: shapely.Geometry) -> list[Array]:
        """Far rings first, among those of one order the nearest; closed rings entered where it is best."""
        runs: list[Array] = []
        here: Array | None = None
        waiting = sorted(group, key=lambda piece: -piece.order)
        while waiting:
            same = [piece for piece in waiting if piece.order == waiting[0].order]
            piece = same[0]
            if here is not None and len(same) > 1:
                starts = np.array([other.points[0] for other in same])
                piece = same[int(np.argmin(np.hypot(*(starts - here).T)))]
            waiting.remove(piece)
            points = piece.points
            if piece.closed:
                clear = ~shapely.contains_xy(near, points[:-1, 0], points[:-1, 1])
                at = 0
                if clear.any():
                    at = int(np.flatnonzero(clear)[0])
                elif here is not None:
                    at = int(np.argmin(np.hypot(*(points[:-1] - here).T)))
                points = np.concatenate((points[at:-1], points[: at + 1]))
            runs.append(points)
            here = points[-1]
        return runs

    def write(self, pen: Pen, step_down: float, *, thinning: bool) -> None:
        """Write the moves: every cavity level by level, from the zone's top to its bottom.

        With ``thinning`` it is fed faster where chips are thin.
        """
        zone = self.zone
        bottom = zone.bottom_for(self.tool)
        top = bottom + self.stock.ridge_height if self.ridges else zone.top
        for cavity in self.cavities:
            first = cavity.runs[0]
            heights = levels(top, bottom if cavity.bottom is None else cavity.bottom, step_down)
            if len(cavity.runs) == 1 and first.path.closed and not first.open:
                write_ring(pen, first.path, top, heights)
            else:
                write_levels(pen, cavity, top, heights, thinning=thinning and not pen.over)
        pen.retract()


def stays_inside(free: shapely.Geometry, a: Point, b: Point) -> bool:
    """Whether the centre may go straight from a to b."""
    return bool(shapely.covers(free, shapely.Point(a) if a == b else shapely.LineString([a, b])))
