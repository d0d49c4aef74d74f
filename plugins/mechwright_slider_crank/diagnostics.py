"""The acceleration pole as the seed document has it, by the signed distances g and h and the angle δ.

P is the coupler's instant centre, where the crank's line meets the normal of the slide through B, Q the
relative centre of crank and slider, where the coupler's line meets the normal through A0. With u = exp(i φ):

* g = (A - P)·u, h = (A0 - P)·u, both signed, so that g - h = a;
* δ is the counter-clockwise angle from the line P B to the line Q P;
* (1) ωc = (1 - h/g) ωa; (3) αc = ωa² (h/g - (h/g)²) cot δ; K = a² + h² cot² δ;
* (10), (11) x and y of the pole in the coupler, (12), (13) X and Y on the ground.

These forms are 0/0 where P is at infinity (cos φ' = 0), where P = A, and where the lines are parallel; the
pole itself is finite there. Compute it with :func:`mechwright.mechanics.planar.acceleration_pole`.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from mechwright.arrays import Array
from mechwright.mechanics.planar import Plane
from mechwright_slider_crank.kinematics import SliderCrank


@dataclass(frozen=True, slots=True)
class Diagnostics:
    """What the parametric forms are made of, and what they give, at (n,) crank angles.

    Parameters
    ----------
    instant_centre, relative_centre
        P and Q, mm.
    g, h
        Signed distances, mm.
    cot_delta
        cot δ.
    omega, alpha
        Rates of the coupler per crank radian by (1) and (3).
    coupler
        The pole by (10) and (11), in the coupler, mm.
    fixed
        The pole by (12) and (13), on the ground, mm.
    """

    instant_centre: Plane
    relative_centre: Plane
    g: Array
    h: Array
    cot_delta: Array
    omega: Array
    alpha: Array
    coupler: Plane
    fixed: Plane


def diagnostics(linkage: SliderCrank, phi: ArrayLike) -> Diagnostics:
    """Equations (1), (3) and (10) to (13); infinite or NaN in the positions where they are 0/0."""
    a, c, e, theta = linkage.crank, linkage.rod, linkage.offset, linkage.direction
    bodies = linkage.bodies(phi)
    phi = np.atleast_1d(np.asarray(phi, dtype=float))
    u: Plane = np.exp(1j * phi)
    pin, end, s = a * u, bodies.slider.origin.position, bodies.position
    normal: Plane = np.full(u.shape, 1j * np.exp(1j * theta))
    with np.errstate(divide="ignore", invalid="ignore"):
        p = _crossing(0 * u, u, end, normal)
        q = _crossing(pin, end - pin, 0 * u, normal)
        g, h = np.real(np.conj(u) * (pin - p)), np.real(np.conj(u) * -p)
        z = (p - q) / normal
        cot = z.real / z.imag
        ratio = h / g
        common = a * g**2 / ((h - g) * (a**2 + h**2 * cot**2))
        cos, sin = np.cos(phi - theta), np.sin(phi - theta)
        x = common / c * ((h - g) * (a - e * sin - s * cos) + h * cot * (e * cos - s * sin))
        y = common / c * ((h - g) * (e * cos - s * sin) + h * cot * (e * sin + s * cos - a))
        # (12) and (13); cos(φ + δ) / sin δ is cos φ cot δ - sin φ, which needs no δ itself.
        fixed = (
            pin.real
            + common * ((g - h) * np.cos(phi) - h * cot * np.sin(phi))
            + 1j * (pin.imag + common * (h * (np.cos(phi) * cot - np.sin(phi)) + g * np.sin(phi)))
        )
        return Diagnostics(p, q, g, h, cot, 1 - ratio, (ratio - ratio**2) * cot, x + 1j * y, fixed)


def _crossing(one: Plane, along: Plane, two: Plane, across: Plane) -> Plane:
    """Where the line through ``one`` along ``along`` meets the one through ``two`` along ``across``."""
    share = np.imag(np.conj(across) * (two - one)) / np.imag(np.conj(across) * along)
    meeting: Plane = one + share * along
    return meeting
