"""Mass of parts and of bodies by solids that were checked. Imports the CAD kernel."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts import mass
from mechwright.contracts.part import Part
from mechwright_cad.solids.solid import part_solid


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
    """As :func:`mechwright.contracts.mass.mass_moments` has them."""
    return mass.mass_moments(part, part_solid)


def body_moments(placed: Iterable[tuple[Part, float]]) -> Array:
    """As :func:`mechwright.contracts.mass.body_moments` has them."""
    return mass.body_moments(placed, part_solid)
