"""Pressure of two cylinders on each other (Hertz; K. L. Johnson, Contact Mechanics, chapter 4)."""

import math

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.materials import Material

SHARPEST = 1e-3
"""Radius of relative curvature, mm, below which a contact is an edge; keeps the pressure of one finite."""


YIELD = 1.67
"""Hertz pressure over yield strength at which a line contact begins to yield below its surface (Johnson,
section 6.1)."""


def plane_modulus(modulus: float, poisson: float) -> float:
    """E/(1 - ν²), MPa."""
    return modulus / (1 - poisson**2)


def contact_modulus(one: Material, other: Material) -> float:
    """E* of two materials, MPa: 1/E* is the sum of (1 - ν²)/E.

    >>> from mechwright.contracts.materials import material
    >>> round(contact_modulus(material("steel"), material("aluminium")), 1)
    58605.2
    """
    return 1 / sum(1 / plane_modulus(m.modulus, m.poisson) for m in (one, other))


def elasticity_factor(modulus: float, poisson: float) -> float:
    """Z_E of ISO 6336-2 of two bodies of one material, √MPa."""
    return math.sqrt(plane_modulus(modulus, poisson) / math.tau)


def relative_radius(one: "float | Array", other: "float | Array") -> Array:
    """Radius of a cylinder that touches a plane as these two touch, mm; a hollow has a radius below 0."""
    return np.asarray(1 / (1 / np.asarray(one) + 1 / np.asarray(other)))


def line_pressure(
    force: "float | Array", length: "float | Array", radius: "float | Array", modulus: float
) -> Array:
    """Greatest pressure along a line of contact, MPa: √(F E*/(π l R)).

    >>> float(line_pressure(180, 8, 5, 58605.1963).round(2))
    289.73
    """
    return np.asarray(np.sqrt(force * modulus / (math.pi * length * radius)))


def flank_radius(pitch_radius: "float | Array", pressure_angle: float) -> Array:
    """Of a tooth's flank at the pitch point, mm: ρ sin α, by Euler and Savary; ρ of the pitch curve there."""
    return np.asarray(pitch_radius * math.sin(pressure_angle))
