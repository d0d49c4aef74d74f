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
MORE_TURN, MORE_TURN_INCH = 0.0254, 0.001
"""By so much an arc beside the contour may turn further than the programmed one, rad, in mm and in inches."""
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
    """Direction of the programmed line, which its offset keeps when its ends are moved, rad."""
    sweep: float = math.inf
    """Angle of the programmed arc, rad, without its sign."""
    offset: float = 0.0
    """By so much the arc was moved, mm."""
    entry: bool = False
    """Whether it is the entry move, whose offset only ends beside the contour."""

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
            raise self.astray(line, "compensation", "XY")
        self.side, self.offset = (side, diameter / 2) if diameter >= 0 else (-side, -diameter / 2)
        self.contour, self.last, self.fresh = self.left or (self.x, self.y), None, True
        self.left = None

    def end_compensation(self, line: int) -> None:
        """G40: the next move leads from the tool's centre to the contour, in axes that it does not name."""
        if self.side and not self.fresh and self.offset > ONE_PLACE:
            self.check_last_move(line)
            self.left = self.contour
        self.side = 0

    def check_last_move(self, line: int) -> None:
        """Raise ProgramError if no move follows, and the last one does not fit into the corner before it."""
        if self.side and not self.fresh and self.offset > ONE_PLACE:
            self._check_forward(line)

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
            if self.fresh and self.offset > ONE_PLACE and not self.dialect.entry_along_z:
                raise fail(
                    line, "the first move after G41 or G42 goes nowhere in X and Y; write Z in a line before"
                )
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
            return Cut(here, self._aside(end, along), along=along, entry=True)
        if not self.dialect.arc_entry:
            raise fail(line, "compensation is turned on along an arc; enter on a line")
        self._check_arc(line, here, end, centre)
        inside = (self.side > 0) == ccw
        if inside and math.dist(here, centre) <= self.offset:
            raise fail(line, f"the tool of radius {self.offset:g} mm does not fit into the entry arc")
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
        middle = (target[0] + reach * nx, target[1] + reach * ny)
        return Cut(here, target, middle, reach > 0, sweep=abs(sweep_of(here, target, middle, reach > 0)))

    def _aside(self, point: Point, heading: float) -> Point:
        """The place of the tool beside a point of the contour."""
        dx, dy = self._away(heading)
        return point[0] + dx, point[1] + dy

    def _away(self, heading: float) -> Point:
        """From the contour to the tool, where the contour goes in this direction."""
        out = heading + self.side * math.pi / 2
        return self.offset * math.cos(out), self.offset * math.sin(out)

    def _beside(self, line: int, start: Point, end: Point, centre: Point | None, ccw: bool) -> Cut:
        move = Cut(start, end, centre, ccw)
        sweep = math.inf
        if centre is None:
            move.along = move.heading(end)
        else:
            self._check_arc(line, start, end, centre)
            sweep = abs(sweep_of(start, end, centre, ccw))
            inside = (self.side > 0) == ccw
            if inside and math.dist(start, centre) <= self.offset:
                raise fail(
                    line,
                    f"the tool of radius {self.offset:g} mm does not fit into an arc of radius "
                    f"{math.dist(start, centre):.3f} mm",
                )
        if move.along is None:
            first, last = (self._aside(point, move.heading(point)) for point in (start, end))
        else:
            dx, dy = self._away(move.along)
            first, last = (start[0] + dx, start[1] + dy), (end[0] + dx, end[1] + dy)
        return Cut(first, last, centre, ccw, move.along, sweep, self.offset)

    def _join(self, line: int, kind: Kind, corner: Point, cut: Cut) -> None:
        """Lead from the last offset to the next one, around or into the corner between them."""
        before = self.last
        assert before is not None  # noqa: S101 - there was an entry
        if self.offset <= ONE_PLACE:
            return  # without a radius there is nothing between the two
        turn = cut.heading(cut.start) - before.heading(before.end)
        turn = (turn + math.pi) % math.tau - math.pi
        outer = -self.side * turn  # positive away from the tool: around the outside of the corner
        if outer < SMALL_CORNER - math.pi:  # back the way it came: around, not between
            outer += math.tau
        # Where a line turns back beside an arc that the tool rolls over, it stays above both.
        arc = before if cut.centre is None else cut
        over = arc.centre is not None and (self.side > 0) != arc.ccw
        if outer > SMALL_CORNER and not (over and outer > math.pi - SMALL_CORNER):
            if cut.centre is None:
                self._check_forward(line)
            arc = Cut((self.x, self.y), cut.start, corner, self.side < 0)
            if kind is Kind.RAPID:
                self._rapid(line, *cut.start, self.z)
            else:
                self._write(line, Kind.ARC, arc, self.z)
        elif abs(outer) > SMALL_CORNER:
            meet = _meeting(before, cut, self.side, outer)
            if meet is None:
                raise fail(line, f"the tool of radius {self.offset:g} mm does not fit into the inner corner")
            self._check_forward(line, meet)
            self._move_end(before, meet)
            cut.start = meet
        else:
            cut.start = self.x, self.y

    def _check_forward(self, line: int, end: Point | None = None) -> None:
        """Raise ProgramError if the last move, ended here or at a place, runs against what is programmed.

        Its start was moved into an inner corner, and lies beyond that end then.
        """
        move = self.last
        if move is None or move.entry:
            return  # of an entry move the control asks on which side it ends, and there is one alone
        end = end or move.end
        if move.centre is not None:
            slack = MORE_TURN_INCH if self.scale != 1.0 else MORE_TURN
            backward = abs(sweep_of(move.start, end, move.centre, move.ccw)) > move.sweep + slack
        else:
            heading = move.heading(end)
            way = end[0] - move.start[0], end[1] - move.start[1]
            backward = way[0] * math.cos(heading) + way[1] * math.sin(heading) < -ONE_PLACE
        if backward:
            raise fail(line, f"the tool of radius {self.offset:g} mm does not fit into the inner corner")

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


def _meeting(a: Cut, b: Cut, side: int, outer: float) -> Point | None:
    """Where two offsets meet at a corner that turns by ``outer`` away from the tool; None if they do not.

    Of two such places it is the one that LinuxCNC takes.
    """
    try:
        if a.centre is None:
            return _line_line(a, b) if b.centre is None else _line_arc(a, b, side, outer)
        return _arc_line(a, b, side) if b.centre is None else _arc_arc(a, b, side)
    except (ValueError, ZeroDivisionError):  # of asin, acos: they are apart
        return None


def _line_line(a: Cut, b: Cut) -> Point | None:
    (x, y), (u, v) = a.end, b.start
    one, two = a.heading(a.end), b.heading(b.start)
    across = math.sin(two - one)
    if abs(across) < ONE_PLACE:
        return None
    along = ((u - x) * math.sin(two) - (v - y) * math.cos(two)) / across
    return x + along * math.cos(one), y + along * math.sin(one)


def _at(centre: Point, radius: float, angle: float) -> Point:
    return centre[0] + radius * math.cos(angle), centre[1] + radius * math.sin(angle)


def _line_arc(a: Cut, b: Cut, side: int, outer: float) -> Point:
    assert b.centre is not None  # noqa: S101 - the caller has looked
    turn, radius, heading = 1 if b.ccw else -1, math.dist(b.end, b.centre), a.heading(a.end)
    # How far the centre lies beside the line that is offset: the arc itself is larger by the offset.
    away = math.asin((b.offset * side * turn - (radius + b.offset * side * turn) * math.cos(outer)) / radius)
    return _at(b.centre, radius, heading + turn * away if side == turn else heading + math.pi - turn * away)


def _arc_line(a: Cut, b: Cut, side: int) -> Point:
    assert a.centre is not None  # noqa: S101
    across = b.heading(b.start) + (math.pi / 2 if a.ccw else -math.pi / 2)
    away = (a.centre[0] - b.start[0]) * math.cos(across) + (a.centre[1] - b.start[1]) * math.sin(across)
    radius = math.dist(a.end, a.centre)
    return _at(a.centre, radius, across + math.pi - side * math.acos(away / radius))


def _arc_arc(a: Cut, b: Cut, side: int) -> Point:
    assert a.centre is not None  # noqa: S101
    assert b.centre is not None  # noqa: S101
    r, s, d = math.dist(a.end, a.centre), math.dist(b.end, b.centre), math.dist(a.centre, b.centre)
    back = math.acos((r * r + d * d - s * s) / (2 * r * d)) * (1 if b.ccw else -1)
    towards = math.atan2(b.centre[1] - a.centre[1], b.centre[0] - a.centre[0])
    inside = (side > 0) == a.ccw
    return _at(a.centre, r, towards + back if inside else towards - back)
