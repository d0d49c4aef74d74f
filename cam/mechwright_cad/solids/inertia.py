"""Mass of parts and of bodies: plates by their outlines, solids by the CAD kernel, which it imports."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from OCP.BRepGProp import BRepGProp
from OCP.GProp import GProp_GProps

from mechwright.arrays import Array
from mechwright.contracts.materials import material
from mechwright.contracts.moments import moments
from mechwright.contracts.part import Part
from mechwright.errors import GeometryError
from mechwright_cad.solids.solid import part_solid
from mechwright_cad.solids.solid_check import QUADRATURE

KILOGRAMS = 1e-6
"""From g/cm³ to kg/mm³."""


@dataclass(frozen=True)
class Inertia:
    """Mass of a body in kg, its centre (3,) in mm, and its inertia (3, 3) about that, kg mm²."""

    mass: float
    centre: Array
    tensor: Array

    @classmethod
    def of(cls, moments: Array) -> "Inertia":
        """From the moments (4, 4) of the mass, kg, kg mm and kg mm²; the mass is above 0."""
        mass = float(moments[3, 3])
        centre = moments[:3, 3] / mass
        about = moments[:3, :3] - mass * np.outer(centre, centre)
        return cls(mass, centre, np.trace(about) * np.eye(3) - about)


def mass_moments(part: Part) -> Array:
    """∫ p pᵀ dm with p = (x, y, z, 1), (4, 4), of a part in its own coordinates, in kg and mm.

    A bought part with a mass of its own has that, spread over its envelope.

    Raises
    ------
    GeometryError
        The part has no volume, or its material no density.
    """
    density = material(part.material).density
    found = moments(part) if part.outline is not None else _solid_moments(part)
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


def _solid_moments(part: Part) -> Array:
    properties = GProp_GProps()
    BRepGProp.VolumeProperties_s(part_solid(part).wrapped, properties, QUADRATURE)
    volume, place = properties.Mass(), properties.CentreOfMass()
    matrix = properties.MatrixOfInertia()
    tensor = np.array([[matrix.Value(i, j) for j in (1, 2, 3)] for i in (1, 2, 3)])
    centre = np.array([place.X(), place.Y(), place.Z()])
    found = np.empty((4, 4))
    found[:3, :3] = np.trace(tensor) / 2 * np.eye(3) - tensor + volume * np.outer(centre, centre)
    found[:3, 3] = found[3, :3] = volume * centre
    found[3, 3] = volume
    return found


def body_moments(placed: Iterable[tuple[Part, float]]) -> Array:
    """Moments (4, 4) of several parts in one body, each with the height of its underside, mm."""
    found = np.zeros((4, 4))
    for part, z in placed:
        shift = np.eye(4)
        shift[2, 3] = z
        found = found + shift @ mass_moments(part) @ shift.T
    return found
