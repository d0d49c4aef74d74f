"""Gears as parts."""

from mechwright import Colour, Instance, Outline, Part
from mechwright.contracts.part import Feature
from mechwright.mechanics.gearing import gear_measures, tip_sites
from mechwright.mechanics.gearing.pair_parts import gear_features
from mechwright_spur_gears.gear_table import GearTable
from mechwright_spur_gears.parts.teeth import outlines_of, teeth_of

COLOURS: dict[str, Colour] = {
    "gear-1": (0.45, 0.58, 0.70),
    "gear-2": (0.80, 0.68, 0.42),
    "ring": (0.80, 0.68, 0.42),
}
"""Part to its colour."""


def parts_of(m: GearTable) -> tuple[Part, ...]:
    """Driver and driven gear, with their sizes over pins, or between them in a ring."""
    params = m.given
    return tuple(
        Part(
            name,
            outline,
            params.thickness,
            params.material,
            instances=(Instance(name, 0.0, COLOURS[name]),),
            machined=tuple(_features(m, name, outline)),
            measures=gear_measures(teeth, backlash=float(m.pair.backlash), inside=name == "ring"),
        )
        for name, outline, teeth in zip(m.names, outlines_of(m), teeth_of(m), strict=True)
    )


def _features(m: GearTable, name: str, outline: Outline) -> list[Feature]:
    """Of a gear its bore, keyway and outside, which tabs may hold at the tips."""
    if name == "ring":
        return m.ring_plate.features(outline, m.given.thickness)
    return gear_features(m.given, outline, tip_sites(outline.outer))
