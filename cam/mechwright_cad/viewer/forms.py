"""The triangles of parts as a page shows them: of plates, turned and bought parts without the CAD kernel."""

import math
from collections.abc import Sequence
from typing import Any

import manifold3d
import numpy as np
import shapely
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.contracts.by_form import kept_by_form
from mechwright.contracts.part import Instance, Part
from mechwright.contracts.shape import Prism, Revolve, Shape, Slot
from mechwright_cad.interference.slabs import Slab, slabs_of, triangles_of

COARSE, FINE = 0.15, 0.02
"""Greatest and least distance of triangles from the surface, mm: less than a line's width on the screen."""

SHARE = 5e-4
"""That distance as a share of the size of a plate."""

ROUND = (16, 64)
"""Least and greatest number of sides of a cylinder."""

HALF = 8
"""Pieces of the half circle at the end of a slot."""

MOST = 40_000
"""Triangles of all bodies together that a computer without a graphics processor still moves fluently."""

LARGEST = 300_000
"""Triangles of different forms that a page of 4 MB holds; a mechanism with more is not drawn in space."""

Mesh = tuple[Array, NDArray[np.int64]]
"""Corners (n, 3), mm, and triangles (k, 3)."""


def is_light(part: Part) -> bool:
    """Whether the form of a part takes no CAD kernel."""
    return part.outline is not None or isinstance(part.build, Shape)


def forms_of(parts: Sequence[Part], coarser: float = 1.0) -> list[Mesh]:
    """The form of each part; fewer triangles for all where copies of them have more than :data:`MOST`."""
    found = [form_of(part, coarser) for part in parts]
    count = sum(len(mesh[1]) * max(1, len(part.instances)) for mesh, part in zip(found, parts, strict=True))
    return forms_of(parts, 2 * coarser) if count > MOST and coarser < 8 else found


@kept_by_form(512)
def form_of(part: Part, coarser: float = 1.0) -> Mesh:
    """The triangles of a part in its own coordinates, a plate on z = 0.

    Raises GeometryError for a part that cannot be made.
    """
    if part.outline is not None:
        x0, y0, x1, y1 = part.outline.bounds
        chord = coarser * min(max(SHARE * math.hypot(x1 - x0, y1 - y0), FINE), COARSE)
        # From the same corner on, the rims of all layers are simplified alike: no step shows between them.
        slabs = slabs_of(part, Instance(""))
        return triangles_of(
            [Slab(shapely.normalize(one.polygon), one.bottom, one.top) for one in slabs], chord
        )
    shape = part.build
    if isinstance(shape, Shape):
        return _of_shape(shape, COARSE * coarser)
    from mechwright_cad.solids.solid import part_solid
    from mechwright_cad.solids.tessellate import mesh_of

    made = mesh_of(part_solid(part), ruled=False, tolerance=COARSE * coarser)
    return made.points, made.triangles


def _of_shape(shape: Shape, chord: float) -> Mesh:
    whole = manifold3d.Manifold.batch_boolean(
        [_piece(one, chord) for one in shape.pieces], manifold3d.OpType.Add
    )
    for one in shape.less:
        whole -= _piece(one, chord)
    mesh = whole.to_mesh64()
    return _kept(mesh.vert_properties[:, :3], mesh.tri_verts)


def _kept(points: Array, triangles: NDArray[Any]) -> Mesh:
    """Copies: what is kept must not hold objects of the library for booleans until the end of the program."""
    return np.array(points, dtype=np.float64), np.array(triangles, dtype=np.int64)


def _piece(piece: Revolve | Prism, chord: float) -> manifold3d.Manifold:
    if isinstance(piece, Revolve):
        profile = manifold3d.CrossSection([np.array(piece.profile)], manifold3d.FillRule.NonZero)
        if profile.is_empty():  # corners clockwise
            profile = manifold3d.CrossSection([np.array(piece.profile)[::-1]], manifold3d.FillRule.NonZero)
        made = profile.revolve(_sides(max(r for r, _ in piece.profile), chord), piece.sweep)
        return made.translate((*piece.axis, 0.0))
    if isinstance(piece, Slot):
        return _slot(piece)
    plan = manifold3d.CrossSection([np.array(piece.corners)], manifold3d.FillRule.EvenOdd)
    return plan.extrude(piece.high - piece.low).translate((0.0, 0.0, piece.low))


def _sides(radius: float, chord: float) -> int:
    """Sides of a cylinder, a multiple of four: so many that their middles are a chord inside."""
    if radius <= chord:
        return ROUND[0]
    sides = math.ceil(math.pi / math.acos(1 - chord / radius) / 4) * 4
    return min(max(sides, ROUND[0]), ROUND[1])


def _slot(piece: Slot) -> manifold3d.Manifold:
    """A box along x whose lower and upper end may be half circles across y."""
    xs, ys = zip(*piece.corners, strict=True)
    middle, half = (min(ys) + max(ys)) / 2, (max(ys) - min(ys)) / 2
    turn = np.linspace(0.0, math.pi, HALF + 1)

    def end(at: float, sign: float, *, is_round: bool) -> Array:
        if not is_round:
            return np.array([(half, at), (-half, at)]) * (-sign, 1.0)
        return np.column_stack((-sign * half * np.cos(turn), at - sign * half + sign * half * np.sin(turn)))

    lower, upper = piece.round_ends
    ring = np.concatenate(
        (end(piece.low, -1.0, is_round=lower)[::-1], end(piece.high, 1.0, is_round=upper)[::-1])
    )
    plan = manifold3d.CrossSection([ring[:, :2] + (middle, 0.0)], manifold3d.FillRule.EvenOdd)
    # Extruded along z: (y, z, x) become (x, y, z) by two quarter turns.
    return plan.extrude(max(xs) - min(xs)).rotate((90.0, 0.0, 90.0)).translate((min(xs), 0.0, 0.0))
