"""What is drawn twice: equal and overlapping lines and arcs become one.

Other programs draw an edge once for each face that has it. Lines of one straight line that overlap, and arcs
of one circle that do, become what they cover together; splines go where they are equal.
"""

import math
from collections.abc import Iterable, Sequence

import numpy as np
import shapely

from mechwright.arrays import Array
from mechwright.drawings.fault import Told, at
from mechwright.drawings.strokes import Stroke
from mechwright.geometry import Arc, BSpline, Line, Segment
from mechwright.tolerances import TOLERANCES

SAME = TOLERANCES.outline
"""Curves within this of each other are one, mm: ten times what drawings are rounded to."""
CHORD = 0.01
"""Chord error of the curves among which near ones are sought, mm."""

Piece = tuple[Segment, Stroke]


def single(pieces: Sequence[Piece], told: Told) -> list[Piece]:
    """The pieces of one layer without what is drawn twice; what was drawn over is noted with its place."""
    given, pieces = pieces, _different(pieces)
    if len(given) > len(pieces):
        told.note(f"drawn twice, to the last digit: {len(given) - len(pieces)} curves; each is taken once")
    left: dict[int, Piece] = dict(enumerate(pieces))
    shapes = [shapely.LineString(segment.flatten(CHORD)) for segment, _ in pieces]
    tree = shapely.STRtree(shapes)
    first, second = tree.query(shapes, predicate="dwithin", distance=2 * CHORD)
    near: dict[int, list[int]] = {}
    for i, j in zip(first.tolist(), second.tolist(), strict=True):
        if i < j:
            near.setdefault(j, []).append(i)
    into: dict[int, int] = {}
    count = 0

    def head(i: int) -> int:
        while i in into:
            i = into[i]
        return i

    for j in range(len(pieces)):
        for i in near.get(j, ()):
            one, two = head(i), head(j)
            if one == two:
                continue
            whole = united(left[one][0], left[two][0])
            if whole is None:
                continue
            low, high = sorted((one, two))
            left[low] = (whole, left[low][1])
            del left[high]
            into[high] = low
            count += 1
            if count <= 3:
                told.note(f"drawn twice: {pieces[j][1].name}, at {at(_middle(pieces[j][0]))}; taken once")
    if count > 3:
        told.note(f"drawn twice, or over each other: {count} curves in all; each is taken once")
    return list(left.values())


def _different(pieces: Sequence[Piece]) -> list[Piece]:
    """The pieces without copies, also those drawn the other way: found at once, however many there are."""
    found: dict[object, Piece] = {}
    for piece in pieces:
        ends = [tuple(round(v, _DIGITS) + 0.0 for v in row) for row in piece[0].at([0.0, 1.0]).tolist()]
        middle = tuple(round(v, _DIGITS) + 0.0 for v in _middle(piece[0]))
        found.setdefault((type(piece[0]), *sorted(ends), middle, _form(piece[0])), piece)
    return list(found.values())


_DIGITS = 6
"""Decimals of mm to which copies are alike."""


def _form(segment: Segment) -> object:
    """What else tells curves apart that share their ends and their middle."""
    if isinstance(segment, BSpline):
        return frozenset((round(x, _DIGITS), round(y, _DIGITS)) for x, y in segment.points)
    return round(segment.radius, _DIGITS) if isinstance(segment, Arc) else None


def _middle(segment: Segment) -> tuple[float, float]:
    x, y = segment.at(0.5)[0]
    return float(x), float(y)


def united(one: Segment, two: Segment) -> Segment | None:
    """What two curves that lie on each other cover; None if they do not, or only meet.

    >>> united(Line((0.0, 0.0), (10.0, 0.0)), Line((12.0, 0.0), (4.0, 0.0)))
    Line(start=(0.0, 0.0), end=(12.0, 0.0), tag='')
    """
    if isinstance(one, Line) and isinstance(two, Line):
        return _lines(one, two)
    if isinstance(one, Arc) and isinstance(two, Arc):
        return _arcs(one, two)
    if isinstance(one, BSpline) and isinstance(two, BSpline) and one.degree == two.degree:
        for other in (two, two.reversed()):
            if len(one.points) == len(other.points) and _near(one.points, other.points):
                return one
    return None


def _near(points: Iterable[tuple[float, float]], others: Iterable[tuple[float, float]]) -> bool:
    return all(math.dist(a, b) <= SAME for a, b in zip(points, others, strict=True))


def _lines(one: Line, two: Line) -> Line | None:
    if math.dist(*_ends(one)) < math.dist(*_ends(two)):
        one, two = two, one
    a, b = (np.array(point) for point in _ends(one))
    length = float(np.hypot(*(b - a)))
    along = (b - a) / length
    across = np.array([-along[1], along[0]])
    others = np.array(_ends(two))
    if np.abs((others - a) @ across).max() > SAME:
        return None
    low, high = sorted(float(value) for value in (others - a) @ along)
    if min(high, length) - max(low, 0.0) <= SAME:
        return None
    start = one.start if low >= -SAME else _nearest(two, a + low * along)
    end = one.end if high <= length + SAME else _nearest(two, a + high * along)
    return Line(start, end)


def _ends(line: Line) -> tuple[tuple[float, float], tuple[float, float]]:
    return line.start, line.end


def _nearest(line: Line, place: Array) -> tuple[float, float]:
    return min(_ends(line), key=lambda end: math.dist(end, place))


def _arcs(one: Arc, two: Arc) -> Arc | None:
    if math.dist(one.centre, two.centre) > SAME or abs(one.radius - two.radius) > SAME:
        return None
    if abs(one.sweep) < abs(two.sweep):
        one, two = two, one
    if one.is_circle:
        return one
    slack = SAME / one.radius
    first, sweep = (
        (one.start_angle, one.sweep) if one.sweep > 0 else (one.start_angle + one.sweep, -one.sweep)
    )
    other, turn = (two.start_angle, two.sweep) if two.sweep > 0 else (two.start_angle + two.sweep, -two.sweep)
    low = (other - first + slack) % math.tau - slack  # where the other begins, from the start of the first
    if low <= sweep - slack:
        end = max(sweep, low + turn) if low + turn > sweep + slack else sweep
        return Arc(one.centre, one.radius, first, min(end, math.tau))
    if low + turn > math.tau + slack:  # it begins before, and reaches in
        start = low - math.tau
        return Arc(one.centre, one.radius, first + start, min(max(sweep, start + turn) - start, math.tau))
    return None
