"""Both gears as parts: outline, bore and keyway, marks that tell how they go together."""

import math

import numpy as np

from mechwright import Bore, Colour, Feature, FittingMark, Instance, Measure, Outline, Part, Point, Profile
from mechwright.geometry import Loop
from mechwright.mechanics.gearing import SectorTeeth, Teeth, gear_measures, tip_sites
from mechwright.mechanics.gearing.usual import DOT
from mechwright.mechanics.openings import opening_of
from mechwright_noncircular_gears.gear import NAMES, outlines_of, rim_of, teeth_of
from mechwright_noncircular_gears.params import NoncircularParams

COLOURS: dict[str, Colour] = {"gear-1": (0.45, 0.58, 0.70), "gear-2": (0.80, 0.68, 0.42)}
"""Part to its colour."""

SITE = 0.15
"""Share of a sector's side from its ends to where tabs may stand."""


def parts_of(params: NoncircularParams) -> tuple[Part, ...]:
    """Driver and driven gear; ``check`` has found no error."""
    marks = _marks(params)
    made_of = (_gear, _ring if params.internal else _gear)
    return tuple(
        _part(params, name, outline, features(params, outline), mark, measures)
        for name, outline, features, mark, measures in zip(
            NAMES, outlines_of(params), made_of, marks, _measures(params), strict=True
        )
    )


def _measures(params: NoncircularParams) -> tuple[tuple[Measure, ...], tuple[Measure, ...]]:
    """Over pins, or between them in a ring."""
    one, two = teeth_of(params)
    return gear_measures(one), gear_measures(two, inside=params.internal)


def _gear(params: NoncircularParams, outline: Outline) -> list[Feature]:
    depth, opening = params.thickness, opening_of(params)
    features: list[Feature] = []
    if opening is not None:
        features.append(Bore("bore", (0.0, 0.0), params.bore, 0, depth))
        if opening.has_keyway:
            features.append(Profile("keyway", opening.loop(), "inside", 0, depth))
    return [*features, Profile("outside", outline.outer, "outside", 0, depth, _sites(outline.outer))]


def _sites(outer: Loop) -> tuple[tuple[Point, float], ...]:
    """Where tabs may hold a gear, and their limits, mm: on its tips, and of a sector on its two sides.

    Those reach from the hub to both ends of the teeth. Where a sector has one side alone, all tips have the
    limit of the least: else tabs would stand together where tips are widest.
    """
    tips, sides = tip_sites(outer), [one for one in outer.segments if one.tag == "side"]
    if len(sides) == 1:
        least = min(width for _, width in tips)
        return tuple((place, least) for place, _ in tips)
    found = []
    for side in sides:
        length = math.dist(side.start, side.end)
        for x, y in side.at([SITE, 1 - SITE]).tolist():
            found.append(((x, y), 2 * SITE * length))
    return (*tips, *found)


def _ring(params: NoncircularParams, outline: Outline) -> list[Feature]:
    depth, rim = params.thickness, rim_of(params)
    return [
        *(Bore(f"hole-{k}", centre, rim.hole, 0, depth) for k, centre in enumerate(rim.centres, start=1)),
        Profile("teeth", outline.inner[0], "inside", 0, depth),
        Profile("outside", outline.outer, "outside", 0, depth),
    ]


def _part(
    params: NoncircularParams,
    name: str,
    outline: Outline,
    features: list[Feature],
    mark: FittingMark,
    measures: tuple[Measure, ...],
) -> Part:
    return Part(
        name,
        outline,
        params.thickness,
        params.material,
        instances=(Instance(name, 0.0, COLOURS[name]),),
        machined=tuple(features),
        marks=(mark,),
        measures=measures,
    )


def _marks(params: NoncircularParams) -> tuple[FittingMark, FittingMark]:
    """One dot under a tooth of the driver, two about the space that takes it up.

    Tooth 0 of the driver lies behind the pitch point at φ = 0, and that space as far: both meet there. Of a
    sector it is a tooth in its middle.
    """
    driver, driven = teeth_of(params)
    tooth = _dot(driver, _marked(driver))
    # Both pitch curves roll off the same length; the arcs of driver and ring run against the contact.
    middle = -params.side * driver.tooth_arcs[_marked(driver)] / driver.rack.pitch - driven.offset
    space = _dot(driven, round(middle - 0.5) % driven.count), _dot(driven, round(middle + 0.5) % driven.count)
    at = math.degrees(_meeting(params)) % 360
    return (
        FittingMark(
            f"The one dot of gear 1 goes between the two dots of gear 2, at {at:.1f} degrees of gear 1.",
            (tooth,),
        ),
        FittingMark("Its two dots take the one dot of gear 1 between them.", space),
    )


def _dot(teeth: Teeth, number: int) -> Point:
    """A place under a tooth."""
    frame = teeth.curve.frame_at(np.asarray(teeth.tooth_arcs[number]))
    x, y = frame.offset(-teeth.rack.dedendum - DOT).tolist()
    return round(x, 4), round(y, 4)


def _marked(driver: Teeth) -> int:
    """The tooth of the driver that has a dot."""
    return driver.count // 2 if isinstance(driver, SectorTeeth) else 0


def _meeting(params: NoncircularParams) -> float:
    """Angle of the driver, rad, at which its marked tooth stands on the line of centres."""
    driver = teeth_of(params)[0]
    arc = driver.tooth_arcs[_marked(driver)]
    return -float(driver.curve.parameter(np.asarray(arc)))


def mill_for_fillets(params: NoncircularParams) -> float:
    """Diameter, mm, of the largest end mill that cuts every fillet exactly.

    A fillet is tightest at its bottom, where the pitch curve is flattest, or hollow the most.
    """
    least = math.inf
    for teeth in teeth_of(params):
        rack = teeth.rack
        curvature = 1 / teeth.curve.frame_at(teeth.arc_centres).radius + rack.curvature
        # Its bottom is the path of the tip arc's centre, widened by the arc: by Euler and Savary.
        depth = rack.arc_depth
        least = min(least, rack.tip_radius + depth**2 / (float(1 / curvature.min()) + depth))
    return 2 * least
