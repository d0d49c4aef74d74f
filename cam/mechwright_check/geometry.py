"""Shapes of lines and arcs, paths as chords, and what they cover: all within SAG of the exact curves."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely

from mechwright_check import Refuted

SAG = 0.0003
"""Chords of arcs are so far off at most, mm; it is added to what a limit allows, against the program."""
SHORTEST = 0.002
"""Stretches of a wall that nothing covers are halved down to this length, mm."""
LONGEST = 1.0
"""A stretch of a wall is so long at first, mm."""
MOST = 4_000_000
"""Chords of a program."""


def polygons(rings: Any) -> Any:
    """The region of rings of nodes, mm: outer rings run counter-clockwise, and their holes follow them."""
    found: list[tuple[Any, list[Any]]] = []
    for ring in rings:
        points = _corners(ring)
        if len(points) < 3 or not np.isfinite(points).all():
            raise Refuted("the certificate has a ring that encloses nothing")
        if shapely.is_ccw(shapely.linearrings(points)):
            found.append((points, []))
        elif found:
            found[-1][1].append(points)
        else:
            raise Refuted("the certificate has a hole outside of any outline")
    shape = shapely.MultiPolygon([shapely.Polygon(outer, holes) for outer, holes in found])
    if not shapely.is_valid(shape):
        raise Refuted("the certificate has an outline that crosses itself")
    return shape


def _corners(ring: Any) -> np.ndarray:
    """Corners (n, 2) of a ring of nodes in µm, mm."""
    points, last = [], ring[-1][:2]
    for node in ring:
        if len(node) == 5:
            a, b, c = np.array(last), np.array(node[:2]), np.array(node[2:4])
            points += arc_points(a / 1000, b / 1000, c / 1000, swept(a, b, c, node[4]))[1:].tolist()
        else:
            points.append([node[0] / 1000, node[1] / 1000])
        last = node[:2]
    return np.array(points, dtype=np.float64)


def swept(a: np.ndarray, b: np.ndarray, c: np.ndarray, turn: float) -> float:
    """Angle of an arc from a to b about c, rad; positive counter-clockwise."""
    angle = np.arctan2(*(b - c)[::-1]) - np.arctan2(*(a - c)[::-1])
    return float(angle % (2 * np.pi) if turn > 0 else -(-angle % (2 * np.pi)))


def arc_points(a: np.ndarray, b: np.ndarray, c: np.ndarray, angle: float) -> np.ndarray:
    """Points (n, 2 or 3) along an arc or helix; a small difference of the radii is spread along it."""
    radius, last = np.hypot(*(a - c)[:2]), np.hypot(*(b[:2] - c[:2]))
    step = 2 * np.arccos(max(1 - SAG / max(radius, last, SAG), -1.0))
    share = np.linspace(0, 1, min(int(abs(angle) / step) + 2, MOST))[:, None]
    first = np.arctan2(*(a - c)[1::-1])
    out = a + (b - a) * share
    reach = radius + (last - radius) * share[:, 0]
    out[:, 0] = c[0] + reach * np.cos(first + angle * share[:, 0])
    out[:, 1] = c[1] + reach * np.sin(first + angle * share[:, 0])
    return out


@dataclass(frozen=True)
class Cutter:
    """The outline of a tool: a cone from its tip on, then a cylinder; mm."""

    number: int
    kind: str
    radius: float
    tip: float
    slope: float
    flute_length: float
    raw: dict[str, Any]

    def at(self, height: Any) -> Any:
        """Radius at a height above the tip."""
        return np.minimum(self.radius, self.tip + self.slope * np.maximum(height, 0.0))


@dataclass(frozen=True)
class Chords:
    """Straight pieces of path: ends (n, 3), the move (n,) each belongs to, its tool, and whether it is fed."""

    a: np.ndarray
    b: np.ndarray
    move: np.ndarray
    tool: np.ndarray
    fed: np.ndarray

    @classmethod
    def of(cls, moves: np.ndarray) -> "Chords":
        """The chords of moves as the reader gives them."""
        ends, owner = [], []
        bent = moves[:, 10] != 0
        for place in np.flatnonzero(bent):
            row = moves[place]
            points = arc_points(row[2:5], row[5:8], np.append(row[8:10], 0.0), row[10])
            ends.append(np.hstack((points[:-1], points[1:])))
            owner.append(np.full(len(points) - 1, place))
        straight = np.flatnonzero(~bent)
        ends.append(moves[straight, 2:8])
        owner.append(straight)
        every, of = np.concatenate(ends), np.concatenate(owner)
        order = np.argsort(of, kind="stable")
        every, of = every[order], of[order]
        return cls(every[:, :3], every[:, 3:], of, moves[of, 11].astype(int), moves[of, 1] == 1)

    def __len__(self) -> int:
        return len(self.move)

    def only(self, which: np.ndarray) -> "Chords":
        """Some of them."""
        return Chords(self.a[which], self.b[which], self.move[which], self.tool[which], self.fed[which])

    @property
    def low(self) -> np.ndarray:
        """Their lower ends (n,), mm."""
        return np.minimum(self.a[:, 2], self.b[:, 2])

    def below(self, height: float) -> "Chords":
        """Their parts below a height."""
        some = self.only(self.low < height)
        a, b = some.a.copy(), some.b.copy()
        for one, other in ((a, b), (b, a)):
            over = one[:, 2] > height
            share = (one[over, 2] - height) / (one[over, 2] - other[over, 2])
            one[over] += (other[over] - one[over]) * share[:, None]
        return Chords(a, b, some.move, some.tool, some.fed)

    def distinct(self) -> "Chords":
        """Each piece of path in plan view once, at its lowest: passes repeat at every depth."""
        order = np.lexsort((self.move, self.low))
        table = np.column_stack((self.tool, self.fed, self.a[:, :2] * 1e4, self.b[:, :2] * 1e4))[order]
        kept = np.unique(np.round(table).astype(np.int64), axis=0, return_index=True)[1]
        return self.only(np.sort(order[kept]))

    def lines(self) -> np.ndarray:
        """One line for each, or a point where it goes straight down; rapids may go anywhere in their box."""
        return lines(self.a, self.b)

    def radii(self, tools: dict[int, Cutter], height: float) -> np.ndarray:
        """How wide (n,) each tool is at a height, mm."""
        out = np.zeros(len(self))
        for number in np.unique(self.tool):
            mine = self.tool == number
            out[mine] = tools[number].at(height - self.low[mine])
        return out


def lines(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Lines between places (n, 2 or more); points where both ends are one."""
    found = shapely.linestrings(np.stack((a[:, :2], b[:, :2]), axis=1))
    still = (a[:, :2] == b[:, :2]).all(axis=1)
    found[still] = shapely.points(a[still, :2])
    return found


def uncovered(walls: Any, a: np.ndarray, b: np.ndarray, radii: np.ndarray) -> np.ndarray:
    """Stretches (k, 2, 2) of lines that no capsule about a chord holds as a whole, mm.

    A capsule is convex, so that it holds a stretch if it holds both of its ends.
    """
    parts = shapely.get_parts(shapely.segmentize(walls, LONGEST))
    coords, ring = shapely.get_coordinates(parts, return_index=True)
    joined = ring[1:] == ring[:-1]
    left = np.stack((coords[:-1][joined], coords[1:][joined]), axis=1)
    groups = [(radius, np.flatnonzero(radii == radius)) for radius in np.unique(radii)]
    trees = [(radius, mine, shapely.STRtree(lines(a[mine], b[mine]))) for radius, mine in groups if radius > 0]
    while len(left):
        open_ = np.ones(len(left), dtype=bool)
        for radius, mine, tree in trees:
            places = np.flatnonzero(open_)
            spots = shapely.points(left[places, 0])
            spot, chord = tree.query(spots, predicate="dwithin", distance=radius)
            place, chord = places[spot], mine[chord]
            held = distance(left[place, 1], a[chord, :2], b[chord, :2]) <= radius
            open_[place[held]] = False
        left = left[open_]
        length = np.hypot(*(left[:, 1] - left[:, 0]).T)
        if len(left) == 0 or length.max() < SHORTEST:
            return left
        middle = left.mean(axis=1)
        left = np.concatenate((np.stack((left[:, 0], middle), 1), np.stack((middle, left[:, 1]), 1)))
    return left


def distance(points: np.ndarray, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Distance (n,) of points from segments."""
    along = b - a
    square = np.maximum((along**2).sum(axis=1), 1e-18)
    share = np.clip(((points - a) * along).sum(axis=1) / square, 0.0, 1.0)
    return np.hypot(*(a + along * share[:, None] - points).T)
