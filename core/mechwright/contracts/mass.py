"""Mass of parts and of bodies: plates and plain forms by their own numbers, others by their solid."""

import math
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.by_form import kept_by_form
from mechwright.contracts.materials import material
from mechwright.contracts.moments import moments, prism
from mechwright.contracts.part import Part
from mechwright.contracts.shape import Prism, Revolve, Shape, Slot
from mechwright.errors import GeometryError
from mechwright.geometry import Loop

if TYPE_CHECKING:
    import cadquery as cq

KILOGRAMS = 1e-6
"""From g/cm³ to kg/mm³."""

QUADRATURE = 1e-9
"""Relative error of the kernel's integrals."""


def _built(part: Part) -> "cq.Solid":
    assert part.build is not None  # noqa: S101 - Part has either an outline or this
    return part.build()


def mass_moments(part: Part, solid: "Callable[[Part], cq.Solid]" = _built) -> Array:
    """∫ p pᵀ dm with p = (x, y, z, 1), (4, 4), of a part in its own coordinates, in kg and mm.

    A bought part with a mass of its own has that, spread over its envelope. ``solid`` makes that of a part
    that is neither a plate nor a plain form.

    Raises
    ------
    GeometryError
        The part has no volume, or its material no density.
    """
    density = material(part.material).density
    found = _volume_moments(part, solid)
    if not found[3, 3] > 0:
        raise GeometryError(f"part {part.name} has a volume of {found[3, 3]:g} mm³ and so no mass")
    if not density > 0:
        raise GeometryError(
            f"part {part.name} is of {part.material}, whose density is {density:g} g/cm³: it has no mass"
        )
    scale = density * KILOGRAMS
    if part.bought is not None and part.bought.mass is not None:
        scale = part.bought.mass / 1000 / float(found[3, 3])
    return found * scale


@kept_by_form(256)
def _volume_moments(part: Part, solid: "Callable[[Part], cq.Solid]") -> Array:
    if part.outline is not None:
        return moments(part)
    form = part.turned or part.bought
    shape = None if form is None else form.shape
    if shape is not None and _plain(shape):
        found = _whole(shape.pieces[0])
        return found - _whole(shape.less[0]) if shape.less else found
    return _solid_moments(solid(part))


def _plain(shape: Shape) -> bool:
    """Whether a shape is a full turn of a profile, also less a hole that lies wholly in it, or one prism."""
    if len(shape.pieces) > 1 or len(shape.less) > 1:
        return False
    if any(isinstance(one, Slot) for one in (*shape.pieces, *shape.less)):
        return False
    piece = shape.pieces[0]
    if not shape.less:
        return isinstance(piece, Prism) or piece.sweep == 360.0
    return isinstance(piece, Revolve) and piece.sweep == 360.0 and _lies_in(shape.less[0], piece)


def _lies_in(hole: Revolve | Prism, turned: Revolve) -> bool:
    """Whether a cylinder about the axis of a turned piece, which lies in it, has all of a hole in it."""
    import shapely

    x, y = turned.axis
    if isinstance(hole, Prism):
        reach = max(math.dist((x, y), corner) for corner in hole.corners)
        low, high = hole.low, hole.high
    elif hole.sweep == 360.0:
        reach = math.dist((x, y), hole.axis) + max(r for r, _ in hole.profile)
        low, high = (end(z for _, z in hole.profile) for end in (min, max))
    else:
        return False
    return bool(shapely.Polygon(turned.profile).covers(shapely.box(0.0, low, reach, high)))


def _whole(piece: Revolve | Prism) -> Array:
    if isinstance(piece, Prism):
        flat = Loop.polygon(piece.corners).moments
        return prism(flat * np.sign(flat[0]), piece.low, piece.high)
    return _revolved(piece)


def _revolved(piece: Revolve) -> Array:
    """Moments of a profile turned fully: by Green, ∫ f r dr dz over it is the sum over its sides."""
    corners = np.array([*piece.profile, piece.profile[0]])
    nodes, weights = np.polynomial.legendre.leggauss(4)  # exact to degree 7; r⁴ z⁰ and r² z² are asked for
    share = (1 + nodes)[:, None] / 2
    r, z = np.moveaxis(corners[:-1] + share[:, :, None] * np.diff(corners, axis=0), 2, 0)
    dz = np.diff(corners[:, 1]) * weights[:, None] / 2

    def integral(power: int, height: int) -> float:
        """∫ r^power z^height dr dz, the outside anti-clockwise in (r, z)."""
        return float((r ** (power + 1) / (power + 1) * z**height * dz).sum())

    volume, first, second = (2 * np.pi * integral(1, k) for k in range(3))
    across = np.pi * integral(3, 0)
    sign = np.sign(volume)
    own = sign * np.diag([across, across, second, volume])
    own[2, 3] = own[3, 2] = sign * first
    shift = np.eye(4)
    shift[:2, 3] = piece.axis
    return np.asarray(shift @ own @ shift.T)


def _solid_moments(solid: "cq.Solid") -> Array:
    """By the CAD kernel, which it imports."""
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps

    properties = GProp_GProps()
    BRepGProp.VolumeProperties_s(solid.wrapped, properties, QUADRATURE)
    volume, place = properties.Mass(), properties.CentreOfMass()
    matrix = properties.MatrixOfInertia()
    tensor = np.array([[matrix.Value(i, j) for j in (1, 2, 3)] for i in (1, 2, 3)])
    centre = np.array([place.X(), place.Y(), place.Z()])
    found = np.empty((4, 4))
    found[:3, :3] = np.trace(tensor) / 2 * np.eye(3) - tensor + volume * np.outer(centre, centre)
    found[:3, 3] = found[3, :3] = volume * centre
    found[3, 3] = volume
    return found


def body_moments(placed: Iterable[tuple[Part, float]], solid: "Callable[[Part], cq.Solid]" = _built) -> Array:
    """Moments (4, 4) of several parts in one body, each with the height of its underside, mm."""
    found = np.zeros((4, 4))
    for part, z in placed:
        shift = np.eye(4)
        shift[2, 3] = z
        found = found + shift @ mass_moments(part, solid) @ shift.T
    return found
