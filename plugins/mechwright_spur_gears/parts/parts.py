"""Gears as parts."""

from mechwright import Bore, Colour, Instance, Outline, Part, Profile
from mechwright.contracts.part import Feature
from mechwright.mechanics.gearing import gear_data, gear_measures, tip_sites
from mechwright.mechanics.gearing.pair_parts import gear_features
from mechwright.mechanics.openings import keyway_measures
from mechwright_spur_gears.gear_table import GearTable
from mechwright_spur_gears.parts.planetary import carrier_parts
from mechwright_spur_gears.parts.rack import rack_part
from mechwright_spur_gears.parts.teeth import outlines_of, pin_hole, teeth_of

COLOURS: dict[str, Colour] = {
    "gear-1": (0.45, 0.58, 0.70),
    "gear-2": (0.80, 0.68, 0.42),
    "sun": (0.45, 0.58, 0.70),
    "planet": (0.80, 0.68, 0.42),
    "ring": (0.70, 0.70, 0.72),
}
"""Part to its colour."""


def parts_of(m: GearTable) -> tuple[Part, ...]:
    """All gears, with their sizes over pins, or between them in a ring; then rack, or carrier and pins."""
    params = m.given
    gears = [
        Part(
            name,
            outline,
            params.thickness,
            params.material,
            instances=tuple(Instance(body, 0.0, COLOURS[name]) for body in _bodies(m, name)),
            machined=tuple(_features(m, name, outline)),
            measures=(
                *gear_measures(teeth, backlash=float(m.pair.backlash), inside=name == "ring"),
                *(() if name in {"ring", "planet"} else keyway_measures(m.opening)),
            ),
            data=gear_data(teeth),
        )
        for name, outline, teeth in zip(m.names, outlines_of(m), teeth_of(m), strict=not m.straight)
    ]
    if m.straight:
        return (*gears, rack_part(m))
    return (*gears, *(carrier_parts(m) if m.planetary else ()))


def _bodies(m: GearTable, name: str) -> list[str]:
    return [f"planet-{k}" for k in range(1, m.dimensions.planets + 1)] if name == "planet" else [name]


def _features(m: GearTable, name: str, outline: Outline) -> list[Feature]:
    """Of a gear its bore, keyway and outside, which tabs may hold at the tips."""
    depth, tabs = m.given.thickness, tip_sites(outline.outer)
    if name == "ring":
        return m.ring_plate.features(outline, depth)
    if name == "planet":
        hole = pin_hole(m)
        return [
            Bore("bore", (0.0, 0.0), hole.middle, 0, depth, hole),
            Profile("outside", outline.outer, "outside", 0, depth, tabs),
        ]
    return gear_features(m.given, outline, tabs)
