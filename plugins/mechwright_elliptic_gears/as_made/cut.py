"""What the chosen cutters leave of the gears: whether pairs still mesh, and whether the keys go in."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

from mechwright import TOLERANCES, Finding
from mechwright.mechanics.gearing.cut import cut_mesh, cut_opening, larger_teeth, ring_of
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.gear import outline_of
from mechwright_elliptic_gears.parts.gear_parts import gears_of
from mechwright_elliptic_gears.parts.mesh_proof import prove_outlines

if TYPE_CHECKING:
    import shapely


def cut_findings(params: EllipticGearParams, cut: "Mapping[str, shapely.Polygon]") -> tuple[Finding, ...]:
    """Judge the gears with their unreachable corners filled: part name to polygon."""
    gears = {body: gear for gear in gears_of(params) for body, _ in gear.bodies if gear.name in cut}
    found: list[Finding] = []
    for one, other in (
        (("gear-2", "gear-4"),) if params.stages == 1 else (("gear-2", "gear-3"), ("gear-4", "gear-5"))
    ):
        if one in gears and other in gears:
            found.append(_pair(params, cut[gears[one].name], cut[gears[other].name]))
    for gear in dict.fromkeys(gears.values()):
        found += cut_opening(params, gear.key, cut[gear.name], params.thickness)
    return tuple(dict.fromkeys(found))  # both pairs of a train have the same to say


def _pair(params: EllipticGearParams, one: "shapely.Polygon", other: "shapely.Polygon") -> Finding:
    deviation = outline_of(params).deviation
    allowance = 2 * (deviation + TOLERANCES.flatten)
    proof = prove_outlines(params, ring_of(one), allowance, ring_of(other))
    return cut_mesh(proof, params.thickness, larger_teeth(params.module, params.teeth))
