"""Solids that are prisms all the same: pins, shafts and keys, whose faces are upright or level.

They are compared as plates are: exactly, and in a fraction of the time. Imports the CAD kernel.
"""

from itertools import pairwise

import cadquery as cq
import numpy as np
import shapely
from OCP.BRepAdaptor import BRepAdaptor_Surface
from OCP.GeomAbs import GeomAbs_SurfaceType
from OCP.gp import gp_Dir

from mechwright.contracts.by_form import kept_by_form
from mechwright.contracts.part import Part
from mechwright.pipeline.result_store import stored
from mechwright.tolerances import TOLERANCES
from mechwright_cad.interference.slabs import Slab
from mechwright_cad.interference.surface import Surface
from mechwright_cad.solids.solid import part_solid
from mechwright_cad.solids.tessellate import WELD, mesh_of

_UP = gp_Dir(0.0, 0.0, 1.0)
_LEVELS = 1e-6
"""Corners closer in height than this, mm, are at one height."""

_ABOVE = 1e-4
"""Share of a layer's height at which it is cut: its corners are then where the lower edge has them."""


def prisms_of(part: Part, low: float) -> tuple[Slab, ...] | None:
    """The layers of a solid that begins at a height, mm; None if a face is neither upright nor level."""
    slabs = _layers(part)
    if slabs is None:
        return None
    return tuple(Slab(slab.polygon, slab.bottom + low, slab.top + low) for slab in slabs)


@kept_by_form(512)
@stored
def _layers(part: Part) -> tuple[Slab, ...] | None:
    """The layers of a solid in its own coordinates: the same for all its copies."""
    solid = part_solid(part)
    if not all(_upright_or_level(face) for face in solid.Faces()):
        return None
    mesh = mesh_of(solid, ruled=False, tolerance=TOLERANCES.flatten)
    body = Surface(mesh.points, mesh.triangles).manifold
    heights = np.unique(mesh.points[:, 2])
    heights = heights[np.append(True, np.diff(heights) > _LEVELS)]
    slabs: list[Slab] = []
    for bottom, top in pairwise(heights.tolist()):
        # Just above the lower edges, for in between the walls' triangles may be twisted a little.
        cut = body.slice(bottom + _ABOVE * (top - bottom)).to_polygons()
        rings = [shapely.simplify(shapely.Polygon(ring), WELD) for ring in cut]
        shape = shapely.Polygon()
        for ring in sorted(rings, key=lambda ring: -ring.area):
            shape = shape.symmetric_difference(ring)  # a loop inside a loop is a hole, or an island in it
        slabs += [
            Slab(piece, bottom, top)
            for piece in shapely.get_parts(shape)
            if isinstance(piece, shapely.Polygon) and piece.area > 0
        ]
    return tuple(slabs)


def _upright_or_level(face: cq.Face) -> bool:
    surface = BRepAdaptor_Surface(face.wrapped)
    tolerance = TOLERANCES.angle_rad
    match surface.GetType():
        case GeomAbs_SurfaceType.GeomAbs_Plane:
            normal = surface.Plane().Axis().Direction()
            return bool(normal.IsParallel(_UP, tolerance) or normal.IsNormal(_UP, tolerance))
        case GeomAbs_SurfaceType.GeomAbs_Cylinder:
            return bool(surface.Cylinder().Axis().Direction().IsParallel(_UP, tolerance))
        case GeomAbs_SurfaceType.GeomAbs_SurfaceOfExtrusion:
            return bool(surface.Direction().IsParallel(_UP, tolerance))
    return False
