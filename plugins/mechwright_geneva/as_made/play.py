"""How far the wheel can turn while the roller stands in its slot: the exact tube, and the closed forms.

The wheel may turn by x either way as long as the roller's centre, seen from the wheel, keeps its radius from
the walls. A straight slot, or a curved one off its middle, gives x = h / lever, h being half of what the slot
is wider than the roller and the lever that of the wall's normal about the wheel's axis. At mid stroke of a
curved slot the lever is 0 and x of order √h, so x is found where it is: on the walls.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from mechwright import Array
from mechwright_geneva.kinematics.geometry import Points, Stroke
from mechwright_geneva.kinematics.mechanism import Mechanism

TRIED = np.concatenate(([0.0], np.geomspace(1e-5, 0.2, 34)))
"""Turns, rad, between which the first wall is looked for: 0.2 moves a roller by more than a slot's width."""
GIVES_WAY = np.geomspace(1e-5, 0.02, 40)
"""Turns, rad, to either side of the exact position among which the wheel finds its own."""
HALVINGS = 10
"""After so many the turn is known to a thousandth of itself, and the rest of the way is straight."""

FAR = 1.0
"""How far from its wall a roller is still looked at, mm: more is no matter of play."""

WAY = 20001
"""Corners of a roller's way: on 200 mm they are a hundredth apart."""
TINY = 1e-30
"""mm², so that an edge without length divides nothing by 0."""

Room = Callable[[Points], Array]
"""How far points in the wheel's frame may move before a roller there touches, mm; below 0 it is in a wall."""


@dataclass(frozen=True)
class Play:
    """Room for the roller over a stroke.

    Parameters
    ----------
    at
        (n,) its centre in the wheel's frame, the wheel in its exact position.
    room
        What stands beside it.
    start
        (n,) rad: how far the wheel has turned from its exact position to have most room, if it had to.
    """

    at: Points
    room: Room
    start: Array | float = 0.0

    @cached_property
    def here(self) -> Array:
        """Room (n,) where it starts, mm; below 0 it binds."""
        return self.room(self.at)

    @cached_property
    def _tried(self) -> tuple[Array, Array]:
        ahead, behind = (
            self._at(sign * np.broadcast_to(TRIED, (self.at.size, TRIED.size))) for sign in (1, -1)
        )
        return ahead, behind

    def _at(self, turn: Array) -> Array:
        """Room (n, k) with the wheel turned by (n, k), rad, counter-clockwise."""
        points = self.at[:, None] * np.exp(-1j * turn)
        return self.room(points.ravel()).reshape(points.shape)

    def turns(self, more: float = 0.0) -> tuple[Array, Array]:
        """Turns (n,) ahead and behind, rad, with ``more`` mm of room on both walls; none where it binds."""
        ahead, behind = (
            self._first(tried + more, sign, more) for tried, sign in zip(self._tried, (1, -1), strict=True)
        )
        return ahead + self.start, behind - self.start

    def _first(self, tried: Array, sign: int, more: float) -> Array:
        rows = np.arange(len(tried))
        met = tried < 0
        first = np.maximum(np.where(met.any(axis=1), met.argmax(axis=1), TRIED.size - 1), 1)
        low, high = TRIED[first - 1], TRIED[first]
        free, held = tried[rows, first - 1], tried[rows, first]
        for _ in range(HALVINGS):
            middle = (low + high) / 2
            there = self._at(sign * middle[:, None])[:, 0] + more
            stops = there < 0
            low, free = np.where(stops, low, middle), np.where(stops, free, there)
            high, held = np.where(stops, middle, high), np.where(stops, there, held)
        share = np.divide(free, free - held, out=np.ones_like(free), where=free > held)
        turn: Array = low + np.clip(share, 0.0, 1.0) * (high - low)
        return np.where(tried[:, 0] < 0, 0.0, turn)


def play(stroke: Stroke, room: Room, shift: Points | complex = 0.0) -> Play:
    """The room over a stroke with the roller's centre off its place by ``shift``, mm, fixed frame.

    A wheel whose roller is off its place gives way: it starts from where the roller has most room.
    """
    at = (stroke.centre + shift) * stroke.to_wheel
    if not np.any(shift):
        return Play(at, room)
    start = _most_room(at, room)
    return Play(at * np.exp(-1j * start), room, start)


def _most_room(at: Points, room: Room) -> Array:
    """Turn (n,) of the wheel, rad, with most room for the roller, near its exact position."""

    def there(turn: Array) -> Array:
        points = at[:, None] * np.exp(-1j * turn)
        return room(points.ravel()).reshape(points.shape)

    grid = np.concatenate((-GIVES_WAY[::-1], [0.0], GIVES_WAY))
    best = there(np.broadcast_to(grid, (at.size, grid.size))).argmax(axis=1)
    low, high = grid[np.maximum(best - 1, 0)], grid[np.minimum(best + 1, grid.size - 1)]
    for _ in range(HALVINGS):
        third = (high - low) / 3
        one, two = there(np.column_stack((low + third, high - third))).T
        low, high = np.where(one < two, low + third, low), np.where(one < two, high, high - third)
    turn: Array = (low + high) / 2
    return turn


def drawn_room(m: Mechanism, half: float) -> Room:
    """The room in a slot whose walls stand ``half`` mm off the roller all along its exact way.

    A straight slot ends where the roller turns back.
    """
    if m.straight:
        way: Points = np.linspace(m.bottom, 2 * m.rim, WAY) * np.exp(-1j * m.wheel_half)
    else:
        lead = np.linspace(math.pi / 2, m.crank_half, WAY)
        before = m.axes - m.crank * np.exp(1j * lead)
        after = (m.axes - m.crank * np.exp(-1j * lead[::-1])) * np.exp(-2j * m.wheel_half)
        way = np.concatenate((before[:-1], m.stroke(np.linspace(0, 1, WAY)).track, after[1:]))
    near = _Nearest.of([way], closed=False)
    return lambda points: half - near.distance(points, FAR)


def made_room(material: shapely.Geometry, roller: float) -> Room:
    """The room for a roller of that radius, mm, beside the material of a wheel as made.

    The walls are followed in steps that are short against the roller.
    """
    shapely.prepare(material)
    rings = [
        shapely.get_coordinates(ring)[:-1] for ring in shapely.get_rings(shapely.get_parts(material)).tolist()
    ]
    near = _Nearest.of([ring[:, 0] + 1j * ring[:, 1] for ring in rings], closed=True)

    def room(points: Points) -> Array:
        away = near.distance(points, roller + FAR)
        inside: NDArray[np.bool_] = shapely.contains_xy(material, points.real, points.imag)
        return np.where(inside, -away, away) - roller

    return room


@dataclass(frozen=True)
class _Nearest:
    """Corners of lines, and the corner before and after each."""

    tree: cKDTree
    corner: Points
    before: Points
    after: Points

    @classmethod
    def of(cls, lines: Sequence[Points], *, closed: bool) -> "_Nearest":
        before, after = ([np.roll(line, turn) for line in lines] for turn in (1, -1))
        if not closed:
            for line, back, on in zip(lines, before, after, strict=True):
                back[0], on[-1] = line[0], line[-1]
        corner = np.concatenate(lines)
        tree = cKDTree(np.column_stack((corner.real, corner.imag)))
        return cls(tree, corner, np.concatenate(before), np.concatenate(after))

    def distance(self, points: Points, most: float) -> Array:
        """Distance (n,) of points from the edges at their nearest corner, mm; ``most`` where it is more."""
        found, at = self.tree.query(np.column_stack((points.real, points.imag)), distance_upper_bound=most)
        near = np.flatnonzero(np.isfinite(found))
        corner = self.corner[at[near]]
        away = np.full(points.shape, most)
        away[near] = found[near]
        for other in (self.before[at[near]], self.after[at[near]]):
            edge, way = other - corner, points[near] - corner
            share = np.clip((way * np.conj(edge)).real / np.maximum(np.abs(edge) ** 2, TINY), 0.0, 1.0)
            away[near] = np.minimum(away[near], np.abs(way - share * edge))
        return away
