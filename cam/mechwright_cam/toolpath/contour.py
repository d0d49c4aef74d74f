"""The contour that a program with cutter compensation describes, beside the ring that its tool's centre runs.

The ring keeps the distance of the largest tool allowed from the wall. It is followed by lines and arcs
without kinks, and those are moved towards the wall one by one, exactly: an arc keeps its centre. So every
parallel of the contour that the control forms, up to that ring, is made of the same lines and arcs, and none
of them can be too narrow for the tool. An inside corner of the ring becomes an arc about it; an outer corner
of the wall, around which the ring runs on an arc, becomes a corner again.

Glossary
--------
node
    Where one line or arc ends and the next begins.
heading
    Direction of travel, rad.
inset
    Distance of the contour from the ring, mm.
"""

import itertools
import math
import sys
from dataclasses import dataclass, replace

import numpy as np

from mechwright.geometry.segments import Point
from mechwright.motion import Array
from mechwright_cam.toolpath.arcfit import spans
from mechwright_cam.toolpath.path import Cut, Path, arc, line, rounded
from mechwright_cam.toolpath.runs import GREATEST_RADIUS

FLAT = 1e-3
"""A line or arc may leave its node under this angle to the heading there, rad: where the control does not
join the parallels of two such neighbours, a tool of 6 mm is 3 µm further along, and a nanometre nearer."""
SCRAP = 0.1
"""Pieces of a ring below this length, mm, may be what is left of a corner."""
LEFT = 0.003
"""So much stays, mm, in a slight inside corner of the ring that is rounded: a third of the leftover limit."""
SHORTEST = 0.01
"""Shorter lines and arcs are left out, mm: printed with three decimals they would have any direction."""
SHARP = 0.01
"""A contour that would turn on a radius below this, mm, has a corner there."""
ON_EDGE = 4
"""Places on each edge of a run that are looked at."""
HALVINGS = 6
"""So often a run is halved for the sake of its two arcs; then the one arc of the fit has to do."""


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


def contour_beside(ring: Array, inset: float, side: int, tolerance: float) -> Path:
    """The contour beside a ring or a run of one.

    Parameters
    ----------
    ring
        (n, 2), mm; a closed one repeats its first point.
    inset
        Distance to the wall's side, mm.
    side
        1 if the tool runs on the left of the contour, with the wall on its right, else -1.
    tolerance
        Largest deviation from the ring, mm.
    """
    closed = bool(np.all(ring[0] == ring[-1]))
    bends = _smooth(ring, closed, side, tolerance)
    return _path(_sharpened(_moved(bends, closed, inset, side), closed), closed)


# -- along the ring -----------------------------------------------------------------------------------------


def _smooth(ring: Array, closed: bool, side: int, tolerance: float) -> list[Bend]:
    """Lines and arcs along a ring that have one heading at every node but sharp corners."""
    points, nodes, straight, height = spans(ring, tolerance / 2)
    first = [
        _bend(points[a], points[b], bool(s), float(k))
        for a, b, s, k in zip(nodes[:-1], nodes[1:], straight, height, strict=True)
    ]
    runs = [points[a : b + 1] for a, b in itertools.pairwise(nodes)]
    first, runs = _without_scraps(first, runs, closed, side, tolerance)
    start, end = _headings(first, closed, tolerance)
    found: list[Bend] = []
    for bend, run, one, two in zip(first, runs, start, end, strict=True):
        found += _run(run, bend, one, two, tolerance)
    return _filleted(found, closed, side)


def _without_scraps(
    bends: list[Bend], runs: list[Array], closed: bool, side: int, tolerance: float
) -> tuple[list[Bend], list[Array]]:
    """Inside corners in place of scraps: short pieces between two longer ones that all but meet there."""
    long = [math.dist(bend.start, bend.end) >= SCRAP for bend in bends]
    kept = [number for number, is_long in enumerate(long) if is_long]
    if len(kept) < 2:
        return bends, runs
    found, gone = list(bends), set()
    for one, two in zip(kept, [*kept[1:], kept[0]], strict=True):
        between = range(one + 1, two) if one < two else [*range(one + 1, len(bends)), *range(two)]
        if not between or (one > two and not closed):
            continue
        turn = side * _wrapped(found[two].heading(found[two].start) - found[one].heading(found[one].end))
        corner = _meeting(found[one], found[two])
        scraps = np.concatenate([runs[number] for number in between])
        t = np.linspace(0.0, 1.0, ON_EDGE)[:, None]
        places = ((1 - t) * scraps[:-1, None] + t * scraps[1:, None]).reshape(-1, 2)
        if turn > FLAT and np.hypot(*(places - corner).T).min() <= tolerance:
            found[one], found[two] = replace(found[one], end=corner), replace(found[two], start=corner)
            gone |= set(between)
    left = [number for number in range(len(bends)) if number not in gone]
    return [found[number] for number in left], [runs[number] for number in left]


def _filleted(bends: list[Bend], closed: bool, side: int) -> list[Bend]:
    """Slight inside corners rounded, as far as nothing to speak of stays in them.

    An arc in their place would be so short that the rounding of its ends gave it any direction.
    """
    found = list(bends)
    fillets: dict[int, tuple[Bend, Bend]] = {}
    for number in range(0 if closed else 1, len(bends)):
        before, after = found[number - 1], found[number]
        heading, ahead = before.heading(before.end), after.heading(after.start)
        turn = side * _wrapped(ahead - heading)
        if not FLAT < turn < math.pi / 2:
            continue
        radius = 8 * LEFT / turn**2
        back = min(radius * math.tan(turn / 2), *(0.4 * math.dist(b.start, b.end) for b in (before, after)))
        if back < SHORTEST:
            continue
        a, b = _along(before, back, from_end=True), _along(after, back)
        pair = _biarc(a, b, before.heading(a), after.heading(b))
        if pair is not None:
            fillets[number] = pair
            found[number - 1], found[number] = replace(before, end=a), replace(after, start=b)
    return [bend for number, last in enumerate(found) for bend in (*fillets.get(number, ()), last)]


def _along(bend: Bend, way: float, *, from_end: bool = False) -> Point:
    """The place ``way`` mm after the start of a line or arc, or before its end."""
    at = bend.end if from_end else bend.start
    sign = -1.0 if from_end else 1.0
    if not bend.turn:
        heading = bend.heading(at)
        return at[0] + sign * way * math.cos(heading), at[1] + sign * way * math.sin(heading)
    angle = math.atan2(at[1] - bend.centre[1], at[0] - bend.centre[0]) + sign * bend.turn * way / bend.radius
    return bend.centre[0] + bend.radius * math.cos(angle), bend.centre[1] + bend.radius * math.sin(angle)


def _bend(a: Array, b: Array, straight: bool, height: float) -> Bend:
    (x0, y0), (x1, y1) = a.tolist(), b.tolist()
    chord = math.hypot(x1 - x0, y1 - y0)
    if straight or chord == 0:
        return Bend((x0, y0), (x1, y1))
    centre = ((x0 + x1) / 2 - height * (y1 - y0) / chord, (y0 + y1) / 2 + height * (x1 - x0) / chord)
    return Bend((x0, y0), (x1, y1), centre, 1 if height > 0 else -1)


def _headings(bends: list[Bend], closed: bool, tolerance: float) -> tuple[list[float], list[float]]:
    """The heading at the start and at the end of each; neighbours share it, unless they meet in a corner.

    The longer one of two knows its direction better. To bend a run of length l by an angle a at its end takes
    it a l / 8 aside: where that is more than the tolerance, there is a corner.
    """
    start = [bend.heading(bend.start) for bend in bends]
    end = [bend.heading(bend.end) for bend in bends]
    for number in range(0 if closed else 1, len(bends)):
        turn = _wrapped(start[number] - end[number - 1])
        one, two = (math.dist(bend.start, bend.end) for bend in (bends[number - 1], bends[number]))
        if abs(turn) * min(one, two) / 8 > tolerance:
            continue
        share = two**2 / max(one**2 + two**2, sys.float_info.min)
        start[number] = end[number - 1] = end[number - 1] + share * turn
    return start, end


def _run(points: Array, bend: Bend, start: float, end: float, tolerance: float, depth: int = 0) -> list[Bend]:
    """One run between two nodes, with these headings at its ends."""
    aside = (start - bend.heading(bend.start), end - bend.heading(bend.end))
    if max(abs(_wrapped(angle)) for angle in aside) <= FLAT:
        return [bend]
    pair = _biarc(bend.start, bend.end, start, end)
    if pair is not None and _deviation(points, pair) <= tolerance:
        return list(pair)
    if depth == HALVINGS or len(points) < 3:
        return [bend]
    middle = len(points) // 2
    place: Point = (float(points[middle, 0]), float(points[middle, 1]))
    between = bend.heading(place)
    one, two = replace(bend, end=place), replace(bend, start=place)
    return [
        *_run(points[: middle + 1], one, start, between, tolerance, depth + 1),
        *_run(points[middle:], two, between, end, tolerance, depth + 1),
    ]


def _biarc(a: Point, b: Point, start: float, end: float) -> tuple[Bend, Bend] | None:
    """Two arcs from a to b with these headings that touch each other; None if there are none.

    Where both turn the same way they touch along the chord: its ends are at the angles e/2 and s/2 of a
    triangle over it, s and e those of the headings to the chord, and neither arc can turn back. Else both
    tangents are of one length d: 2 (1 - cos) d² + 2 v·(t + u) d - v·v = 0 for the unit headings t, u and the
    way v (Bolton: Biarc curves, Computer-Aided Design 7, 1975).
    """
    vx, vy = b[0] - a[0], b[1] - a[1]
    along, chord = math.atan2(vy, vx), math.hypot(vx, vy)
    tx, ty, ux, uy = math.cos(start), math.sin(start), math.cos(end), math.sin(end)
    one, two = _wrapped(start - along), _wrapped(end - along)
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


def _deviation(points: Array, pair: tuple[Bend, Bend]) -> float:
    """Largest distance of a run from its two arcs, mm, at its vertices and on its edges."""
    one, two = pair
    t = np.linspace(0.0, 1.0, ON_EDGE, endpoint=False)[:, None]
    edges = (1 - t) * points[:-1, None] + t * points[1:, None]
    points = np.concatenate((edges.reshape(-1, 2), points[-1:]))
    q = np.array(one.end)
    split = (points - q) @ (np.array(two.end) - np.array(one.start)) > 0
    worst = 0.0
    for bend, mine in ((one, points[~split]), (two, points[split])):
        if not len(mine):
            continue
        if bend.turn:
            off = np.abs(np.hypot(*(mine - bend.centre).T) - bend.radius)
        else:
            a, b = np.array(bend.start), np.array(bend.end)
            off = np.abs((mine - a) @ np.array((a[1] - b[1], b[0] - a[0]))) / max(math.dist(a, b), 1e-12)
        worst = max(worst, float(off.max()))
    return worst


# -- to the wall --------------------------------------------------------------------------------------------


def _moved(bends: list[Bend], closed: bool, inset: float, side: int) -> list[Bend | None]:
    """All lines and arcs moved to the wall's side; None where an outer corner is, or swallows an arc."""
    found: list[Bend | None] = []
    for number, bend in enumerate(bends):
        shifted = _shifted(bend, inset, side)
        if number or closed:
            before = bends[number - 1]
            turn = side * _wrapped(bend.heading(bend.start) - before.heading(before.end))
            if turn > FLAT:
                found.append(Bend(_shifted(before, inset, side).end, shifted.start, bend.start, side))
            elif turn < -FLAT:
                found.append(None)
        swallowed = bend.turn == -side and bend.radius - inset < SHARP
        found.append(None if swallowed else shifted)
    return found


def _shifted(bend: Bend, inset: float, side: int) -> Bend:
    def aside(at: Point) -> Point:
        out = bend.heading(at) - side * math.pi / 2
        return at[0] + inset * math.cos(out), at[1] + inset * math.sin(out)

    return replace(bend, start=aside(bend.start), end=aside(bend.end))


def _sharpened(bends: list[Bend | None], closed: bool) -> list[Bend]:
    """Outer corners where arcs have been swallowed: their neighbours meet."""
    alive = [number for number, bend in enumerate(bends) if bend is not None]
    if not alive:
        return []
    found = [bend for bend in bends if bend is not None]
    for place in range(len(found) if closed else len(found) - 1):
        after = (place + 1) % len(found)
        if (alive[after] - alive[place]) % len(bends) == 1 or found[after] is found[place]:
            continue
        corner = _meeting(found[place], found[after])
        found[place] = replace(found[place], end=corner)
        found[after] = replace(found[after], start=corner)
    return found


def _meeting(one: Bend, two: Bend) -> Point:
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


def _path(bends: list[Bend], closed: bool) -> Path:
    """The path, rounded as programs print it."""
    kept = [b for b in bends if math.dist(b.start, b.end) >= SHORTEST or b.sweep > math.pi]
    ends = [(rounded(b.end[0]), rounded(b.end[1])) for b in kept]
    here = start = ends[-1] if closed else (rounded(bends[0].start[0]), rounded(bends[0].start[1]))
    cuts: list[Cut] = []
    for bend, end in zip(kept, ends, strict=True):
        if end != here:
            cuts.append(arc(here, end, bend.centre, bend.turn) if bend.turn else line(here, end))
        here = end
    return Path(start, tuple(cuts))


def _wrapped(angle: float) -> float:
    return (angle + math.pi) % math.tau - math.pi
