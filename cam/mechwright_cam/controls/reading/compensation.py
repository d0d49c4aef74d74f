"""Cutter compensation (G41, G42): from the contour that the text describes to the path of the tool's centre.

The rules are those of LinuxCNC's documents: the first move leads from the present place to the contour and is
longer than the tool's radius; at an outer corner the tool rolls around it on an arc; at an inner corner both
moves end where their offsets meet, and a corner or an arc that the tool does not fit into is an error.

Glossary
--------
programmed
    Where the text says the contour is; the tool's centre is ``radius`` beside it.
side
    1 with the tool on the left of the contour (G41), -1 on the right (G42).
"""

import math
from dataclasses import dataclass

from mechwright_cam.controls.reading.arcs import sweep_of
from mechwright_cam.controls.reading.blocks import fail
from mechwright_cam.controls.reading.recorder import Recorder
from mechwright_cam.controls.reading.run import Kind

SMALL_CORNER = 0.05
"""Corners up to this angle are passed without an arc or an intersection, rad: LinuxCNC's own tolerance."""
ONE_PLACE = 1e-9
"""Places nearer than this are one, mm."""

Point = tuple[float, float]


@dataclass(slots=True)
class Cut:
    """The offset of one programmed move: a line, or an arc about ``centre``; ``ccw`` is its sense."""

    start: Point
    end: Point
    centre: Point | None = None
    ccw: bool = False
    along: float | None = None
    """Direction of the programmed entry move, whose offset only ends beside the contour, rad."""

    def heading(self, at: Point) -> float:
        """Direction of travel at a point of it, rad."""
        if self.along is not None:
            return self.along
        if self.centre is None:
            return math.atan2(self.end[1] - self.start[1], self.end[0] - self.start[0])
        turn = math.pi / 2 if self.ccw else -math.pi / 2
        return math.atan2(at[1] - self.centre[1], at[0] - self.centre[0]) + turn


class Compensation(Recorder):
    """A recorder that keeps the tool beside the contour."""

    side = 0
    offset = 0.0
    """Radius, mm."""
    contour: Point = (math.nan, math.nan)
    """Programmed place."""
    left: Point | None = None
    """Where the contour was left by G40, until the next move."""
    last: Cut | None = None
    row = 0
    """Row of the last move in X and Y."""
    fresh = False
    """Whether the entry move is still to come."""

    def begin_compensation(self, line: int, side: int, diameter: float) -> None:
        """G41 or G42."""
        if self.side:
            raise fail(line, "compensation is on already; turn it off with G40 first")
        if not (math.isfinite(self.x) and math.isfinite(self.y)):
            raise fail(line, "compensation from an unknown position; move to X and Y first")
        self.side, self.offset = (side, diameter / 2) if diameter >= 0 else (-side, -diameter / 2)
        self.contour, self.last, self.fresh = self.left or (self.x, self.y), None, True
        self.left = None

    def end_compensation(self) -> None:
        """G40: the next move leads from the tool's centre to the contour, in axes that it does not name."""
        if self.side:
            self.left = self.contour
        self.side = 0

    def look_anew(self) -> None:
        """A subroutine has ended; between G40 and the move that leaves the contour that is ambiguous."""
        if self.left is not None:
            raise ValueError("a subroutine ends between G40 and the next move; move away before it ends")

    def compensated(
        self, line: int, kind: Kind, x: float, y: float, z: float, centre: Point | None, ccw: bool
    ) -> None:
        """Make one programmed move."""
        start, end = self.contour, (x, y)
        if centre is None and math.dist(start, end) <= ONE_PLACE:
            self._write(line, kind, Cut((self.x, self.y), (self.x, self.y)), z)
            return
        if self.fresh:
            self.fresh = False
            cut = self._entry(line, end, centre, ccw)
        else:
            cut = self._beside(line, start, end, centre, ccw)
            self._join(line, kind, start, cut)
        self.contour = end
        self.last = cut
        self._write(line, kind, cut, z)
        self.row = len(self.rows) - 1

    def _write(self, line: int, kind: Kind, cut: Cut, z: float) -> None:
        if cut.centre is not None:
            self._arc_to(line, *cut.end, z, cut.centre, cut.ccw)
        elif kind is Kind.RAPID:
            self._rapid(line, *cut.end, z)
        else:
            self._feed_to(line, *cut.end, z)

    def _entry(self, line: int, end: Point, centre: Point | None, ccw: bool) -> Cut:
        here = (self.x, self.y)
        if math.dist(here, end) <= self.offset:
            raise fail(
                line,
                f"the entry move of {math.dist(here, end):.3f} mm is not longer than the tool's radius of "
                f"{self.offset:g} mm",
            )
        if centre is None:
            along = math.atan2(end[1] - here[1], end[0] - here[0])
            return Cut(here, self._aside(end, along), along=along)
        arc = Cut(here, end, centre, ccw)
        along = arc.heading(end)
        target = self._aside(end, along)
        # The arc that ends tangentially there and starts at the tool: its centre is on the end's normal.
        nx, ny = -math.sin(along), math.cos(along)
        dx, dy = here[0] - target[0], here[1] - target[1]
        across = 2 * (dx * nx + dy * ny)
        if abs(across) <= ONE_PLACE:
            return Cut(here, target)
        reach = (dx * dx + dy * dy) / across
        return Cut(here, target, (target[0] + reach * nx, target[1] + reach * ny), reach > 0)

    def _aside(self, point: Point, heading: float) -> Point:
        """The place of the tool beside a point of the contour."""
        out = heading + self.side * math.pi / 2
        return point[0] + self.offset * math.cos(out), point[1] + self.offset * math.sin(out)

    def _beside(self, line: int, start: Point, end: Point, centre: Point | None, ccw: bool) -> Cut:
        move = Cut(start, end, centre, ccw)
        if centre is not None:
            inside = (self.side > 0) == ccw
            if inside and math.dist(start, centre) <= self.offset:
                raise fail(
                    line,
                    f"the tool of radius {self.offset:g} mm does not fit into an arc of radius "
                    f"{math.dist(start, centre):.3f} mm",
                )
        first, last = (self._aside(point, move.heading(point)) for point in (start, end))
        return Cut(first, last, centre, ccw)

    def _join(self, line: int, kind: Kind, corner: Point, cut: Cut) -> None:
        """Lead from the last offset to the next one, around or into the corner between them."""
        before = self.last
        assert before is not None  # noqa: S101 - there was an entry
        if self.offset <= ONE_PLACE:
            return  # without a radius there is nothing between the two
        turn = cut.heading(cut.start) - before.heading(before.end)
        turn = (turn + math.pi) % math.tau - math.pi
        outer = -self.side * turn  # positive away from the tool: around the outside of the corner
        if abs(abs(turn) - math.pi) <= ONE_PLACE:
            outer = math.pi
        if outer > SMALL_CORNER:
            arc = Cut((self.x, self.y), cut.start, corner, self.side < 0)
            if kind is Kind.RAPID:
                self._rapid(line, *cut.start, self.z)
            else:
                self._write(line, Kind.ARC, arc, self.z)
        elif outer < -SMALL_CORNER:
            meet = _meeting(before, cut)
            if meet is None or _reversed(before, meet):
                raise fail(line, f"the tool of radius {self.offset:g} mm does not fit into the inner corner")
            self._move_end(before, meet)
            cut.start = meet

    def _move_end(self, before: Cut, place: Point) -> None:
        """Shorten the last move in X and Y, and with it the moves of Z after it."""
        for index in range(self.row, len(self.rows)):
            row = list(self.rows[index])
            if index > self.row:
                row[2:4] = place
            row[5:7] = place
            if index == self.row and before.centre is not None:
                row[10] = sweep_of((row[2], row[3]), place, before.centre, before.ccw)
            self.rows[index] = tuple(row)
        before.end = place
        self.x, self.y = place


def _meeting(a: Cut, b: Cut) -> Point | None:
    """Where two offsets meet, nearest to the corner; None if they do not."""
    points: list[Point] = []
    if a.centre is None and b.centre is None:
        points = _line_line(a, b)
    elif a.centre is None:
        points = _line_circle(a, b)
    elif b.centre is None:
        points = _line_circle(b, a)
    else:
        points = _circle_circle(a, b)
    return min(points, key=lambda p: math.dist(p, a.end) + math.dist(p, b.start), default=None)


def _line_line(a: Cut, b: Cut) -> list[Point]:
    (x, y), (u, v) = a.end, b.start
    one, two = a.heading(a.end), b.heading(b.start)
    across = math.sin(two - one)
    if abs(across) < ONE_PLACE:
        return []
    along = ((u - x) * math.sin(two) - (v - y) * math.cos(two)) / across
    return [(x + along * math.cos(one), y + along * math.sin(one))]


def _line_circle(line: Cut, arc: Cut) -> list[Point]:
    assert arc.centre is not None  # noqa: S101 - the caller has looked
    (x, y), heading = line.end, line.heading(line.end)
    ux, uy = math.cos(heading), math.sin(heading)
    px, py = arc.centre[0] - x, arc.centre[1] - y
    foot, away = px * ux + py * uy, px * uy - py * ux
    half = math.dist(arc.start, arc.centre) ** 2 - away**2
    if half < 0:
        return []
    root = math.sqrt(half)
    return [(x + (foot + s) * ux, y + (foot + s) * uy) for s in (-root, root)]


def _circle_circle(a: Cut, b: Cut) -> list[Point]:
    assert a.centre is not None  # noqa: S101
    assert b.centre is not None  # noqa: S101
    r, s, d = math.dist(a.end, a.centre), math.dist(b.start, b.centre), math.dist(a.centre, b.centre)
    if d < ONE_PLACE or d > r + s or d < abs(r - s):
        return []
    along = (r * r - s * s + d * d) / (2 * d)
    up = math.sqrt(max(r * r - along * along, 0.0))
    ux, uy = (b.centre[0] - a.centre[0]) / d, (b.centre[1] - a.centre[1]) / d
    x, y = a.centre[0] + along * ux, a.centre[1] + along * uy
    return [(x - up * uy, y + up * ux), (x + up * uy, y - up * ux)]


def _reversed(cut: Cut, place: Point) -> bool:
    """Whether a move that ends at ``place`` instead would run backwards."""
    if cut.centre is None:
        (x, y), (u, v) = cut.start, cut.end
        return (u - x) * (place[0] - x) + (v - y) * (place[1] - y) < 0
    whole = abs(sweep_of(cut.start, cut.end, cut.centre, cut.ccw))
    return abs(sweep_of(cut.start, place, cut.centre, cut.ccw)) > whole + ONE_PLACE
