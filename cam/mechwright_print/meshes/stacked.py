"""Plates as layers of polygons: closed meshes whose walls are chords of the exact curves.

Where the slicer cuts the first layer, the walls of a mesh stand back by the foot, so that the squeezed layer
ends where the wall stands.
"""

import manifold3d
import numpy as np
import shapely

from mechwright.contracts.details import Chamfer
from mechwright.contracts.part import Part
from mechwright.contracts.sections import sections
from mechwright.errors import GeometryError
from mechwright.geometry.parallel import MITRE
from mechwright_cad.exporters.mesh import part_mesh
from mechwright_cad.solids.tessellate import Mesh

CHORD = 0.003
"""Chord error of the walls, mm."""


def stacked(part: Part, foot: float, first: float, *, on_top: bool) -> Mesh:
    """A plate in its own coordinates, its first layer stepped back.

    Parameters
    ----------
    part
        The plate.
    foot
        By how much the first layer stands back on each side, mm.
    first
        Its height, mm.
    on_top
        Whether the bed is at the plate's top face.

    Raises
    ------
    GeometryError
        The layers cannot be joined, or nothing is left of the first one; the message names the part.
    """
    layers = sections(part, CHORD)
    if any(isinstance(one, Chamfer) for one in part.details):  # slopes are the kernel's
        body = manifold_of(part_mesh(part))
    else:
        solids = [_prism(one.shape, part.thickness - one.bottom, part.thickness - one.top) for one in layers]
        body = manifold3d.Manifold.batch_boolean(solids, manifold3d.OpType.Add)
    if foot > 0:
        up = 1.0 if on_top else -1.0
        cut = part.thickness - first if on_top else first
        on_bed = layers[0].shape if on_top else layers[-1].shape
        narrow = shapely.buffer(on_bed, -foot, join_style="mitre", mitre_limit=MITRE)
        if narrow.is_empty:
            raise GeometryError(
                f"part {part.name}: nothing is left of its first layer when it stands back by {foot:g} mm; "
                "set deviation.foot = 0 in the file of the printer"
            )
        low, high = sorted((cut, part.thickness if on_top else 0.0))
        rest = body.trim_by_plane((0.0, 0.0, -up), -up * cut)
        body = rest + (_prism(narrow, low, high) ^ body)
    if body.status() != manifold3d.Error.NoError or body.is_empty():
        raise GeometryError(f"part {part.name}: its layers cannot be joined to a mesh")
    found = body.to_mesh64()
    return Mesh(np.asarray(found.vert_properties[:, :3], float), np.asarray(found.tri_verts, np.int64))


def manifold_of(mesh: Mesh) -> manifold3d.Manifold:
    """A closed mesh for set operations."""
    return manifold3d.Manifold(
        manifold3d.Mesh64(
            np.array(mesh.points, float, order="C"), np.array(mesh.triangles, np.uint64, order="C")
        )
    )


def _prism(shape: "shapely.Geometry", low: float, high: float) -> manifold3d.Manifold:
    """What stands over a shape from one height to another; its faces have exactly these heights."""
    rings = shapely.get_rings(shapely.get_parts(shapely.orient_polygons(shape)))
    plan = manifold3d.CrossSection([np.asarray(ring.coords)[:-1] for ring in rings])
    mesh = plan.extrude(1.0).to_mesh64()
    points = np.array(mesh.vert_properties[:, :3], float)
    points[:, 2] = np.where(points[:, 2] > 0.5, high, low)
    return manifold_of(Mesh(points, np.asarray(mesh.tri_verts, np.int64)))
