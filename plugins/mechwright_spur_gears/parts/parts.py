"""Both gears as parts."""

from mechwright import Bore, Colour, Feature, Instance, Outline, Part, Profile
from mechwright.mechanics.gearing import gear_measures, tip_sites
from mechwright_spur_gears.gear_table import NAMES, GearTable
from mechwright_spur_gears.parts.teeth import outlines_of, teeth_of

COLOURS: dict[str, Colour] = {"gear-1": (0.45, 0.58, 0.70), "gear-2": (0.80, 0.68, 0.42)}
"""Part to its colour."""


def parts_of(m: GearTable) -> tuple[Part, ...]:
    """Driver and driven gear, with their sizes over pins."""
    params = m.given
    return tuple(
        Part(
            name,
            outline,
            params.thickness,
            params.material,
            instances=(Instance(name, 0.0, COLOURS[name]),),
            machined=tuple(_features(m, outline)),
            measures=gear_measures(teeth, backlash=float(m.pair.backlash)),
        )
        for name, outline, teeth in zip(NAMES, outlines_of(m), teeth_of(m), strict=True)
    )


def _features(m: GearTable, outline: Outline) -> list[Feature]:
    """Bore, keyway, then the outside, which tabs may hold at the tips."""
    depth, opening = m.given.thickness, m.opening
    features: list[Feature] = []
    if opening is not None:
        features.append(Bore("bore", (0.0, 0.0), m.given.bore, 0, depth))
        if opening.has_keyway:
            features.append(Profile("keyway", opening.loop(), "inside", 0, depth))
    return [*features, Profile("outside", outline.outer, "outside", 0, depth, tip_sites(outline.outer))]
