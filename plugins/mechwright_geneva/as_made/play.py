"""How far the wheel can turn while the roller stands in its slot.

The wheel may turn by x either way as long as the roller has room. In a slot as drawn the room is half the
clearance, h, less the distance of the roller's centre from its exact way over the wheel. In a slot as made
the room is the distance from the walls less the roller's radius. A straight slot, or a curved one off its
middle, gives x = h / lever, with the lever of the wall's normal about the wheel's axis. At mid stroke of a
curved slot the lever is 0 and x of order √h, so x is found where it is: on the walls.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely
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
TINY = 1e-30
"""mm², so that an edge without length divides nothing by 0."""

WAY, LEAD = 4001, 0.25
"""Points of the way among which the nearest is sought; crank angle, rad, by which it goes on at both ends."""
NEWTON = 3
"""Places on the way that Newton's method tries: from half a step of the crank to rounding."""

Room = Callable[[Points], Array]
"""How far points (...) in the wheel's frame may move before a roller there touches, mm; below 0 in a wall."""


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

    @classmethod
    def of(cls, stroke: Stroke, room: Room, shift: Points | complex = 0.0) -> "Play":
        """The room over a stroke with the roller's centre off its place by ``shift``, mm, fixed frame.

        A wheel whose roller is off its place gives way: it starts from where the roller has most room.
        """
        exact = cls((stroke.centre + shift) * stroke.to_wheel, room)
        if not np.any(shift):
            return exact
        start = exact._most_room()
        return cls(exact.at * np.exp(-1j * start), room, start)

    @cached_property
    def here(self) -> Array:
        """Room (n,) where it starts, mm; below 0 it binds."""
        return self.room(self.at)

    @cached_property
    def _tried(self) -> tuple[Array, Array]:
        return self._turned(TRIED), self._turned(-TRIED)

    def _turned(self, turn: Array) -> Array:
        """Room (n, k) with the wheel turned by (k,) or (n, k), rad, counter-clockwise."""
        return self.room(self.at[:, None] * np.exp(-1j * turn))

    def _most_room(self) -> Array:
        """Turn (n,) of the wheel, rad, with most room for the roller, near its exact position."""
        grid = np.concatenate((-GIVES_WAY[::-1], [0.0], GIVES_WAY))
        best = self._turned(grid).argmax(axis=1)
        low, high = grid[np.maximum(best - 1, 0)], grid[np.minimum(best + 1, grid.size - 1)]
        for _ in range(HALVINGS):
            third = (high - low) / 3
            one, two = self._turned(np.column_stack((low + third, high - third))).T
            low, high = np.where(one < two, low + third, low), np.where(one < two, high, high - third)
        return np.asarray((low + high) / 2)

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
        free, stopped = tried[rows, first - 1], tried[rows, first]
        for _ in range(HALVINGS):
            middle = (low + high) / 2
            there = self._turned(sign * middle[:, None])[:, 0] + more
            stops = there < 0
            low, free = np.where(stops, low, middle), np.where(stops, free, there)
            high, stopped = np.where(stops, middle, high), np.where(stops, there, stopped)
        share = np.divide(free, free - stopped, out=np.ones_like(free), where=free > stopped)
        turn: Array = low + np.clip(share, 0.0, 1.0) * (high - low)
        return np.where(tried[:, 0] < 0, 0.0, turn)


def drawn_room(m: Mechanism, half: float) -> Room:
    """The room in a slot whose walls stand ``half`` mm off the roller all along its exact way.

    A straight slot ends where the roller turns back.
    """
    if m.straight:
        to_slot = np.exp(1j * m.wheel_half)

        def straight(points: Points) -> Array:
            along = points * to_slot
            return np.asarray(half - np.abs(along - np.maximum(along.real, m.bottom)))

        return straight
    angles = np.linspace(-LEAD, 2 * m.crank_half + LEAD, WAY)
    tree, step = cKDTree(_plane(m.way(angles).track)), angles[1] - angles[0]

    def curved(points: Points) -> Array:
        away, nearest = tree.query(_plane(points))
        at = angles[nearest]
        for _ in range(NEWTON):
            run = m.way(at)
            off = run.centre - points / run.to_wheel
            away = np.minimum(away, np.abs(off))
            slope = (np.conj(run.velocity) * off).real
            change = run.speed**2 + (np.conj(run.acceleration) * off).real
            at = at - np.clip(slope / np.where(change > 0, change, np.inf), -step, step)
        return np.asarray(half - away)

    return curved


def made_room(material: shapely.Geometry, roller: float) -> Room:
    """The room for a roller of that radius, mm, beside the material of a wheel as made.

    The walls have corners in steps that are short against the roller, so the nearest edge is at the nearest.
    """
    shapely.prepare(material)
    rings = [
        shapely.get_coordinates(ring)[:-1] @ (1, 1j)
        for ring in shapely.get_rings(shapely.get_parts(material)).tolist()
    ]
    corners = np.concatenate(rings)
    neighbours = [np.concatenate([np.roll(ring, step) for ring in rings]) for step in (1, -1)]
    tree = cKDTree(_plane(corners))

    def room(points: Points) -> Array:
        away, nearest = tree.query(_plane(points), distance_upper_bound=roller + FAR)
        near = np.isfinite(away)
        corner, found = corners[nearest[near]], away[near]
        for other in neighbours:
            edge, way = other[nearest[near]] - corner, points[near] - corner
            share = np.clip((way * np.conj(edge)).real / np.maximum(np.abs(edge) ** 2, TINY), 0.0, 1.0)
            found = np.minimum(found, np.abs(way - share * edge))
        away = np.full(points.shape, roller + FAR)
        away[near] = found
        return np.where(shapely.contains_xy(material, points.real, points.imag), -away, away) - roller

    return room


def _plane(points: Points) -> Array:
    """Points (...) as coordinates (..., 2)."""
    return np.stack((points.real, points.imag), axis=-1)
