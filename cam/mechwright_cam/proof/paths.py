"""Where the cutters go: the moves of a run as plan-view lines, cut at heights.

Glossary
--------
piece
    The part of one move that runs below a height.
chain
    Pieces that follow on each other with the same tool.
"""

from collections.abc import Callable, Iterable
from copy import copy
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright_cam.controls.reading import Kind, Run
from mechwright_cam.controls.reading.run import Ints
from mechwright_cam.shop.cutter import Cutter, cutter
from mechwright_cam.shop.tool import MILLS, Tool, ToolKind

PATH_CHORD = 0.0002
"""Chord error of arcs, mm: a twenty-fifth of the gouge limit."""
FAR_ABOVE = 1000.0
"""Stands for the machine's upper end, mm: above any clamp or clearance."""
NEAR = 1e-6
"""Coordinates closer than this are the same, mm: far below the last decimal of any program."""

Geometries = NDArray[Any]


@dataclass(frozen=True)
class Pieces:
    """Pieces of moves."""

    step: Ints
    """(m,) index into the run."""
    first: Array
    last: Array
    """(m,) the part of the move, from 0 to 1."""
    low: Array
    """(m,) lowest z of the piece, mm."""

    def __len__(self) -> int:
        return int(self.step.size)

    def only(self, which: NDArray[Any]) -> "Pieces":
        """Some of the pieces, by mask or index."""
        return Pieces(self.step[which], self.first[which], self.last[which], self.low[which])


class Paths:
    """The moves of a run whose position is known, and the tools that make them."""

    def __init__(self, run: Run, tools: Iterable[Tool]) -> None:
        self.run = run
        self.tools = {tool.number: tool for tool in tools}
        known = np.array(sorted(self.tools), dtype=np.int64)
        self.start, self.end = run.start.copy(), run.end.copy()
        for ends in (self.start, self.end):
            height = ends[:, 2]
            height[np.isposinf(height)] = FAR_ABOVE
        placed = np.isfinite(self.start).all(axis=1) & np.isfinite(self.end).all(axis=1)
        self.steps: Ints = np.flatnonzero(run.moving & placed & np.isin(run.tool, known))

    @property
    def mills(self) -> list[Tool]:
        """The mills that any of the steps are made with."""
        used = set(self.run.tool[self.steps].tolist())
        return [tool for number, tool in self.tools.items() if number in used and tool.kind in MILLS]

    @property
    def cuts(self) -> Ints:
        """Those of the steps that are feed moves."""
        return self.steps[self.run.cutting[self.steps]]

    @property
    def rapids(self) -> Ints:
        """Those of the steps that are rapid moves."""
        rapids: Ints = self.steps[self.run.kind[self.steps] == Kind.RAPID]
        return rapids

    @cached_property
    def low(self) -> Array:
        """(n,) z of the lower end of each step, mm."""
        return np.minimum(self.start[:, 2], self.end[:, 2])

    @cached_property
    def length(self) -> Array:
        """(n,) length of each step, mm; 0 where an end is unknown, and the upper end is ``FAR_ABOVE``."""
        move = self.end - self.start
        arc = self.run.kind == Kind.ARC
        flat = np.where(arc, np.abs(self.run.sweep) * self.run.radius, np.hypot(*move[:, :2].T))
        return np.nan_to_num(np.hypot(flat, move[:, 2]))

    @cached_property
    def radius(self) -> Array:
        """(n,) radius of the tool in the spindle, mm; NaN for an unknown one."""
        return self.of_tool(lambda tool: tool.radius)

    def of_kinds(self, kinds: set[ToolKind]) -> "Paths":
        """The same, with the steps of some kinds of tool only."""
        numbers = [number for number, tool in self.tools.items() if tool.kind in kinds]
        some = copy(self)
        some.steps = self.steps[np.isin(self.run.tool[self.steps], numbers)]
        return some

    @cached_property
    def cutter(self) -> Cutter:
        """The outlines (n,) of the tools in the spindle."""
        names = ("radius", "nose", "tip", "slope")
        return Cutter(*(self.of_tool(lambda tool, name=name: getattr(cutter(tool), name)) for name in names))

    def of_tool(self, value: Callable[..., float | None]) -> Array:
        """(n,) a value of the tool in the spindle; NaN for an unknown tool or value."""
        numbers = self.run.tool
        out = np.full(numbers.size, np.nan)
        for number, tool in self.tools.items():
            out[numbers == number] = value(tool)
        return out

    def cutters(self, steps: Ints) -> Cutter:
        """The outlines (m,) of the tools of some steps."""
        every = self.cutter
        return Cutter(every.radius[steps], every.nose[steps], every.tip[steps], every.slope[steps])

    def radius_at(self, pieces: Pieces, height: float) -> Array:
        """(m,) largest radius at ``height`` over each piece, mm, taken at its lowest place."""
        return self.cutters(pieces.step).radius_at(height - pieces.low)

    def whole(self, steps: Ints) -> Pieces:
        """All of some steps."""
        return self.below(np.inf, steps=steps)

    def below(self, height: float | Array, *, steps: Ints | None = None) -> Pieces:
        """The pieces that run at or below ``height``, one for all or one (m,) for each of the steps."""
        steps = self.steps if steps is None else steps
        z0, z1 = self.start[steps, 2], self.end[steps, 2]
        reach = np.minimum(z0, z1) <= height
        steps, z0, z1, height = (
            steps[reach],
            z0[reach],
            z1[reach],
            np.broadcast_to(height, reach.shape)[reach],
        )
        drop = np.where(z0 == z1, 1.0, z0 - z1)
        crossing = np.clip((z0 - height) / drop, 0.0, 1.0)
        first = np.where(z0 > height, crossing, 0.0)
        last = np.where(z1 > height, crossing, 1.0)
        return Pieces(steps, first, last, np.minimum(z0, z1))

    def corners(self, pieces: Pieces, chord: float = PATH_CHORD) -> Ints:
        """How many corners (m,) the line of each piece has."""
        run, step = self.run, pieces.step
        arc = run.kind[step] == Kind.ARC
        turn = run.sweep[step] * (pieces.last - pieces.first)
        radius = np.where(arc, run.radius[step], 1.0)
        largest = 2 * np.arccos(np.maximum(1 - chord / np.maximum(radius, chord), 0.0))
        count: Ints = np.where(arc, np.ceil(np.abs(turn) / largest), 1).astype(np.int64) + 1
        return np.maximum(count, 2)

    def points(self, pieces: Pieces, chord: float = PATH_CHORD) -> tuple[Array, Ints]:
        """Corners (k, 2) of all pieces, mm, and the piece (k,) that each belongs to."""
        run, step = self.run, pieces.step
        arc, count = run.kind[step] == Kind.ARC, self.corners(pieces, chord)
        owner, share = _spread(count)
        t = pieces.first[owner] + (pieces.last - pieces.first)[owner] * share
        start = self.start[step, :2]
        way = self.end[step, :2] - start
        flat = start[owner] + way[owner] * t[:, None]
        bent = np.flatnonzero(arc)
        if bent.size:
            on = arc[owner]
            flat[on] = self._on_arc(step[bent], np.repeat(np.arange(bent.size), count[bent]), t[on])
        return flat, owner

    def samples(self, steps: Ints, spacing: float) -> tuple[Array, Array, Ints]:
        """Places (k, 2) and heights (k,) along the moves, ends included, and the step (k,) of each."""
        run = self.run
        count = np.maximum(np.ceil(self.length[steps] / spacing), 1).astype(np.int64) + 1
        place, share = _spread(count)
        owner = steps[place]
        way = self.end[steps] - self.start[steps]
        points = way[place]
        points *= share[:, None]
        points += self.start[owner]
        bent = np.flatnonzero(run.kind[steps] == Kind.ARC)
        if bent.size:
            centre = run.centre[steps[bent]]
            spoke = self.start[steps[bent], :2] - centre
            first, radius = np.arctan2(spoke[:, 1], spoke[:, 0]), np.hypot(*spoke.T)
            on, of = np.flatnonzero(run.kind[owner] == Kind.ARC), np.repeat(np.arange(bent.size), count[bent])
            angle = run.sweep[owner[on]] * share[on] + first[of]
            points[on, 0] = centre[of, 0] + radius[of] * np.cos(angle)
            points[on, 1] = centre[of, 1] + radius[of] * np.sin(angle)
        return points[:, :2], points[:, 2], owner

    def _on_arc(self, step: Ints, owner: Ints, t: Array) -> Array:
        """Points (k, 2) on arcs (m,); a small difference of the two radii is spread along the arc."""
        centre = self.run.centre[step]
        out, back = self.start[step, :2] - centre, self.end[step, :2] - centre
        first = np.hypot(out[:, 0], out[:, 1])
        more = np.hypot(back[:, 0], back[:, 1]) - first
        angle = np.arctan2(out[:, 1], out[:, 0])[owner] + self.run.sweep[step][owner] * t
        radius = first[owner] + more[owner] * t
        points = centre[owner]
        points[:, 0] += radius * np.cos(angle)
        points[:, 1] += radius * np.sin(angle)
        return points

    def extent(self, steps: Ints | None = None) -> tuple[Array, Array]:
        """Least and greatest x and y, (m, 2) each, of every one of some steps, or of ``self.steps``, mm."""
        run, step = self.run, self.steps if steps is None else steps
        start, end = self.start[step, :2], self.end[step, :2]
        least, most = np.minimum(start, end), np.maximum(start, end)
        arc = np.flatnonzero(run.kind[step] == Kind.ARC)
        centre, sweep = run.centre[step[arc]], run.sweep[step[arc]]
        radius = run.radius[step[arc]] + run.arc_error[step[arc]]
        spoke = start[arc] - centre
        first = np.arctan2(spoke[:, 1], spoke[:, 0])
        for axis, angle, side in ((0, 0.0, 1), (1, np.pi / 2, 1), (0, np.pi, -1), (1, -np.pi / 2, -1)):
            # An arc reaches out furthest where it passes the direction of an axis.
            passed = np.mod((angle - first) * np.sign(sweep), 2 * np.pi) <= np.abs(sweep)
            at, reach = arc[passed], centre[passed, axis] + side * radius[passed]
            if side > 0:
                most[at, axis] = np.maximum(most[at, axis], reach)
            else:
                least[at, axis] = np.minimum(least[at, axis], reach)
        return least, most

    def lines(self, pieces: Pieces, chord: float = PATH_CHORD) -> Geometries:
        """One line per piece; a point where it goes straight down."""
        if len(pieces) == 0:
            return np.empty(0, dtype=object)
        return _lines(*self.points(pieces, chord))

    def room(self, pieces: Pieces) -> Geometries:
        """Where the tip may be in plan view while it makes each piece: of a feed move that is its line.

        The axes of a rapid may arrive one after the other: whatever the order, X and Y stay in the rectangle
        between both ends of the whole move, at the height of the lower end.
        """
        found = self.lines(pieces)
        rapid = np.flatnonzero(self.run.kind[pieces.step] == Kind.RAPID)
        if rapid.size:
            ends = self.start[pieces.step[rapid], :2], self.end[pieces.step[rapid], :2]
            low, high = np.minimum(*ends), np.maximum(*ends)
            wide = (high - low > NEAR).all(axis=1)
            found[rapid[wide]] = shapely.box(*low[wide].T, *high[wide].T)
            straight = rapid[~wide]
            found[straight] = self.lines(self.whole(pieces.step[straight]))
        return found

    def chains(self, pieces: Pieces, chord: float = PATH_CHORD) -> Geometries:
        """The pieces joined into chains, repeated passes once.

        All pieces have to be of one tool.
        """
        if len(pieces) == 0:
            return np.empty(0, dtype=object)
        points, owner = self.points(pieces, chord)
        joined = (np.diff(pieces.step) == 1) & (pieces.last[:-1] == 1.0) & (pieces.first[1:] == 0.0)
        chain = np.concatenate(([0], np.cumsum(~joined)))[owner]
        distinct = {line.wkb: line for line in _lines(points, chain)}
        return np.array(list(distinct.values()), dtype=object)


def _spread(count: Ints) -> tuple[Ints, Array]:
    """Index (k,) of each of so many places (m,), and its share of the way from the first to the last."""
    owner = np.repeat(np.arange(count.size), count)
    return owner, (np.arange(owner.size) - (np.cumsum(count) - count)[owner]) / (count[owner] - 1)


def _lines(points: Array, owner: Ints) -> Geometries:
    """Lines through points (k, 2); a line without length becomes a point.

    GEOS 3.14 finds a line of length 0 outside any distance of a prepared polygon; a point it finds.
    """
    lines: Geometries = shapely.linestrings(points, indices=owner)
    still = np.flatnonzero(shapely.length(lines) == 0)
    lines[still] = shapely.points(points[np.searchsorted(owner, still)])
    return lines
