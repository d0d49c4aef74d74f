"""Lines and arcs that a contour is made of: their headings, where two meet, two arcs between two headings."""

import math
from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright.geometry.segments import Point
from mechwright_plane.runs import GREATEST_RADIUS

FLAT = 1e-3
"""A line or arc may leave its node under this angle to the heading there, rad: where the control does not
join the parallels of two such neighbours, a tool of 6 mm is 3 µm further along, and a nanometre nearer."""
SHARP = 0.01
"""A contour that would turn on a radius below this, mm, has a corner there."""


@dataclass(frozen=True)
class Bend:
    """A line, or an arc about ``centre`` that turns ``turn`` (+1 to the left, -1 to the right)."""

    start: Point
    end: Point
    centre: Point = (0.0, 0.0)
    turn: int = 0

    @property
    def radius(self) -> float:
        """Radius of the arc, mm; inf for a line."""
        return math.dist(self.start, self.centre) if self.turn else math.inf

    @property
    def sweep(self) -> float:
        """Angle of the arc, rad, positive; 0 for a line."""
        if not self.turn:
            return 0.0
        a = math.atan2(self.start[1] - self.centre[1], self.start[0] - self.centre[0])
        b = math.atan2(self.end[1] - self.centre[1], self.end[0] - self.centre[0])
        return ((b - a) * self.turn) % math.tau

    def heading(self, at: Point) -> float:
        """Direction of travel at one of its ends, rad."""
        if not self.turn:
            return math.atan2(self.end[1] - self.start[1], self.end[0] - self.start[0])
        return math.atan2(at[1] - self.centre[1], at[0] - self.centre[0]) + self.turn * math.pi / 2


def wrapped(angle: float) -> float:
    """An angle as one from -π to π, rad."""
    return (angle + math.pi) % math.tau - math.pi


def along(bend: Bend, way: float, *, from_end: bool = False) -> Point:
    """The place ``way`` mm after the start of a line or arc, or before its end."""
    at = bend.end if from_end else bend.start
    sign = -1.0 if from_end else 1.0
    if not bend.turn:
        heading = bend.heading(at)
        return at[0] + sign * way * math.cos(heading), at[1] + sign * way * math.sin(heading)
    angle = math.atan2(at[1] - bend.centre[1], at[0] - bend.centre[0]) + sign * bend.turn * way / bend.radius
    return bend.centre[0] + bend.radius * math.cos(angle), bend.centre[1] + bend.radius * math.sin(angle)


def places(bend: Bend, t: Array) -> Array:
    """Points (n, 2) at shares (n,) of the way along a line or arc."""
    start, end = np.array(bend.start), np.array(bend.end)
    if not bend.turn:
        return np.asarray(start + t[:, None] * (end - start))
    angle = math.atan2(*(start - bend.centre)[::-1]) + bend.turn * bend.sweep * t
    return np.array(bend.centre) + bend.radius * np.column_stack((np.cos(angle), np.sin(angle)))


def left_of(bend: Bend, points: Array) -> Array:
    """Distance (n,) of points to the left of a line or arc, mm; negative to the right."""
    if bend.turn:
        return np.asarray(bend.turn * (bend.radius - np.hypot(*(points - bend.centre).T)))
    heading = bend.heading(bend.start)
    x, y = (points - bend.start).T
    return np.asarray(y * math.cos(heading) - x * math.sin(heading))


def biarc(a: Point, b: Point, start: float, end: float) -> tuple[Bend, Bend] | None:
    """Two arcs from a to b with these headings that touch each other; None if there are none.

    Where both turn the same way they touch along the chord: its ends are at the angles e/2 and s/2 of a
    triangle over it, s and e those of the headings to the chord, and neither arc can turn back. Else both
    tangents are of one length d: 2 (1 - cos) d² + 2 v·(t + u) d - v·v = 0 for the unit headings t, u and the
    way v (Bolton: Biarc curves, Computer-Aided Design 7, 1975).
    """
    vx, vy = b[0] - a[0], b[1] - a[1]
    along, chord = math.atan2(vy, vx), math.hypot(vx, vy)
    tx, ty, ux, uy = math.cos(start), math.sin(start), math.cos(end), math.sin(end)
    one, two = wrapped(start - along), wrapped(end - along)
    if chord == 0:
        return None
    if one * two < 0:
        first = chord * math.sin(two / 2) / math.sin((two - one) / 2)
        way = along + one / 2
        q = (a[0] + first * math.cos(way), a[1] + first * math.sin(way))
        return _from_heading(a, q, tx, ty), _to_heading(q, b, ux, uy)
    square = 2 * (1 - (tx * ux + ty * uy))
    half = vx * (tx + ux) + vy * (ty + uy)
    if half <= 0:
        return None
    d = chord**2 / (half + math.sqrt(half * half + square * chord**2))
    q = ((a[0] + b[0] + d * (tx - ux)) / 2, (a[1] + b[1] + d * (ty - uy)) / 2)
    return _from_heading(a, q, tx, ty), _to_heading(q, b, ux, uy)


def _from_heading(a: Point, b: Point, tx: float, ty: float) -> Bend:
    """The arc from a to b that leaves a under a heading."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    across = 2 * (-ty * dx + tx * dy)
    square = dx * dx + dy * dy
    if abs(across) * GREATEST_RADIUS <= square:
        return Bend(a, b)
    reach = square / across
    return Bend(a, b, (a[0] - reach * ty, a[1] + reach * tx), 1 if reach > 0 else -1)


def _to_heading(a: Point, b: Point, ux: float, uy: float) -> Bend:
    back = _from_heading(b, a, -ux, -uy)
    return Bend(a, b, back.centre, -back.turn)


def meeting(one: Bend, two: Bend) -> Point:
    """Where two lines or arcs meet that end near each other; half way between them if they do not."""
    (x0, y0), (x1, y1) = one.end, two.start
    middle = ((x0 + x1) / 2, (y0 + y1) / 2)
    if not (one.turn or two.turn):
        places = _line_line(one, two)
    elif one.turn and two.turn:
        places = _circle_circle(one, two)
    else:
        places = _line_circle(two, one) if one.turn else _line_circle(one, two)
    near = [place for place in places if math.dist(place, middle) <= math.dist(one.end, two.start) + SHARP]
    return min(near, key=lambda place: math.dist(place, middle), default=middle)


def _line_line(one: Bend, two: Bend) -> list[Point]:
    a, b = one.heading(one.end), two.heading(two.start)
    across = math.sin(b - a)
    if abs(across) < FLAT:
        return []
    dx, dy = two.start[0] - one.end[0], two.start[1] - one.end[1]
    along = (dx * math.sin(b) - dy * math.cos(b)) / across
    return [(one.end[0] + along * math.cos(a), one.end[1] + along * math.sin(a))]


def _line_circle(straight: Bend, round_: Bend) -> list[Point]:
    a = straight.heading(straight.start)
    ux, uy = math.cos(a), math.sin(a)
    px, py = round_.centre[0] - straight.start[0], round_.centre[1] - straight.start[1]
    foot, away = px * ux + py * uy, px * uy - py * ux
    half = math.sqrt(max(round_.radius**2 - away**2, 0.0))
    return [
        (straight.start[0] + along * ux, straight.start[1] + along * uy)
        for along in (foot - half, foot + half)
    ]


def _circle_circle(one: Bend, two: Bend) -> list[Point]:
    r, s, apart = one.radius, two.radius, math.dist(one.centre, two.centre)
    if apart < SHARP:
        return []
    along = (r * r - s * s + apart * apart) / (2 * apart)
    up = math.sqrt(max(r * r - along * along, 0.0))
    ux, uy = (two.centre[0] - one.centre[0]) / apart, (two.centre[1] - one.centre[1]) / apart
    x, y = one.centre[0] + along * ux, one.centre[1] + along * uy
    return [(x - up * uy, y + up * ux), (x + up * uy, y - up * ux)]
