"""A program as strokes: where each move starts and ends. For pictures and for tables, not for the proof."""

from collections.abc import Iterator
from dataclasses import dataclass

from mechwright.program import Drill, Feed, FeedArc, Move, Operation, Pause, Program, Rapid, ToolSection

Place = tuple[float, float, float]


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
            for move in operation.moves:
                if isinstance(move, Pause):
                    stops.append(move.message)
                    continue
                if place is None:
                    place = (move.x or 0.0, move.y or 0.0, program.clearance)
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
        case Drill():
            above = (move.x, move.y, max(z, move.retract))
            yield Stroke(start, above, z, 0.0)
            yield Stroke(above, above, move.bottom, move.feed, drilled=True)


def _to(wanted: float | None, present: float) -> float:
    return present if wanted is None else wanted
