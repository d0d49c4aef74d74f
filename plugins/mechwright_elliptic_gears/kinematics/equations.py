"""Motion of a pair and of a train of two pairs, in closed form.

Gear 2 turns about O2 = 0, gear 4 about O4 = 2a on the x axis; all angles are counter-clockwise from x, to
the far vertex of each gear. The other foci J = 2 a e exp(i θ2) and K = 2a + 2 a e exp(i θ4) stay 2a apart:
the pair moves like a crossed anti-parallelogram with the coupler J-K. With D = 1 + e² - 2 e cos θ2:

* (1), (2) s2 = b² / (a (1 - e cos θ2)), s4 = b² / (a (1 + e cos θ4)), s2 + s4 = 2a: axis to pitch point;
* (3), (4) ω2 × O2C = ω4 × O4C, so ω4 = -(s2/s4) ω2;
* (5) ω4 = f ω2, f = -(1 - e²)/D;
* (6) α4 = f' ω2² + f α2, f' = 2 e (1 - e²) sin θ2 / D²;
* (7) θ4 = 2π - 2 atan2((1 + e) sin(x/2), (1 - e) cos(x/2)) - 2π n, x = θ2 - 2π n in [-π, π);
* (8) to (11) θ3 = θ2 + θ4 (mod 2π) is the direction of J-K, and ω3, α3 are the sums of the others.

Every angle may be any real number: θ4 falls by 2π for each turn of gear 2.

In a train gear 2 drives gear 3 as above. Gear 4 is fixed to gear 3 and drives gear 5 in the same way:

* (17) θ4 = θ3 + φ. Gears 2 and 3 are turned until θ2 is the phase angle γ, and only then gear 4 is fixed with
  θ4 = 0, so φ = -θ3(γ), that is tan(φ/2) = (1 + e)/(1 - e) tan(γ/2);
* (18) to (20) gear 4 has the speed of gear 3, (21) to (23) gear 5 that of (5) to (7) with θ4 as the input.
"""

from typing import Any

import numpy as np

from mechwright import Array
from mechwright.mechanics.planar import Turning as Turning  # for all that knows these gears

Complex = np.ndarray[tuple[int, ...], np.dtype[np.complex128]]
"""Points, directions or vectors as x + i y."""


def ratio(cos: Array, eccentricity: Array | float) -> Array:
    """Speed ratio f = ω4/ω2 = -(1 - e²)/D at cos θ2: equation (5)."""
    e = eccentricity
    f: Array = (e * e - 1) / (1 + e * e - 2 * e * cos)
    return f


def mate_pointer(pointer: Complex, eccentricity: Array | float) -> Complex:
    """exp(i θ4) from exp(i θ2), without the angles: cos θ4 = ((1 + e²) cos θ2 - 2 e)/D, sin θ4 = f sin θ2."""
    mate: Complex = np.conj((pointer - eccentricity) / (1 - eccentricity * pointer))
    return mate


def driven(gear: Turning, eccentricity: Array | float) -> Turning:
    """Motion of the gear that ``gear`` drives: equations (5) to (7) and their time derivative.

    >>> pair = driven(Turning.of(0.0, 10.0), 0.8)
    >>> round(float(pair.omega), 9)
    -90.0
    """
    e, theta = eccentricity, gear.theta
    turns = np.floor((theta + np.pi) / (2 * np.pi))
    half = (theta - 2 * np.pi * turns) / 2
    angle = 2 * np.pi * (1 - turns) - 2 * np.arctan2((1 + e) * np.sin(half), (1 - e) * np.cos(half))
    cos, sin = np.cos(theta), np.sin(theta)
    f = ratio(cos, e)
    # With f = -(1 - e²)/D the derivatives are f' = 2 e f² sin θ / (1 - e²), and that of the product.
    twice = 2 * e / (1 - e * e)
    f1 = twice * f * f * sin
    f2 = twice * f * (f * cos + 2 * f1 * sin)
    return Turning(
        angle,
        f * gear.omega,
        f1 * gear.omega**2 + f * gear.alpha,
        f2 * gear.omega**3 + 3 * f1 * gear.omega * gear.alpha + f * gear.jerk,
    )


def phase_offset(phase: float, eccentricity: float) -> float:
    """φ = -θ3(γ), rad, by which gear 4 stands ahead of gear 3 on their shaft; it grows by 2π with γ.

    >>> round(phase_offset(np.pi / 2, 0.4), 9)
    2.331809081
    """
    return float(phase_offsets(phase, eccentricity))


def phase_offsets(phase: Array | float, eccentricity: Array | float) -> Array:
    """The same of many trains."""
    return 2 * np.pi - driven(Turning.of(phase, 0.0), eccentricity).theta


def train(
    gear2: Turning, eccentricity: Array | float, phase: Array | float
) -> tuple[Turning, Turning, Turning]:
    """Motion of gears 3, 4 and 5 of a train with the phase angle ``phase``, rad: equations (17) to (23).

    Arrays of eccentricities and phases broadcast with the angles of gear 2.
    """
    gear3 = driven(gear2, eccentricity)
    gear4 = Turning(gear3.theta + phase_offsets(phase, eccentricity), gear3.omega, gear3.alpha, gear3.jerk)
    return gear3, gear4, driven(gear4, eccentricity)


def coupler(gear: Turning, mate: Turning) -> Turning:
    """Motion of the coupler J-K: equations (8) to (11); its angle is not reduced to one turn."""
    return Turning(
        gear.theta + mate.theta, gear.omega + mate.omega, gear.alpha + mate.alpha, gear.jerk + mate.jerk
    )


def pitch_radii(gear: Turning, semi_major: float, eccentricity: float) -> tuple[Array, Array]:
    """s2 and s4 (n,), mm, from each axis to the pitch point: equations (1) and (2)."""
    s2 = semi_major * (1 - eccentricity**2) / (1 - eccentricity * np.cos(gear.theta))
    return s2, 2 * semi_major - s2


def tilt(gear: Turning, eccentricity: float) -> Array:
    """Angle ν (n,), rad, of the pitch curve against the circle about the axis, at most asin e.

    With r = b² / (a (1 - e cos θ)) it is atan(e sin θ / (1 - e cos θ)). It is the same for both gears, whose
    pitch points move along the same line.
    """
    e = eccentricity
    angle: Array = np.arctan(e * np.sin(gear.theta) / (1 - e * np.cos(gear.theta)))
    return angle


def shaft_pressure_angle(gear: Turning, eccentricity: float, pressure_angle: float) -> Array:
    """Angle (n,), rad, between a flank's normal and the motion of the pitch point; the larger of both flanks.

    It is the rack's pressure angle and the :func:`tilt` of the pitch curves.
    """
    return pressure_angle + np.abs(tilt(gear, eccentricity))


def alpha_peak(eccentricity: Array | float) -> Array:
    """Greatest size of f' (...), rad/s² at 1 rad/s of gear 2: where 2 e cos² θ + (1 + e²) cos θ = 4 e."""
    e = np.asarray(eccentricity, dtype=float)
    one = 1 + e * e
    # the root in the form that stands where e is 0
    cos = 8 * e / (one + np.sqrt(one * one + 32 * e * e))
    peak: Array = 2 * e * (1 - e * e) * np.sqrt(1 - cos * cos) / (one - 2 * e * cos) ** 2
    return peak


def jerk_peak(eccentricity: Array | float) -> Array:
    """Greatest size of the second derivative of f (...), rad/s³ at 1 rad/s of gear 2.

    With c = cos θ it is 2 e (1 - e²) (2 e c² + (1 + e²) c - 4 e)/D³, greatest at θ = 0, at π, or where
    4 e² c² + 8 e (1 + e²) c + (1 + e²)² = 24 e².
    """
    e = np.asarray(eccentricity, dtype=float)
    one = 1 + e * e
    half, rest = 4 * e * one, one * one - 24 * e * e
    root = np.sqrt(np.maximum(half * half - 4 * e * e * rest, 0.0))
    inner = np.clip(-rest / np.where(half + root > 0, half + root, np.inf), -1, 1)
    sizes = [np.abs((2 * e * c * c + one * c - 4 * e) / (one - 2 * e * c) ** 3) for c in (1.0, -1.0, inner)]
    peak: Array = 2 * e * (1 - e * e) * np.maximum.reduce(sizes)
    return peak


def steepest_shaft_pressure_angle(eccentricity: Any, pressure_angle: Any) -> Any:
    """Largest value of :func:`shaft_pressure_angle` over a turn, rad: pressure angle + asin e."""
    return pressure_angle + np.arcsin(eccentricity)
