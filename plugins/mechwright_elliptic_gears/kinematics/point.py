"""Motion of a point Q of the coupler J-K, to the jerk, in closed form.

With the two gears at angles θ, θ' about 0 and 2a, J = 2 a e exp(i θ) and K = 2 a + 2 a e exp(i θ'). A point
that stands u of the way from J to K and w to the left of that line is Q = (1 - c) J + c K with
c = u + i w / (2 a), since |JK| = 2 a. Its derivatives are those of the two pointers.

A middle point (c = 1/2) runs along a hippopede whatever the phase angle, about (a, 0):
(x² + y²)² = 4 a² (e² x² - (1 - e²) y²). It is 4 a e long, 2 a e² high, and its two lobes hold
4 a² ((e² - 1/2) 2 β + sin(2 β)/2), β = arcsin e.
"""

from typing import Any

import numpy as np

from mechwright import Array
from mechwright.mechanics.planar import PointMotion
from mechwright_elliptic_gears.kinematics.equations import Complex, Turning, mate_pointer, ratio


def place(along: Any, across: Any, semi_major: Any) -> Any:
    """The number c of a point ``along`` (0 at J, 1 at K) and ``across``, mm to the left of J-K."""
    return along + 1j * across / (2 * semi_major)


def point_of_coupler(
    gear: Turning,
    mate: Turning,
    semi_major: Array | float,
    eccentricity: Array | float,
    c: Complex | complex = 0.5 + 0j,
) -> PointMotion:
    """Motion of Q; the axis of ``gear`` is the origin, that of ``mate`` lies at 2a on the x axis.

    Arrays of designs broadcast with the angles of the gears.

    >>> at = Turning.of(0.0, 10.0)
    >>> q = point_of_coupler(at, at, 50.0, 0.4)
    >>> complex(q.position), float(q.speed)
    ((90+0j), 400.0)
    """
    reach = 2 * semi_major * eccentricity
    shape = np.broadcast_shapes(np.shape(gear.theta), np.shape(reach), np.shape(c))
    position: Complex = np.zeros(shape, dtype=np.complex128) + 2 * semi_major * c
    rates: list[Complex] = [np.zeros_like(position) for _ in range(3)]
    for turning, share in ((gear, 1 - c), (mate, c)):
        pointer = _unit(turning.theta) * (share * reach)
        position += pointer
        omega, alpha = turning.omega, turning.alpha
        rates[0] += 1j * omega * pointer
        rates[1] += _complex(-omega * omega, alpha) * pointer
        rates[2] += _complex(-3 * omega * alpha, turning.jerk - omega**3) * pointer
    return PointMotion(position, *rates)


def speed_of_q(
    theta2: Array, eccentricity: Array | float, phase: Array | float | None, c: Complex | complex = 0.5
) -> Array:
    """Speed of Q over a ω2, and nothing else, for many designs at once.

    Parameters
    ----------
    theta2
        Angles (..., n), rad.
    eccentricity, phase, c
        Numbers, or arrays that broadcast with ``theta2``: e, γ in rad (None for a single pair), and the place
        of Q, see :func:`place`.
    """
    e = eccentricity
    first: Complex = _unit(theta2)
    omega: Array | float = 1.0
    if phase is not None:
        omega = ratio(first.real, e)
        # exp(i φ) undoes exp(i θ3) at θ2 = γ.
        turn = np.conj(mate_pointer(_unit(np.asarray(phase, dtype=np.float64)), e))
        first = mate_pointer(first, e) * turn
    second = mate_pointer(first, e)
    speed: Array = np.abs(omega * 2 * e * ((1 - c) * first + c * ratio(first.real, e) * second))
    return speed


def _unit(theta: Array) -> Complex:
    return _complex(np.cos(theta), np.sin(theta))


def _complex(real: Array, imaginary: Array) -> Complex:
    number = np.empty(np.shape(real), dtype=np.complex128)
    number.real, number.imag = real, imaginary
    return number
