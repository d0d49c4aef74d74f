"""Roughing: remove what is left in front of a wall, ring by ring from the far side to the wall.

Coverage: a point that the cutter can reach lies within one step of the next ring towards the wall, because the
way to the nearest wall point crosses that ring. So with steps up to the radius, the rings leave nothing.
"""

from dataclasses import dataclass

import numpy as np
import shapely

from mechwright.geometry.segments import Point
from mechwright.tooling import Tool
from mechwright_cam.planning.pen import Pen, levels
from mechwright_cam.planning.zone import SLACK, Zone
from mechwright_cam.toolpath.arcfit import fit
from mechwright_cam.toolpath.offsets import (
    BIAS,
    CHORD,
    FIT,
    ROUGH,
    Piece,
    densified,
    grow,
    opened,
    pieces,
    polygons,
    rings,
)
from mechwright_cam.toolpath.path import Path

SLIVER = 0.02
"""Half the width of stock that roughing does not bother with, mm: a tenth of the usual allowance."""
CLEAR = 0.01
"""A cutter this far from uncut stock runs in the clear, mm."""
COARSE_FROM = 4 * ROUGH
"""From this allowance on the wall is far enough away for thinned paths, mm."""
BESIDE = 1.5
"""The next ring is beside the present one if its start is within this many steps."""
TIGHT = 0.49
"""Steps up to half a diameter cover everything, see above; a wider step_over is cut back to this."""


@dataclass(frozen=True)
class Run:
    """A path at one depth, and whether its start is clear of stock."""

    path: Path
    open: bool
    order: int


@dataclass(frozen=True)
class Cavity:
    """Connected stock and the runs that remove it, in cutting order."""

    runs: tuple[Run, ...]


class Roughing:
    """One tool's roughing of one zone.

    Parameters
    ----------
    zone
        Its ``left`` is what has to go.
    tool
        An end mill.
    allowance
        Stock to leave on the wall, mm; at least BIAS.
    step_over
        Distance of rings, diameters.
    climb
        Direction.
    only
        The stock worth an effort; all that is left if None.
    """

    def __init__(
        self,
        zone: Zone,
        tool: Tool,
        allowance: float,
        step_over: float,
        climb: bool,
        only: shapely.Geometry | None = None,
    ) -> None:
        self.zone, self.tool, self.climb = zone, tool, climb
        coarse = allowance >= COARSE_FROM
        self.chord = ROUGH if coarse else CHORD
        self.fit = ROUGH if coarse else FIT
        # The shape that the cutter's edge must not enter.
        self.keep = zone.rough_keep(allowance) if coarse else grow(zone.keep, max(allowance, BIAS))
        self.step = min(step_over, TIGHT) * tool.diameter
        self.blocked = grow(self.keep, tool.radius, self.chord)
        self.room = zone.room(tool.radius, SLACK)
        self.free = shapely.difference(self.room, self.blocked)
        self.reach = grow(self.free, tool.radius, ROUGH)
        self.take = opened(shapely.intersection(zone.left if only is None else only, self.reach), SLIVER)

    @property
    def share(self) -> float:
        """Part of what is left that this cut takes."""
        return float(self.take.area / self.zone.left.area) if self.zone.left.area > 0 else 0.0

    def commit(self) -> None:
        """Take what this cut removes out of what is left."""
        self.zone.left = shapely.difference(self.zone.left, self.reach)

    def cavities(self) -> list[Cavity]:
        """The runs, grouped by the connected stock they remove, each cavity from its far side to the wall."""
        if not polygons(self.take):
            return []
        found = self._pieces()
        if not found:
            return []
        parts = polygons(self.take)
        middles = shapely.points([piece.points[len(piece.points) // 2] for piece in found])
        owner = shapely.STRtree(parts).query_nearest(middles, all_matches=False)[1]
        near = grow(self.zone.left, self.tool.radius - CLEAR, ROUGH)
        shapely.prepare(near)
        groups: dict[int, list[Piece]] = {}
        for piece, part in zip(found, owner.tolist(), strict=True):
            groups.setdefault(part, []).append(piece)
        waiting = [Cavity(tuple(self._ordered(group, near))) for group in groups.values()]
        ordered = [waiting.pop(0)]
        while waiting:
            here = ordered[-1].runs[-1].path.end
            starts = np.array([cavity.runs[0].path.start for cavity in waiting])
            ordered.append(waiting.pop(int(np.argmin(np.hypot(*(starts - here).T)))))
        return ordered

    def _pieces(self) -> list[Piece]:
        radius = self.tool.radius
        shapely.prepare(self.room)
        blocked, take, found = self.blocked, self.take, []
        order = 0
        while True:
            if order:
                # The ring before reaches this far; this ring is for what lies beyond.
                beyond = (order - 1) * self.step + 2 * radius - CLEAR
                take = opened(shapely.difference(take, grow(self.keep, beyond, ROUGH)), SLIVER)
                if not polygons(take):
                    return found
                blocked = grow(self.keep, radius + order * self.step, self.chord)
            wanted = grow(take, radius - SLIVER, ROUGH)
            near = grow(take, radius + CLEAR, ROUGH)
            shapely.prepare(wanted)
            shapely.prepare(near)
            some = False
            for ring in rings(blocked, self.climb, self.chord):
                dense = densified(ring, radius / 2)
                x, y = dense.T
                inside = shapely.contains_xy(near, x, y)
                if not inside.any():
                    continue
                new = pieces(
                    dense,
                    shapely.contains_xy(wanted, x, y),
                    inside,
                    shapely.contains_xy(self.room, x, y),
                    order,
                )
                found.extend(new)
                some = some or bool(new)
            if order and not some:
                return found
            order += 1

    def _ordered(self, group: list[Piece], near: shapely.Geometry) -> list[Run]:
        """Far rings first; among those of one order the nearest next; closed rings entered where it is best."""
        runs: list[Run] = []
        here: Point | None = None
        waiting = sorted(group, key=lambda piece: -piece.order)
        while waiting:
            order = waiting[0].order
            same = [piece for piece in waiting if piece.order == order]
            piece = same[0]
            if here is not None and len(same) > 1:
                piece = min(same, key=lambda p: float(np.hypot(*(p.points[0] - here))))
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
            is_open = not shapely.contains_xy(near, points[0, 0], points[0, 1])
            path = fit(points, self.fit)
            if path.cuts:
                runs.append(Run(path, is_open, piece.order))
                here = path.end
        return runs

    def write(self, pen: Pen, step_down: float, top: float | None = None) -> None:
        """Write the moves: every cavity level by level, from the zone's top to its bottom."""
        zone = self.zone
        top = zone.top if top is None else top
        # Slack for rounding: a link along a ring's chord may cut its corner by this much.
        shapely.prepare(free := grow(self.free, 2 * self.chord + self.fit, ROUGH))
        near = grow(zone.left, self.tool.radius - CLEAR, ROUGH)
        shapely.prepare(near)
        heights = levels(top, zone.bottom, step_down)
        for cavity in self.cavities():
            if not cavity.runs:
                continue
            first = cavity.runs[0]
            if len(cavity.runs) == 1 and first.path.closed and not first.open:
                self._spiral(pen, first, heights, top)
                continue
            above = top
            pen.retract()
            begun = False
            for z in heights:
                for number, run in enumerate(cavity.runs):
                    self._enter(pen, run, z, above, begun, number > 0, free, near)
                    pen.follow(run.path)
                    begun = True
                above = z
        pen.retract()

    def _spiral(self, pen: Pen, run: Run, heights: list[float], top: float) -> None:
        """One closed ring: down along it without a stop, and once round at the bottom."""
        pen.above(run.path.start)
        pen.sink(top)
        for z in heights:
            pen.ramp(run.path, z)
        pen.follow(run.path)

    def _enter(
        self,
        pen: Pen,
        run: Run,
        z: float,
        above: float,
        begun: bool,
        beside: bool,
        free: shapely.Geometry,
        near: shapely.Geometry,
    ) -> None:
        """Bring the cutter to the start of a run at height z."""
        start = run.path.start
        if begun and pen.place is not None:
            way = _between(pen.place, start, self.tool.radius / 4)
            allowed = bool(shapely.contains_xy(free, way[:, 0], way[:, 1]).all())
            short = np.hypot(start[0] - pen.place[0], start[1] - pen.place[1]) <= BESIDE * self.step
            cleared = not shapely.contains_xy(near, way[:, 0], way[:, 1]).any()
            if allowed and beside and (short or cleared):
                pen.straight(start)
                return
            # Back to the first run, through what this level has already cleared.
            if allowed and not beside:
                pen.straight(start)
                if run.open:
                    pen.sink(z)
                else:
                    pen.ramp(run.path, z)
                return
        pen.above(start)
        if run.open:
            pen.sink(z)
        else:
            pen.sink(above)
            pen.ramp(run.path, z)


def _between(a: Point, b: Point, step: float) -> np.ndarray:  # type: ignore[type-arg]
    count = max(1, int(np.ceil(np.hypot(b[0] - a[0], b[1] - a[1]) / step)))
    t = np.arange(count + 1)[:, None] / count
    line: np.ndarray = np.array(a) + t * (np.array(b) - np.array(a))  # type: ignore[type-arg]
    return line
