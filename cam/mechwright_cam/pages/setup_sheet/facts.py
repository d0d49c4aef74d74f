"""What the setup sheet says about tools, operations and proof, as plain rows."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from mechwright.geometry.segments import Point
from mechwright_cam.controls.reading.arcs import sweep_of
from mechwright_cam.pages.picture import tool_colours
from mechwright_cam.pages.trace import Stroke, Traced
from mechwright_cam.program.moves import Program
from mechwright_cam.setup.job import Job
from mechwright_cam.setup.limits import HOLDER_GAP
from mechwright_cam.shop.lengths import MILLIMETRES, Lengths
from mechwright_cam.shop.tool import Tool, ToolKind

MARKED = 3
"""So many places of each kind are marked on the walls."""


@dataclass(frozen=True)
class ToolRow:
    """A tool and what the job asks of it; lengths in mm, feeds in mm/min, spindle in rev/min."""

    tool: Tool
    colour: str
    description: str
    bottom: float
    stick_out: float
    over_clamp: bool
    flutes_reach: bool
    spindle: str
    feed: str
    coolant: str
    seconds: float | None
    in_cut: str


@dataclass(frozen=True)
class OperationRow:
    """An operation in cutting order; ``stops`` are messages at which the machine waits after it."""

    number: int
    name: str
    tool: int
    colour: str
    bottom: float | None
    seconds: float | None
    cutting: float | None
    stops: tuple[str, ...]


def tool_rows(
    job: Job, program: Program, traced: Sequence[Traced], proof: Mapping[str, Any], to: Lengths = MILLIMETRES
) -> list[ToolRow]:
    """One row per tool in the order of first use."""
    colours = tool_colours(program)
    clamped = _after_stop(traced)
    seconds: Mapping[str, float] = proof.get("tool_times_s") or {}
    rows = []
    for tool in program.tools:
        mine = [item for item in traced if item.section.tool.number == tool.number]
        bottom = min((item.bottom for item in mine if item.bottom is not None), default=0.0)
        over_clamp = job.clamp is not None and any(item in clamped for item in mine)
        above = job.clamp.top if job.clamp is not None and over_clamp else 0.0
        feeds = [stroke.feed for item in mine for stroke in item.strokes if stroke.feed > 0]
        rows.append(
            ToolRow(
                tool,
                colours[tool.number],
                describe(tool, to),
                bottom,
                max(0.0, -bottom) + above + HOLDER_GAP,
                over_clamp,
                tool.flute_length >= -bottom,
                _range([item.section.spindle for item in mine]),
                _range([feed / to.scale for feed in feeds]),
                ", ".join(dict.fromkeys(item.section.coolant for item in mine)),
                seconds.get(str(tool.number)),
                _in_cut(tool, proof),
            )
        )
    return rows


def operation_rows(
    program: Program, traced: Sequence[Traced], proof: Mapping[str, Any]
) -> list[OperationRow]:
    """One row per operation; times are those of the proof, where it has them."""
    colours = tool_colours(program)
    times = _by_operation(program, proof)
    rows = []
    place = 0
    for item, known in zip(traced, times, strict=True):
        number = item.section.tool.number
        place += item.bottom is not None  # an operation that only stops has no number
        rows.append(
            OperationRow(
                place,
                item.operation.name,
                number,
                colours[number],
                item.bottom,
                known.get("time_s"),
                known.get("cutting_mm"),
                item.stops,
            )
        )
    return rows


def describe(tool: Tool, to: Lengths = MILLIMETRES) -> str:
    """A tool in words.

    >>> describe(Tool(name="em6", number=3, kind="end-mill", diameter=6, flutes=3, flute_length=13))
    'end mill ⌀6, 3 flutes'
    """
    words = f"{str(tool.kind).replace('-', ' ')} ⌀{to.size(tool.diameter)}"
    if tool.pitch is not None:
        words = f"{'left-hand ' if tool.left_hand else ''}{words} × {to.plain(tool.pitch)}"
        words += f", chamfer of {tool.chamfer_length:g} turns{', floating' if tool.floating else ''}"
        return words + (f", {tool.coating}" if tool.coating else "")
    words += f", {tool.coating}" if tool.coating else ""
    if tool.kind not in (ToolKind.DRILL, ToolKind.SPOT_DRILL, ToolKind.CHAMFER):
        plunge = "" if tool.centre_cutting else ", not centre cutting"
        return f"{words}, {tool.flutes} flute{'s' if tool.flutes != 1 else ''}{plunge}"
    return f"{words}, {tool.point_angle:g}° point"


def duration(seconds: float | None) -> str:
    """A time as people say it.

    >>> duration(7), duration(200), duration(3840), duration(None)
    ('7 s', '3 min 20 s', '1 h 04 min', '–')
    """
    if seconds is None:
        return "–"
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60:02d} s"
    return f"{whole // 3600} h {whole % 3600 // 60:02d} min"


def reach(traced: Sequence[Traced]) -> tuple[float, float, float, float] | None:
    """Least x, least y, greatest x and greatest y that cutters reach at a feed, mm; None without any."""
    boxes = []
    for item in traced:
        radius = item.section.tool.radius
        for stroke in item.strokes:
            if stroke.feed <= 0:
                continue
            points = [stroke.start[:2], stroke.end[:2], *extreme_points(stroke)]
            xs, ys = zip(*points, strict=True)
            boxes.append((min(xs) - radius, min(ys) - radius, max(xs) + radius, max(ys) + radius))
    if not boxes:
        return None
    x0, y0, x1, y1 = zip(*boxes, strict=True)
    return min(x0), min(y0), max(x1), max(y1)


def extreme_points(stroke: Stroke) -> list[Point]:
    """Where an arc passes the directions of the axes: there it reaches out furthest."""
    if stroke.centre is None:
        return []
    (x, y), r = stroke.centre, math.dist(stroke.centre, stroke.start[:2])
    sweep = sweep_of(stroke.start[:2], stroke.end[:2], stroke.centre, stroke.ccw)
    first = math.atan2(stroke.start[1] - y, stroke.start[0] - x)
    passed = [
        quarter * math.pi / 2
        for quarter in range(4)
        if (quarter * math.pi / 2 - first) * math.copysign(1, sweep) % math.tau <= abs(sweep)
    ]
    return [(x + r * math.cos(angle), y + r * math.sin(angle)) for angle in passed]


KINDS = {"left": "stock left", "cut": "cut into the part", "corners": "corner"}
"""What the worst places on walls are, in words."""


def place_rows(proof: Mapping[str, Any]) -> list[dict[str, Any]]:
    """The worst places on walls, numbered as the picture of the walls marks them."""
    walls = proof.get("walls") or {}
    rows = [
        {**row, "what": words} for kind, words in KINDS.items() for row in (walls.get(kind) or ())[:MARKED]
    ]
    return [{**row, "number": number} for number, row in enumerate(rows, start=1)]


def check_rows(proof: Mapping[str, Any]) -> list[tuple[str, bool, str]]:
    """Name, answer and message of each check."""
    checks: Mapping[str, Mapping[str, Any]] = proof.get("checks") or {}
    return [
        (name.replace("-", " ").replace("_", " "), bool(check.get("passed")), str(check.get("message", "")))
        for name, check in checks.items()
    ]


def verdict(proof: Mapping[str, Any]) -> bool | None:
    """Whether the program is proven; None if nobody tried."""
    if "ok" in proof:
        return bool(proof["ok"])
    checks = check_rows(proof)
    return all(passed for _, passed, _ in checks) if checks else None


def _in_cut(tool: Tool, proof: Mapping[str, Any]) -> str:
    """Time in cut, and how much of the tool's life that is where the library knows it."""
    seconds = (proof.get("tool_cutting_s") or {}).get(str(tool.number))
    if seconds is None:
        return ""
    words = f"{duration(seconds)} in cut"
    if tool.life is not None:
        words += f" of a life of {tool.life:g} min ({100 * seconds / 60 / tool.life:.0f} %)"
    return words


def _after_stop(traced: Sequence[Traced]) -> list[Traced]:
    """The operations that follow the first stop: those cut around the clamp."""
    for place, item in enumerate(traced):
        if item.stops:
            return list(traced[place + 1 :])
    return list(traced)


def _by_operation(program: Program, proof: Mapping[str, Any]) -> list[Mapping[str, Any]]:
    """The proof's rows, one per operation of the program: matched by tool and name, in order."""
    left: list[Mapping[str, Any]] = list(proof.get("operations") or ())
    found: list[Mapping[str, Any]] = []
    for section in program.sections:
        for operation in section.operations:
            wanted = (section.tool.number, operation.name.casefold())
            match = next((row for row in left if (row["tool"], row["name"].casefold()) == wanted), {})
            if match:
                left.remove(match)
            found.append(match)
    return found


def _range(values: Sequence[float]) -> str:
    if not values:
        return "–"
    low, high = round(min(values)), round(max(values))
    return f"{high}" if low == high else f"{low} … {high}"
