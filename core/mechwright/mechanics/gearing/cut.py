"""What the chosen cutters leave of gears: whether a pair still meshes, and whether a key goes in."""

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.finding import Change, Finding
from mechwright.contracts.keyed import Keyed
from mechwright.mechanics.gearing.proof import MeshProof
from mechwright.mechanics.openings import opening_of

if TYPE_CHECKING:
    import shapely

KEY_FIT = 0.01
"""How far, mm, the nominal key may stand in the walls: its own tolerance (h9 of the smallest keys is 0.025)
takes up more."""

_SMALLER: tuple[Change, ...] = ({"cam.corner_mill": 1}, {"cam.corner_mill": 0.5}, {"cam.tools": None})
"""Lets smaller end mills be chosen, for the fillets, or all of the library."""

_THINNER = (0.9, 0.8, 0.6, 0.4, 0.25)
"""Shares of the face width that are proposed where no smaller end mill helps: their flutes are short."""

RELIEF = 0.7
"""Widest relief that is proposed, in widths of the keyway: between two, three tenths of the floor stay."""

TRIED = 3
"""Reliefs that are proposed, the widest first: each is tried with all cutters, which takes a second or so."""

_MILLS = (8.0, 6.0, 5.0, 4.0, 3.0, 2.5, 2.0, 1.6, 1.2, 1.0)
"""Diameters of common end mills, mm, which a relief in the corners of a keyway may have."""


_LARGER = (1.25, 1.6, 2.0)
"""How many times as large teeth are proposed where no smaller end mill helps at any face width."""

_WITH_LARGER = (1.0, 0.9, 0.6, 0.36)
"""Shares of the face width that are proposed together with larger teeth, or with reliefs of a keyway."""


def larger_teeth(
    module: float | None, teeth: int, divisor: int = 1, diametral_pitch: float | None = None
) -> Iterator[Change]:
    """Changes with which the teeth of a gear are larger: its module, mm, or diametral pitch, or fewer teeth.

    Their number stays a multiple of ``divisor``.
    """
    for ratio in _LARGER:
        if diametral_pitch is not None:
            yield {"parameters.diametral_pitch": round(diametral_pitch / ratio, 3)}
        elif module is not None:
            yield {"parameters.module": round(ratio * module, 3)}
        elif (fewer := int(teeth / ratio / divisor) * divisor) > 0:
            yield {"parameters.teeth": fewer}


def ring_of(polygon: "shapely.Polygon") -> Array:
    """The outside (n, 2), mm, of a gear as cut, counter-clockwise."""
    import shapely

    ring: Array = shapely.get_coordinates(shapely.orient_polygons(shapely.Polygon(polygon.exterior)))[:-1]
    return ring


def hole_of(polygon: "shapely.Polygon") -> Array:
    """The opening (n, 2), mm, about the axis of a ring as cut, clockwise; none without points (0, 2)."""
    import shapely

    for hole in polygon.interiors:
        if shapely.Polygon(hole).contains(shapely.Point(0, 0)):
            points: Array = shapely.get_coordinates(hole)[:-1]
            return points[::-1] if shapely.is_ccw(hole) else points
    return np.empty((0, 2))


def cut_mesh(proof: MeshProof, thickness: float, larger: Iterable[Change] = ()) -> Finding:
    """What the mesh proof of two outlines as cut says; ``thickness`` is the face width, mm.

    ``larger`` are changes with which the teeth are larger.
    """
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
            "add a smaller end mill, or take a smaller thickness, which smaller ones cut through, or larger "
            "teeth",
            proposed=(
                *_SMALLER,
                *({"parameters.thickness": share * thickness} for share in _THINNER),
                *(
                    change if share == 1 else {**change, "parameters.thickness": share * thickness}
                    for change in larger
                    for share in _WITH_LARGER
                ),
            ),
        )
    return Finding.note(
        "gear.cut-mesh",
        f"as cut, the pair meshes: overlap {overlap:g} mm², transmission error {proof.error * 1e6:.1f} µrad",
        proof.error * 1e6,
        "µrad",
    )


def cut_opening(
    table: Keyed, key: float | None, cut: "shapely.Polygon", thickness: float
) -> Iterator[Finding]:
    """Whether the bore is cut, and the key goes in that stands in direction ``key``, rad; None without.

    ``thickness`` is the face width, mm.
    """
    import shapely

    opening = opening_of(table)
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
    if key is None:
        return
    section = shapely.affinity.rotate(
        shapely.Polygon(opening.key_section()), key, origin=(0, 0), use_radians=True
    )
    outside = shapely.difference(section, hole)
    corners = shapely.get_coordinates(outside)
    depth = float(np.max(shapely.distance(hole, shapely.points(corners)), initial=0.0))
    fitting = [size for size in _MILLS if size <= RELIEF * table.keyway_width][:TRIED]
    reliefs = [{"parameters.keyway_relief": size} for size in fitting]
    thinner = [{"parameters.thickness": share * thickness} for share in _WITH_LARGER if share < 1]
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
            proposed=(*reliefs, *({**one, **thin} for thin in thinner for one in reliefs)),
        )
