"""What the chosen cutters leave of the gears: whether the pair still meshes, and whether the keys go in."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

from mechwright import TOLERANCES, Finding
from mechwright.mechanics.gearing.cut import cut_mesh, cut_opening, hole_of, larger_teeth, ring_of
from mechwright_noncircular_gears.gear import NAMES, outlines_of
from mechwright_noncircular_gears.params import NoncircularParams
from mechwright_noncircular_gears.proof import prove_outlines

if TYPE_CHECKING:
    import shapely


def cut_findings(params: NoncircularParams, cut: "Mapping[str, shapely.Polygon]") -> tuple[Finding, ...]:
    """Judge the gears with their unreachable corners filled: part name to polygon."""
    found: list[Finding] = []
    if all(name in cut for name in NAMES):
        allowance = sum(outline.deviation + 2 * TOLERANCES.flatten for outline in outlines_of(params))
        one, two = (ring_of(cut[name]) for name in NAMES)
        if params.internal:
            two = hole_of(cut[NAMES[1]])
        larger = larger_teeth(params.module, params.teeth, params.lobes)
        found.append(cut_mesh(prove_outlines(params, one, two, allowance), params.thickness, larger))
    key = 0.0 if params.keyway_width > 0 else None
    for name in NAMES[: 1 if params.internal else 2]:
        if name in cut:
            found += cut_opening(params, key, cut[name], params.thickness)
    return tuple(dict.fromkeys(found))
