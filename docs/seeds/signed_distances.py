"""The acceleration pole as the source has it, by the signed distances g and h and the angle δ.

P is the coupler's instant centre, where the crank's line meets the follower's (of a slider: the normal of the
slide through B); Q is the relative centre of crank and follower, where the coupler's line meets the ground's
(of a slider: the normal of the slide through A0). With u = exp(i φ):

* g = (A - P)·u, h = (A0 - P)·u, both signed, so that g - h = a;
* δ is the counter-clockwise angle from the line P B to the line Q P;
* (1) ωc = (1 - h/g) ωa; (3) αc = ωa² (h/g - (h/g)²) cot δ; K = a² + h² cot² δ;
* (6), (7) of the four-bar, (10), (11) of the slider-crank: x and y of the pole in the coupler;
* (8), (9) and (12), (13): X and Y on the ground.

These forms are 0/0 where P is at infinity, where P = A, and where P B and Q P are parallel; the pole itself
is finite there. The program computes it with :func:`mechwright.mechanics.planar.acceleration_pole`; these are
to compare.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from mechwright.arrays import Array
from mechwright.mechanics.planar import Plane
from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.kinematics.loop import close
from mechwright_slider_crank.kinematics.slider_crank import SliderCrank


@dataclass(frozen=True, slots=True)
class SignedDistances:
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
        The pole by (6) and (7), or (10) and (11), in the coupler, mm.
    fixed
        The pole by (8) and (9), or (12) and (13), from A0, mm.
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


def of_four_bar(bar: FourBar, phi: ArrayLike) -> SignedDistances:
    """Equations (1), (3) and (6) to (9); infinite or NaN in the positions where they are 0/0.

    >>> found = of_four_bar(FourBar(40, 120, 80, 100), np.deg2rad(120))
    >>> round(float(found.g), 6), round(float(found.h), 6), round(float(found.cot_delta), 6)
    (286.823189, 246.823189, 1.160162)
    """
    loop = close(bar, phi)
    ground: Plane = np.asarray(bar.ground * np.exp(1j * np.asarray(bar.ground_angle)), dtype=np.complex128)
    lines = ground, loop.joint_b - ground, ground
    return _found(bar.crank, bar.coupler, loop.phi, loop.joint_a, loop.joint_b, lines)


def of_slider_crank(linkage: SliderCrank, phi: ArrayLike) -> SignedDistances:
    """Equations (1), (3) and (10) to (13); infinite or NaN in the positions where they are 0/0."""
    end = linkage.bodies(phi).slider.origin.position
    phi = np.atleast_1d(np.asarray(phi, dtype=float))
    normal: Plane = np.full(phi.shape, 1j * np.exp(1j * linkage.direction))
    pin = linkage.crank * np.exp(1j * phi)
    return _found(linkage.crank, linkage.rod, phi, pin, end, (end, normal, normal))


def _found(
    a: float, c: float, phi: Array, pin: Plane, end: Plane, lines: tuple[Plane, Plane, Plane]
) -> SignedDistances:
    """The forms of a crank a and a coupler c from A, ``pin``, to B, ``end``.

    ``lines`` are a point and the direction of the line through P and B, and the direction of the one through
    A0 and Q.
    """
    through, follower, ground = lines
    u: Plane = np.exp(1j * phi)
    with np.errstate(divide="ignore", invalid="ignore"):
        p = _crossing(np.zeros_like(u), u, through, follower)
        q = _crossing(pin, end - pin, np.zeros_like(u), ground)
        g, h = np.real(np.conj(u) * (pin - p)), np.real(np.conj(u) * -p)
        z = (p - q) / follower
        cot = z.real / z.imag
        ratio = h / g
        common = a * g**2 / ((h - g) * (a**2 + h**2 * cot**2))
        # B from A0, along the crank and across it.
        along, across = (end * np.conj(u)).real, (end * np.conj(u)).imag
        x = common / c * ((h - g) * (a - along) + h * cot * across)
        y = common / c * ((h - g) * across + h * cot * (along - a))
        # cos(φ + δ) / sin δ is cos φ cot δ - sin φ, which needs no δ itself.
        cos, sin = np.cos(phi), np.sin(phi)
        fixed = pin + common * ((g - h) * cos - h * cot * sin + 1j * (h * (cos * cot - sin) + g * sin))
        return SignedDistances(p, q, g, h, cot, 1 - ratio, (ratio - ratio**2) * cot, x + 1j * y, fixed)


def _crossing(one: Plane, along: Plane, two: Plane, across: Plane) -> Plane:
    """Where the line through ``one`` along ``along`` meets the one through ``two`` along ``across``."""
    share = np.imag(np.conj(across) * (two - one)) / np.imag(np.conj(across) * along)
    meeting: Plane = one + share * along
    return meeting
