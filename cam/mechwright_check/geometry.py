"""Shapes of lines and arcs, paths as chords, and what those cover: all within SAG of the exact curves.

A chord is a straight piece of path. What it sweeps in plan view is a capsule, which is convex: it holds a
stretch of a wall if it holds both of its ends.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely

from mechwright_check import RefutedError, UnknownError
from mechwright_check.reading import CENTRE, END, KIND, START, SWEEP, TOOL

SAG = 0.0003
"""Chords of arcs are so far off at most, mm; it is added to what a limit allows, against the program."""
SHORTEST, LONGEST = 0.002, 1.0
"""Stretches of a wall are so long at first, and halved down to where they are held or so short, mm."""
COARSE = 0.02
"""And so far where only the load of a tool and what hangs together are asked."""
MOST = 3_000_000
"""Chords of a program, or corners of a part."""


@dataclass(frozen=True)
class Cutter:
    """The outline of a tool: a cone from its tip on, then a cylinder; its depth, and what else is said."""

    kind: str
    radius: float
    tip: float
    slope: float
    flutes: float
    raw: dict[str, Any]

    def at(self, height: Any) -> Any:
        """Radius at a height above the tip."""
        return np.minimum(self.radius, self.tip + self.slope * np.maximum(height, 0.0))


def polygons(rings: Any) -> Any:
    """The region of rings of nodes, µm: outer rings run counter-clockwise, and their holes follow them."""
    found: list[tuple[Any, list[Any]]] = []
    for ring in rings:
        points = _corners(np.array([node[:2] for node in ring], dtype=np.float64) / 1000, ring)
        if shapely.is_ccw(shapely.linearrings(points)):
            found.append((points, []))
        else:
            found[-1][1].append(points)
    shape = shapely.MultiPolygon(found)
    if not shapely.is_valid(shape) or not np.isfinite(shapely.get_coordinates(shape)).all():
        raise RefutedError("the certificate has an outline that crosses itself")
    return shape


def _corners(ends: np.ndarray, ring: Any) -> np.ndarray:
    """Corners (n, 2) of a ring whose nodes end at ``ends``."""
    points = []
    for a, b, node in zip(np.roll(ends, 1, axis=0), ends, ring, strict=True):
        if len(node) == 5:
            centre = np.array(node[2:4]) / 1000
            angle = np.arctan2(*(b - centre)[::-1]) - np.arctan2(*(a - centre)[::-1])
            angle = angle % (2 * np.pi) if node[4] > 0 else -(-angle % (2 * np.pi))
            points += arc_points(a, b, centre, angle)[1:].tolist()
        else:
            points.append(b)
    return np.array(points)


def arc_points(a: np.ndarray, b: np.ndarray, c: np.ndarray, angle: float, sag: float = SAG) -> np.ndarray:
    """Points (n, 2 or 3) along an arc or helix about c; a small difference of radii is spread along it."""
    first, last = np.hypot(*(a - c)[:2]), np.hypot(*(b - c)[:2])
    count = abs(angle) / (2 * np.arccos(max(1 - sag / max(first, last, sag), -1.0))) + 2
    if not count < MOST / 100:
        raise UnknownError("an arc of a radius that is too large")
    share = np.linspace(0, 1, int(count))
    turned, reach = np.arctan2(*(a - c)[1::-1]) + angle * share, first + (last - first) * share
    out = a + (b - a) * share[:, None]
    out[:, :2] = c[:2] + np.column_stack((reach * np.cos(turned), reach * np.sin(turned)))
    out[-1] = b
    return np.asarray(out)


@dataclass(frozen=True)
class Chords:
    """Straight pieces of path: ends (n, 3), the move (n,) of each, its tool, and whether it is fed."""

    a: np.ndarray
    b: np.ndarray
    move: np.ndarray
    tool: np.ndarray
    fed: np.ndarray

    @classmethod
    def of(cls, moves: np.ndarray, sag: float = SAG) -> "Chords":
        """The chords of moves, in their order, at most ``sag`` off."""
        bent = np.flatnonzero(moves[:, SWEEP])
        straight = np.flatnonzero(moves[:, SWEEP] == 0)
        every, owner = [np.hstack((moves[straight, START], moves[straight, END]))], [straight]
        for place in bent.tolist():
            row = moves[place]
            points = arc_points(row[START], row[END], np.append(row[CENTRE], 0.0), row[SWEEP], sag)
            every.append(np.hstack((points[:-1], points[1:])))
            owner.append(np.full(len(points) - 1, place))
        ends, of = np.concatenate(every), np.concatenate(owner)
        if len(of) > MOST:
            raise UnknownError("too many chords")
        order = np.argsort(of, kind="stable")
        ends, of = ends[order], of[order]
        return cls(ends[:, :3], ends[:, 3:], of, moves[of, TOOL].astype(int), moves[of, KIND] == 1)

    def only(self, which: np.ndarray) -> "Chords":
        """Some of them."""
        return Chords(self.a[which], self.b[which], self.move[which], self.tool[which], self.fed[which])

    @property
    def low(self) -> np.ndarray:
        """Their lower ends (n,)."""
        return np.asarray(np.minimum(self.a[:, 2], self.b[:, 2]))

    def below(self, height: float) -> "Chords":
        """Their parts below a height: each piece in plan view once, at its lowest."""
        some = self.only(self.low < height)
        a, b = some.a.copy(), some.b.copy()
        for one, other in ((a, b), (b, a)):
            over = one[:, 2] > height
            share = (one[over, 2] - height) / (one[over, 2] - other[over, 2])
            one[over] += (other[over] - one[over]) * share[:, None]
        order = np.argsort(some.low, kind="stable")
        plan = np.column_stack((some.tool, some.fed, a[:, :2] * 1e4, b[:, :2] * 1e4))[order]
        kept = np.unique(np.round(plan).astype(np.int64), axis=0, return_index=True)[1]
        return Chords(a, b, some.move, some.tool, some.fed).only(np.sort(order[kept]))

    def lines(self) -> np.ndarray:
        """One line (n,) for each, in plan view; a point where it goes straight down."""
        found = shapely.linestrings(np.stack((self.a[:, :2], self.b[:, :2]), axis=1))
        still = (self.a[:, :2] == self.b[:, :2]).all(axis=1)
        found[still] = shapely.points(self.a[still, :2])
        return np.asarray(found)

    def radii(self, tools: dict[int, Cutter], height: float) -> np.ndarray:
        """How wide (n,) their tools are at a height."""
        out = np.zeros(len(self.move))
        for number in np.unique(self.tool).tolist():
            mine = self.tool == number
            out[mine] = tools[number].at(height - self.low[mine])
        return out


def nearest(points: np.ndarray, a: np.ndarray, b: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Distance (n,) of points (n, 2) from chords in plan view, and z of the chords there."""
    along = (b - a)[:, :2]
    square = (along**2).sum(axis=1)
    share = ((points - a[:, :2]) * along).sum(axis=1) / np.maximum(square, 1e-18)
    at = a + (b - a) * np.clip(share, 0.0, 1.0)[:, None]
    low = np.minimum(a[:, 2], b[:, 2])  # of one that goes straight down
    return np.hypot(*(at[:, :2] - points).T), np.where(square > 0, at[:, 2], low)


def uncovered(walls: Any, chords: Chords, radii: np.ndarray) -> np.ndarray:
    """Stretches (k, 2, 2) of lines that no capsule about a chord holds as a whole."""
    parts = shapely.get_parts(shapely.segmentize(walls, LONGEST))
    corners, line = shapely.get_coordinates(parts, return_index=True)
    joined = line[1:] == line[:-1]
    left, lines = np.stack((corners[:-1][joined], corners[1:][joined]), axis=1), chords.lines()
    groups = [(radius, np.flatnonzero(radii == radius)) for radius in np.unique(radii[radii > 0])]
    trees = [(radius, mine, shapely.STRtree(lines[mine])) for radius, mine in groups]
    while len(left):
        open_, bare = np.ones(len(left), dtype=bool), np.ones(len(left), dtype=bool)
        for radius, mine, tree in trees:
            places = np.flatnonzero(open_)
            spot, chord = tree.query(shapely.points(left[places, 0]), predicate="dwithin", distance=radius)
            place, chord = places[spot], mine[chord]
            bare[place] = False
            held = nearest(left[place, 1], chords.a[chord], chords.b[chord])[0] <= radius
            open_[place[held]] = False
        left, bare = left[open_], bare[open_]
        if bare.any():  # where they begin no capsule is at all
            return np.asarray(left[bare])
        if len(left) == 0 or np.hypot(*(left[:, 1] - left[:, 0]).T).max() < SHORTEST:
            break
        middle = left.mean(axis=1)
        left = np.concatenate((np.stack((left[:, 0], middle), 1), np.stack((middle, left[:, 1]), 1)))
    return left
