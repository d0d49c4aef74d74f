"""The pair as the chosen cutters and its programs leave it: whether it meshes, goes together and turns."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from mechwright import AsMade, Finding, MadePart
from mechwright.mechanics.gearing.cut import larger_teeth
from mechwright.mechanics.gearing.pair_parts import cut_pair, pair_as_made
from mechwright_noncircular_gears.table import NAMES, GearTable

if TYPE_CHECKING:
    import shapely

RULE = "least with which gears as made turn: 2 (D + c sin α / cos ν) / cos α"


def cut_findings(m: GearTable, cut: "Mapping[str, shapely.Polygon]") -> tuple[Finding, ...]:
    """Judge the gears with their unreachable corners filled: part name to polygon."""
    given = m.given
    outlines = dict(zip(NAMES, m.outlines, strict=True))
    larger = larger_teeth(given.module, given.teeth, given.lobes)
    return cut_pair(given, outlines, cut, m.prove_outlines, larger, ring=given.internal)


def as_made(m: GearTable, made: Mapping[str, Sequence[MadePart]]) -> AsMade:
    """Judge the pair: part name to its copies as made."""
    bores = dict(zip(NAMES, (m.given.bore, None if m.given.internal else m.given.bore), strict=True))
    return pair_as_made(made, bores, m.pair, m.teeth, (m.least_backlash, RULE))
