"""The acceleration pole as the seed document has it, by the signed distances g and h and the angle δ.

P is the coupler's instant centre, where crank and follower meet when prolonged; Q is the relative centre of
crank and follower, where coupler and ground line meet. With u = exp(i φ):

* g = (A - P)·u, h = (A0 - P)·u, both signed, so that g - h = a;
* δ is the counter-clockwise angle from the line P B to the line Q P;
* (1) ωc = (1 - h/g) ωa; (3) αc = ωa² (h/g - (h/g)²) cot δ; K = a² + h² cot² δ;
* (6), (7) x and y of the pole in the coupler, (8), (9) X and Y on the ground.

These forms are 0/0 where crank and follower are parallel, where P = A, and where P B and Q P are parallel;
the pole itself is finite there. Compute with :func:`mechwright.mechanics.planar.acceleration_pole`, and use
these to compare.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from mechwright.arrays import Array
from mechwright.mechanics.planar import Plane
from mechwright_four_bar.dimensions import FourBar
from mechwright_four_bar.loop import close


@dataclass(frozen=True, slots=True)
class Diagnostics:
    """What the parametric forms are made of, and what they give, at (...) crank angles.

    Parameters
    ----------
    instant_centre, relative_centre
        P and Q, mm from A0.
    g, h
        Signed distances, mm.
    cot_delta
        cot δ.
    omega, alpha
        Rates of the coupler per crank radian by (1) and (3).
    coupler
        The pole by (6) and (7), in the coupler, mm.
    fixed
        The pole by (8) and (9), from A0, mm.
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


def diagnostics(bar: FourBar, phi: ArrayLike) -> Diagnostics:
    """Equations (1), (3) and (6) to (9); infinite or NaN in the positions where they are 0/0.

    Examples
    --------
    >>> found = diagnostics(FourBar(40, 120, 80, 100), np.deg2rad(120))
    >>> round(float(found.g), 6), round(float(found.h), 6), round(float(found.cot_delta), 6)
    (286.823189, 246.823189, 1.160162)
    """
    a, c, b, f = bar.lengths
    theta = np.asarray(bar.ground_angle)
    loop = close(bar, phi)
    phi = loop.phi
    u: Plane = np.exp(1j * phi)
    ground: Plane = np.asarray(f * np.exp(1j * theta), dtype=np.complex128)
    normal = loop.joint_b - ground
    psi = np.angle(normal)
    with np.errstate(divide="ignore", invalid="ignore"):
        p = _crossing(np.zeros_like(u), u, ground, normal)
        q = _crossing(loop.joint_a, loop.joint_b - loop.joint_a, np.zeros_like(u), ground)
        g, h = np.real(np.conj(u) * (loop.joint_a - p)), np.real(np.conj(u) * -p)
        z = (p - q) / normal
        cot = z.real / z.imag
        ratio = h / g
        common = a * g**2 / ((h - g) * (a**2 + h**2 * cot**2))
        along, across = f * np.cos(theta - phi), f * np.sin(theta - phi)
        to_follower, beside = b * np.cos(phi - psi), b * np.sin(phi - psi)
        x = common / c * ((h - g) * (a - along - to_follower) + h * cot * (across - beside))
        y = common / c * ((h - g) * (across - beside) + h * cot * (along + to_follower - a))
        # (8) and (9); cos(φ + δ) / sin δ is cos φ cot δ - sin φ, which needs no δ itself.
        cos, sin = np.cos(phi), np.sin(phi)
        fixed = loop.joint_a + common * (
            (g - h) * cos - h * cot * sin + 1j * (h * (cos * cot - sin) + g * sin)
        )
        return Diagnostics(p, q, g, h, cot, 1 - ratio, (ratio - ratio**2) * cot, x + 1j * y, fixed)


def _crossing(one: Plane, along: Plane, two: Plane, across: Plane) -> Plane:
    """Where the line through ``one`` along ``along`` meets the one through ``two`` along ``across``."""
    share = np.imag(np.conj(across) * (two - one)) / np.imag(np.conj(across) * along)
    meeting: Plane = one + share * along
    return meeting
