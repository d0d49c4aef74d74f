"""The two plates. The crank's origin is its shaft, the yoke's the middle of its slot."""

import math
from typing import TYPE_CHECKING

from mechwright import Arc, Instance, Line, Loop, Outline, Part, circle, material

if TYPE_CHECKING:
    from mechwright_scotch_yoke.family import ScotchYokeParams

FILLET = 4.0
"""Radius between stem and head, mm: an 8 mm end mill, the smallest that roughs well, goes round it."""
GAP = 0.5
"""Air between crank and yoke, mm: room for a shim washer."""


def crank(params: "ScotchYokeParams") -> Part:
    """A disc with a bore for the shaft and one for the pin, which stands at angle 0.

    Raises
    ------
    GeometryError
        The bores cut each other; the finding ``scotch-yoke.crank-web`` says so too.
    """
    r, pin, shaft = params.crank_radius, params.pin_diameter / 2, params.shaft_diameter / 2
    outline = Outline(
        Loop((circle((0.0, 0.0), max(r + pin, shaft) + params.rim, tag="rim"),)),
        (
            Loop((circle((0.0, 0.0), shaft, clockwise=True, tag="shaft"),)),
            Loop((circle((r, 0.0), pin, clockwise=True, tag="pin"),)),
        ),
    )
    outline.polygon()
    return Part(
        "crank",
        outline,
        params.crank_thickness,
        params.crank_material,
        instances=(Instance("crank"),),
        colour=(0.55, 0.58, 0.62),
    )


def yoke(params: "ScotchYokeParams") -> Part:
    """A head with the slot across, and a stem towards +x.

    Raises
    ------
    GeometryError
        The stem is too wide for the head; the finding ``scotch-yoke.stem-width`` says so too.
    """
    outline = yoke_outline(params)
    outline.polygon()
    return Part(
        "yoke",
        outline,
        params.yoke_thickness,
        params.yoke_material,
        instances=(Instance("yoke", z=params.crank_thickness + GAP),),
        colour=(0.80, 0.65, 0.30),
    )


def yoke_outline(params: "ScotchYokeParams") -> Outline:
    """The yoke seen from above; it cuts itself where the stem is too wide."""
    r = params.crank_radius
    slot = (params.pin_diameter + params.clearance) / 2
    head, h, f = slot + params.rim, params.stem_width / 2, FILLET
    tip = head + params.stem_length
    quarter, half = math.pi / 2, math.pi
    outer = Loop(
        (
            Line((head, -r), (head, -h - f), "head"),
            Arc((head + f, -h - f), f, half, -quarter, "fillet"),
            Line((head + f, -h), (tip, -h), "stem"),
            Line((tip, -h), (tip, h), "stem"),
            Line((tip, h), (head + f, h), "stem"),
            Arc((head + f, h + f), f, -quarter, -quarter, "fillet"),
            Line((head, h + f), (head, r), "head"),
            Arc((0.0, r), head, 0.0, half, "head"),
            Line((-head, r), (-head, -r), "head"),
            Arc((0.0, -r), head, half, half, "head"),
        )
    )
    inner = Loop(
        (
            Line((slot, r), (slot, -r), "slot"),
            Arc((0.0, -r), slot, 0.0, -half, "slot"),
            Line((-slot, -r), (-slot, r), "slot"),
            Arc((0.0, r), slot, half, -half, "slot"),
        )
    )
    return Outline(outer, (inner,))


def yoke_mass(params: "ScotchYokeParams") -> float:
    """Mass of the yoke, kg: head without its slot, stem, fillets; a column (n, 1) in a table of designs."""
    r, slot = params.crank_radius, (params.pin_diameter + params.clearance) / 2
    head = slot + params.rim
    ring = math.pi * (head**2 - slot**2) + 4 * r * (head - slot)
    area = ring + params.stem_length * params.stem_width + 2 * (1 - math.pi / 4) * FILLET**2
    return area * params.yoke_thickness / 1000 * material(params.yoke_material).density / 1000
