"""Outlines of links, discs and plates, from lines and arcs alone. Points are complex numbers x + i y, mm."""

import cmath
import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise

from mechwright.errors import GeometryError
from mechwright.geometry import Arc, Line, Loop, Outline, Segment, circle
from mechwright.geometry.segments import Point
from mechwright.tolerances import TOLERANCES

FILLET = 5.0
"""Radius between web and boss, mm: end mills up to 10 mm go round it. Links too short for it get none."""

_KEPT = 128
"""Links that are kept: of designs tried one after the other most are alike."""

SAME_DIRECTION = 1e-9
"""Tangents closer in direction than this, rad, are one line along three bosses of a row."""


@dataclass(frozen=True)
class Boss:
    """A round end of a link.

    Parameters
    ----------
    centre
        x + i y, mm.
    radius
        Outside, mm.
    bore
        Diameter of its bore, mm; 0 for none.
    tag
        What the bore is for.
    """

    centre: complex
    radius: float
    bore: float = 0.0
    tag: str = "bore"


def _point(z: complex) -> Point:
    return z.real, z.imag


def bores(bosses: Sequence[Boss]) -> tuple[Loop, ...]:
    """The bores of the bosses that have one, as inner loops."""
    return tuple(
        Loop((circle(_point(boss.centre), boss.bore / 2, clockwise=True, tag=boss.tag),))
        for boss in bosses
        if boss.bore > 0
    )


def hull_link(bosses: Sequence[Boss]) -> Outline:
    """The shortest outline around all bosses, one at least: a straight link for two, a ternary one for three.

    >>> link = hull_link([Boss(0j, 5, 4), Boss(20 + 0j, 5, 4)])
    >>> round(link.area - (20 * 10 + 25 * math.pi - 8 * math.pi), 9)
    0.0
    """
    return _hull(tuple(bosses))


@lru_cache(_KEPT)
def _hull(bosses: tuple[Boss, ...]) -> Outline:
    if not bosses:
        raise GeometryError("a link needs at least one boss")
    shown = [boss for number, boss in enumerate(bosses) if not _covered(boss, number, bosses)]
    if len(shown) == 1:
        return Outline(_ring(shown[0]), bores(bosses))
    # At each normal direction the boss that reaches furthest is on the outline; walk counter-clockwise.
    heading = -math.pi
    furthest = max(_reach(boss, heading) for boss in shown)
    row = [k for k, boss in enumerate(shown) if _reach(boss, heading) >= furthest - 2 * TOLERANCES.closure]
    # Of several in a row, begin with the last that the walk comes by.
    current = max(row, key=lambda k: _reach(shown[k], heading + math.pi / 2) - shown[k].radius)
    corners: list[tuple[int, float, int]] = []
    for _ in range(2 * len(shown)):  # the outline of n circles has at most 2 n - 2 tangents
        advance, following = _next_tangent(shown, current, heading)
        if corners and (current, following) == (corners[0][0], corners[0][2]):
            return Outline(_wrapped(shown, corners), bores(bosses))
        heading += advance
        corners.append((current, heading, following))
        current = following
    raise GeometryError("the bosses of a link lie too close together to go round them")


def _covered(boss: Boss, number: int, bosses: Sequence[Boss]) -> bool:
    """Whether another boss holds all of this one; of two equal ones the first stays."""
    for place, other in enumerate(bosses):
        spare = other.radius - boss.radius - abs(other.centre - boss.centre) + TOLERANCES.closure
        equal = abs(other.radius - boss.radius) <= 2 * TOLERANCES.closure
        if place != number and spare >= 0 and (not equal or place < number):
            return True
    return False


def _reach(boss: Boss, heading: float) -> float:
    return (boss.centre * cmath.exp(-1j * heading)).real + boss.radius


def _ring(boss: Boss) -> Loop:
    return Loop((circle(_point(boss.centre), boss.radius, tag="boss"),))


def _next_tangent(bosses: Sequence[Boss], current: int, heading: float) -> tuple[float, int]:
    """How far the outward normal turns on a boss before another one takes over, and which."""
    one = bosses[current]
    found: list[tuple[float, float, int]] = []
    for number, other in enumerate(bosses):
        if number == current:
            continue
        between = other.centre - one.centre
        normal = cmath.phase(between) - math.acos((one.radius - other.radius) / abs(between))
        advance = (normal - heading) % math.tau
        found.append((0.0 if advance > math.tau - SAME_DIRECTION else advance, abs(between), number))
    least = min(advance for advance, _, _ in found)
    # Of several on one tangent the farthest.
    advance, _, following = max(
        (item for item in found if item[0] <= least + SAME_DIRECTION), key=lambda item: item[1]
    )
    return advance, following


def _wrapped(bosses: Sequence[Boss], corners: Sequence[tuple[int, float, int]]) -> Loop:
    """Arcs on the bosses and tangents between them; a corner is boss, normal where it is left, next boss."""
    segments: list[Segment] = []
    for place, (current, leave, following) in enumerate(corners):
        arrive = corners[place - 1][1]
        boss, other, normal = bosses[current], bosses[following], cmath.exp(1j * leave)
        sweep = (leave - arrive) % math.tau
        if sweep > SAME_DIRECTION:
            segments.append(Arc(_point(boss.centre), boss.radius, leave - sweep, sweep, "boss"))
        segments.append(
            Line(
                _point(boss.centre + boss.radius * normal),
                _point(other.centre + other.radius * normal),
                "web",
            )
        )
    return Loop(tuple(segments))


def web_link(one: Boss, two: Boss, width: float, fillet: float) -> Outline:
    """A straight link whose web, ``width`` mm wide, is narrower than either of its bosses.

    ``fillet`` is the radius between web and boss, mm; a cutter of that radius goes round it. Raises
    GeometryError with the limit where the web is too wide, or the fillets need more length than there is.

    >>> link = web_link(Boss(0j, 8), Boss(40 + 0j, 6), 6, 4)
    >>> [segment.tag for segment in link.outer.segments].count("fillet")
    4
    """
    return _webbed(one, two, (), width, fillet)


def straight_link(one: Boss, two: Boss, width: float) -> Outline:
    """A web between two bosses, or their hull where there is no room for the fillets of a web.

    >>> [len(straight_link(Boss(0j, 8), Boss(x + 0j, 8), 6).outer.segments) for x in (20, 40)]
    [4, 8]
    """
    half = width / 2
    if half < min(one.radius, two.radius):
        taken = sum(_fillet_reach(boss, half, FILLET) for boss in (one, two))
        if taken < abs(two.centre - one.centre):
            return web_link(one, two, width, FILLET)
    return hull_link((one, two))


def bent_link(one: Boss, two: Boss, elbow: complex, width: float, fillet: float, radius: float) -> Outline:
    """A link whose web goes by way of an elbow, rounded to ``radius``, mm, on the web's middle.

    Raises as :func:`web_link`, and where the bend is tighter than the web is wide, or longer than its legs,
    or where bosses, legs and fillets run into each other.

    >>> link = bent_link(Boss(0j, 8), Boss(60 + 0j, 8), 30 + 15j, 8, 5, 10)
    >>> 8 < link.bounds[3] < 15 + 4, round(link.bounds[1], 3)
    (True, -8.0)
    """
    made = _webbed(one, two, (elbow,), width, fillet, radius)
    try:
        made.polygon()
    except GeometryError as error:
        raise GeometryError(
            f"bosses of {2 * one.radius:g} and {2 * two.radius:g} mm, {abs(two.centre - one.centre):.4g} mm "
            "apart, and the legs of the bent link run into each other"
        ) from error
    return made


@lru_cache(_KEPT)
def _webbed(
    one: Boss, two: Boss, elbows: tuple[complex, ...], width: float, fillet: float, radius: float = 0.0
) -> Outline:
    half = width / 2
    least = min(one.radius, two.radius)
    if not 0 < half < least:
        raise GeometryError(
            f"a web of {width:g} mm does not fit between bosses; it must be below {2 * least:g} mm"
        )
    path = (one.centre, *elbows, two.centre)
    starts = [_fillet_reach(boss, half, fillet) for boss in (one, two)]
    right = _side(path, half, starts, radius)
    # The other side is the right one of the way back.
    left = _side(path[::-1], half, starts[::-1], radius)
    segments = (
        *_around(one, path[0], path[1], path[0], half, fillet)[1:],
        *right,
        *_around(two, path[-1], path[-2], path[-1], half, fillet),
        *left,
        *_around(one, path[0], path[1], path[0], half, fillet)[:1],
    )
    return Outline(Loop(segments), bores((one, two)))


def _fillet_reach(boss: Boss, half: float, fillet: float) -> float:
    """Distance along the web from the boss's centre to where the fillet ends."""
    return math.sqrt((boss.radius + fillet) ** 2 - (half + fillet) ** 2)


def _around(
    boss: Boss, centre: complex, towards: complex, at: complex, half: float, fillet: float
) -> tuple[Segment, Segment, Segment]:
    """Fillet, arc round the boss, fillet: counter-clockwise, as seen by who comes along the web."""
    along = (towards - centre) / abs(towards - centre)
    reach = _fillet_reach(boss, half, fillet)
    out = math.atan2(half + fillet, reach)
    base = cmath.phase(along)
    # In the frame of the web, which leaves the boss along +x, we come in at y = +half and leave at -half.
    first = at + along * complex(reach, half + fillet)
    last = at + along * complex(reach, -half - fillet)
    turn = math.pi / 2 - out
    return (
        Arc(_point(first), fillet, base - math.pi / 2, -turn, "fillet"),
        Arc(_point(at), boss.radius, base + out, math.tau - 2 * out, "boss"),
        Arc(_point(last), fillet, base + math.pi - out, -turn, "fillet"),
    )


def _side(
    path: Sequence[complex], half: float, starts: Sequence[float], radius: float
) -> tuple[Segment, ...]:
    """The right side of the web along a path of one or two legs."""
    legs = [(b - a) / abs(b - a) for a, b in pairwise(path)]
    if len(legs) == 1:
        room = abs(path[1] - path[0]) - sum(starts)
        if room <= 0:
            raise GeometryError(
                f"fillets of {sum(starts):.4g} mm do not fit bosses {abs(path[1] - path[0]):.4g} mm apart; "
                "take a smaller fillet or a wider web"
            )
        a = path[0] + legs[0] * complex(starts[0], -half)
        b = path[1] + legs[0] * complex(-starts[1], -half)
        return (Line(_point(a), _point(b), "web"),)
    turn = cmath.phase(legs[1] / legs[0])
    taken = radius * math.tan(abs(turn) / 2)
    if radius <= half:
        raise GeometryError(f"the bend's radius is {radius:g} mm; it must be above half the web, {half:g} mm")
    for leg, start in zip((abs(path[1] - path[0]), abs(path[2] - path[1])), starts, strict=True):
        if leg <= start + taken:
            raise GeometryError(
                f"a leg of the bent link is {leg:.4g} mm long; fillet and bend need {start + taken:.4g} mm"
            )
    side = math.copysign(1.0, turn) if turn else 1.0
    centre = path[1] - legs[0] * taken + legs[0] * 1j * side * radius
    # Right of the path is outside a left bend.
    offset = radius + side * half
    a = path[0] + legs[0] * complex(starts[0], -half)
    b = path[1] + legs[0] * complex(-taken, -half)
    c = path[1] + legs[1] * complex(taken, -half)
    d = path[2] + legs[1] * complex(-starts[1], -half)
    bend = Arc(_point(centre), offset, cmath.phase(-legs[0] * 1j * side), turn, "bend")
    return (Line(_point(a), _point(b), "web"), bend, Line(_point(c), _point(d), "web"))


def disc(radius: float, holes: Sequence[Boss], centre: complex = 0j) -> Outline:
    """A round plate with the bores of ``holes``."""
    return Outline(Loop((circle(_point(centre), radius, tag="rim"),)), bores(holes))


def rectangle(low: complex, high: complex, corner: float, holes: Sequence[Boss] = ()) -> Outline:
    """A plate from ``low`` to ``high``, corners rounded to ``corner``, mm; GeometryError if it is too small.

    >>> round(rectangle(0j, 10 + 6j, 1.0).area - (60 - 4 + math.pi), 9)
    0.0
    """
    return _rectangle(low, high, corner, tuple(holes))


@lru_cache(_KEPT)
def _rectangle(low: complex, high: complex, corner: float, holes: tuple[Boss, ...]) -> Outline:
    x0, y0, x1, y1 = low.real, low.imag, high.real, high.imag
    if not 0 < 2 * corner < min(x1 - x0, y1 - y0):
        raise GeometryError(
            f"corners of {corner:g} mm do not fit a plate of {x1 - x0:.4g} by {y1 - y0:.4g} mm"
        )
    return Outline(
        hull_link(
            [
                Boss(complex(x, y), corner)
                for x, y in (
                    (x0 + corner, y0 + corner),
                    (x1 - corner, y0 + corner),
                    (x1 - corner, y1 - corner),
                    (x0 + corner, y1 - corner),
                )
            ]
        ).outer,
        bores(holes),
    )
