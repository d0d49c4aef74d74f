"""Both gears as parts: outline, bore and keyway, marks that tell how they go together."""

import math

import numpy as np

from mechwright import Colour, FittingMark, Instance, Part, Point
from mechwright.geometry import Loop
from mechwright.mechanics.gearing import SectorTeeth, Teeth, gear_measures, tip_sites
from mechwright.mechanics.gearing.pair_parts import gear_features
from mechwright.mechanics.gearing.usual import DOT
from mechwright.mechanics.openings import keyway_measures
from mechwright_noncircular_gears.table import NAMES, GearTable

COLOURS: dict[str, Colour] = {"gear-1": (0.45, 0.58, 0.70), "gear-2": (0.80, 0.68, 0.42)}
"""Part to its colour."""

SITE = 0.15
"""Share of a sector's side from its ends to where tabs may stand."""


def parts_of(m: GearTable) -> tuple[Part, ...]:
    """Driver and driven gear; ``check`` has found no error."""
    params, ring = m.given, m.given.internal
    one, two = m.teeth
    keyway = keyway_measures(m.opening)
    measures = (
        (*gear_measures(one), *keyway),
        (*gear_measures(two, inside=ring), *(() if ring else keyway)),
    )
    features = [gear_features(params, outline, _sites(outline.outer)) for outline in m.outlines]
    if ring:
        features[1] = m.ring_plate.features(m.outlines[1], params.thickness)
    return tuple(
        Part(
            name,
            outline,
            params.thickness,
            params.material,
            instances=(Instance(name, 0.0, COLOURS[name]),),
            machined=tuple(machined),
            marks=(mark,),
            measures=sizes,
        )
        for name, outline, machined, mark, sizes in zip(
            NAMES, m.outlines, features, _marks(m), measures, strict=True
        )
    )


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


def _marks(m: GearTable) -> tuple[FittingMark, FittingMark]:
    """One dot under a tooth of the driver, two about the space that takes it up.

    Tooth 0 of the driver lies behind the pitch point at φ = 0, and that space as far: both meet there. Of a
    sector it is a tooth in its middle.
    """
    driver, driven = m.teeth
    tooth = _dot(driver, _marked(driver))
    # Both pitch curves roll off the same length; the arcs of driver and ring run against the contact.
    middle = -m.given.side * driver.tooth_arcs[_marked(driver)] / driver.rack.pitch - driven.offset
    space = _dot(driven, round(middle - 0.5) % driven.count), _dot(driven, round(middle + 0.5) % driven.count)
    # The angle of the driver at which its marked tooth stands on the line of centres.
    arc = np.asarray(driver.tooth_arcs[_marked(driver)])
    at = math.degrees(-float(driver.curve.parameter(arc))) % 360
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
