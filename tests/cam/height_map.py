"""A brute-force milling simulator that shares nothing with the project's interpreter, planner or proof.

It reads posted text with a reader of its own, stamps the cutter along every move into a height map, and notes
for every stamp how much stock it met: in area beside the feed, in degrees of the cutter, and in depth.
"""

import math
import re
from dataclasses import dataclass, field

import numpy as np
import shapely
from numba import njit

WORD = re.compile(r"([A-Z])([-+]?[0-9.]+)")
HOME = 1e3


@dataclass(frozen=True)
class Cutter:
    radius: float
    cone: float = math.inf
    """Height gained per mm of radius from the tip; inf for a flat end."""
    nose: float = 0.0
    """Radius of a rounded corner."""


@dataclass(frozen=True)
class Move:
    line: int
    kind: str
    """rapid, feed or drill."""
    tool: int
    operation: str
    points: np.ndarray
    """(n, 3), mm."""
    feed: float
    rpm: float
    turn: int


def read(text):
    """The moves of a program; drilling cycles as one move down and one up."""
    moves, where, motion, tool, feed, rpm, operation = [], [math.nan] * 3, 0, 0, 0.0, 0.0, ""
    clearance, absolute = HOME, True
    for number, line in enumerate(text.splitlines(), 1):
        if match := re.match(r"\(operation: (.*)\)", line):
            operation = match[1]
        words = WORD.findall(re.sub(r"\(.*?\)", "", line))
        codes = [float(value) for letter, value in words if letter == "G"]
        args = {letter: float(value) for letter, value in words if letter not in "GM"}
        tool, feed, rpm = int(args.get("T", tool)), args.get("F", feed), args.get("S", rpm)
        absolute = (absolute or 90 in codes) and 91 not in codes
        assert absolute, "only absolute programs are read"
        for code in codes:
            if code in (0, 1, 2, 3, 81, 82, 83, 73):
                motion = int(code)
            if code == 80:
                motion = 0
        if 53 in codes:
            where[2] = HOME
            continue
        if not {"X", "Y", "Z"} & set(args):
            continue
        end = [args.get(axis, old) for axis, old in zip("XYZ", where, strict=True)]
        if motion in (81, 82, 83, 73):
            x, y, clearance = end[0], end[1], where[2]
            points = [[x, y, clearance], [x, y, args["R"]], [x, y, args["Z"]]]
            moves.append(Move(number, "drill", tool, operation, np.array(points), feed, rpm, 0))
            where = [x, y, clearance]
            continue
        if motion in (2, 3):
            points = _arc(where, end, args.get("I", 0.0), args.get("J", 0.0), motion == 3)
        else:
            points = np.array([where, end])
        kind = "rapid" if motion == 0 else "feed"
        turn = {2: -1, 3: 1}.get(motion, 0)
        moves.append(Move(number, kind, tool, operation, points, feed, rpm, turn))
        where = end
    return moves


def _arc(start, end, i, j, ccw):
    cx, cy = start[0] + i, start[1] + j
    radius = math.hypot(i, j)
    assert abs(radius - math.hypot(end[0] - cx, end[1] - cy)) < 0.002
    a, b = math.atan2(-j, -i), math.atan2(end[1] - cy, end[0] - cx)
    sweep = (b - a) % math.tau if ccw else -((a - b) % math.tau)
    if math.dist(start[:2], end[:2]) < 1e-9:
        sweep = math.tau if ccw else -math.tau
    t = np.linspace(0, 1, max(2, math.ceil(abs(sweep) * math.sqrt(max(radius, 0.1) / 0.002))) + 1)
    x, y = cx + radius * np.cos(a + sweep * t), cy + radius * np.sin(a + sweep * t)
    points = np.column_stack((x, y, start[2] + (end[2] - start[2]) * t))
    points[-1] = end
    return points


@dataclass
class Simulation:
    """A plate of height 0 to -thickness on a square grid, cut by moves.

    ``met`` collects for every stamp: index of the move, tool, x, y, z, distance since the last stamp, area cut
    in mm² (volume over distance), angle in degrees of the engagement ahead, mean depth in mm, and whether the
    cutter only went down.
    """

    stock: tuple
    thickness: float
    pitch: float = 0.1
    under: object = None
    """Function of x and y to the height below which earlier setups have left nothing; None: the underside."""
    met: list = field(default_factory=list)
    complaints: list = field(default_factory=list)

    def __post_init__(self):
        x0, y0, x1, y1 = self.stock
        self.pad = 16.0
        self.x = np.arange(x0 - self.pad, x1 + self.pad, self.pitch) + self.pitch / 2
        self.y = np.arange(y0 - self.pad, y1 + self.pad, self.pitch) + self.pitch / 2
        inside = ((self.y > y0) & (self.y < y1))[:, None] & ((self.x > x0) & (self.x < x1))[None, :]
        self.bottom = -self.thickness - 50.0
        self.height = np.where(inside, 0.0, self.bottom)
        self.lowest = np.full(inside.shape, -self.thickness)
        if self.under is not None:
            self.lowest = np.maximum(self.lowest, self.under(*np.meshgrid(self.x, self.y)))
        self.solid = inside & (self.lowest < -1e-9)
        self.height = np.where(self.solid, 0.0, self.bottom)

    def run(self, moves, cutters):
        for index, move in enumerate(moves):
            if np.isnan(move.points).any():
                continue
            self._move(index, move, cutters[move.tool])

    def _move(self, index, move, cutter):
        step = max(self.pitch, cutter.radius / 8)
        for a, b in zip(move.points[:-1], move.points[1:], strict=True):
            if min(a[2], b[2]) > self.pitch:
                continue
            way = math.dist(a, b)
            count = max(1, math.ceil(way / step))
            for t in np.arange(1, count + 1) / count:
                self._stamp(index, move, cutter, a + (b - a) * t, (b - a) / max(way, 1e-12), way / count)

    def _stamp(self, index, move, cutter, place, direction, way):
        heading = math.atan2(direction[1], direction[0])
        flat = math.hypot(direction[0], direction[1]) > 1e-6
        shape = (cutter.radius, cutter.cone, cutter.nose)
        at = tuple(place.tolist())
        drop, cells, angle = _cut(
            self.height, self.lowest, self.x, self.y, self.pitch, at, shape, heading, flat
        )
        if not cells:
            return
        volume = drop * self.pitch**2
        if move.kind == "rapid" and volume > 0:
            self.complaints.append(f"line {move.line}: rapid into {volume:.3f} mm³ at {place}")
        self.met.append((index, move.tool, *place, way, volume / way, angle, drop / cells, not flat))

    def table(self):
        return np.array(self.met, dtype=float)

    def stands(self, z):
        """Cells of the plate whose material still stands at height z."""
        return self.solid & (self.height > z) & (self.height > self.lowest + 1e-4)

    def gouge(self, keep, z):
        """Greatest depth inside ``keep`` of a cell centre that no longer stands at z, mm."""
        yy, xx = np.nonzero(self.solid & ~self.stands(z))
        points = shapely.points(self.x[xx], self.y[yy])
        shapely.prepare(keep)
        inside = points[shapely.contains_xy(keep, self.x[xx], self.y[yy])]
        return float(shapely.distance(shapely.boundary(keep), inside).max()) if inside.size else 0.0

    def left(self, region, z):
        """Points (n, 2) in ``region`` that still stand at z."""
        yy, xx = np.nonzero(self.stands(z))
        shapely.prepare(region)
        inside = shapely.contains_xy(region, self.x[xx], self.y[yy])
        return np.column_stack((self.x[xx], self.y[yy]))[inside]


@njit(cache=True, error_model="numpy")
def _end(square, shape):
    """Height of a cutter's end above its tip, at a squared distance from the axis."""
    radius, cone, nose = shape
    if math.isfinite(cone):
        return math.sqrt(square) * cone
    if nose == 0:
        return 0.0
    out = min(max(math.sqrt(square) - radius + nose, 0.0), nose)
    return nose - math.sqrt(nose**2 - out**2)


@njit(cache=True, error_model="numpy")
def _cut(height, lowest, x, y, pitch, place, shape, heading, flat):
    """Lower the cells under a cutter: the sum of their drops, their number, and the engagement ahead, degrees."""
    r = shape[0]
    i0, i1 = np.searchsorted(x, place[0] - r), np.searchsorted(x, place[0] + r)
    j0, j1 = np.searchsorted(y, place[1] - r), np.searchsorted(y, place[1] + r)
    drop, cells, angle = 0.0, 0, 0.0
    for lower in (False, True):  # what is engaged is counted before anything is cut
        if lower and not cells:
            break
        if lower and flat:
            for degrees in range(-90, 91, 3):
                a = heading + math.radians(degrees)
                i = int((place[0] + (r - 0.3 * pitch) * math.cos(a) - x[0]) / pitch + 0.5)
                j = int((place[1] + (r - 0.3 * pitch) * math.sin(a) - y[0]) / pitch + 0.5)
                if height[j, i] > max(place[2], lowest[j, i]) + 0.01:
                    angle += 3.0
        for j in range(j0, j1):
            for i in range(i0, i1):
                square = (x[i] - place[0]) ** 2 + (y[j] - place[1]) ** 2
                if square > r * r:
                    continue
                level = place[2] + _end(square, shape)
                stands, least = height[j, i], lowest[j, i]
                if stands <= level + 1e-4 or stands <= least + 1e-4:
                    continue
                if lower:
                    height[j, i] = level
                    continue
                cells += 1
                drop += stands - max(level, least)
    return drop, cells, angle


def cutters(job):
    found = {}
    for tool in job.tools:
        cone = math.inf
        if tool.kind not in ("end-mill", "bull-nose", "ball"):
            cone = 1 / math.tan(math.radians(tool.point_angle) / 2)
        nose = tool.radius if tool.kind == "ball" else tool.corner_radius
        found[tool.number] = Cutter(tool.radius, cone, nose)
    return found
