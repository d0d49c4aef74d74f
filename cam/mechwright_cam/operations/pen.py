"""Writes moves: keeps the present position, and holds the rules of rapids and entries."""

import math
from collections.abc import Sequence
from itertools import accumulate, repeat
from typing import cast

from mechwright.errors import ToolError
from mechwright.geometry.segments import Point
from mechwright.tolerances import TOLERANCES
from mechwright_cam.operations.over_tabs import lifted_height, over_tabs
from mechwright_cam.operations.rates import RAMP_SHARE, Rates
from mechwright_cam.program.moves import Feed, FeedArc, Move, Rapid
from mechwright_cam.setup.holding import Tab
from mechwright_cam.shop.tool import Tool
from mechwright_plane.path import Path, polyline, printed, rounded

APPROACH = 1.0
"""Rapids end this far above the stock, mm: thicker than any unevenness of a sawn plate."""
AIR = 3.0
"""Feed through cleared ground in feeds of a full cut: where an edge should meet something after all chips are
thin, and no proof lets pass more of programs with the cutting data of others."""
DOWN = 1.5
"""The same straight down: where the end of a mill should meet something, that is still no more than a proof
accepts of programs with the cutting data of others."""
EASIER = 1e-3
"""Ramps are longer than the steepest by this share, and so many mm: rounding of z must make none steeper."""
STEEP = math.tan(math.radians(3))
"""Slope from which on the feed is that of ramps: the usual angle."""
TINY = 0.5
"""A way shorter than this many diameters is too short to ramp along: the cutter plunges."""


class Pen:
    """A cutter at work.

    Its rapids in X and Y run at the height of ``clearance``, mm, and no ramp is steeper than the tangent
    ``slope``. It goes ``over`` ramped tabs: ``z`` follows their upper sides, ``level`` is its height beside.
    """

    def __init__(
        self, tool: Tool, rates: Rates, clearance: float, slope: float, over: tuple[Tab, ...] = ()
    ) -> None:
        self.tool, self.rates, self.clearance, self.slope = tool, rates, clearance, slope
        self.over = over
        self.moves: list[Move] = []
        self.place: Point | None = None
        self.z = self.level = math.inf

    @property
    def air(self) -> float:
        """Feed through what is cleared, at depth, mm/min: no slower than in the cut."""
        return self.times(AIR)

    @property
    def air_down(self) -> float:
        """Feed straight down through what is cleared, mm/min."""
        return self.times(DOWN)

    def thin(self, engagement: float) -> float:
        """Feed, mm/min, with which no chip is thicker than planned up to an engagement, rad."""
        return self.times(1 / math.sin(engagement))

    def times(self, share: float) -> float:
        """Feed, mm/min, in feeds of a full cut; no slower than in the cut."""
        return max(self.rates.feed, min(math.floor(share * self.rates.full), self.rates.fastest))

    def above(self, point: Point) -> None:
        """Retract, rapid over a point and down to just over the stock."""
        point = printed(point)
        self.retract()
        if self.place != point:
            self.moves.append(Rapid(x=point[0], y=point[1]))
        height = min(APPROACH, self.clearance)
        self.moves.append(Rapid(z=height))
        self.place, self.z, self.level = point, height, height

    def go(self, point: Point, direct: bool, feed: float | None = None) -> None:
        """Straight to a point where the way at this height is free, else over the stock."""
        if direct:
            self.straight(point, feed)
        else:
            self.above(point)

    def retract(self) -> None:
        """Rapid up to the clearance height."""
        if self.place is not None and self.z < self.clearance:
            self.moves.append(Rapid(z=self.clearance))
            self.z = self.level = self.clearance

    def sink(self, z: float, feed: float | None = None) -> None:
        """Feed straight down or up; through air unless told a feed for material."""
        self.level = z = rounded(z)
        if self.over and self.place is not None:  # on a tab if there is one
            z = max(z, lifted_height(self.over, self.place, self.tool.radius))
        if z != self.z:
            self.moves.append(Feed(None, None, z, self.rates.feed if feed is None else feed))
            self.z = z

    def straight(self, point: Point, feed: float | None = None) -> None:
        """Feed straight to a point at this height."""
        point = printed(point)
        if point != self.place:
            if self.over and self._goes_over(polyline([self.place or point, point]), self.level, feed):
                return
            self.moves.append(Feed(point[0], point[1], None, self.rates.feed if feed is None else feed))
            self.place = point

    def _goes_over(self, path: Path, z: float, feed: float | None, inside: int = 0) -> bool:
        """Run along a path that leads over tabs, down to ``z`` at its end; False if it leads over none."""
        stretches = self.over and over_tabs(path, self.level, z, self.over, self.tool.radius)
        if not stretches:
            return False
        feed = self.rates.feed if feed is None else feed
        for part, height in stretches:
            drop = self.z - height
            # Downhill the end of the cutter goes down no faster than in a plunge.
            pace = min(feed, self.rates.plunge * math.hypot(part.length, drop) / drop) if drop > 0 else feed
            self._evenly(part, height, math.floor(pace), inside)
        self.level = rounded(z)
        return True

    def follow(self, path: Path, feed: float | None = None, inside: int = 0) -> None:
        """Run along a path at this height.

        Arcs that turn ``inside`` (+1 to the left, -1 to the right) run inside a wall: the cutter's edge there
        is faster than its centre and takes more, so the centre is slowed down.
        """
        feed = self.rates.feed if feed is None else feed
        if path.start != self.place:
            raise AssertionError(f"the path starts at {path.start}, the cutter is at {self.place}")
        if self._goes_over(path, self.level, feed, inside):
            return
        moves = cast("list[Move] | None", path.cache.get((feed, inside)))
        if moves is None:
            moves = self.along(path, feed, inside)
            path.cache[feed, inside] = moves
        self.moves.extend(moves)
        self.place = path.end

    def along(
        self,
        path: Path,
        feed: float,
        inside: int = 0,
        heights: Sequence[float] | None = None,
        nearer: float = 0.0,
    ) -> list[Move]:
        """The moves along a path, each to its height if there are some, z in mm.

        On arcs that turn ``inside``, see :meth:`follow`, the centre runs ``nearer`` mm nearer to the middle.
        """
        moves: list[Move] = []
        for (here, cut, _), z in zip(path.walk(), heights or repeat(None), strict=False):
            if cut.turn:
                i, j = cut.cx - here[0], cut.cy - here[1]
                centre = math.hypot(i, j) - nearer
                pace = self.rates.inside(centre, self.tool.radius, feed) if cut.turn == inside else feed
                moves.append(FeedArc(cut.x, cut.y, z, i, j, cut.turn > 0, pace))
            else:
                moves.append(Feed(cut.x, cut.y, z, feed))
        return moves

    def descend(self, path: Path, z: float, feed: float | None = None) -> None:
        """Run along a path while going evenly down to ``z``, arcs as helices."""
        feed = self.ramp_feed(self.level - z, path.length) if feed is None else feed
        if not self._goes_over(path, z, feed):
            self._evenly(path, z, feed)

    def ramp_feed(self, drop: float, length: float) -> float:
        """Feed down along a way: that of ramps where it is steep, and nearly that of a cut where it is not.

        Of each chip the end of the cutter takes the share that the slope is: once round a wall next to none.
        """
        full, steep = self.rates.ramp / RAMP_SHARE, min(self.slope, STEEP)
        share = min(1.0, max(0.0, drop) / (steep * length)) if length > 0 else 1.0
        return max(self.rates.ramp, round(full - (full - self.rates.ramp) * share, -1))

    def _evenly(self, path: Path, z: float, feed: float, inside: int = 0) -> None:
        """Run along a path while going evenly to ``z``."""
        start, total, heights = self.z, path.length, None
        if rounded(z) != start:
            ways = accumulate(cut.length for cut in path.cuts)
            heights = [rounded(start + (z - start) * way / total) for way in ways]
            heights[-1:] = [rounded(z)]
        self.moves += self.along(path, feed, inside, heights)
        self.place, self.z = path.end, rounded(z)
        self.level = self.z

    def enter(self, path: Path, above: float, z: float, clear: bool, feed: float | None = None) -> None:
        """Down at a path's start: straight to ``z`` where that is clear, else from ``above`` along it.

        Straight down it goes with the ``feed``, that of a cut unless it is given.
        """
        self.sink(z if clear else above, feed)
        if not clear:
            self.ramp(path, z)

    def helix(
        self,
        turn: Path,
        radius: float,
        top: float,
        bottom: float,
        step: float = math.inf,
        feed: float | None = None,
    ) -> None:
        """Go down along a circle, no more than ``step`` mm in a turn, and once round at the bottom."""
        self.above(turn.start)
        self.sink(top)
        # A little less than the steepest, for rounding.
        for z in levels(top, bottom, min(step, math.tau * radius * self.slope * 0.999)):
            ramp = self.ramp_feed(self.level - z, turn.length)
            self.descend(turn, z, ramp if feed is None else min(ramp, feed))
        self.follow(turn, feed)

    def ramp(self, path: Path, z: float) -> None:
        """Go down to ``z`` along the beginning of a path, and end on its start.

        A closed path is run round and round; an open one to and fro. A way too short for that is plunged:
        raises ToolError where the cutter may not be.
        """
        drop = self.level - rounded(z)
        if drop <= 0:
            return
        if path.length < TINY * self.tool.diameter:
            if not self.tool.centre_cutting:
                raise ToolError(
                    f"cam.tools: {self.tool.name} is not centre-cutting and finds only {path.length:.2f} mm "
                    f"to ramp in near X{path.start[0]:.1f} Y{path.start[1]:.1f}; list a centre-cutting or a "
                    "smaller end mill"
                )
            self.sink(z, self.rates.plunge)
            return
        run = drop / self.slope * (1 + EASIER) + EASIER
        start = self.level
        if path.closed:
            part = back = path
            legs = math.ceil(run / path.length)
        else:
            part = path.split(run)[0] if run < path.length else path
            legs = math.ceil(run / part.length)
            legs += legs % 2
            part = path.split(run / legs)[0] if run / legs < path.length else path
            back = part.reversed()
        for leg in range(1, legs + 1):
            self.descend(part if leg % 2 else back, start - drop * leg / legs)


def levels(top: float, bottom: float, step: float) -> list[float]:
    """Heights of even passes from ``top`` down to ``bottom``, none deeper than ``step``.

    >>> levels(0.0, -10.0, 4.0)
    [-3.3333, -6.6667, -10.0]
    """
    count = max(1, math.ceil((top - bottom) / step - TOLERANCES.noise))
    return [rounded(top + (bottom - top) * number / count) for number in range(1, count + 1)]
