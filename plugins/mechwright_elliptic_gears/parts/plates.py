"""Plates of a train that are no gears: the coupler and the base."""

import math
from collections.abc import Mapping, Sequence
from types import MappingProxyType

from mechwright import (
    Arc,
    Bore,
    Colour,
    Feature,
    Instance,
    Line,
    Loop,
    Outline,
    Part,
    Point,
    Profile,
    Segment,
)
from mechwright.contracts.fits import Fit
from mechwright.mechanics.linkage import Boss, rectangle
from mechwright.mechanics.linkage.outlines import bores
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.bushes import bush_seat
from mechwright_elliptic_gears.parts.layout import EDGE, FIXING, MARGIN, Layout, screw_places

COUPLER, BASE = "coupler", "base"
"""Names of the parts and of their bodies."""


_FLAT = 1e-6
"""mm. A point Q nearer to the line J-K lies on it: ten times what two segments of a loop may be apart."""


def coupler_part(params: EllipticGearParams, layout: Layout) -> Part:
    """The coupler: eyes at J, the origin, and K on +x, and a hole at Q if it has one."""
    q = complex(2 * layout.semi_major * params.point_along, params.point_across)
    eyes = [
        Boss(0j, layout.eye, layout.pin, "joint-j"),
        Boss(complex(2 * layout.semi_major), layout.eye, layout.pin, "joint-k"),
        Boss(q, layout.eye, layout.tracer, "tracer"),
    ]
    outline = Outline(rounded_hull(corners_of(eyes), layout.eye), bores(eyes))
    at = Instance(COUPLER, layout.link)
    return _plate(COUPLER, outline, layout.coupler, params.material, at, (0.72, 0.32, 0.27))


def base_part(params: EllipticGearParams, layout: Layout) -> Part:
    """The base plate: bores of the three shafts, and four holes that fix it, or those of a frame's screws."""
    reach, rounding = 2 * layout.semi_major, layout.bore / 2
    side, fixing = MARGIN * layout.bore, round(FIXING * layout.bore, 1)
    axes = {"2": -reach, "4": 0.0, "5": reach}
    seat = bush_seat(params, layout.base)
    bushed = {"2", "4"} if params.keyed_phase else {"2"}
    fits = {f"shaft-{name}": seat for name in bushed if seat is not None}
    holes = [
        Boss(complex(x), 0.0, seat.middle if seat and name in bushed else layout.bore, f"shaft-{name}")
        for name, x in axes.items()
    ]
    high, corner = side - rounding - fixing / 2, complex(reach + side, side)
    places = [complex(x, y) for x in (-layout.semi_major, layout.semi_major) for y in (-high, high)]
    if params.screw_hole is not None:
        fixing, rounding, places = params.screw_hole, EDGE * params.screw_hole, [*screw_places(params)]
        corner = places[-1] + complex(rounding, rounding)
    holes += [Boss(place, 0.0, fixing, f"fixing-{number}") for number, place in enumerate(places)]
    outline, at = rectangle(-corner, corner, rounding, holes), Instance(BASE, -layout.base)
    return _plate(BASE, outline, layout.base, params.material, at, (0.55, 0.57, 0.60), fits)


def _plate(
    name: str,
    outline: Outline,
    thickness: float,
    material: str,
    at: Instance,
    colour: Colour,
    fits: Mapping[str, Fit] = MappingProxyType({}),
) -> Part:
    """A plate whose features have the names of its holes."""
    features: list[Feature] = []
    for loop in outline.inner:
        (hole,) = loop.segments
        assert isinstance(hole, Arc)  # noqa: S101 - a bore is a circle
        features.append(Bore(hole.tag, hole.centre, 2 * hole.radius, 0, thickness, fits.get(hole.tag)))
    features.append(Profile("outside", outline.outer, "outside", 0, thickness))
    return Part(name, outline, thickness, material, (at,), colour, tuple(features))


def corners_of(eyes: Sequence[Boss]) -> list[Point]:
    """Corners of the hull of J, K on +x, and Q: counter-clockwise from the first one on x."""
    j, k, q = ((round(eye.centre.real, 6), round(eye.centre.imag, 6)) for eye in eyes)
    if abs(q[1]) <= _FLAT:
        return [j, k]
    around = [j, k, q] if q[1] > 0 else [j, q, k]
    first = around.index(min(around))
    return around[first:] + around[:first]


def rounded_hull(corners: Sequence[Point], radius: float) -> Loop:
    """The convex hull of discs of one radius, mm, around its corners, counter-clockwise: lines and arcs.

    >>> round(rounded_hull([(0, 0), (10, 0)], 1.0).area, 9) == round(20 + math.pi, 9)
    True
    """
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
