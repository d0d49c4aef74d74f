"""Bending of teeth of non-circular gears: the tooth of a circular gear of the same curvature carries alone.

At the pitch point a pitch curve of radius of curvature ρ is taken for a circular gear of z_v = 2 ρ/m teeth.
Form and stress correction factors are those of ISO 6336-3 for the rack that generates the teeth, with the
load at the tip (method of DIN 3990, part 3, method C). Undercut teeth are outside of it.

Glossary
--------
lever
    Of the tooth's force about the driven axis: its radius there, and the slant of the pitch tangent.
slant δ
    Angle between the pitch tangent and the square of the radius.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from mechwright.arrays import Array

STRAIGHT = 1000.0
"""Teeth of the gear that a straight or hollow pitch curve is taken for."""

FACTOR = 1.5
"""Application, dynamic and face load factor together, where nothing is known."""

_ROUNDS = 60
"""Of the iteration for the angle of the root section; it shrinks by 2G/z each time, below 0.2."""


@dataclass(frozen=True)
class Rack:
    """Profile of the generating rack: angle in rad, the rest in modules."""

    angle: float = math.radians(20)
    addendum: float = 1.0
    dedendum: float = 1.25
    tip_radius: float = 0.38


def virtual_teeth(radius: "float | Array", module: float) -> Array:
    """z_v = 2 ρ/m; 1000 where the pitch curve is straight or hollow.

    >>> virtual_teeth(20.0, 2.0), virtual_teeth(-5.0, 2.0)
    (array(20.), array(1000.))
    """
    radius = np.asarray(radius, dtype=float)
    return np.where(radius > 0, np.minimum(2 * radius / module, STRAIGHT), STRAIGHT)


def form_factors(
    teeth: "float | Array", rack: Rack = Rack(), shift: "float | Array" = 0.0, addendum: Any = None
) -> tuple[Array, Array]:
    """Y_F and Y_S of gears with these numbers of teeth.

    Parameters
    ----------
    shift
        Profile shift x, in modules.
    addendum
        From the reference circle to the tip, in modules; None for that of the rack and the shift.

    >>> [round(float(value), 3) for value in form_factors(20)]
    [2.8, 1.553]
    >>> [round(float(value), 3) for value in form_factors(20, shift=0.5)]
    [2.173, 1.795]
    """
    z, alpha = np.asarray(teeth, dtype=float), rack.angle
    tan, cos, root = np.tan(alpha), np.cos(alpha), rack.tip_radius
    g = root - rack.dedendum + np.asarray(shift, dtype=float)
    height = rack.addendum + shift if addendum is None else addendum
    e = math.pi / 4 - rack.dedendum * tan - (1 - np.sin(alpha)) * root / cos
    h = 2 / z * (math.pi / 2 - e) - math.pi / 3
    theta = np.full(np.broadcast(z, g).shape, math.pi / 6)
    for _ in range(_ROUNDS):
        theta = 2 * g / z * np.tan(theta) - h
    thick = z * np.sin(math.pi / 3 - theta) + math.sqrt(3) * (g / np.cos(theta) - root)
    fillet = root + 2 * g * g / (np.cos(theta) * (z * np.cos(theta) ** 2 - 2 * g))
    outside = z + 2 * height
    tip = np.arccos(z * cos / outside)
    gamma = (math.pi / 2 + 2 * shift * tan) / z + (tan - alpha) - (np.tan(tip) - tip)
    slope = tip - gamma
    arm = (
        (np.cos(gamma) - np.sin(gamma) * np.tan(slope)) * outside
        - z * np.cos(math.pi / 3 - theta)
        - g / np.cos(theta)
        + root
    ) / 2
    form = 6 * arm * np.cos(slope) / (thick**2 * cos)
    stress = (1.2 + 0.13 * thick / arm) * (thick / (2 * fillet)) ** (1 / (1.21 + 2.3 * arm / thick))
    return form, stress


def tangential_force(
    torque: "float | Array", radius: "float | Array", slant: "float | Array", angle: float
) -> Array:
    """Along the pitch tangent, N, of the flank that has the shorter lever.

    ``torque``, N m, acts on the gear whose radius vector to the pitch point, mm, has this ``slant``, rad.
    """
    reach = np.minimum(np.cos(angle + slant), np.cos(angle - np.asarray(slant)))
    return np.asarray(torque * 1000 * math.cos(angle) / (radius * reach))


def root_stress(
    force: "float | Array",
    face: float,
    module: float,
    teeth: "float | Array",
    factor: float = FACTOR,
    rack: Rack = Rack(),
    shift: "float | Array" = 0.0,
    addendum: Any = None,
) -> Array:
    """σ_F = F_t/(b m) Y_F Y_S K, MPa; shift and addendum are those of :func:`form_factors`."""
    form, stress = form_factors(teeth, rack, shift, addendum)
    return np.asarray(force / (face * module) * form * stress * factor)


@dataclass(frozen=True)
class EllipticMesh:
    """The pitch point of two equal ellipses, each on a focus, over the driver's angle from the far vertex.

    Parameters
    ----------
    radius
        To the driven axis, mm.
    slant
        Of the pitch tangent, rad.
    curvature
        Radius of curvature of both pitch curves, mm.
    """

    radius: Array
    slant: Array
    curvature: Array

    @classmethod
    def at(cls, angle: "float | Array", semi_major: float, eccentricity: float) -> "EllipticMesh":
        """At these angles of the driver.

        >>> mesh = EllipticMesh.at(0.0, 40.61, 0.4)
        >>> round(float(mesh.radius), 3), round(float(mesh.curvature), 4)
        (24.366, 34.1124)
        """
        a, e, theta = semi_major, eccentricity, np.asarray(angle, dtype=float)
        own = a * (1 - e * e) / (1 - e * np.cos(theta))
        other = 2 * a - own
        slant = np.arctan(e * np.sin(theta) / (1 - e * np.cos(theta)))
        return cls(other, slant, (own * other) ** 1.5 / (a * a * math.sqrt(1 - e * e)))
