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
from dataclasses import replace

import numpy as np

from mechwright.arrays import Array
from mechwright.geometry.segments import Point
from mechwright_plane.bends import FLAT, SHARP, Bend, along, biarc, left_of, meeting, places, wrapped
from mechwright_plane.path import Cut, Path, arc, line, printed
from mechwright_plane.runs import over_chord, prepared_polylines, runs_of

SCRAP = 0.1
"""Pieces of a ring below this length, mm, may be what is left of a corner."""
LEFT = 0.003
"""So much stays, mm, in a slight inside corner of the ring that is rounded: a third of the leftover limit."""
SHORTEST = 0.01
"""Shorter lines and arcs are left out, mm: printed with three decimals they would have any direction."""
TRIED = 2
"""Neighbours share a heading where that takes a run aside by so many tolerances, at a guess that is high."""
ON_EDGE = 4
"""Places on each edge of a run that are looked at."""
ON_FILLET = 9
"""Places on either side of a corner at which the arcs that round it are looked at."""
ROUNDED = 0.0007
"""By so much three decimals move the end of a line or arc, mm; its centre turns with its chord."""
HALVINGS = 6
"""So often a run is halved for the sake of its two arcs; then the one arc of the fit has to do."""


def offset_contour(ring: Array, inset: float, side: int, tolerance: float, spare: float = 0.0) -> Path:
    """The contour ``inset`` mm beside a ring (n, 2), mm, or a run of one; a ring repeats its first point.

    ``side`` is 1 if the tool runs on the left of the contour, with the wall on its right, else -1;
    ``tolerance`` is the largest deviation from the ring, mm. The control is asked for parallels up to
    ``spare`` mm from the ring.
    """
    closed = bool(np.all(ring[0] == ring[-1]))
    bends = _smooth(ring, closed, side, tolerance)
    moved = _sharpened(_moved(bends, closed, inset, side), closed)
    return _path(_forward(_without_crumbs(moved, closed), closed, inset - spare, side), closed)


# -- along the ring -----------------------------------------------------------------------------------------


def _smooth(ring: Array, closed: bool, side: int, tolerance: float) -> list[Bend]:
    """Lines and arcs along a ring that have one heading at every node but sharp corners."""
    way = prepared_polylines([ring], tolerance / 2)
    fitted, points = runs_of(way, tolerance / 2), np.column_stack(way.points)
    runs = [points[a : b + 1] for a, b in itertools.pairwise(fitted.nodes)]
    first = [
        _bend(run[0], run[-1], bool(s), float(k))
        for run, s, k in zip(runs, fitted.straight, fitted.height, strict=True)
    ]
    first, runs = _without_scraps(first, runs, closed, side, tolerance)
    start, end = _headings(first, closed, tolerance)
    found: list[Bend] = []
    for bend, run, one, two in zip(first, runs, start, end, strict=True):
        found += _run(run, bend, one, two, tolerance)
    return _filleted(found, closed, side, tolerance)


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
        turn = side * wrapped(found[two].heading(found[two].start) - found[one].heading(found[one].end))
        corner = meeting(found[one], found[two])
        scraps = np.concatenate([runs[number] for number in between])
        t = np.linspace(0.0, 1.0, ON_EDGE)[:, None]
        places = ((1 - t) * scraps[:-1, None] + t * scraps[1:, None]).reshape(-1, 2)
        if turn > FLAT and np.hypot(*(places - corner).T).min() <= tolerance:
            found[one], found[two] = replace(found[one], end=corner), replace(found[two], start=corner)
            gone |= set(between)
    left = [number for number in range(len(bends)) if number not in gone]
    return [found[number] for number in left], [runs[number] for number in left]


def _filleted(bends: list[Bend], closed: bool, side: int, tolerance: float) -> list[Bend]:
    """Slight inside corners rounded, as far as nothing to speak of stays in them.

    An arc in their place would be so short that the rounding of its ends gave it any direction.
    """
    found = list(bends)
    fillets: dict[int, tuple[Bend, Bend]] = {}
    for number in range(0 if closed else 1, len(bends)):
        before, after = found[number - 1], found[number]
        heading, ahead = before.heading(before.end), after.heading(after.start)
        turn = side * wrapped(ahead - heading)
        if not FLAT < turn < math.pi / 2:
            continue
        radius = 8 * LEFT / turn**2
        back = min(radius * math.tan(turn / 2), *(0.4 * math.dist(b.start, b.end) for b in (before, after)))
        # Where they bend themselves, two long arcs in their place would leave them.
        while back >= SHORTEST:
            a, b = along(before, back, from_end=True), along(after, back)
            pair = biarc(a, b, before.heading(a), after.heading(b))
            one, two = replace(before, start=a), replace(after, end=b)
            if pair is not None and _rounds(pair, one, two, side, tolerance):
                fillets[number] = pair
                found[number - 1], found[number] = replace(before, end=a), replace(after, start=b)
                break
            back /= 2
    return [bend for number, last in enumerate(found) for bend in (*fillets.get(number, ()), last)]


def _rounds(pair: tuple[Bend, Bend], one: Bend, two: Bend, side: int, tolerance: float) -> bool:
    """Whether two arcs come no nearer to the wall than what they replace, and leave little in the corner."""
    t = np.linspace(0.0, 1.0, ON_FILLET)
    points = np.concatenate([places(bend, t) for bend in (one, two)])
    inwards = side * _left_of(pair, points)
    return bool(inwards.max() <= tolerance / 4 and inwards.min() >= -LEFT - tolerance / 4)


def _left_of(pair: tuple[Bend, Bend], points: Array) -> Array:
    """Distance (n,) of points to the left of the nearer of two bends, seen along them, mm; in any order."""
    one, two = pair
    second = (points - one.end) @ np.subtract(two.end, one.start) > 0
    return np.concatenate([left_of(one, points[~second]), left_of(two, points[second])])


def _bend(a: Array, b: Array, straight: bool, height: float) -> Bend:
    (x0, y0), (x1, y1) = start, end = a.tolist(), b.tolist()
    if straight or (x0, y0) == (x1, y1):
        return Bend((x0, y0), (x1, y1))
    return Bend((x0, y0), (x1, y1), over_chord(start, end, height), 1 if height > 0 else -1)


def _headings(bends: list[Bend], closed: bool, tolerance: float) -> tuple[list[float], list[float]]:
    """The heading at the start and at the end of each; neighbours share it, unless they meet in a corner.

    The longer one of two knows its direction better. To bend a run of length l by an angle a at its end takes
    it a l / 8 aside at most: where that is much more than the tolerance, there is a corner.
    """
    start = [bend.heading(bend.start) for bend in bends]
    end = [bend.heading(bend.end) for bend in bends]
    for number in range(0 if closed else 1, len(bends)):
        turn = wrapped(start[number] - end[number - 1])
        one, two = (math.dist(bend.start, bend.end) for bend in (bends[number - 1], bends[number]))
        if abs(turn) * min(one, two) / 8 > TRIED * tolerance:
            continue
        share = two**2 / max(one**2 + two**2, sys.float_info.min)
        start[number] = end[number - 1] = end[number - 1] + share * turn
    return start, end


def _run(points: Array, bend: Bend, start: float, end: float, tolerance: float, depth: int = 0) -> list[Bend]:
    """One run between two nodes, with these headings at its ends."""
    aside = (start - bend.heading(bend.start), end - bend.heading(bend.end))
    if max(abs(wrapped(angle)) for angle in aside) <= FLAT:
        return [bend]
    pair = biarc(bend.start, bend.end, start, end)
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


def _deviation(points: Array, pair: tuple[Bend, Bend]) -> float:
    """Largest distance of a run from its two arcs, mm, at its vertices and on its edges."""
    t = np.linspace(0.0, 1.0, ON_EDGE, endpoint=False)[:, None]
    edges = (1 - t) * points[:-1, None] + t * points[1:, None]
    return float(np.abs(_left_of(pair, np.concatenate((edges.reshape(-1, 2), points[-1:])))).max())


# -- to the wall --------------------------------------------------------------------------------------------


def _moved(bends: list[Bend], closed: bool, inset: float, side: int) -> list[Bend | None]:
    """All lines and arcs moved to the wall's side; None where an outer corner is, or swallows an arc."""
    found: list[Bend | None] = []
    for number, bend in enumerate(bends):
        shifted = _shifted(bend, inset, side)
        if number or closed:
            before = bends[number - 1]
            turn = side * wrapped(bend.heading(bend.start) - before.heading(before.end))
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
    return _joined([bend for bend in bends if bend is not None], alive, len(bends), closed)


def _without_crumbs(bends: list[Bend], closed: bool) -> list[Bend]:
    """Lines and arcs without those too short to print; the neighbours of one meet, or it would bend them."""
    while True:
        # Ends of an arc all the way round meet, but then there is no other.
        round_ = closed and len(bends) <= 2
        alive = [
            n
            for n, b in enumerate(bends)
            if math.dist(b.start, b.end) >= SHORTEST or (round_ and b.sweep > math.pi)
        ]
        if len(alive) == len(bends):
            return bends
        # Where they meet they are shorter than before.
        bends = _joined([bends[number] for number in alive], alive, len(bends), closed)


def _forward(bends: list[Bend], closed: bool, inset: float, side: int) -> list[Bend]:
    """Bends none of whose parallels up to ``inset`` mm, on the tool's ``side``, runs back.

    Where two meet under a slight inside angle, the control begins the second parallel where the first one
    ends, past its own start. An arc that ends before that becomes one nearly all the way round: it is left
    out, and its neighbours meet, if the next one is long enough for that.
    """
    lost = [number for number, bend in enumerate(bends) if side * bend.turn > 0]
    while lost and len(bends) > 3:
        number = lost.pop()
        if not closed and number in (0, len(bends) - 1):
            continue
        before, bend, after = (bends[(number + k) % len(bends)] for k in (-1, 0, 1))
        if _left_ahead(before, bend, inset, side) > 0 or _left_ahead(before, after, inset, side) <= 0:
            continue
        kept = [other for other in range(len(bends)) if other != number]
        bends = _without_crumbs(_joined([bends[k] for k in kept], kept, len(bends), closed), closed)
        lost = [other for other, left in enumerate(bends) if side * left.turn > 0]
    return bends


def _left_ahead(before: Bend, bend: Bend, inset: float, side: int) -> float:
    """Length of a bend's parallel after that of the one before it, once they have been rounded, mm."""
    kink = side * wrapped(bend.heading(bend.start) - before.heading(before.end))
    chords = [math.dist(one.start, one.end) for one in (before, bend)]
    length = bend.sweep * (bend.radius - side * bend.turn * inset) if bend.turn else chords[1]
    return length - inset * max(kink + sum(ROUNDED / chord for chord in chords), 0.0)


def _joined(found: list[Bend], numbers: list[int], count: int, closed: bool) -> list[Bend]:
    """Bends that meet where others between them are left out; their ``numbers`` are those among ``count``.

    One that would run backwards then, for its corner lies before its start, shrinks to nothing.
    """
    before = list(found)
    for place in range(len(found) if closed else len(found) - 1):
        after = (place + 1) % len(found)
        if (numbers[after] - numbers[place]) % count == 1 or after == place:
            continue
        corner = meeting(found[place], found[after])
        found[place] = replace(found[place], end=corner)
        found[after] = replace(found[after], start=corner)
    if len(found) <= 2:
        return found
    return [
        replace(bend, end=bend.start) if _runs_back(bend, old) else bend
        for bend, old in zip(found, before, strict=True)
    ]


def _runs_back(bend: Bend, old: Bend) -> bool:
    """Whether a bend whose ends have moved runs back: an arc then goes all but round."""
    if bend.turn:
        return bend.sweep > math.pi + old.sweep / 2
    (x, y), (u, v) = (np.subtract(b.end, b.start).tolist() for b in (bend, old))
    return bool(x * u + y * v < 0)


def _path(bends: list[Bend], closed: bool) -> Path:
    """The path, rounded as programs print it."""
    if not bends:
        return Path((0.0, 0.0), ())
    ends = [printed(bend.end) for bend in bends]
    here = start = ends[-1] if closed else printed(bends[0].start)
    cuts: list[Cut] = []
    for bend, end in zip(bends, ends, strict=True):
        if end != here:
            cuts.append(arc(here, end, bend.centre, bend.turn) if bend.turn else line(here, end))
        here = end
    return Path(start, tuple(cuts))
