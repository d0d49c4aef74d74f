"""Parts of the clamp: flange, register, ring with its mark, screws; and the scale of gear 4."""

import math

from mechwright import Bore, Colour, Instance, Outline, Part, Profile, circle
from mechwright.contracts.details import Detail, Engraving, Thread
from mechwright.geometry import Loop
from mechwright.geometry.lettering import lettering
from mechwright.standards.screws import screw
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.clamp import (
    HEAD_GAP,
    LETTER,
    MARK,
    REGISTER_LOW,
    Clamp,
    clamp_of,
    mark_of,
)
from mechwright_elliptic_gears.parts.layout import Layout, clamp_screws
from mechwright_elliptic_gears.parts.turned import MATERIAL

LINE, DEEP = 0.6, 0.2
"""Greatest width and depth of engraved lines, mm."""

MARK_LENGTH = 2.0
"""Of a line of scale and mark, mm."""

_RING: Colour = (0.50, 0.47, 0.62)


def clamp_plates(params: EllipticGearParams, layout: Layout) -> tuple[Part, ...]:
    """Flange, register and ring: discs on the middle shaft, of the gears' material."""
    clamp, over = clamp_of(params), layout.lower + layout.thickness
    top = layout.upper + layout.thickness
    end = clamp.outside - HEAD_GAP
    mark = Engraving("mark", (_ray(MARK, end - MARK_LENGTH, end),), DEEP, LINE)
    return (
        _disc(params, "clamp-flange", clamp.outside, layout.gap, over),
        _disc(
            params, "clamp-register", clamp.spigot.middle / 2, layout.thickness - REGISTER_LOW, layout.upper
        ),
        _disc(params, "clamp-ring", clamp.outside, clamp.ring, top, (mark,)),
    )


def _disc(
    params: EllipticGearParams,
    name: str,
    radius: float,
    height: float,
    z: float,
    details: tuple[Detail, ...] = (),
) -> Part:
    holes = [
        Bore("bore", (0.0, 0.0), params.bore, 0, height),
        *screw_holes(clamp_of(params), clamp_of(params).hole, height),
    ]
    inner = [Loop((circle(one.centre, one.diameter / 2, clockwise=True, tag=one.name),)) for one in holes]
    outer = Loop((circle((0.0, 0.0), radius, tag="outside"),))
    return Part(
        name,
        Outline(outer, tuple(inner)),
        height,
        params.material,
        (Instance("gear-3", z),),
        _RING,
        (*holes, Profile("outside", outer, "outside", 0, height)),
        details=details,
    )


def screw_holes(clamp: Clamp, diameter: float, height: float) -> tuple[Bore, ...]:
    """Holes of one diameter, mm, where the screws stand."""
    return tuple(
        Bore(
            f"screw-{number}",
            (clamp.circle * math.cos(angle), clamp.circle * math.sin(angle)),
            diameter,
            0,
            height,
        )
        for number, angle in enumerate(clamp.directions, start=1)
    )


def core_of(clamp: Clamp) -> float:
    """Diameter of the holes of gear 3 before they are threaded, mm."""
    return round(Thread("thread", (0.0, 0.0), clamp.screw, clamp.of.pitch, 1.0).core, 6)


def threads(params: EllipticGearParams) -> tuple[Thread, ...]:
    """Of gear 3, from its upper side: a pitch deeper than the screws come."""
    clamp = clamp_of(params)
    depth = min(params.thickness, engaged(params) + clamp.of.pitch)
    return tuple(
        Thread(f"thread-{hole.name}", hole.centre, clamp.screw, clamp.of.pitch, depth)
        for hole in screw_holes(clamp, core_of(clamp), params.thickness)
    )


def scale(params: EllipticGearParams) -> Engraving:
    """A line for each phase at φ(γ) with its degrees outside of it; numbers that would meet are left out."""
    clamp, strokes = clamp_of(params), []
    written: list[float] = []
    middle = scale_reach(params) - LETTER / 2
    for phase in params.set_phases:
        angle = mark_of(phase, params.eccentricity)
        strokes.append(_ray(angle, clamp.scale, clamp.scale + MARK_LENGTH))
        half = LETTER * len(f"{phase:g}")  # a letter is as wide as high, with what parts it from the next
        apart = [abs((angle - one + math.pi) % math.tau - math.pi) for one in written]
        if min(apart, default=math.pi) * middle >= half:
            written.append(angle)
            at = (middle * math.cos(angle), middle * math.sin(angle))
            strokes += lettering(f"{phase:g}", LETTER, at, angle - math.pi / 2)
    return Engraving("scale", tuple(strokes), DEEP, LINE)


def scale_reach(params: EllipticGearParams) -> float:
    """Radius, mm, up to which the scale reaches."""
    return clamp_of(params).scale + MARK_LENGTH + HEAD_GAP + LETTER


def _ray(angle: float, start: float, end: float) -> tuple[tuple[float, float], ...]:
    return tuple((radius * math.cos(angle), radius * math.sin(angle)) for radius in (start, end))


def clamp_screw_part(params: EllipticGearParams, layout: Layout) -> Part:
    """Screws from the ring into gear 3, bought in the length that the clamp is made for."""
    clamp = clamp_of(params)
    assert clamp.length is not None  # noqa: S101 - check has found one
    bought = screw(clamp.screw, clamp.length).bought
    under_head = layout.upper + layout.thickness + clamp.ring
    at = tuple(Instance(body, under_head) for body in clamp_screws(params))
    return Part("clamp-screw", None, 0.0, MATERIAL, instances=at, colour=(0.36, 0.38, 0.42), bought=bought)


def engaged(params: EllipticGearParams) -> float:
    """How far the screws stand in gear 3, mm."""
    clamp = clamp_of(params)
    return (clamp.length or 0.0) - clamp.ring - params.thickness - params.spacing
