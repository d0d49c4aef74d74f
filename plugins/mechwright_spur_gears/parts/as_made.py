"""Whether the gears as their programs leave them mesh, go together and turn."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from mechwright import TOLERANCES, AsMade, Finding, MadePart
from mechwright.mechanics.gearing.cut import cut_mesh, cut_opening, hole_of, larger_teeth, ring_of
from mechwright.mechanics.gearing.pair_parts import pair_as_made
from mechwright_spur_gears.gear_table import GearTable
from mechwright_spur_gears.pair import backlash_for
from mechwright_spur_gears.parts.rack import made_of
from mechwright_spur_gears.parts.teeth import (
    operating_teeth,
    outlines_of,
    pin_hole,
    prove_outlines,
    rolling_pair,
)

if TYPE_CHECKING:
    import shapely

RULE = "least with which gears as made turn: 2 (D + c sin α) / cos α"


def as_made(m: GearTable, made: Mapping[str, Sequence[MadePart]]) -> AsMade:
    """Judge all pairs that mesh: part name to its copies as made."""
    if m.straight:
        return made_of(m, made, (float(backlash_for(m.pair)), RULE))
    found = AsMade()
    for mesh, pair in enumerate(m.meshes):
        bores = {name: _bore(m, name) for name in m.names[mesh : mesh + 2]}
        teeth = tuple(operating_teeth(pair, gear) for gear in (0, 1))
        one = pair_as_made(made, bores, rolling_pair(pair), teeth, (float(backlash_for(pair)), RULE))
        found = AsMade(
            (*found.figures, *one.figures), (*found.curves, *one.curves), (*found.findings, *one.findings)
        )
    return found


def _bore(m: GearTable, name: str) -> float | None:
    """Diameter about whose middle a gear runs; None of a ring."""
    if name == "planet":
        return pin_hole(m).middle
    return None if name == "ring" else float(m.given.bore)


def cut_findings(m: GearTable, cut: "Mapping[str, shapely.Polygon]") -> tuple[Finding, ...]:
    """Judge the gears with their unreachable corners filled: part name to polygon."""
    given, found = m.dimensions, list[Finding]()
    outlines = dict(zip(m.names, outlines_of(m), strict=True))
    for mesh in range(len(m.meshes)):
        names = m.names[mesh : mesh + 2]
        if all(name in cut for name in names):
            allowance = sum(outlines[name].deviation + 2 * TOLERANCES.flatten for name in names)
            one, two = ((hole_of if name == "ring" else ring_of)(cut[name]) for name in names)
            larger = larger_teeth(given.module, given.teeth, diametral_pitch=given.diametral_pitch)
            found.append(cut_mesh(prove_outlines(m, mesh, one, two, allowance), given.thickness, larger))
    key = 0.0 if given.keyway_width > 0 else None
    for name in ("gear-1", "gear-2", "sun", "carrier"):
        if name in cut:
            depth = given.carrier_thickness if name == "carrier" else given.thickness
            found += cut_opening(given, key, cut[name], depth)
    return tuple(dict.fromkeys(found))
