"""Plates as slabs: a polygon between two heights, with the loops that bound it.

Coordinates are those of the body: x and y of the part, z upwards with the height of the instance added.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.contracts.by_form import kept_by_form
from mechwright.contracts.part import Instance, Part
from mechwright.contracts.sections import sections
from mechwright.errors import GeometryError
from mechwright.tolerances import TOLERANCES

LOOP_CHORD = 0.0015
"""Chord error of the loops that are swept against each other, mm: three times fewer edges than with that of
drawings. Overlaps are measured on the finer polygons."""

TOUCH = 0.005
"""Overlap that passes as contact, mm: what two fitted outlines (``outline`` each) and their chords
(``LOOP_CHORD`` each) can put on a fit without clearance, where nothing overlaps in truth."""

SURE_IN_PLAN = 2 * TOUCH
"""Every overlap deeper than this is found, mm: fits and chords may hide as much as they may feign."""

_ROUND = 1e-6
"""Corners of a loop that are so equally far from one point, mm, lie on a circle; a thousandth of an outline's
own deviation."""

_LEAST_ROUND = 8
"""Corners of a circle, at least: fewer are a polygon that happens to have a circle through its corners."""

_SHARP = 0.01
"""Cosine of a corner's angle from which it is sharper than a right one."""

_NO_EDGES = np.empty((0, 2, 2))


@dataclass(frozen=True)
class Circle:
    """A circle: centre (2,) and radius, mm."""

    centre: Array
    radius: float


@dataclass(frozen=True)
class Ring:
    """A loop of a slab: its corners (n, 2), mm, whether it is a hole, and the circle that it is, if any."""

    points: Array
    hole: bool
    circle: Circle | None = None

    @classmethod
    def of(cls, points: Array, hole: bool) -> "Ring":
        """Look at a closed polygon (n, 2) with fine chords, the first not repeated, and thin it out."""
        slim = shapely.simplify(shapely.Polygon(points), LOOP_CHORD - TOLERANCES.flatten)
        few = shapely.get_coordinates(slim.exterior)[:-1]
        if len(points) < _LEAST_ROUND:
            return cls(few, hole)
        middle = _circle_centre(points)
        reach = np.hypot(*(points - middle).T)
        radius = float(reach.mean())
        edge = np.hypot(*(np.roll(points, -1, axis=0) - points).T)
        sagitta = float(edge.max()) ** 2 / (8 * radius)
        if np.ptp(reach) < _ROUND and sagitta < LOOP_CHORD:
            return cls(few, hole, Circle(middle, radius))
        return cls(few, hole)

    def shrunk(self) -> list["Ring"]:
        """The loop moved into the material by ``TOUCH``; of a thinner body nothing is left."""
        inwards = TOUCH if self.hole else -TOUCH
        if self.circle is not None:
            centre, radius = self.circle.centre, self.circle.radius + inwards
            if radius <= 0:
                return []
            points = centre + (self.points - centre) * (radius / self.circle.radius)
            return [Ring(points, self.hole, Circle(centre, radius))]
        moved = shapely.buffer(shapely.Polygon(self.points), inwards, join_style="mitre")
        return [
            Ring(shapely.get_coordinates(piece.exterior)[:-1], self.hole)
            for piece in shapely.get_parts(moved)
            if not piece.is_empty
        ]


@dataclass(frozen=True)
class Slab:
    """A layer of a plate.

    Parameters
    ----------
    polygon
        Its cross-section, within ``TOLERANCES.flatten``, mm.
    bottom, top
        Its heights in the body, mm.
    """

    polygon: shapely.Polygon
    bottom: float
    top: float

    @cached_property
    def rings(self) -> tuple[Ring, ...]:
        """The loops, within ``LOOP_CHORD``."""
        loops = [self.polygon.exterior, *self.polygon.interiors]
        return tuple(
            Ring.of(shapely.get_coordinates(loop)[:-1], place > 0) for place, loop in enumerate(loops)
        )

    @cached_property
    def core(self) -> tuple[Ring, ...]:
        """The loops moved into the material by ``TOUCH``."""
        return tuple(piece for ring in self.rings for piece in ring.shrunk())

    @cached_property
    def points(self) -> Array:
        """The edges (n, 2, 2), mm, at corners that are sharper than a right angle."""
        return np.concatenate(
            [_sharp(ring.points) for ring in self.rings if ring.circle is None] or [_NO_EDGES]
        )

    @cached_property
    def core_shape(self) -> shapely.Geometry:
        """The cross-section without its skin of ``TOUCH``."""
        return shapely.buffer(self.polygon, -TOUCH)

    @cached_property
    def disc(self) -> Circle | None:
        """The outside of a round slab without openings."""
        return self.rings[0].circle if len(self.rings) == 1 else None

    @cached_property
    def around(self) -> Circle:
        """A circle about the slab."""
        x0, y0, x1, y1 = self.polygon.bounds
        middle = np.array(((x0 + x1) / 2, (y0 + y1) / 2))
        return Circle(middle, float(np.hypot(*(self.rings[0].points - middle).T).max()) + LOOP_CHORD)

    def face_down(self) -> "Slab":
        """The slab turned over about x."""
        turned = shapely.transform(self.polygon, lambda points: points * (1.0, -1.0))
        return Slab(shapely.orient_polygons(turned), -self.top, -self.bottom)


def _sharp(points: Array) -> Array:
    """The edges (n, 2, 2) at sharp corners of a polygon that has the material on its left or on its right."""
    into = points - np.roll(points, 1, axis=0)
    out = np.roll(points, -1, axis=0) - points
    cosine = (into * out).sum(axis=1) / np.maximum(np.hypot(*into.T) * np.hypot(*out.T), 1e-300)
    at = np.flatnonzero(cosine < -_SHARP)
    before = np.stack((np.roll(points, 1, axis=0)[at], points[at]), axis=1)
    after = np.stack((points[at], np.roll(points, -1, axis=0)[at]), axis=1)
    return np.concatenate((before, after))


def _circle_centre(points: Array) -> Array:
    """Centre (2,) of the circle that fits points (n, 2) best: x² + y² is linear in 1, x and y on it."""
    origin = points.mean(axis=0)
    near = points - origin
    rows = np.column_stack((2 * near, np.ones(len(near))))
    solution = np.linalg.lstsq(rows, (near**2).sum(axis=1), rcond=None)[0]
    centre: Array = origin + solution[:2]
    return centre


def slabs_of(part: Part, instance: Instance) -> tuple[Slab, ...]:
    """The layers of a plate in its body, from the top down, a slab for each piece; without fillets on floors.

    Raises GeometryError for a part that is no plate, and for an outline that cuts itself.
    """
    if part.outline is None:
        raise GeometryError(f"part {part.name} is no plate")
    return _slabs_from(part, instance.z)


@kept_by_form(512)
def _slabs_from(part: Part, low: float) -> tuple[Slab, ...]:
    base = low + part.thickness
    return tuple(
        Slab(piece, base - layer.bottom, base - layer.top)
        for layer in sections(part, steps=0)
        for piece in shapely.get_parts(layer.shape)
        if isinstance(piece, shapely.Polygon) and piece.area > 0
    )


def triangles_of(slabs: Sequence[Slab], slack: float) -> tuple[Array, NDArray[np.int64]]:
    """Corners (n, 3) and triangles (k, 3) of slabs on each other, ``slack`` mm off their polygons at most."""
    import manifold3d

    layers = []
    for slab in slabs:
        slim = shapely.simplify(slab.polygon, slack)
        rings = [shapely.get_coordinates(ring)[:-1] for ring in (slim.exterior, *slim.interiors)]
        plan = manifold3d.CrossSection(rings, manifold3d.FillRule.EvenOdd)
        prism = manifold3d.Manifold.extrude(plan, slab.top - slab.bottom)
        layers.append(prism.translate((0.0, 0.0, slab.bottom)))
    mesh = manifold3d.Manifold.batch_boolean(layers, manifold3d.OpType.Add).to_mesh64()
    return np.asarray(mesh.vert_properties)[:, :3], np.asarray(mesh.tri_verts, dtype=np.int64)
