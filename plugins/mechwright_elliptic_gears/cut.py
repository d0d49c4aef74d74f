"""What the chosen cutters leave of the gears: whether pairs still mesh, and whether the keys go in."""

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

import numpy as np

from mechwright import TOLERANCES, Array, Finding
from mechwright_elliptic_gears.gear import opening_of, outline_of
from mechwright_elliptic_gears.gear_parts import Gear, gears_of
from mechwright_elliptic_gears.params import EllipticGearParams
from mechwright_elliptic_gears.proof import prove_outlines

if TYPE_CHECKING:
    import shapely

KEY_FIT = 0.01
"""How far, mm, the nominal key may stand in the walls: its own tolerance (h9 of the smallest keys is 0.025)
takes up more."""


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
        found += _opening(params, gear, cut[gear.name])
    return tuple(dict.fromkeys(found))  # both pairs of a train have the same to say


_SMALLER = ({"cam.corner_mill": 1}, {"cam.corner_mill": 0.5})
"""Lets smaller end mills be chosen, for the fillets."""


RELIEF = 0.7
"""Widest relief that is proposed, in widths of the keyway: between two, three tenths of the floor stay."""
TRIED = 3
"""Reliefs that are proposed, the widest first: each is tried with all cutters, which takes a second or so."""
_MILLS = (8.0, 6.0, 5.0, 4.0, 3.0, 2.5, 2.0, 1.6, 1.2, 1.0)
"""Diameters of common end mills, mm, which a relief in the corners of a keyway may have."""


def _ring(polygon: "shapely.Polygon") -> Array:
    import shapely

    ring: Array = shapely.get_coordinates(shapely.orient_polygons(shapely.Polygon(polygon.exterior)))[:-1]
    return ring


def _pair(params: EllipticGearParams, one: "shapely.Polygon", other: "shapely.Polygon") -> Finding:
    deviation = outline_of(params).deviation
    proof = prove_outlines(params, _ring(one), 2 * (deviation + TOLERANCES.flatten), _ring(other))
    depth, overlap = float(proof.mesh.depth.max()), proof.mesh.overlap
    if proof.collides:
        return Finding.error(
            "gear.cut-mesh",
            "cam.tools",
            f"as cut, the pair collides: {depth:.3f} mm deep, {overlap:.3f} mm² of overlap where no chosen "
            "cutter reaches into the fillets",
            depth,
            proof.allowance,
            "mm",
            "add a smaller end mill",
            proposed=_SMALLER,
        )
    return Finding.note(
        "gear.cut-mesh",
        f"as cut, the pair meshes: overlap {overlap:g} mm², transmission error {proof.error * 1e6:.1f} µrad",
        proof.error * 1e6,
        "µrad",
    )


def _opening(params: EllipticGearParams, gear: Gear, cut: "shapely.Polygon") -> Iterator[Finding]:
    import shapely

    opening = opening_of(params)
    if opening is None:
        return
    holes = [shapely.Polygon(hole) for hole in cut.interiors]
    hole = next((hole for hole in holes if hole.contains(shapely.Point(0, 0))), None)
    if hole is None:
        yield Finding.error(
            "gear.cut-bore",
            "cam.tools",
            f"no chosen cutter goes into the bore of {opening.bore:g} mm",
            opening.bore,
            unit="mm",
            remedy="add a smaller end mill",
            proposed=_SMALLER,
        )
        return
    if gear.key is None:
        return
    key = shapely.affinity.rotate(
        shapely.Polygon(opening.key_section()), gear.key, origin=(0, 0), use_radians=True
    )
    outside = shapely.difference(key, hole)
    corners = shapely.get_coordinates(outside)
    depth = float(np.max(shapely.distance(hole, shapely.points(corners)), initial=0.0))
    if depth > KEY_FIT:
        yield Finding.error(
            "gear.cut-key",
            "keyway_relief",
            f"the key does not go in: the chosen cutters leave {depth:.3f} mm of the keyway's corners "
            "standing in its way",
            depth,
            KEY_FIT,
            "mm",
            "set keyway_relief to the diameter of an end mill that cuts the keyway, or add a smaller one",
            proposed=tuple(
                {"parameters.keyway_relief": size} for size in _MILLS if size <= RELIEF * params.keyway_width
            )[:TRIED],
        )
