"""A program as strokes: where each move starts and ends. For pictures and for tables, not for the proof.

Where the control compensates the cutter's radius, strokes are those of the cutter's centre with D as planned.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from mechwright_cam.controls.reading import Dialect, Kind
from mechwright_cam.controls.reading.compensation import Compensation
from mechwright_cam.program.moves import (
    Drill,
    Feed,
    FeedArc,
    Move,
    Operation,
    Pause,
    Program,
    Rapid,
    Tap,
    ToolSection,
)

Place = tuple[float, float, float]
_AS_PLANNED = Dialect()
"""No control has touched the program yet: of a dialect the limits of arcs alone count here."""


@dataclass(frozen=True, slots=True)
class Stroke:
    """One move from ``start`` to ``end``, work coordinates, mm.

    ``bottom`` is the deepest z on the way. An arc has a centre; ``feed`` is 0 for a rapid.
    """

    start: Place
    end: Place
    bottom: float
    feed: float
    centre: tuple[float, float] | None = None
    ccw: bool = False
    drilled: bool = False


@dataclass(frozen=True, slots=True)
class Traced:
    """The strokes and the stops of one operation."""

    section: ToolSection
    operation: Operation
    strokes: tuple[Stroke, ...]
    stops: tuple[str, ...]

    @property
    def bottom(self) -> float | None:
        """Deepest z of its cuts, mm; None if it cuts nothing."""
        return min((stroke.bottom for stroke in self.strokes if stroke.feed > 0), default=None)


def trace(program: Program) -> tuple[Traced, ...]:
    """Follow a program through all its operations."""
    traced = []
    for section in program.sections:
        # After a tool change the spindle comes from above; the first move has x and y.
        place: Place | None = None
        for operation in section.operations:
            strokes: list[Stroke] = []
            stops: list[str] = []
            contour: list[Feed | FeedArc] = []
            diameter = 0.0 if program.compensation == "wear" else section.tool.diameter
            for move in operation.moves:
                if isinstance(move, Pause):
                    stops.append(move.message)
                    continue
                if place is None:
                    place = (move.x or 0.0, move.y or 0.0, program.clearance)
                if isinstance(move, Feed | FeedArc) and (contour or _side(move)):
                    contour.append(move)
                    if _side(move) != "off":
                        continue
                    strokes += _compensated(contour, place, diameter)
                    contour = []
                else:
                    strokes += _strokes(move, place)
                place = strokes[-1].end
            traced.append(Traced(section, operation, tuple(strokes), tuple(stops)))
    return tuple(traced)


def _strokes(move: Move, start: Place) -> Iterator[Stroke]:
    x, y, z = start
    match move:
        case Rapid():
            end = (_to(move.x, x), _to(move.y, y), _to(move.z, z))
            yield Stroke(start, end, min(z, end[2]), 0.0)
        case Feed():
            end = (_to(move.x, x), _to(move.y, y), _to(move.z, z))
            yield Stroke(start, end, min(z, end[2]), move.feed)
        case FeedArc():
            end = (move.x, move.y, _to(move.z, z))
            centre = (x + move.i, y + move.j)
            yield Stroke(start, end, min(z, end[2]), move.feed, centre, move.ccw)
        case Drill() | Tap():
            above = (move.x, move.y, max(z, move.retract))
            yield Stroke(start, above, z, 0.0)
            yield Stroke(above, above, move.bottom, move.feed, drilled=True)


def _to(wanted: float | None, present: float) -> float:
    return present if wanted is None else wanted


def _side(move: Feed | FeedArc) -> str | None:
    return move.side if isinstance(move, Feed) else None


def _compensated(moves: Sequence[Feed | FeedArc], start: Place, diameter: float) -> Iterator[Stroke]:
    """The strokes of moves that turn compensation on, follow a contour, and turn it off."""
    control = Compensation(_AS_PLANNED)
    control.x, control.y, control.z = start
    control.begin_compensation(0, 1 if _side(moves[0]) == "left" else -1, diameter)
    for move in moves[:-1]:
        control.feed = move.feed
        x, y = control.contour
        end = _to(move.x, x), _to(move.y, y), _to(move.z, control.z)
        if isinstance(move, FeedArc):
            control.compensated(0, Kind.ARC, *end, (x + move.i, y + move.j), move.ccw)
        else:
            control.compensated(0, Kind.FEED, *end, None, False)
    for kind, _, *place, cx, cy, sweep, _, feed, _, _ in control.rows:
        centre = (cx, cy) if kind == Kind.ARC else None
        one, two = (place[0], place[1], place[2]), (place[3], place[4], place[5])
        yield Stroke(one, two, min(one[2], two[2]), feed, centre, sweep > 0)
    yield from _strokes(moves[-1], (control.x, control.y, control.z))
