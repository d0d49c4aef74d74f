"""Rows of parts that share straight edges: neighbours stand one kerf apart, and one line cuts both.

Glossary
--------
side
    A straight edge of an outside that does not work, with all of the part behind it.
row
    Parts in a line; each meets the one before it along a side, and the next one along the opposite side.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mechwright.geometry import Line, Outline
from mechwright.geometry.segments import Point
from mechwright_cut.cuts import WORKING

SHORTEST = 5.0
"""A shorter edge is not shared, mm: leads and corners would take what it saves."""
SHARE = 0.5
"""Of two sides that are shared the shorter one has at least this share of the longer one."""
BEHIND = 1e-4
"""Rounding of the places of points behind a side, mm."""
OPPOSITE = 1e-6
"""Two sides are opposite within this angle, rad: 0.1 µm at a side of 100 mm."""


@dataclass(frozen=True, slots=True)
class Place:
    """Where a part lies: turned by ``angle``, rad, then moved, mm."""

    x: float = 0.0
    y: float = 0.0
    angle: float = 0.0

    def of(self, point: Point) -> Point:
        """A point of the part, where it lies."""
        c, s = math.cos(self.angle), math.sin(self.angle)
        return c * point[0] - s * point[1] + self.x, s * point[0] + c * point[1] + self.y

    def then(self, dx: float, dy: float, turned: bool) -> "Place":
        """The place after a quarter turn about the origin, or none, and a move."""
        x, y = (-self.y, self.x) if turned else (self.x, self.y)
        return Place(x + dx, y + dy, self.angle + (math.pi / 2 if turned else 0.0))


@dataclass(frozen=True, slots=True)
class Member:
    """A part of a row: its number, where it lies, and its sides beside the one before and the next one."""

    number: int
    place: Place = Place()
    before: Line | None = None
    behind: Line | None = None


@dataclass(frozen=True)
class Row:
    """Parts that share edges, or a single one; ``bounds`` are least and greatest x and y, mm."""

    members: tuple[Member, ...]
    bounds: tuple[float, float, float, float]

    @property
    def size(self) -> tuple[float, float]:
        """Length in X and in Y, mm."""
        x0, y0, x1, y1 = self.bounds
        return x1 - x0, y1 - y0


def sides(outline: Outline) -> list[Line]:
    """The sides of an outline, the longest first.

    >>> from mechwright.geometry import Loop
    >>> plate = Outline(Loop.polygon([(0, 0), (20, 0), (20, 8), (12, 8), (12, 6), (0, 6)]))
    >>> [side.start for side in sides(plate)]  # beside the step at y = 6 no part can stand
    [(0.0, 0.0), (20.0, 0.0), (20.0, 8.0), (0.0, 6.0)]
    """
    points = outline.outer.flatten()
    found = []
    for segment in outline.outer.segments:
        if not isinstance(segment, Line) or segment.tag in WORKING or _length(segment) < SHORTEST:
            continue
        along = np.subtract(segment.end, segment.start) / _length(segment)
        behind = (points - segment.start) @ np.array((-along[1], along[0]))
        if behind.min() >= -BEHIND:
            found.append(segment)
    return sorted(found, key=lambda side: -round(_length(side), 6))


def rows_of(outlines: Sequence[Outline], kerf: float, room: tuple[float, float]) -> list[Row]:
    """The parts in rows that go on a plate of this room, mm, however it is turned."""
    known = {id(one): sides(one) for one in outlines}
    left, found = list(range(len(outlines))), []
    while left:
        members = [Member(left.pop(0))]
        exits = known[id(outlines[members[0].number])]
        while following := _following(members, exits, left, outlines, known, kerf):
            grown, exits = following
            if not _goes_on(_bounds(grown, outlines), room):
                break
            left.remove(grown[-1].number)
            members = grown
        found.append(Row(tuple(members), _bounds(members, outlines)))
    return found


def single_rows(outlines: Sequence[Outline]) -> list[Row]:
    """Each part alone."""
    return [Row((Member(number),), outline.bounds) for number, outline in enumerate(outlines)]


def _length(side: Line) -> float:
    return math.dist(side.start, side.end)


def _heading(side: Line) -> float:
    return math.atan2(side.end[1] - side.start[1], side.end[0] - side.start[0])


def _following(
    members: Sequence[Member],
    exits: Sequence[Line],
    left: Iterable[int],
    outlines: Sequence[Outline],
    known: dict[int, list[Line]],
    kerf: float,
) -> tuple[list[Member], list[Line]] | None:
    """The row with one more part, and the sides by which it may go on; None where none has a like side.

    Of all parts that one follows whose side differs least in length, and the row goes on if it can.
    """
    for out in exits:
        last = members[-1]
        if len(members) == 1:  # the first part is turned until this side looks along X
            last = Member(last.number, Place(angle=math.pi / 2 - _heading(out)))
        able: list[tuple[float, bool, int, Line, list[Line]]] = []
        for number in left:
            own = known[id(outlines[number])]
            for side in own:
                shorter, longer = sorted((_length(side), _length(out)))
                if shorter >= SHARE * longer:
                    onward = [one for one in own if _opposite(side, one)]
                    able.append((round(longer - shorter, 4), not onward, number, side, onward))
        if able:
            *_, number, side, onward = min(able, key=lambda one: one[:3])
            place = _beside(side, last.place.of(out.start), last.place.of(out.end), kerf)
            return [*members[:-1], replace(last, behind=out), Member(number, place, side)], onward
    return None


def _opposite(one: Line, two: Line) -> bool:
    apart = (_heading(two) - _heading(one)) % math.tau
    return abs(apart - math.pi) <= OPPOSITE


def _beside(side: Line, start: Point, end: Point, kerf: float) -> Place:
    """Where a part lies whose side stands one kerf beyond another, which runs up from start to end."""
    angle = -math.pi / 2 - _heading(side)
    x, y = Place(angle=angle).of(((side.start[0] + side.end[0]) / 2, (side.start[1] + side.end[1]) / 2))
    return Place((start[0] + end[0]) / 2 + kerf - x, (start[1] + end[1]) / 2 - y, angle)


def _bounds(members: Sequence[Member], outlines: Sequence[Outline]) -> tuple[float, float, float, float]:
    boxes = [outlines[one.number].moved(one.place.x, one.place.y, one.place.angle).bounds for one in members]
    lefts, lows, rights, highs = zip(*boxes, strict=True)
    return min(lefts), min(lows), max(rights), max(highs)


def _goes_on(bounds: tuple[float, float, float, float], room: tuple[float, float]) -> bool:
    wide, high = bounds[2] - bounds[0], bounds[3] - bounds[1]
    return max(wide, high) <= max(room) and min(wide, high) <= min(room)
