"""Paths of the cutter's centre in the plane.

Glossary
--------
cut
    One line or arc of a path.
turn
    0 for a line, +1 for a counter-clockwise arc, -1 for a clockwise one.
closed
    The path ends where it starts, so it may be entered anywhere.
"""

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

import numpy as np

from mechwright.arrays import Array
from mechwright.geometry.segments import Point
from mechwright.tolerances import TOLERANCES

DECIMALS = 4
"""Digits of a coordinate in mm. Paths are rounded before arcs get their centres, so that what a post prints
still starts and ends on the arc; a tenth of a micrometre keeps arcs consistent far below 2 µm."""

NOISE = 1e-6
"""Share of a last decimal that is the noise of floating point."""


class Cut(NamedTuple):
    """A line or an arc; its start is the end of the cut before. Lengths in mm."""

    x: float
    y: float
    cx: float
    cy: float
    turn: int
    length: float


def rounded(value: float) -> float:
    """A coordinate as programs print it; never a negative zero."""
    return round(value, DECIMALS) + 0.0


def printed(point: Point) -> Point:
    """A point as programs print it."""
    return rounded(point[0]), rounded(point[1])


def line(start: Point, end: Point) -> Cut:
    """A straight cut."""
    return Cut(end[0], end[1], 0.0, 0.0, 0, math.hypot(end[0] - start[0], end[1] - start[1]))


def arc(start: Point, end: Point, centre: Point, turn: int) -> Cut:
    """An arc below a full turn; the centre is moved so that both ends have one radius.

    An arc whose ends coincide after rounding would be read as a full circle: it becomes a line.
    """
    dx, dy = end[0] - start[0], end[1] - start[1]
    chord = math.hypot(dx, dy)
    if chord < 2 * 10**-DECIMALS:
        return line(start, end)
    mx, my = (start[0] + end[0]) / 2, (start[1] + end[1]) / 2
    nx, ny = -dy / chord, dx / chord
    height = (centre[0] - mx) * nx + (centre[1] - my) * ny
    cx, cy = mx + height * nx, my + height * ny
    a = math.atan2(start[1] - cy, start[0] - cx)
    b = math.atan2(end[1] - cy, end[0] - cx)
    sweep = ((b - a) * turn) % math.tau
    return Cut(end[0], end[1], cx, cy, turn, sweep * math.hypot(chord / 2, height))


class Place(NamedTuple):
    """A place on a cut: length from the path's start, mm, the point, and the heading, rad."""

    at: float
    point: Point
    heading: float


def place_on(start: Point, cut: Cut, share: float, done: float) -> Place:
    """The place at a share of a cut."""
    at = done + share * cut.length
    if not cut.turn:
        x, y = (a + share * (b - a) for a, b in zip(start, (cut.x, cut.y), strict=True))
        return Place(at, (x, y), math.atan2(cut.y - start[1], cut.x - start[0]))
    radius = math.hypot(start[0] - cut.cx, start[1] - cut.cy)
    angle = math.atan2(start[1] - cut.cy, start[0] - cut.cx) + share * cut.turn * cut.length / radius
    point = cut.cx + radius * math.cos(angle), cut.cy + radius * math.sin(angle)
    return Place(at, point, angle + cut.turn * math.pi / 2)


@dataclass(frozen=True)
class Path:
    """A chain of cuts from ``start``, mm."""

    start: Point
    cuts: tuple[Cut, ...]
    cache: dict[object, object] = field(default_factory=dict, repr=False, compare=False, hash=False)

    @property
    def end(self) -> Point:
        """The last point."""
        return (self.cuts[-1].x, self.cuts[-1].y) if self.cuts else self.start

    @property
    def closed(self) -> bool:
        """Whether it ends where it starts."""
        return bool(self.cuts) and self.end == self.start

    @cached_property
    def length(self) -> float:
        """Length, mm."""
        return math.fsum(cut.length for cut in self.cuts)

    def __add__(self, other: "Path") -> "Path":
        if other.start != self.end:
            raise ValueError(f"paths do not meet: {self.end} and {other.start}")
        return Path(self.start, self.cuts + other.cuts)

    def reversed(self) -> "Path":
        """The same way run backwards."""
        back = [Cut(*start, cut.cx, cut.cy, -cut.turn, cut.length) for start, cut, _ in self.walk()]
        return Path(self.end, tuple(back[::-1]))

    def walk(self) -> Iterator[tuple[Point, Cut, float]]:
        """The cuts, with their starts and the way before them."""
        here, done = self.start, 0.0
        for cut in self.cuts:
            yield here, cut, done
            here, done = (cut.x, cut.y), done + cut.length

    def split(self, at: float) -> tuple["Path", "Path"]:
        """The parts before and after ``at`` mm of the way; either may be empty."""
        for number, (here, cut, done) in enumerate(self.walk()):
            if done + cut.length >= at:
                first, second = _cut_at(here, cut, at - done)
                before = Path(self.start, self.cuts[:number] + first)
                return before, Path(before.end, second + self.cuts[number + 1 :])
        return self, Path(self.end, ())

    def points(self, step: float) -> Array:
        """Points (n, 2) along the way, both ends included, at most ``step`` mm apart."""
        rows: list[Array] = [np.array([self.start])]
        for here, cut, _ in self.walk():
            count = max(1, math.ceil(cut.length / step))
            t = np.arange(1, count + 1)[:, None] / count
            if cut.turn:
                a = math.atan2(here[1] - cut.cy, here[0] - cut.cx)
                radius = math.hypot(here[0] - cut.cx, here[1] - cut.cy)
                angle = a + cut.turn * cut.length / radius * t
                rows.append(np.hstack((cut.cx + radius * np.cos(angle), cut.cy + radius * np.sin(angle))))
            else:
                rows.append(np.array(here) + t * (np.array((cut.x, cut.y)) - here))
        return np.concatenate(rows)


def _cut_at(start: Point, cut: Cut, at: float) -> tuple[tuple[Cut, ...], tuple[Cut, ...]]:
    """Divide one cut; a rest shorter than the program can print is none."""
    least = 2 * 10**-DECIMALS
    if at < least:
        return (), (cut,)
    if cut.length - at < least:
        return (cut,), ()
    end, middle = (cut.x, cut.y), printed(place_on(start, cut, at / cut.length, 0.0).point)
    if not cut.turn:
        return (line(start, middle),), (line(middle, end),)
    centre = (cut.cx, cut.cy)
    return (arc(start, middle, centre, cut.turn),), (arc(middle, end, centre, cut.turn),)


def polyline(points: Iterable[Point]) -> Path:
    """A path of straight cuts through these points, rounded; points that coincide count once."""
    rows = list(map(printed, points))
    cuts = []
    here = rows[0]
    for row in rows[1:]:
        if row != here:
            cuts.append(line(here, row))
            here = row
    return Path(rows[0], tuple(cuts))


def circle(centre: Point, radius: float, start: Point, ccw: bool) -> Path:
    """A full circle from ``start`` in two halves, rounded."""
    begin = printed(start)
    far = printed((2 * centre[0] - start[0], 2 * centre[1] - start[1]))
    turn = 1 if ccw else -1
    half = math.pi * radius
    one = Cut(*far, (begin[0] + far[0]) / 2, (begin[1] + far[1]) / 2, turn, half)
    return Path(begin, (one, one._replace(x=begin[0], y=begin[1])))


def round_from_right(centre: Point, radius: float, ccw: bool) -> Path:
    """A full circle from its rightmost point."""
    return circle(centre, radius, (centre[0] + radius, centre[1]), ccw)


CIRCLE_BIAS = TOLERANCES.flatten + 1e-4
"""A bore's path is an exact circle: it keeps off by the chords of the outline and by rounding, mm."""
