"""What a program does to the part: each check raises RefutedError with the line, or adds a note."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import shapely

from mechwright_check import RefutedError, UnknownError
from mechwright_check.geometry import COARSE, SAG, Chords, Cutter, nearest, uncovered
from mechwright_check.reading import END, FEED, FILE, KIND, LINE, OFF, RPM, START, STOPS, TOOL, TOP

GOUGE, LEFTOVER, UNEVEN = 0.005, 0.010, 0.2
"""Deepest cut into the part, thickest stock on a wall or floor, least height of a rapid's end above stock."""
MILLS, WALLS = {"end-mill"}, {"end-mill", "drill", "reamer"}
HARDER, LASTING = 1.5, 2.0
"""Speeds, depths and feeds may be so many times the library's; a cut that is too deep is so for so many diameters."""
BESIDE = 3.0
"""A cut may go so many diameters, and so many mm, beside the plate."""


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
        """Those of them that cut, as :func:`_cuts` gives them."""
        return _cuts(self.coarse)

    @cached_property
    def widest(self) -> float:
        """Radius of the widest tool."""
        return max(tool.radius for tool in self.tools.values())

    def refuse(self, which: np.ndarray, why: str, moves: np.ndarray | None = None) -> None:
        """Refute the program for the first of the moves, or of all, of a mask."""
        found = np.flatnonzero(which) if moves is None else moves[which]
        if found.size:
            row = self.moves[found[0]]
            file = f"{self.files[int(row[FILE])]}: " if len(self.files) > 1 else ""
            place = " ".join(f"{axis}{value:.3f}" for axis, value in zip("XYZ", row[END], strict=True))
            raise RefutedError(f"{file}line {row[LINE]:.0f}: {why}, at {place}")

    def stock_at(self, points: np.ndarray, level: np.ndarray, before: np.ndarray) -> np.ndarray:
        """Whether (n,) at points above levels something is left by the chords before some."""
        places, tree = self.cuts
        point, cut = tree.query(shapely.points(points), predicate="dwithin", distance=self.widest)
        chord = places[cut]
        early = chord < before[point]
        point, chord = point[early], chord[early]
        away, z = nearest(points[point], self.coarse.a[chord], self.coarse.b[chord])
        tools = self.coarse.tool[chord]
        own, height = tools == self.coarse.tool[before[point]], level[point] + 0.001 - z
        wide = np.zeros(len(point))
        for number in np.unique(tools).tolist():
            mine = tools == number
            wide[mine] = np.where(own, TOP, height)[mine]
            wide[mine] = self.tools[number].at(wide[mine])
        left = shapely.contains_xy(self.plate, points[:, 0], points[:, 1])
        left[point[(away <= wide + COARSE) & (height >= 0)]] = False
        return np.asarray(left)


def _cuts(chords: Chords) -> tuple[np.ndarray, Any]:
    """The chords that cut, by their places among all, and a tree of their lines."""
    places = np.flatnonzero(chords.fed & (chords.low < 0))
    return places, shapely.STRtree(chords.only(places).lines())


def check_all(case: Case) -> None:
    """Every check in turn."""
    for check in (limits, rates, loads, gouge, rapids, leftover, floors, holding):
        check(case)


def limits(case: Case) -> None:
    """Moves fit into the travel of each axis, and are as deep as flutes and the room below the plate allow."""
    moves, unknown = case.moves, []
    ends = np.concatenate((case.chords.a, case.chords.b))
    ends[ends[:, 2] >= TOP, 2] = np.nan
    for axis, letter in enumerate("XYZ"):
        (low, high), zero, at = case.machine[letter.lower()], case.machine["zero"][axis], ends[:, axis]
        far = np.abs(at - np.nanmedian(at))
        over = (far == np.nanmax(far)) & (np.nanmax(at) - np.nanmin(at) > high - low)
        if zero is not None and letter != "Z":
            over |= (at + zero < low - 1e-6) | (at + zero > high + 1e-6)
        case.refuse(over, f"leaves the travel of {letter}", np.tile(case.chords.move, 2))
        unknown += [letter] if zero is None or letter == "Z" else []
    if unknown:
        case.notes.append(f"where the work offset stands in the travel of {', '.join(unknown)} is not known")
    low = np.minimum(moves[:, 4], moves[:, 7])
    for number, tool in case.tools.items():
        mine, point = moves[:, TOOL] == number, (tool.radius - tool.tip) / (tool.slope or 1.0)
        case.refuse(
            mine & (low < case.limits["lowest"] - 1.0 - point - 1e-6), f"T{number} goes far below the plate"
        )
        case.refuse(
            mine & (-low > tool.raw["flute_length"] / 1000 + 1e-6), f"T{number} goes deeper than its flutes"
        )
        out = tool.raw["stick_out"]
        if out is not None and (mine & (low + out / 1000 < 0)).any():
            raise UnknownError(f"the holder of T{number} goes below the top of the plate")
    cut = case.coarse.only(case.cuts[0])
    beside = shapely.distance(case.plate, cut.lines()) > 2 * BESIDE * cut.radii(case.tools, TOP) + BESIDE
    case.refuse(beside, "cuts far outside of the plate", cut.move)


def rates(case: Case) -> None:
    """Speeds and feeds are those that machine and edges bear; drills cut straight down only."""
    moves, (slow, fast) = case.moves, case.machine["spindle"]
    cut = (moves[:, KIND] == 1) & (np.minimum(moves[:, 4], moves[:, 7]) < -1e-6)
    case.refuse(moves[:, FEED] > case.machine["max_feed"] + 0.1, "feeds faster than the machine")
    case.refuse(
        cut & ((np.abs(moves[:, RPM]) < slow) | (moves[:, RPM] > fast)), "a speed that the spindle has not"
    )
    case.refuse(cut & (moves[:, RPM] < 0), "cuts with the spindle turning backwards")
    for number, tool in case.tools.items():
        mine, data = cut & (moves[:, TOOL] == number), tool.raw
        if tool.kind not in MILLS:
            aside = (moves[:, END] != moves[:, START])[:, :2].any(axis=1)
            case.refuse(mine & aside, f"moves T{number}, a {tool.kind}, sideways in the plate")
        if data["speed"] is not None:
            most = max(HARDER * 1000 * data["speed"] / (2 * np.pi * tool.radius), slow) + 1
            tooth = moves[:, FEED] / (np.abs(moves[:, RPM]) * data["flutes"] + 1e-9)
            case.refuse(mine & (moves[:, RPM] > most), f"turns T{number} much faster than its edges bear")
            rubs = tooth < min(0.002, 0.1 * data["chip"] / 1000)
            case.refuse(mine & rubs & (tool.kind not in MILLS), f"T{number} rubs instead of cutting")


def loads(case: Case) -> None:
    """Where stock is left on the line of their axis, mills go no deeper, faster or steeper than edges bear."""
    every = case.coarse
    flat, drop = np.hypot(*(every.b - every.a)[:, :2].T), (every.a - every.b)[:, 2]
    tooth = case.moves[every.move, FEED] / (np.abs(case.moves[every.move, RPM]) + 1e-9)
    for number, tool in case.tools.items():
        data, mine = tool.raw, np.flatnonzero(every.fed & (every.tool == number) & (every.low < -1e-6))
        if data["speed"] is None or mine.size == 0:
            continue
        mill, low, chip = tool.kind in MILLS, every.low[mine], data["chip"] / 1000 * data["flutes"]
        down, steep = flat[mine] < 1e-6, drop[mine] > flat[mine] * np.tan(np.radians(data["ramp"])) + 0.003
        slow = data["centre_cutting"] & (tooth[mine] <= HARDER * chip * data["plunge"] + 0.001)
        deep = low + HARDER * data["step_down"] * 2 * tool.radius
        for which, level, least, why in (
            (tooth[mine] > HARDER * chip + 0.001, low, 0.0, "is fed much faster than its edges bear"),
            (steep & ~slow & mill, low, 0.0, "goes down more steeply or faster than it can"),
            (
                (deep < -1e-6) & mill,
                deep,
                LASTING * 2 * tool.radius,
                "takes more in depth than its edges bear",
            ),
        ):
            some = mine[which]
            met = case.stock_at(every.b[some, :2], level[which], some)
            group = np.cumsum(~met)  # stretches of path, each behind a place where nothing is left
            length = np.bincount(group, (flat + np.abs(drop))[some] * met)[group] if some.size else 0.0
            case.refuse(met & (length > least), f"T{number} {why}", every.move[some])


def gouge(case: Case) -> None:
    """No tool comes deeper than GOUGE into the part or a tab, nor into a clamp or jaw once that is set."""
    for top, _, shape in case.levels:
        _meet(case, case.chords, shape, top, GOUGE, "the part")
    for top, shape in case.hold["tabs"]:
        _meet(case, case.chords, shape, top, GOUGE, "a tab")
    stops = case.moves[case.chords.move, STOPS]
    for top, shape, stop in case.hold["prisms"]:
        since = (
            stops >= stop if (stops >= stop).any() else stops >= 0
        )  # one that no stop sets is there before
        _meet(case, case.chords.only(since), shape, top, 0.0, "a clamp or jaw")


def _meet(case: Case, chords: Chords, shape: Any, top: float, limit: float, what: str) -> None:
    """Refute the program if a tool comes into a prism below a height, deeper than a limit."""
    some = chords.below(top - limit)
    if shapely.is_empty(shape) or len(some.move) == 0:
        return
    off = np.nan_to_num(case.moves[some.move, OFF]) * some.fed
    reach = some.radii(case.tools, top - limit)
    room = reach - limit + off + SAG
    shapely.prepare(shape)
    met = np.flatnonzero((room > 0) & shapely.dwithin(shape, some.lines(), room))
    if met.size:
        gap = shapely.distance(shape, some.only(met).lines())
        depth = np.minimum(reach[met] - gap + off[met], top - some.low[met])
        worst, count = met[int(np.argmax(depth))], len(np.unique(case.moves[some.move[met], LINE]))
        least = "at least " if gap.min() == 0 else ""
        why = f"goes {least}{depth.max():.3f} mm into {what} ({count} lines do)"
        case.refuse(np.arange(len(case.moves)) == some.move[worst], why)


def rapids(case: Case) -> None:
    """Rapids go above the stock, or where earlier cuts have left nothing."""
    every, (places, tree) = case.chords, _cuts(case.chords)
    flat = np.hypot(*(every.b - every.a)[:, :2].T)
    rising = (flat < 1e-6) & (every.b[:, 2] > every.a[:, 2])
    free: set[Any] = set()
    for place in np.flatnonzero(~every.fed & (every.low < UNEVEN - 1e-6) & ~rising).tolist():
        tool, low = case.tools[int(every.tool[place])], float(every.low[place])
        a, b, level = every.a[place, :2], every.b[place, :2], min(low, -UNEVEN / 10)
        key = (int(every.tool[place]), round(low, 4), *a.tolist(), *b.tolist())
        if key in free:
            continue  # what is free stays so
        way = (
            shapely.box(*np.minimum(a, b), *np.maximum(a, b))
            if (a != b).all()
            else shapely.LineString([a, b])
        )
        way = shapely.Point(a) if (a == b).all() else way  # the axes may arrive one after the other
        body = shapely.intersection(way.buffer(float(tool.at(max(-low, 0.0))) - 0.01), case.plate)
        early = places[np.sort(tree.query(body, predicate="dwithin", distance=case.widest))]
        some = every.only(early[early < place]).below(level + 0.001)
        wide = np.where(
            some.tool == every.tool[place], some.radii(case.tools, TOP), some.radii(case.tools, level)
        )
        body = body.difference(shapely.union_all(shapely.buffer(some.lines(), wide, quad_segs=64)))
        if not body.buffer(-0.01).is_empty:
            why = f"a rapid goes into stock, or ends less than {UNEVEN} mm above it"
            case.refuse(np.arange(len(case.moves)) == every.move[place], why)
        free.add(key)


def leftover(case: Case) -> None:
    """Each wall is cut along its whole length, where the finest mill that cuts through can enter."""
    used = np.unique(case.moves[case.moves[:, KIND] == 1, TOOL]).astype(int).tolist()
    mills = [case.tools[number] for number in used if case.tools[number].kind in MILLS]
    through = [
        tool.radius for tool in mills if -case.limits["lowest"] <= tool.raw["flute_length"] / 1000 + 1e-6
    ]
    if mills and not through:
        raise UnknownError("no mill of the program cuts through the plate")
    radius, widest = (
        min(through, default=0.0) + case.limits["play"],
        max((tool.radius for tool in mills), default=0.0),
    )
    inner, near, done = case.plate.buffer(-LEFTOVER, join_style="mitre"), LEFTOVER - 3 * SAG, []
    fine = {"quad_segs": int(np.pi / 4 / np.arccos(1 - SAG / (radius + 1))) + 1}
    cutting = case.chords.only(
        case.chords.fed & np.isin(case.chords.tool, [n for n in used if case.tools[n].kind in WALLS])
    )
    for top, bottom, shape in reversed(case.levels):
        tabs = [tab for height, tab in case.hold["tabs"] if height + case.limits["tab_slack"] >= top - 1e-6]
        if shapely.is_empty(shape) or any(shape is other for other in done):
            continue  # what is cut to a wall further down is so here as well
        done += [] if tabs else [shape]
        holes = [shapely.Polygon(ring) for part in shapely.get_parts(shape) for ring in part.interiors]
        bores = shapely.union_all([hole.buffer(3 * SAG - LEFTOVER) for hole in holes if _is_round(hole)])
        closed = shape.buffer(radius, **fine)
        walls = shapely.union(shapely.boundary(closed.buffer(near - radius, **fine)), shapely.boundary(bores))
        lifted = shapely.union_all([tab.buffer(2 * widest) for tab in tabs])
        walls = shapely.difference(shapely.intersection(walls, inner), lifted)
        cut = cutting.below(bottom + SAG)
        left = uncovered(walls, cut, cut.radii(case.tools, bottom + SAG))
        if len(left):
            x, y = left[0].mean(axis=0)
            raise RefutedError(
                f"more than {LEFTOVER} mm are left on a wall at X{x:.3f} Y{y:.3f} Z{bottom:.3f}"
            )
        rest = shapely.area(shapely.difference(closed.buffer(-radius, **fine), shape))
        if rest > 0.1:
            case.notes.append(f"{rest:.2f} mm² at Z{bottom:.3f} are out of reach of the mills")


def _is_round(hole: Any) -> bool:
    points = shapely.get_coordinates(hole)
    return len(points) > 12 and float(np.ptp(np.hypot(*(points - points[:-1].mean(axis=0)).T))) < 2 * SAG


def floors(case: Case) -> None:
    """Each floor is cut all over, where the finest mill can enter."""
    least = (
        min([tool.radius for tool in case.tools.values() if tool.kind in MILLS], default=0.0)
        + case.limits["play"]
    )
    for (_, bottom, above), (_, _, below) in zip(case.levels, case.levels[1:], strict=False):
        if above is not below:
            floor = shapely.intersection(shapely.difference(below, above), case.plate)
            corners = above.buffer(least, quad_segs=64).buffer(LEFTOVER - least, quad_segs=64)
            cut = case.chords.only(case.chords.fed).below(bottom + LEFTOVER)
            gone = shapely.buffer(cut.lines(), cut.radii(case.tools, bottom + LEFTOVER) + SAG, quad_segs=64)
            gone = shapely.union_all(gone[shapely.intersects(floor, gone)])
            left = shapely.difference(shapely.difference(floor, corners), gone).buffer(-LEFTOVER / 2)
            if not shapely.is_empty(left):
                x, y = left.representative_point().coords[0]
                raise RefutedError(f"the floor is not cut at X{x:.3f} Y{y:.3f} Z{bottom:.3f}")


def holding(case: Case) -> None:
    """Each piece of the part that is cut free of the plate is held by two tabs that reach the frame."""
    if case.hold["method"] != "tabs":
        return
    bottom = case.levels[-1][1]
    low = case.coarse.only(case.coarse.fed).below(bottom + SAG)
    gone = shapely.buffer(low.lines(), low.radii(case.tools, bottom + SAG), quad_segs=16)
    rim = shapely.boundary(case.plate).buffer(0.05)
    for piece in shapely.get_parts(case.levels[-1][2]):
        outer = shapely.Polygon(piece.exterior)
        free = shapely.union_all(gone[shapely.dwithin(shapely.boundary(outer), gone, 0.1)])
        frame = shapely.get_parts(shapely.difference(case.plate, shapely.union(free, outer)))
        frame = frame[shapely.intersects(frame, rim)]
        tabs = [tab for _, tab in case.hold["tabs"] if shapely.intersects(tab, piece)]
        held = sum(bool(shapely.intersects(tab, frame).any()) for tab in tabs)
        if held < 2 and shapely.intersects(free, shapely.boundary(outer.buffer(0.1))):
            raise RefutedError(f"a piece of the part is held by {held} tabs that reach the frame; 2 at least")
