"""Whether the gears as their programs leave them mesh, go together and turn."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from mechwright import AsMade, Finding, MadePart
from mechwright.mechanics.gearing.cut import larger_teeth
from mechwright.mechanics.gearing.pair_parts import cut_pair, pair_as_made
from mechwright_spur_gears.gear_table import GearTable
from mechwright_spur_gears.pair import backlash_for
from mechwright_spur_gears.parts.teeth import operating_teeth, outlines_of, prove_outlines, rolling_pair

if TYPE_CHECKING:
    import shapely

RULE = "least with which gears as made turn: 2 (D + c sin α) / cos α"


def as_made(m: GearTable, made: Mapping[str, Sequence[MadePart]]) -> AsMade:
    """Judge the pair: part name to its copies as made."""
    bores = {name: None if name == "ring" else m.given.bore for name in m.names}
    teeth = tuple(operating_teeth(m, gear) for gear in (0, 1))
    return pair_as_made(made, bores, rolling_pair(m), teeth, (float(backlash_for(m.pair)), RULE))


def cut_findings(m: GearTable, cut: "Mapping[str, shapely.Polygon]") -> tuple[Finding, ...]:
    """Judge the gears with their unreachable corners filled: part name to polygon."""
    given = m.given
    outlines = dict(zip(m.names, outlines_of(m), strict=True))
    larger = larger_teeth(given.module, given.teeth, diametral_pitch=given.diametral_pitch)
    return cut_pair(given, outlines, cut, lambda *walls: prove_outlines(m, *walls), larger, ring=m.ring)
