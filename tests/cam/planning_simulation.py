"""A crude, independent simulation of neutral programs for the planning tests.

It knows nothing of how paths are made: it samples every move and measures distances to the finished part.
"""

import itertools
import math
from dataclasses import dataclass

import numpy as np
import shapely

from mechwright.contracts.part import Bore, Pocket, Profile
from mechwright_cam.program.moves import Drill, Feed, FeedArc, Pause, Program, Rapid
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.tool import Tool, ToolKind

CHAIN = 100
"""Points of a chain of moves from which on another one is begun."""


@dataclass(frozen=True, eq=False)
class Motion:
    tool: Tool
    operation: str
    kind: str  # rapid, feed, arc, drill
    points: np.ndarray  # (n, 3)
    feed: float


def motions(program: Program, step: float = 0.1) -> list[Motion]:
    """Every move as points at most ``step`` apart on arcs (lines: their two ends)."""
    out = []
    for section in program.sections:
        first = section.operations[0].moves[0]
        if isinstance(first, Pause):
            first = section.operations[0].moves[1]
        assert isinstance(first, Rapid), "a section starts with a rapid"
        assert first.x is not None
        assert first.y is not None
        assert first.z is None
        x, y, z = first.x, first.y, program.clearance
        for operation in section.operations:
            for move in operation.moves:
                if isinstance(move, Pause):
                    assert z >= program.clearance, "the machine stops high"
                    continue
                if isinstance(move, Drill):
                    way = np.array([[x, y, z], [move.x, move.y, z]])
                    out.append(Motion(section.tool, operation.name, "rapid", way, 0.0))
                    x, y = move.x, move.y
                    points = np.array([[x, y, z], [x, y, move.bottom], [x, y, z]])
                    out.append(Motion(section.tool, operation.name, "drill", points, move.feed))
                    continue
                nx = x if move.x is None else move.x
                ny = y if move.y is None else move.y
                nz = z if move.z is None else move.z
                kind, feed = "rapid", 0.0
                points = np.array([[x, y, z], [nx, ny, nz]])
                if isinstance(move, Feed):
                    assert not np.array_equal(points[0], points[1]), f"{move} goes nowhere"
                if isinstance(move, Feed):
                    kind, feed = "feed", move.feed
                if isinstance(move, FeedArc):
                    kind, feed = "arc", move.feed
                    points = _arc(x, y, z, nx, ny, nz, move, step)
                out.append(Motion(section.tool, operation.name, kind, points, feed))
                x, y, z = nx, ny, nz
        assert z >= program.clearance, "a section ends high"
    return out


def _arc(x, y, z, nx, ny, nz, move, step):
    cx, cy = x + move.i, y + move.j
    radius, end_radius = math.hypot(move.i, move.j), math.hypot(nx - cx, ny - cy)
    assert abs(radius - end_radius) < 0.002, f"arc radii {radius} and {end_radius}"
    assert radius > 1e-3
    a, b = math.atan2(y - cy, x - cx), math.atan2(ny - cy, nx - cx)
    sweep = (b - a) % math.tau if move.ccw else -((a - b) % math.tau)
    if (nx, ny) == (x, y):
        sweep = math.tau if move.ccw else -math.tau
    count = max(2, math.ceil(abs(sweep) * radius / step), math.ceil(abs(sweep) / 0.1))
    t = np.linspace(0, 1, count + 1)
    points = np.column_stack(
        (cx + radius * np.cos(a + sweep * t), cy + radius * np.sin(a + sweep * t), z + (nz - z) * t)
    )
    points[-1] = (nx, ny, nz)
    return points


def keep_at(job: Job, z: float) -> shapely.Geometry:
    """What must stand at height z (tabs included below their tops)."""
    keep = job.target
    for feature in job.features:
        depth = feature.top + feature.depth
        if depth < job.thickness - 1e-9 and -depth < z < -feature.top:
            keep = keep.difference(_plan(feature))
    low = [tab.shape for tab in job.tabs if z < tab.top - 1e-6]
    return shapely.union_all([keep, *low])


def _plan(feature):
    if isinstance(feature, Bore):
        return shapely.Point(feature.centre).buffer(feature.diameter / 2, quad_segs=200)
    if isinstance(feature, Profile):
        return shapely.Polygon(feature.loop.flatten())
    assert isinstance(feature, Pocket)
    return shapely.Polygon(feature.boundary.flatten(), [loop.flatten() for loop in feature.islands])


def gouge(job: Job, program: Program) -> float:
    """The deepest entry of a cutter into the part or its tabs, mm."""
    worst = -math.inf
    found = motions(program)
    heights = sorted(
        {0.0, -job.thickness, *(tab.top for tab in job.tabs)} | {-(f.top + f.depth) for f in job.features},
        reverse=True,
    )
    for top, bottom in itertools.pairwise(heights):
        keep = keep_at(job, (top + bottom) / 2)
        shapely.prepare(keep)
        for number in {motion.tool.number for motion in found}:
            group = [m for m in found if m.tool.number == number and m.kind != "rapid"]
            tool = group[0].tool
            lines = np.array(
                [shapely.linestrings(m.points[:, :2]) for m in group if m.points[:, 2].min() < top - 1e-6]
            )
            if not lines.size:
                continue
            radius = tool.radius
            if tool.kind is ToolKind.SPOT_DRILL:  # its cone is only this wide at the top
                depth = -min(m.points[:, 2].min() for m in group)
                radius = min(radius, depth * math.tan(math.radians(tool.point_angle / 2)))
            near = lines[shapely.dwithin(keep, lines, radius + 0.01)]
            if near.size:
                worst = max(worst, float((radius - shapely.distance(near, keep)).max()))
    return worst


def leftover(job: Job, program: Program, thickness: float = 0.010) -> float:
    """Area, mm², of reachable stock thicker than ``thickness`` beside the part's walls."""
    found = [m for m in motions(program, 0.05) if m.kind != "rapid"]
    mills = {m.tool.number: m.tool for m in found if m.tool.kind is ToolKind.END_MILL}
    if not mills:
        return 0.0
    finest = min(tool.radius for tool in mills.values())
    widest = max(tool.diameter for tool in mills.values())
    area = 0.0
    heights = sorted(
        {0.0, -job.thickness, *(tab.top for tab in job.tabs)} | {-(f.top + f.depth) for f in job.features},
        reverse=True,
    )
    for top, bottom in itertools.pairwise(heights):
        keep = keep_at(job, (top + bottom) / 2)
        left = keep.buffer(finest + 0.003, quad_segs=96).buffer(-finest - 0.003, quad_segs=96)
        band = job.target.buffer(2 * finest, quad_segs=64).intersection(shapely.box(*job.stock))
        todo = band.difference(left)
        # What stays beside a tab goes with the tab.
        low = [tab.shape.buffer(widest) for tab in job.tabs if tab.top > bottom + 1e-6]
        todo = todo.difference(shapely.union_all(low)) if low else todo
        for tool in {m.tool.number: m.tool for m in found}.values():
            ways = np.array(_ways([m for m in found if m.tool.number == tool.number], bottom), dtype=object)
            shapely.prepare(todo)
            near = ways[shapely.dwithin(todo, ways, tool.radius + 1e-3)]
            # Chords lie within the circle: what they leave too much is far thinner than what counts.
            todo = todo.difference(shapely.union_all(shapely.buffer(near, tool.radius + 1e-4, quad_segs=32)))
        area += todo.buffer(-thickness / 2, quad_segs=4).area
    return area


def _ways(found: list[Motion], bottom: float) -> list[shapely.Geometry]:
    """Where the middle of one tool goes at a height or below: points of drills, and moves in chains.

    A chain is buffered far sooner than its moves, each with two round ends; a long one no longer is.
    """
    ways: list[shapely.Geometry] = []
    chain: list[np.ndarray] = []
    for motion in found:
        if motion.kind == "drill":
            cone = motion.tool.radius / math.tan(math.radians(motion.tool.point_angle / 2))
            if motion.points[1, 2] + cone <= bottom:
                ways.append(shapely.Point(motion.points[1, :2]))
        elif (motion.points[:, 2] <= bottom + 2e-4).all():
            points = motion.points[:, :2]
            if chain and (sum(map(len, chain)) > CHAIN or not np.array_equal(chain[-1][-1], points[0])):
                ways.append(shapely.LineString(np.concatenate(chain)))
                chain = []
            chain.append(points)
    return [*ways, *([shapely.LineString(np.concatenate(chain))] if chain else [])]


def check_rules(job: Job, program: Program) -> None:
    """Rapids, ramps, plunges and cutting depth."""
    stock = shapely.box(*job.stock)
    slope = math.tan(math.radians(job.settings.ramp_angle))
    every = motions(program)
    fastest: dict[int, float] = {}
    for motion in every:
        fastest[motion.tool.number] = max(fastest.get(motion.tool.number, 0.0), motion.feed)
    low = np.array([m.points.min(axis=0) for m in every])
    high = np.array([m.points.max(axis=0) for m in every])
    plunges = []
    for number, motion in enumerate(every):
        start, end = motion.points[0], motion.points[-1]
        moved = bool((high[number, :2] > low[number, :2]).any())
        if motion.kind == "rapid":
            assert not moved or start[2] >= program.clearance, "a rapid in XY below clearance"
            assert not moved or end[2] == start[2]
            assert end[2] > start[2] or moved or end[2] > 0, "a rapid down into the stock"
        elif motion.kind in {"feed", "arc"}:
            assert motion.feed > 0
            assert end[2] >= job.floor - 6e-5
            if moved:
                way = np.hypot(*np.diff(motion.points[:, :2], axis=0).T).sum()
                assert start[2] - end[2] <= slope * way * 1.0005 + 1.1e-4, "a ramp is too steep"
            elif end[2] < min(start[2], 0):
                planned = motion.tool.centre_cutting and motion.feed <= 0.31 * fastest[motion.tool.number]
                if not planned:
                    plunges.append(number)
    for number in plunges[:: 1 + len(plunges) // 60]:  # a sample is enough
        _check_plunge(every, number, low, high, stock)


def _check_plunge(every, number, low, high, stock) -> None:
    motion = every[number]
    x, y, z = motion.points[-1]
    disc = shapely.Point(x, y).buffer(motion.tool.radius - 0.03).intersection(stock)
    swept = []
    reach = motion.tool.radius + np.array([m.tool.radius for m in every[:number]])
    near = (low[:number, :2] <= np.array((x, y)) + reach[:, None]).all(axis=1)
    near &= (high[:number, :2] >= np.array((x, y)) - reach[:, None]).all(axis=1)
    for i in np.flatnonzero(near & (low[:number, 2] <= z + 2e-4)).tolist():
        old = every[i]
        if old.kind == "drill":
            swept.append(shapely.Point(old.points[1, :2]).buffer(old.tool.radius))
        elif high[i, 2] <= z + 2e-4:
            swept.append(shapely.LineString(old.points[:, :2]).buffer(old.tool.radius + 0.005))
    rest = disc.difference(shapely.union_all(swept))
    assert rest.area < 0.03 * disc.area + 1e-6, (
        f"{motion.operation}: plunge into {rest.area:.3f} mm² of stock at {x:.3f} {y:.3f} {z:.3f}"
    )
