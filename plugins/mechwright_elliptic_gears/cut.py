"""What the chosen cutters leave of the gear: whether pairs of it still mesh, and whether the key goes in."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from mechwright.findings import Finding, Severity
from mechwright.geometry.keyway import Opening
from mechwright.tolerances import TOLERANCES
from mechwright_elliptic_gears.gear import opening_of, outline_of
from mechwright_elliptic_gears.params import EllipticGearParams
from mechwright_elliptic_gears.proof import prove_outlines

if TYPE_CHECKING:
    import shapely

KEY_FIT = 0.01
"""How far, mm, the nominal key may stand in the walls: its own tolerance (h9 of the smallest keys is 0.025)
takes up more."""


def cut_findings(params: EllipticGearParams, cut: "shapely.Polygon") -> Iterator[Finding]:
    """Judge the gear with its unreachable corners filled."""
    import shapely

    ring = shapely.get_coordinates(shapely.orient_polygons(shapely.Polygon(cut.exterior)))[:-1]
    deviation = outline_of(params).deviation
    proof = prove_outlines(params, ring, 2 * (deviation + TOLERANCES.flatten))
    depth, overlap = float(proof.mesh.depth.max()), proof.mesh.overlap
    if proof.collides:
        yield Finding(
            "gear.cut-mesh",
            Severity.ERROR,
            "cam.tools",
            f"as cut, the pair collides: {depth:.3f} mm deep, {overlap:.3f} mm² of overlap where no chosen "
            "cutter reaches into the fillets",
            depth,
            proof.allowance,
            "mm",
            "add a smaller end mill",
        )
    else:
        yield Finding(
            "gear.cut-mesh",
            Severity.NOTE,
            "",
            f"as cut, the pair meshes: overlap {overlap:g} mm², transmission error "
            f"{proof.error * 1e6:.1f} µrad",
            proof.error * 1e6,
            None,
            "µrad",
        )
    opening = opening_of(params)
    if opening is not None:
        yield from _opening(opening, cut)


def _opening(opening: Opening, cut: "shapely.Polygon") -> Iterator[Finding]:
    import shapely

    holes = [shapely.Polygon(hole) for hole in cut.interiors]
    hole = next((hole for hole in holes if hole.contains(shapely.Point(0, 0))), None)
    if hole is None:
        yield Finding(
            "gear.cut-bore",
            Severity.ERROR,
            "cam.tools",
            f"no chosen cutter goes into the bore of {opening.bore:g} mm",
            opening.bore,
            None,
            "mm",
            "add a smaller end mill",
        )
        return
    if not opening.has_keyway:
        return
    outside = shapely.difference(shapely.Polygon(opening.key_section()), hole)
    corners = shapely.get_coordinates(outside)
    depth = float(np.max(shapely.distance(hole, shapely.points(corners)), initial=0.0))
    if depth > KEY_FIT:
        yield Finding(
            "gear.cut-key",
            Severity.ERROR,
            "keyway_relief",
            f"the key does not go in: the chosen cutters leave {depth:.3f} mm of the keyway's corners "
            "standing in its way",
            depth,
            KEY_FIT,
            "mm",
            "set keyway_relief to the diameter of an end mill that cuts the keyway, or add a smaller one",
        )
