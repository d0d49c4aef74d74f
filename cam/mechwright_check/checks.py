"""What a program does to the part: each check raises Refuted with the line, or returns a note."""

from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
import shapely

from mechwright_check import Refuted, Unknown, at
from mechwright_check.geometry import SAG, Chords, Cutter, lines, uncovered

GOUGE, LEFTOVER = 0.005, 0.010
"""Deepest cut into the part, and thickest stock on a wall or floor, mm."""
ROUNDED = 0.0026
"""The last decimal of an inch: heights are rounded down by it, mm."""
UNEVEN = 0.2
"""A rapid ends so high above stock that is not cut, mm."""
MILLS = {"end-mill"}
WALLS = {"end-mill", "drill", "reamer"}
HARDER, THIN = 1.5, 3.0
"""Speeds and feeds of drills may be so many times those of the tool library, feeds of mills so many times."""


@dataclass(frozen=True)
class Case:
    """A program with its job, mm."""

    moves: np.ndarray
    files: list[str]
    tools: dict[int, Cutter]
    levels: list[tuple[float, float, Any]]
    stock: tuple[float, float, float, float]
    hold: dict[str, Any]
    machine: dict[str, Any]
    limits: dict[str, float]
    notes: list[str] = field(default_factory=list)

    @cached_property
    def chords(self) -> Chords:
        """All motions."""
        return Chords.of(self.moves)

    @cached_property
    def plate(self) -> Any:
        """The stock in plan view."""
        return shapely.box(*self.stock)

    @cached_property
    def cuts(self) -> tuple[np.ndarray, Any]:
        """The chords that cut, and a tree of their lines."""
        cut = np.flatnonzero(self.chords.fed & (self.chords.low < 0))
        return cut, shapely.STRtree(self.chords.only(cut).lines())

    def left(self, place: int, radius: float, level: float) -> bool:
        """Whether earlier cuts have left stock above a level where a chord goes with a cylinder."""
        a, b = self.chords.a[place, :2], self.chords.b[place, :2]
        way = lines(a[None], b[None])[0]
        if not self.chords.fed[place] and (a != b).all():  # the axes of a rapid may arrive one after the other
            way = shapely.box(*np.minimum(a, b), *np.maximum(a, b))
        body = shapely.intersection(way.buffer(radius - 0.01), self.plate)
        if body.is_empty:
            return False
        cut, tree = self.cuts
        before = cut[np.sort(tree.query(body, predicate="dwithin", distance=self.widest))]
        some = self.chords.only(before[before < place]).below(level + 0.001).distinct()
        own = some.tool == self.chords.tool[place]
        wide = np.where(own, some.radii(self.tools, 1000.0), some.radii(self.tools, level))
        gone = shapely.union_all(shapely.buffer(some.lines(), wide, quad_segs=64))
        return not body.difference(gone).buffer(-0.01).is_empty

    @cached_property
    def widest(self) -> float:
        """Radius of the widest tool, mm."""
        return max(tool.radius for tool in self.tools.values())

    @property
    def thickness(self) -> float:
        """Of the part, mm."""
        return -self.levels[-1][1]

    def wrong(self, move: int, why: str) -> None:
        """Refute the program for one of its moves."""
        row = self.moves[move]
        place = " ".join(f"{axis}{value:.3f}" for axis, value in zip("XYZ", row[5:8], strict=True))
        raise Refuted(at(int(row[0]), self.files[int(row[15])]) + f"{why}, at {place}")


def check_all(case: Case) -> list[str]:
    """Every check in turn; notes on what no program shows."""
    for check in (limits, rates, gouge, tabs, prisms, leftover, floors, rapids, holding):
        check(case)
    return case.notes


def limits(case: Case) -> None:
    """Moves fit into the travel of each axis, flutes are long enough, and nothing goes far below the plate."""
    moves, chords, machine = case.moves, case.chords, case.machine
    ends = np.concatenate((chords.a, chords.b))
    owner = np.concatenate((chords.move, chords.move))
    ends[ends[:, 2] >= 1000.0, 2] = np.nan
    unknown: list[str] = []
    for axis, letter in enumerate("xyz"):
        low, high = machine[letter]
        span = np.nanmax(ends[:, axis]) - np.nanmin(ends[:, axis])
        if span > high - low and span > machine["travel"][axis]:
            far = int(np.nanargmax(np.abs(ends[:, axis] - np.nanmedian(ends[:, axis]))))
            case.wrong(owner[far], f"the moves span {span:.1f} mm in {letter.upper()}")
        zero, length = machine["zero"][axis], 0.0
        if zero is None or letter not in machine["known"]:
            unknown.append(letter.upper())
            continue
        over = np.fmax(low - ends[:, axis] - zero - length, ends[:, axis] + zero + length - high)
        if letter != "z" and np.nanmax(over) > 1e-6:
            case.wrong(owner[int(np.nanargmax(over))], f"leaves the travel of {letter.upper()}")
    if unknown:
        case.notes.append(f"where the work offset stands in the travel of {', '.join(unknown)} is not known")
    for number, tool in case.tools.items():
        mine = np.flatnonzero(moves[:, 11] == number)
        low = np.minimum(moves[mine, 4], moves[mine, 7])
        point = (tool.radius - tool.tip) / tool.slope if tool.slope else 0.0
        if mine.size and low.min() < case.limits["lowest"] - 1.0 - point - 1e-6:
            case.wrong(mine[low.argmin()], f"T{number} goes {-low.min() - case.thickness:.2f} mm below the plate")
        if mine.size and -low.min() > tool.flute_length + 1e-6:
            case.wrong(mine[low.argmin()], f"T{number} goes {-low.min():.2f} mm deep, beyond its flutes")
        stick = tool.raw["stick_out"]
        if stick is not None and mine.size and low.min() + stick / 1000 < 0:
            raise Unknown(f"the holder of T{number} goes below the top of the plate")
    x0, y0, x1, y1 = case.stock
    cut = chords.only(chords.fed & (chords.low < 0))
    away = np.maximum.reduce((x0 - cut.b[:, 0], y0 - cut.b[:, 1], cut.b[:, 0] - x1, cut.b[:, 1] - y1))
    reach = 6 * cut.radii(case.tools, 1000.0) + 3
    if (away > reach).any():
        case.wrong(cut.move[int(np.argmax(away - reach))], "cuts far outside of the stock")


def rates(case: Case) -> None:
    """Speeds and feeds of cuts are those that machine and edges bear; drills cut straight down only."""
    moves = case.moves
    for number, tool in case.tools.items():
        low = np.minimum(moves[:, 4], moves[:, 7])
        cut = np.flatnonzero((moves[:, 11] == number) & (moves[:, 1] == 1) & (low < -1e-6))
        rpm, feed = moves[cut, 12], moves[cut, 13]
        slow, fast = case.machine["spindle"]
        flat = np.hypot(*(moves[cut, 5:7] - moves[cut, 2:4]).T)
        down = (flat < 1e-6) & (moves[cut, 7] < moves[cut, 4]) & (moves[cut, 10] == 0)
        speed, chip = tool.raw["speed"], tool.raw["chip"]
        highest = max(HARDER * 1000 * speed / (2 * np.pi * tool.radius), slow) + 1 if speed else fast
        share = np.where(down | (tool.kind not in MILLS), HARDER, THIN)
        tooth = share * chip / 1000 * np.abs(rpm) * tool.raw["flutes"] + 1 if chip else np.full(cut.size, np.inf)
        for bad, why in (
            (rpm <= 0, "cuts with the spindle turning backwards or not at all"),
            ((rpm < slow) | (rpm > fast), "cuts at a speed that the spindle has not"),
            (rpm > highest, f"turns T{number} much faster than its edges bear"),
            (feed > case.machine["max_feed"] + 0.1, "feeds faster than the machine"),
            ((tool.kind not in MILLS) & (flat > 1e-6), f"moves T{number}, a {tool.kind}, sideways in the plate"),
        ):
            if bad.any():
                case.wrong(cut[int(np.argmax(bad))], why)
        for move in cut[feed > tooth]:
            for place in np.flatnonzero(case.chords.move == move):
                if case.left(place, float(tool.at(-case.chords.low[place])), case.chords.low[place]):
                    case.wrong(move, f"feeds T{number} much faster than its edges bear")


def _hits(case: Case, shape: Any, top: float, limit: float, which: np.ndarray | None = None) -> None:
    """Refute the program if a tool comes into a prism below a height, deeper than a limit."""
    if shapely.is_empty(shape):
        return
    some = case.chords if which is None else case.chords.only(which)
    some = some.below(top - limit).distinct()
    if len(some) == 0:
        return
    off = np.nan_to_num(case.moves[some.move, 14]) * some.fed
    reach = some.radii(case.tools, top - limit)
    room = reach - limit + off + SAG
    shapely.prepare(shape)
    met = np.flatnonzero((room > 0) & shapely.dwithin(shape, some.lines(), room))
    if met.size:
        gap = shapely.distance(shape, some.only(met).lines())
        depth = np.minimum(reach[met] - gap + off[met], top - some.low[met])
        worst = int(np.argmax(depth))
        found = len(np.unique(case.moves[some.move[met], 0]))
        also = f" ({found} lines do so)" if found > 1 else ""
        inner = "at least " if gap[worst] == 0 else ""
        yield_ = f"cuts {inner}{depth[worst]:.3f} mm into {{}}{also}"
        raise _Met(int(some.move[met[worst]]), yield_)


class _Met(Exception):
    """A move that meets something, and words with a gap for what it is."""


def _keep(case: Case, what: str, shape: Any, top: float, limit: float, which: Any = None) -> None:
    try:
        _hits(case, shape, top, limit, which)
    except _Met as met:
        case.wrong(met.args[0], met.args[1].format(what))


def gouge(case: Case) -> None:
    """No tool comes deeper than GOUGE into any level of the part."""
    for top, _, shape in case.levels:
        _keep(case, "the part", shape, top, GOUGE)


def tabs(case: Case) -> None:
    """Tabs stay whole."""
    for place, (top, shape) in enumerate(case.hold["tabs"], 1):
        _keep(case, f"tab {place}", shape, top, GOUGE)


def prisms(case: Case) -> None:
    """No tool comes into clamps and jaws, from the stop on at which they are set."""
    for top, shape, stop in case.hold["prisms"]:
        _keep(case, "a clamp or jaw", shape, top, 0.0, case.moves[case.chords.move, 16] >= stop)


def leftover(case: Case) -> None:
    """Each wall is cut along its whole length, where a mill that cuts through can enter."""
    used = {int(number) for number in np.unique(case.moves[case.moves[:, 1] == 1, 11])}
    mills = [tool for number, tool in case.tools.items() if number in used and tool.kind in MILLS]
    through = [tool.radius for tool in mills if tool.flute_length >= -case.limits["lowest"] - 1e-6]
    radius = min(through, default=0.0) + case.limits["play"]
    if not through and mills:
        raise Unknown("no mill of the program cuts through the plate")
    widest = max((tool.radius for tool in mills), default=0.0)
    inner = case.plate.buffer(-LEFTOVER, join_style="mitre")
    done: list[Any] = []
    for top, bottom, shape in reversed(case.levels):
        if shapely.is_empty(shape):
            continue
        lifted = [tab for height, tab in case.hold["tabs"] if height + case.limits["tab_slack"] >= top - 1e-6]
        if any(shape is other for other in done):
            continue  # what is cut to the wall further down is so here as well
        if not lifted:
            done.append(shape)
        holes = [shapely.Polygon(ring) for part in shapely.get_parts(shape) for ring in part.interiors]
        bores = shapely.union_all([hole.buffer(-LEFTOVER + SAG) for hole in holes if _is_round(hole)])
        near = LEFTOVER - 3 * SAG
        quads = int(np.pi / 4 / np.arccos(1 - SAG / (radius + 1))) + 1
        reached = shape.buffer(radius, quad_segs=quads).buffer(near - radius, quad_segs=quads)
        walls = shapely.union_all([shapely.boundary(reached), shapely.boundary(bores)])
        walls = shapely.intersection(walls, inner)
        if lifted:
            around = shapely.union_all([tab.buffer(2 * widest) for tab in lifted])
            walls = shapely.difference(walls, around)
        level = max(bottom, -case.thickness) + ROUNDED / 10
        cut = case.chords.only(case.chords.fed & np.isin(case.chords.tool, _of_kinds(case, WALLS)))
        cut = cut.below(level).distinct()
        open_ = uncovered(walls, cut.a, cut.b, cut.radii(case.tools, level))
        if len(open_):
            x, y = open_[0].mean(axis=0)
            raise Refuted(f"more than {LEFTOVER * 1000:g} µm are left on a wall at X{x:.3f} Y{y:.3f} Z{bottom:.3f}")
        rest = shapely.area(shapely.difference(shape.buffer(radius, quad_segs=quads).buffer(-radius), shape))
        if rest > 0.01:
            case.notes.append(f"{rest:.2f} mm² at Z{bottom:.3f} are out of reach of the mills")


def _of_kinds(case: Case, kinds: set[str]) -> list[int]:
    return [number for number, tool in case.tools.items() if tool.kind in kinds]


def _is_round(hole: Any) -> bool:
    points = shapely.get_coordinates(hole)
    reach = np.hypot(*(points - points[:-1].mean(axis=0)).T)
    return len(points) > 12 and float(np.ptp(reach)) < 0.002


def floors(case: Case) -> None:
    """Each floor is cut all over, where the mills can enter."""
    mills = [tool for tool in case.tools.values() if tool.kind in MILLS]
    least = min((tool.radius for tool in mills), default=0.0) + case.limits["play"]
    for (_, bottom, above), (_, _, below) in zip(case.levels, case.levels[1:], strict=False):
        if above is below:
            continue
        floor = shapely.intersection(shapely.difference(below, above), case.plate)
        floor = shapely.difference(floor, above.buffer(least, quad_segs=64).buffer(LEFTOVER - least, quad_segs=64))
        level = bottom + LEFTOVER
        cut = case.chords.only(case.chords.fed).below(level).distinct()
        radii = cut.radii(case.tools, level)
        near = np.flatnonzero(shapely.dwithin(floor, cut.lines(), radii))
        gone = shapely.union_all(shapely.buffer(cut.only(near).lines(), radii[near] + SAG, quad_segs=64))
        left = shapely.difference(floor, gone).buffer(-LEFTOVER / 2)
        if not shapely.is_empty(left):
            x, y = left.representative_point().coords[0]
            raise Refuted(f"the floor is not cut at X{x:.3f} Y{y:.3f} Z{bottom:.3f}")


def rapids(case: Case) -> None:
    """Rapids go above the stock, or where earlier cuts have left nothing."""
    every = case.chords
    flat = np.hypot(*(every.b - every.a)[:, :2].T)
    rising = (flat < 1e-6) & (every.b[:, 2] > every.a[:, 2])
    free: set[Any] = set()
    for place in np.flatnonzero(~every.fed & (every.low < UNEVEN) & ~rising):
        tool, low = case.tools[every.tool[place]], every.low[place]
        ways = np.round(np.concatenate((every.a[place, :2], every.b[place, :2], [low])), 4)
        key = (tool.number, *ways.tolist())  # what is free stays so
        if key not in free:
            if case.left(place, float(tool.at(max(-low, 0.0))), min(low, -UNEVEN / 10)):
                case.wrong(every.move[place], "a rapid goes into stock, or ends less than 0.2 mm above it")
            free.add(key)


def holding(case: Case) -> None:
    """What is cut free of the plate is held: each piece of the part by two tabs that reach the frame."""
    method, part = case.hold["method"], case.levels[-1][2]
    if method not in {"tabs", "bore", "vice", "vacuum", "tape"}:
        raise Unknown(f"a part that is held by {method!r:.30}")
    low = case.chords.only(case.chords.fed).below(-case.thickness + 1e-4).distinct()
    radii = low.radii(case.tools, -case.thickness + 1e-4)
    for piece in shapely.get_parts(part):
        if method != "tabs":
            continue
        outer = shapely.Polygon(piece.exterior)
        near = np.flatnonzero(shapely.dwithin(outer.buffer(0.1), low.lines(), radii))
        free = shapely.union_all(shapely.buffer(low.only(near).lines(), radii[near], quad_segs=16))
        frame = shapely.difference(case.plate, shapely.union(free, outer))
        rim = shapely.boundary(case.plate).buffer(0.05)
        frame = [one for one in shapely.get_parts(frame) if shapely.intersects(one, rim)]
        held = [
            tab
            for _, tab in case.hold["tabs"]
            if shapely.intersection(tab, piece).area > 0.01 and any(shapely.intersects(tab, f) for f in frame)
        ]
        if len(held) < 2 and not shapely.is_empty(shapely.intersection(free, outer.buffer(0.1).boundary)):
            raise Refuted(f"a piece of the part is held by {len(held)} tabs; 2 at least")
