"""Surfaces of bodies in space as closed triangle meshes, and the same without a skin.

A plate is extruded from its slabs, without the CAD kernel. A part with a solid of its own is divided into
triangles by the kernel, which takes 1.6 s to import; only then it is.
"""

from dataclasses import dataclass
from functools import cached_property

import manifold3d
import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.contracts.by_form import kept_by_form
from mechwright.contracts.part import Instance, Part
from mechwright.errors import GeometryError
from mechwright.tolerances import TOLERANCES
from mechwright_cad.interference.nearest import Nearest
from mechwright_cad.interference.slabs import slabs_of, triangles_of
from mechwright_cad.interference.tree import Tree, by_place_and_direction

FACET_CHORD = 0.005
"""Largest distance of a triangle from its surface, mm: a shaft of 10 mm has 70 facets."""

SKIN = 2 * (FACET_CHORD + TOLERANCES.outline)
"""Overlap that passes as contact, mm: what triangles and fitted outlines put on a fit without clearance."""

_TIP = 1.8
"""Furthest that a corner gives way with the skin, in skins: as far as that of a cube (√3). A sharper one
would lose its point, and with it the collisions of the point."""

SURE_IN_SPACE = (1 + _TIP) * SKIN
"""Every overlap deeper than this is found, mm: triangles may hide as much as they may feign, and a point
loses more than a face."""

_FLAT = 1e-4
"""Share of the largest eigenvalue below which normals of a corner's triangles have nothing to say in that
direction: facets that meet at less than a degree are one surface."""


@dataclass(frozen=True)
class Surface:
    """A closed mesh: points (n, 3), mm, and triangles (k, 3), counter-clockwise seen from outside."""

    points: Array
    triangles: NDArray[np.int64]

    @cached_property
    def manifold(self) -> manifold3d.Manifold:
        """The mesh as the library for booleans has it; GeometryError if it is not closed."""
        made = manifold3d.Manifold(
            manifold3d.Mesh64(
                np.array(self.points, order="C"), np.array(self.triangles, dtype=np.uint64, order="C")
            )
        )
        if made.is_empty():
            raise GeometryError("the triangles of a solid are no closed surface")
        return made

    @cached_property
    def tree(self) -> Tree:
        """The triangles with bounding spheres and boxes."""
        return Tree.of(by_place_and_direction(self.points[self.triangles]), boxes=True)

    @cached_property
    def nearest(self) -> Nearest:
        """The triangles, to ask for distances."""
        return Nearest.of(self.points[self.triangles])

    @cached_property
    def core(self) -> "Surface":
        """The surface moved inwards by ``SKIN``: every corner to where its triangles' planes then meet."""
        corners = self.points[self.triangles]
        edges = np.roll(corners, -1, axis=1) - corners
        normal = np.cross(edges[:, 0], edges[:, 1])
        size = np.linalg.norm(normal, axis=1)
        good = size > 0
        normal = normal[good] / size[good, None]
        unit = edges[good] / np.maximum(np.linalg.norm(edges[good], axis=2), 1e-300)[..., None]
        # A triangle counts by its angle at the corner, so that how a face is divided does not matter.
        cosine = -np.einsum("nki,nki->nk", unit, np.roll(unit, 1, axis=1))
        angle = np.arccos(np.clip(cosine, -1.0, 1.0))
        matrix = np.zeros((len(self.points), 3, 3))
        right = np.zeros((len(self.points), 3))
        for place in range(3):
            weight = angle[:, place]
            at = self.triangles[good, place]
            np.add.at(matrix, at, weight[:, None, None] * normal[:, :, None] * normal[:, None, :])
            np.add.at(right, at, weight[:, None] * normal)
        shift = np.einsum("nij,nj->ni", np.linalg.pinv(matrix, rcond=_FLAT, hermitian=True), right)
        shift *= np.minimum(1.0, _TIP / np.maximum(np.linalg.norm(shift, axis=1), 1e-300))[:, None]
        return Surface(self.points - SKIN * shift, self.triangles)


def surface_of(part: Part, instance: Instance) -> Surface:
    """The surface of a copy of a part in the frame of its body; GeometryError if the part cannot be made."""
    return _surface_from(part, instance.z)


@kept_by_form(512)
def _surface_from(part: Part, low: float) -> Surface:
    if part.outline is not None:
        return Surface(*triangles_of(slabs_of(part, Instance("", low)), FACET_CHORD - TOLERANCES.flatten))
    from mechwright_cad.solids.solid import part_solid
    from mechwright_cad.solids.tessellate import mesh_of

    mesh = mesh_of(part_solid(part), ruled=False, tolerance=FACET_CHORD)
    return Surface(mesh.points + np.array((0.0, 0.0, low)), mesh.triangles)
