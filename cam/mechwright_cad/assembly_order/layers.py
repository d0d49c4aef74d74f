"""Bodies in layers across a way: plates, and solids that come from plain numbers.

Where a body is conical or chamfered, a layer is as wide as its widest place.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import shapely
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.contracts.by_form import kept_by_form
from mechwright.contracts.holes import joined
from mechwright.contracts.part import Instance, Part
from mechwright.contracts.shape import Prism, Revolve, Shape
from mechwright.mechanics.mating.rounds import PARALLEL
from mechwright_cad.bodies import Body
from mechwright_cad.interference.slabs import Slab, slabs_of, triangles_of
from mechwright_cad.interference.surface import Surface

UP = np.array((0.0, 0.0, 1.0))
"""The way that is up where the mechanism stands on its base."""

LEVEL = 0.02
"""Heights closer to each other than this, mm, are one."""

CHORD = 0.05
"""Largest distance of a mesh from its solid, mm."""

FINE = 5e-4
"""The same as a share of the size of a part, so that the bore of a small one is drawn round."""

ROUND = 48
"""Corners in a quarter of a circle: 0.003 mm off one of 50 mm."""


@dataclass(frozen=True)
class Layer:
    """A shadow across a way, mm, and where along it the body is: from ``low`` to ``high``."""

    shape: shapely.Geometry
    low: float
    high: float


def frame_of(way: Array) -> Array:
    """Rows (3, 3): two unit vectors across a way, and the way; right-handed."""
    other = np.eye(3)[int(np.abs(way).argmin())] if abs(way[2]) < 1 - PARALLEL else np.array((1.0, 0.0, 0.0))
    u = other - (other @ way) * way
    u /= np.linalg.norm(u)
    return np.array((u, np.cross(way, u), way))


def layers_of(body: Body, sample: int, way: Array) -> tuple[Layer, ...] | None:
    """The layers of a body where it stands at a sample, across a way, from below; None where it has none."""
    turn, place = body.poses.rotation[sample], body.poses.position[sample]
    frame = frame_of(way)
    seen = frame @ turn
    upright = own_layers(body.part) if abs(seen[2, 2]) > 1 - PARALLEL else None
    if upright is None:
        return None
    sign, lift = np.sign(seen[2, 2]), frame @ place
    height = body.instance.z
    found = [
        Layer(
            _moved(layer.shape, seen[:2, :2], lift[:2]),
            *sorted((sign * (layer.low + height) + lift[2], sign * (layer.high + height) + lift[2])),
        )
        for layer in upright
    ]
    return tuple(sorted(found, key=lambda layer: layer.low))


@kept_by_form(512)
def own_layers(part: Part) -> tuple[Layer, ...] | None:
    """The layers of a part across its own z, from its foot; None where it has none of its own.

    What is pressed or screwed into a hole is meant to be there: holes are as wide as what goes in.
    """
    met = joined(part)
    if met.outline is not None:
        return tuple(Layer(slab.polygon, slab.bottom, slab.top) for slab in slabs_of(met, Instance("")))
    shape = met.build
    return tuple(_of_shape(shape)) if isinstance(shape, Shape) else None


def _of_shape(shape: Shape) -> Iterator[Layer]:
    pieces, less = shape.pieces, shape.less
    for low, high in pairwise(_levels([z for piece in (*pieces, *less) for z in _heights(piece)])):
        whole = shapely.union_all([_between(piece, low, high) for piece in pieces])
        # What is taken away counts only where it is taken all through the layer.
        taken = shapely.union_all(
            [_between(piece, low, high) for piece in less if _through(piece, low, high)]
        )
        left = shapely.difference(whole, taken)
        if left.area > 0:
            yield Layer(left, low, high)


def _through(piece: Revolve | Prism, low: float, high: float) -> bool:
    heights = _heights(piece)
    return min(heights) <= low + LEVEL and high - LEVEL <= max(heights)


def _heights(piece: Revolve | Prism) -> list[float]:
    return [piece.low, piece.high] if isinstance(piece, Prism) else [z for _, z in piece.profile]


def _levels(heights: Sequence[float]) -> list[float]:
    found: list[float] = []
    for height in sorted(heights):
        if not found or height - found[-1] > LEVEL:
            found.append(height)
    return found


def _between(piece: Revolve | Prism, low: float, high: float) -> shapely.Geometry:
    """The shadow of a piece between two heights."""
    if isinstance(piece, Prism):
        inside = piece.low < high - LEVEL / 2 and low + LEVEL / 2 < piece.high
        return shapely.Polygon(piece.corners) if inside else shapely.Polygon()
    strip = shapely.box(-1.0, low + LEVEL / 4, 1e6, high - LEVEL / 4)
    cut = shapely.intersection(shapely.Polygon(piece.profile), strip)
    rings = []
    for part in shapely.get_parts(cut):
        if part.area > 0:
            inner, _, outer, _ = part.bounds
            disc = shapely.Point(piece.axis).buffer(outer, quad_segs=ROUND)
            hole = (
                shapely.Point(piece.axis).buffer(inner, quad_segs=ROUND) if inner > 0 else shapely.Polygon()
            )
            rings.append(shapely.difference(disc, hole))
    return shapely.union_all(rings) if rings else shapely.Polygon()


def _moved(shape: shapely.Geometry, turn: Array, place: Array) -> shapely.Geometry:
    return shapely.transform(shape, lambda points: points @ turn.T + place)


def mesh_points(body: Body, sample: int) -> tuple[Array, NDArray[np.int64]]:
    """Corners (n, 3), mm, and triangles (k, 3) of a body where it stands."""
    mesh = _coarse(body.part)
    points = mesh.points + np.array((0.0, 0.0, body.instance.z))
    turn, place = body.poses.rotation[sample], body.poses.position[sample]
    return points @ turn.T + place, mesh.triangles


@kept_by_form(512)
def _coarse(part: Part) -> Surface:
    """A mesh of a part in its own coordinates, a few hundredths off its solid."""
    own = own_layers(part)
    if own is not None:
        slabs = [Slab(piece, one.low, one.high) for one in own for piece in _pieces(one.shape)]
        left, front, right, rear = shapely.total_bounds([slab.polygon for slab in slabs])
        return Surface(*triangles_of(slabs, min(CHORD, FINE * float(np.hypot(right - left, rear - front)))))
    from mechwright_cad.solids.solid import part_solid
    from mechwright_cad.solids.tessellate import mesh_of

    solid = part_solid(joined(part))
    tolerance = min(CHORD, FINE * solid.BoundingBox().DiagonalLength)
    mesh = mesh_of(solid, ruled=False, tolerance=tolerance)
    return Surface(mesh.points, mesh.triangles)


def axis_of(part: Part) -> Array:
    """The axis (3,) of a turned part that does not stand upright, from its first cylinder; or upright."""
    from OCP.BRepAdaptor import BRepAdaptor_Surface
    from OCP.GeomAbs import GeomAbs_SurfaceType

    from mechwright_cad.solids.solid import part_solid

    for face in part_solid(part).Faces():
        surface = BRepAdaptor_Surface(face.wrapped)
        if surface.GetType() == GeomAbs_SurfaceType.GeomAbs_Cylinder:
            axis = surface.Cylinder().Axis().Direction()
            return np.array((axis.X(), axis.Y(), axis.Z()))
    return UP


def _pieces(shape: shapely.Geometry) -> list[shapely.Polygon]:
    return [one for one in shapely.get_parts(shape) if isinstance(one, shapely.Polygon) and one.area > 0]
