"""Mass, centre and moment of inertia of plates and turned parts, from their own geometry."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from mechwright.contracts.materials import material
from mechwright.contracts.motion import Scalar
from mechwright.geometry import Outline


@dataclass(frozen=True, slots=True)
class Mass:
    """Mass of a body in the plane.

    Parameters
    ----------
    mass
        kg.
    centre
        Centre of mass, x + i y in the body's coordinates, mm.
    inertia
        Moment of inertia about the centre of mass and z, kg mm².
    """

    mass: float
    centre: complex = 0j
    inertia: float = 0.0

    def about(self, place: complex) -> float:
        """Moment of inertia, kg mm², about another point of the body."""
        return self.inertia + self.mass * abs(self.centre - place) ** 2


def _density(name: str) -> float:
    """kg/mm³."""
    return material(name).density * 1e-6


def plate_mass(outline: Outline, thickness: float, material_name: str) -> Mass:
    """Mass of a plate: the moments of its outline, times thickness and density."""
    scale = thickness * _density(material_name)
    x, y = outline.centroid
    about_origin = outline.polar_moment * scale
    mass = outline.area * scale
    return Mass(mass, complex(x, y), about_origin - mass * (x * x + y * y))


def cylinder_mass(
    diameter: float, length: float, material_name: str, centre: complex = 0j, bore: float = 0.0
) -> Mass:
    """Mass of a turned cylinder or ring whose axis stands at ``centre``.

    >>> ring = cylinder_mass(10, 1000 / 75 / math.pi * 4, "steel", bore=5)
    >>> round(ring.mass * 1e6 / 1000, 9)
    7.85
    """
    outer, inner = diameter**2, bore**2
    mass = math.pi / 4 * (outer - inner) * length * _density(material_name)
    return Mass(mass, centre, mass * (outer + inner) / 8)


def together(masses: Iterable[Mass]) -> Mass:
    """Several masses fixed to one body, by the parallel axis theorem; numbers, or columns (n, 1) of designs.

    >>> together([Mass(1, 0j), Mass(1, 2 + 0j)])
    Mass(mass=2, centre=(1+0j), inertia=2.0)
    """
    parts = list(masses)
    total = sum(part.mass for part in parts)
    if np.all(total == 0):
        return Mass(0.0)
    centre = sum((part.mass * part.centre for part in parts), 0j) / total
    return Mass(total, centre, sum(part.about(centre) for part in parts))


def moving_figures(masses: Mapping[str, Mass], weights: Mapping[str, complex]) -> dict[str, Scalar]:
    """Figures of a motion: the masses of bodies, and the counterweights on them, mass times place, kg mm."""
    found = {f"mass_{name}": Scalar(mass.mass, "kg") for name, mass in masses.items()}
    for name, weight in weights.items():
        found[f"balance_{name}_x"] = Scalar(weight.real, "kg*mm")
        found[f"balance_{name}_y"] = Scalar(weight.imag, "kg*mm")
    return found
