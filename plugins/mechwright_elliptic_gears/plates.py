"""Plates of a train that are no gears: the coupler and the base."""

import math
from collections.abc import Sequence

from mechwright import (
    Arc,
    Bore,
    Feature,
    Instance,
    Line,
    Loop,
    Outline,
    Part,
    Point,
    Profile,
    Segment,
    circle,
)
from mechwright_elliptic_gears.layout import FIXING, MARGIN, Layout
from mechwright_elliptic_gears.params import EllipticGearParams

COUPLER, BASE = "coupler", "base"
"""Names of the parts and of their bodies."""

_FLAT = 1e-6
"""mm. A point nearer than this to a line, or to another point, lies on it: a nanometre, ten times what two
segments of a loop may be apart."""


def coupler_part(params: EllipticGearParams, layout: Layout) -> Part:
    """The coupler: eyes at J, the origin, and K on +x, and a hole at Q if it has one."""
    centres: list[Point] = [(0.0, 0.0), (2 * layout.semi_major, 0.0)]
    holes = [("joint-j", centres[0], layout.pin), ("joint-k", centres[1], layout.pin)]
    q = (2 * layout.semi_major * params.point_along, params.point_across)
    if layout.tracer > 0:
        holes.append(("tracer", q, layout.tracer))
    outer = rounded_hull([*centres, q], layout.eye)
    at = Instance(COUPLER, layout.link)
    return plate(COUPLER, outer, holes, layout.coupler, params.material, at, (0.72, 0.32, 0.27))


def base_part(params: EllipticGearParams, layout: Layout) -> Part:
    """The base plate: bores of the three shafts, and four holes that fix it."""
    reach, rounding = 2 * layout.semi_major, layout.bore / 2
    side, fixing = MARGIN * layout.bore - rounding, round(FIXING * layout.bore, 1)
    axes = {"2": -reach, "4": 0.0, "5": reach}
    holes = [(f"shaft-{name}", (x, 0.0), layout.bore) for name, x in axes.items()]
    holes += [
        (f"fixing-{number}", (x, y), fixing)
        for number, (x, y) in enumerate(
            (sx * layout.semi_major, sy * (side - fixing / 2)) for sx in (-1, 1) for sy in (-1, 1)
        )
    ]
    corners = [(sx * (reach + side), sy * side) for sx, sy in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    outer = rounded_hull(corners, rounding)
    at = Instance(BASE, -layout.base)
    return plate(BASE, outer, holes, layout.base, params.material, at, (0.55, 0.57, 0.60))


def plate(
    name: str,
    outer: Loop,
    holes: Sequence[tuple[str, Point, float]],
    thickness: float,
    material: str,
    at: Instance,
    colour: tuple[float, float, float],
) -> Part:
    """A plate with round holes, each a name, a centre and a diameter."""
    inner = tuple(Loop((circle(centre, size / 2, clockwise=True, tag=tag),)) for tag, centre, size in holes)
    features: list[Feature] = [Bore(tag, centre, size, 0, thickness) for tag, centre, size in holes]
    features.append(Profile("outside", outer, "outside", 0, thickness))
    return Part(
        name,
        Outline(outer, inner),
        thickness,
        material,
        instances=(at,),
        colour=colour,
        machined=tuple(features),
    )


def rounded_hull(points: Sequence[Point], radius: float) -> Loop:
    """The convex hull of discs of one radius, mm, around the points: lines and arcs.

    >>> round(rounded_hull([(0, 0), (10, 0)], 1.0).area, 9) == round(20 + math.pi, 9)
    True
    """
    corners = convex_hull(points)
    segments: list[Segment] = []
    count = len(corners)
    for i, (x, y) in enumerate(corners):
        (px, py), (nx, ny) = corners[i - 1], corners[(i + 1) % count]
        before, after = math.atan2(y - py, x - px), math.atan2(ny - y, nx - x)
        start, sweep = before - math.pi / 2, (after - before) % math.tau
        arc = Arc((x, y), radius, start, sweep, "round")
        if segments:
            segments.append(Line(segments[-1].end, arc.start, "side"))
        segments.append(arc)
    segments.append(Line(segments[-1].end, segments[0].start, "side"))
    return Loop(tuple(segments))


def convex_hull(points: Sequence[Point]) -> list[Point]:
    """Corners of the convex hull, counter-clockwise, without points on its sides (monotone chain)."""

    def half(ordered: Sequence[Point]) -> list[Point]:
        chain: list[Point] = []
        for point in ordered:
            while len(chain) > 1 and _left(chain[-2], chain[-1], point) <= _FLAT:
                chain.pop()
            chain.append(point)
        return chain[:-1]

    grain = -round(math.log10(_FLAT))
    ordered = sorted({(round(x, grain), round(y, grain)) for x, y in points})
    return half(ordered) + half(ordered[::-1])


def _left(a: Point, b: Point, p: Point) -> float:
    """How far p lies to the left of the line from a to b, mm."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    return (dx * (p[1] - a[1]) - dy * (p[0] - a[0])) / math.hypot(dx, dy)
