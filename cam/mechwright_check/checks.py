"""What a program does to the part: each check raises RefutedError with the line, or adds a note."""

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np
import shapely

from mechwright_check import RefutedError, UnknownError
from mechwright_check.geometry import COARSE, SAG, Chords, Cutter, nearest, uncovered
from mechwright_check.reading import END, FEED, FILE, KIND, LINE, OFF, ROUNDED, RPM, START, STOPS, TOOL, TOP

GOUGE, LEFTOVER, UNEVEN, NEAR = 0.005, 0.010, 0.2, 1e-6
"""Deepest cut into the part, thickest stock on a wall or floor, least height of a rapid's end above stock."""
MILLS, WALLS = {"end-mill"}, {"end-mill", "drill", "reamer"}
HARDER, LASTING = 1.5, 2.0
"""Speeds, feeds and depths may be so many times the library's, depths for no more than so many diameters."""


@dataclass(frozen=True)
class Case:
    """A program with its job: levels and tabs are heights with regions, prisms have a stop besides."""

    moves: np.ndarray
    files: list[str]
    tools: dict[int, Cutter]
    levels: list[tuple[float, float, Any]]
    plate: Any
    hold: dict[str, Any]
    machine: dict[str, Any]
    limits: dict[str, float]
    notes: list[str]

    @cached_property
    def chords(self) -> Chords:
        """All motions."""
        return Chords.of(self.moves)

    @cached_property
    def coarse(self) -> Chords:
        """All motions, for what need not be exact."""
        return Chords.of(self.moves, COARSE)

    @cached_property
    def cuts(self) -> tuple[np.ndarray, Any]:
        """Those of them that cut, by their places, and a tree of their lines."""
        places = np.flatnonzero(self.coarse.fed & (self.coarse.low < 0))
        return places, shapely.STRtree(self.coarse.only(places).lines())

    @cached_property
    def fed(self) -> Chords:
        """The motions of what makes walls and floors."""
        makers = [number for number, tool in self.tools.items() if tool.kind in WALLS]
        return self.chords.only(self.chords.fed & np.isin(self.chords.tool, makers))

    @cached_property
    def mills(self) -> list[Cutter]:
        """The mills that the job has."""
        return [tool for tool in self.tools.values() if tool.kind in MILLS]

    def bad(self, which: np.ndarray, why: str, moves: np.ndarray | None = None) -> None:
        """Refute the program for the first of its moves, or of ``moves``, that a mask marks."""
        found = np.flatnonzero(which) if moves is None else moves[which]
        if found.size:
            row = self.moves[found[0]]
            file = f"{self.files[int(row[FILE])]}: " if len(self.files) > 1 else ""
            x, y, z = row[END]
            raise RefutedError(f"{file}line {row[LINE]:.0f}: {why}, at X{x:.3f} Y{y:.3f} Z{z:.3f}")

    def stock_at(self, points: np.ndarray, level: np.ndarray, before: np.ndarray) -> np.ndarray:
        """Whether (n,) at points above levels something is left by the coarse chords before some."""
        (places, tree), every = self.cuts, self.coarse
        widest = max(tool.radius for tool in self.tools.values())
        left = np.asarray(shapely.contains_xy(self.plate, points[:, 0], points[:, 1]))
        for reach in (0.1 * widest, 0.4 * widest, widest):  # most are cleared by what went close by
            open_ = np.flatnonzero(left)
            spots = shapely.points(points[open_])
            point, cut = tree.query(spots, predicate="dwithin", distance=reach)
            early = places[cut] < before[open_[point]]
            point, chord = open_[point[early]], places[cut][early]
            away, z = nearest(points[point], every.a[chord], every.b[chord])
            height, wide = level[point] + 0.001 - z, np.zeros(point.size)
            for number in np.unique(every.tool[chord]).tolist():
                mine = every.tool[chord] == number
                own = every.tool[before[point[mine]]] == number  # all of it goes where its tip has been
                wide[mine] = self.tools[number].at(np.where(own, TOP, height[mine]))
            left[point[(away <= wide + COARSE) & (height >= 0)]] = False
        return left


def check_all(case: Case) -> None:
    """Every check in turn."""
    for check in (limits, rates, loads, gouge, rapids, leftover, floors, holding):
        check(case)


def limits(case: Case) -> None:
    """Moves fit into the travel of each axis, and as deep as flutes and room below the plate allow."""
    unknown, ends = [], np.concatenate((case.chords.a, case.chords.b))
    ends[ends[:, 2] >= TOP, 2] = np.nan
    for axis, letter in enumerate("XYZ"):
        (low, high), zero, at = case.machine[letter.lower()], case.machine["zero"][axis], ends[:, axis]
        far = np.abs(at - np.nanmedian(at))
        over = (far == np.nanmax(far)) & (np.nanmax(at) - np.nanmin(at) > high - low)
        if zero is None or letter == "Z":  # where Z stands depends on the lengths of tools
            unknown.append(letter)
        else:
            over |= (at + zero < low - NEAR) | (at + zero > high + NEAR)
        case.bad(over, f"leaves the travel of {letter}", np.tile(case.chords.move, 2))
    case.notes.append(f"where the work offset stands in the travel of {', '.join(unknown)} is not known")
    low = np.minimum(case.moves[:, 4], case.moves[:, 7])
    for number, tool in case.tools.items():
        mine, point = case.moves[:, TOOL] == number, (tool.radius - tool.tip) / (tool.slope or 1.0)
        lowest, out = case.limits["lowest"] - 1.0 - point, tool.raw["stick_out"]
        case.bad(mine & (low < lowest - NEAR), f"T{number} goes far below the plate")
        case.bad(mine & (-low > tool.flutes + NEAR), f"T{number} goes deeper than its flutes")
        if out is not None and (mine & (low + out / 1000 < 0)).any():
            raise UnknownError(f"the holder of T{number} goes below the top of the plate")


def rates(case: Case) -> None:
    """Speeds and feeds are those that machine and edges bear; drills cut straight down only."""
    moves, (slow, fast) = case.moves, case.machine["spindle"]
    feed, rpm = moves[:, FEED], moves[:, RPM]
    cut = (moves[:, KIND] == 1) & (np.minimum(moves[:, 4], moves[:, 7]) < -NEAR)
    aside = (moves[:, END] != moves[:, START])[:, :2].any(axis=1)
    case.bad(feed > case.machine["max_feed"] + 0.1, "feeds faster than the machine")
    case.bad(cut & (rpm < 0), "cuts with the spindle turning backwards")
    case.bad(cut & ((rpm < slow) | (rpm > fast)), "cuts at a speed that the spindle has not")
    for number, tool in case.tools.items():
        mine, speed = cut & (moves[:, TOOL] == number), tool.raw["speed"]
        case.bad(
            mine & aside & (tool.kind not in MILLS), f"moves T{number}, a {tool.kind}, sideways in the plate"
        )
        if speed is not None:
            most = max(HARDER * 1000 * speed / (2 * np.pi * tool.radius), slow) + 1
            rubs = feed < min(0.002, 0.1 * tool.raw["chip"] / 1000) * rpm * tool.raw["flutes"]
            case.bad(mine & (rpm > most), f"turns T{number} much faster than its edges bear")
            case.bad(mine & rubs & (tool.kind not in MILLS), f"T{number} rubs instead of cutting")


def loads(case: Case) -> None:
    """Where stock is left on the line of their axis, mills go as deep, fast and steep as edges bear."""
    every = case.coarse
    flat, drop = np.hypot(*(every.b - every.a)[:, :2].T), (every.a - every.b)[:, 2]
    turned = case.moves[every.move, FEED] / (np.abs(case.moves[every.move, RPM]) + 1e-9)
    for number, tool in case.tools.items():
        data, mine = tool.raw, np.flatnonzero(every.fed & (every.tool == number) & (every.low < -NEAR))
        if data["speed"] is None or mine.size == 0:
            continue
        mill, low, chip = tool.kind in MILLS, every.low[mine], data["chip"] / 1000 * data["flutes"]
        steep = drop[mine] > flat[mine] * np.tan(np.radians(data["ramp"])) + 0.003
        steep &= mill & ~(data["centre_cutting"] & (turned[mine] <= HARDER * chip * data["plunge"] + 0.001))
        deep = low + HARDER * data["step_down"] * 2 * tool.radius
        for which, level, least, why in (
            (turned[mine] > HARDER * chip + 0.001, low, 0.0, "is fed much faster than its edges bear"),
            (steep, low, 0.0, "goes down more steeply or faster than it can"),
            ((deep < -NEAR) & mill, deep, LASTING * 2 * tool.radius, "takes more in depth than it bears"),
        ):
            some = mine[which]
            met = case.stock_at(every.b[some, :2], level[which], some)
            group = np.cumsum(~met)  # stretches of path, each behind a place where nothing is left
            length = np.bincount(group, (flat + np.abs(drop))[some] * met, 1)[group]
            case.bad(met & (length > least), f"T{number} {why}", every.move[some])


def gouge(case: Case) -> None:
    """No tool comes deeper than GOUGE into the part or a tab, nor into a clamp or jaw once that is set."""
    solid = [(top, shape, "the part") for top, _, shape in case.levels]
    for top, shape, what in solid + [(top, shape, "a tab") for top, shape in case.hold["tabs"]]:
        _meet(case, case.chords, shape, top, GOUGE, what)
    stops = case.moves[case.chords.move, STOPS]
    for top, shape, stop in case.hold["prisms"]:
        since = stops >= (stop if (stops >= stop).any() else 0)  # one that no stop sets is there before
        _meet(case, case.chords.only(since), shape, top, 0.0, "a clamp or jaw")


def _meet(case: Case, chords: Chords, shape: Any, top: float, limit: float, what: str) -> None:
    """Refute the program if a tool comes into a prism below a height, deeper than a limit."""
    some = chords.below(top - limit)
    if shapely.is_empty(shape) or len(some.move) == 0:
        return
    off, reach = np.nan_to_num(case.moves[some.move, OFF]) * some.fed, some.radii(case.tools, top - limit)
    room = reach - limit + off + SAG
    shapely.prepare(shape)
    met = np.flatnonzero((room > 0) & shapely.dwithin(shape, some.lines(), room))
    if met.size:
        gap = shapely.distance(shape, some.only(met).lines())
        depth = np.minimum(reach[met] - gap + off[met], top - some.low[met])
        count, least = len(np.unique(case.moves[some.move[met], LINE])), "at least " * bool(gap.min() == 0)
        why = f"goes {least}{depth.max():.3f} mm into {what} ({count} lines do)"
        case.bad(depth == depth.max(), why, some.move[met])


def rapids(case: Case) -> None:
    """Rapids go above the stock, or where earlier cuts have left nothing."""
    every, free = case.chords, set[Any]()
    places = np.flatnonzero(every.fed & (every.low < 0))
    tree = shapely.STRtree(every.only(places).lines())
    clear, aside = case.limits.get("clearance", UNEVEN), (every.a[:, :2] != every.b[:, :2]).any(axis=1)
    low = ~every.fed & aside & (every.low < clear - ROUNDED) & shapely.intersects(case.plate, every.lines())
    case.bad(low, f"a rapid over the plate below Z{clear:g}", every.move)
    rising = (every.a[:, :2] == every.b[:, :2]).all(axis=1) & (every.b[:, 2] > every.a[:, 2])
    for place in np.flatnonzero(~every.fed & (every.low < UNEVEN - NEAR) & ~rising).tolist():
        number, low = int(every.tool[place]), float(every.low[place])
        tool, a, b = case.tools[number], every.a[place, :2], every.b[place, :2]
        if (key := (number, round(low, 4), *a.tolist(), *b.tolist())) in free:
            continue  # what is free stays so
        way = every.only(np.array([place])).lines()[0]
        if (a != b).all():  # the axes may arrive one after the other
            way = shapely.box(*np.minimum(a, b), *np.maximum(a, b))
        level, wide = min(low, -UNEVEN / 10), float(tool.at(max(-low, 0.0)))
        body = shapely.intersection(way.buffer(wide - 0.01), case.plate)
        early = places[np.sort(tree.query(body.buffer(max(one.radius for one in case.tools.values()))))]
        some = every.only(early[early < place]).below(level + 0.001)
        radii = np.where(some.tool == number, tool.radius, some.radii(case.tools, level))
        body = body.difference(shapely.union_all(shapely.buffer(some.lines(), radii, quad_segs=64)))
        why = f"a rapid goes into stock, or ends less than {UNEVEN} mm above it"
        case.bad(np.array([not body.buffer(-0.01).is_empty]), why, every.move[[place]])
        free.add(key)


def leftover(case: Case) -> None:
    """Each wall is cut along its whole length, where the finest mill that cuts through can enter."""
    deep = [tool.radius for tool in case.mills if tool.flutes + NEAR >= -case.limits["lowest"]]
    if case.mills and not deep:
        raise UnknownError("no mill of the program cuts through the plate")
    radius, widest = min(deep, default=0.0) + case.limits["play"], max(deep, default=0.0)
    fine: dict[str, Any] = {"quad_segs": int(np.pi / 4 / np.arccos(1 - SAG / (radius + 1))) + 1}
    inner, near, done = case.plate.buffer(-LEFTOVER, join_style="mitre"), LEFTOVER - 3 * SAG, list[Any]()
    for top, bottom, shape in reversed(case.levels):
        tabs = [tab for height, tab in case.hold["tabs"] if height + case.limits["tab_slack"] >= top - NEAR]
        if shapely.is_empty(shape) or any(shape is other for other in done):
            continue  # what is cut to a wall further down is so here as well
        done += [] if tabs else [shape]
        holes = [shapely.Polygon(ring) for part in shapely.get_parts(shape) for ring in part.interiors]
        bores = [hole.buffer(-near) for hole in holes if _is_round(hole)]
        closed = shape.buffer(radius, **fine)
        walls = shapely.union_all(shapely.boundary([closed.buffer(near - radius, **fine), *bores]))
        lifted = shapely.union_all([tab.buffer(2 * widest) for tab in tabs])
        walls = shapely.difference(shapely.intersection(walls, inner), lifted)
        cut = case.fed.below(bottom + SAG)
        left = uncovered(walls, cut, cut.radii(case.tools, bottom + SAG))
        if len(left):
            x, y = left[0].mean(axis=0)
            raise RefutedError(
                f"more than {LEFTOVER} mm are left on a wall at X{x:.3f} Y{y:.3f} Z{bottom:.3f}"
            )
        rest = shapely.area(shapely.difference(closed.buffer(-radius, **fine), shape))
        case.notes.extend(
            [f"{rest:.2f} mm² at Z{bottom:.3f} are out of reach of the mills"] * bool(rest > 0.1)
        )


def _is_round(hole: Any) -> bool:
    points = shapely.get_coordinates(hole)
    return len(points) > 12 and float(np.ptp(np.hypot(*(points - points[:-1].mean(axis=0)).T))) < 2 * SAG


def floors(case: Case) -> None:
    """Each floor is cut all over, where the finest mill can enter."""
    least = min([tool.radius for tool in case.mills], default=0.0) + case.limits["play"]
    for (_, bottom, above), (_, _, below) in pairwise(case.levels):
        floor = shapely.intersection(shapely.difference(below, above), case.plate)
        if above is not below and not shapely.is_empty(floor):
            corners = above.buffer(least, quad_segs=64).buffer(LEFTOVER - least, quad_segs=64)
            cut = case.fed.below(bottom + LEFTOVER)
            gone = shapely.buffer(cut.lines(), cut.radii(case.tools, bottom + LEFTOVER) + SAG, quad_segs=64)
            gone = shapely.union_all(gone[shapely.intersects(floor, gone)])
            left = shapely.difference(shapely.difference(floor, corners), gone).buffer(-LEFTOVER / 2)
            if not shapely.is_empty(left):
                x, y = left.representative_point().coords[0]
                raise RefutedError(f"the floor is not cut at X{x:.3f} Y{y:.3f} Z{bottom:.3f}")


def holding(case: Case) -> None:
    """Each piece of the part that is cut free of the plate is held by two tabs that reach the frame."""
    bottom, rim = case.levels[-1][1], shapely.boundary(case.plate).buffer(0.05)
    low = case.coarse.only(case.coarse.fed).below(bottom + SAG)
    gone = shapely.buffer(low.lines(), low.radii(case.tools, bottom + SAG), quad_segs=8)
    for piece in shapely.get_parts(case.levels[-1][2]) if case.hold["method"] == "tabs" else ():
        outer = shapely.Polygon(piece.exterior)
        free = shapely.union_all(gone[shapely.dwithin(shapely.boundary(outer), gone, 0.1)])
        frame = shapely.get_parts(shapely.difference(case.plate, shapely.union(free, outer)))
        frame = frame[shapely.intersects(frame, rim)]
        tabs = [tab for _, tab in case.hold["tabs"] if shapely.intersects(tab, piece)]
        held = sum(bool(shapely.intersects(tab, frame).any()) for tab in tabs)
        if held < 2 and shapely.intersects(free, shapely.boundary(outer.buffer(0.1))):
            raise RefutedError(f"a piece of the part is held by {held} tabs that reach the frame; 2 at least")
