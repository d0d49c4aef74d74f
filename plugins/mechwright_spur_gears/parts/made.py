"""Whether the pair as its programs leave it meshes, goes together and turns."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from mechwright import TOLERANCES, AsMade, Finding, MadePart
from mechwright.mechanics.gearing.cut import cut_mesh, cut_opening, larger_teeth, ring_of
from mechwright.mechanics.gearing.running import (
    MadePair,
    about_bore,
    play_curve,
    running_figures,
    running_findings,
)
from mechwright_spur_gears.gear_table import NAMES, GearTable
from mechwright_spur_gears.pair import backlash_for
from mechwright_spur_gears.parts.teeth import operating_teeth, outlines_of, prove_outlines, rolling_pair

if TYPE_CHECKING:
    import shapely

RULE = "least with which gears as made turn: 2 (D + c sin α) / cos α"


def as_made(m: GearTable, made: Mapping[str, Sequence[MadePart]]) -> AsMade:
    """Judge the pair: part name to its copies as made."""
    copies = [made.get(name, ()) for name in NAMES]
    if not all(copies):
        return AsMade()
    one, two = (copy[0] for copy in copies)
    pair = MadePair(
        rolling_pair(m),
        operating_teeth(m, 0),
        NAMES,
        (about_bore(one, m.given.bore), about_bore(two, m.given.bore)),
        one.corridor + two.corridor,
        (float(backlash_for(m.pair)), RULE),
        mate=operating_teeth(m, 1),
    )
    return AsMade(tuple(running_figures(pair)), (play_curve(pair),), tuple(running_findings(pair)))


def cut_findings(m: GearTable, cut: "Mapping[str, shapely.Polygon]") -> tuple[Finding, ...]:
    """Judge the gears with their unreachable corners filled: part name to polygon."""
    found: list[Finding] = []
    if all(name in cut for name in NAMES):
        allowance = sum(outline.deviation + 2 * TOLERANCES.flatten for outline in outlines_of(m))
        one, two = (ring_of(cut[name]) for name in NAMES)
        larger = larger_teeth(m.given.module, m.given.teeth, diametral_pitch=m.given.diametral_pitch)
        found.append(cut_mesh(prove_outlines(m, one, two, allowance), m.given.thickness, larger))
    key = 0.0 if m.given.keyway_width > 0 else None
    for name in NAMES:
        if name in cut:
            found += cut_opening(m.given, key, cut[name], m.given.thickness)
    return tuple(dict.fromkeys(found))
