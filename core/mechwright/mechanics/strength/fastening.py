"""Keys, dowels, cross pins, joint pins, studs, press fits, circlips.

Sources: DIN 6892 method C (keys), Roloff/Matek (pins, studs), Lamé's fit with a given pressure.
"""

import math

import numpy as np

from mechwright.errors import GeometryError

_N_MM = 1000.0

LONGEST_KEY = 1.3
"""Length of a key that counts, in diameters (DIN 6892)."""

RING_SAFETY = 1.5
"""Least safety of a circlip's groove and ring."""


def key_pressure(torque: float, d: float, proud: float, length: float) -> float:
    """On the hub's side, MPa: 2 T/(d (h - t1) l).

    ``proud`` is h - t1, how far the key stands out of the shaft; the ``length`` bears: without the round ends
    of form A, which are a width long in all.

    >>> round(key_pressure(5, 12, 4 - 2.5, 10), 2)
    55.56
    """
    return 2 * torque * _N_MM / (d * _above(proud) * _above(length))


def key_shear(torque: float, d: float, width: float, length: float) -> float:
    """In the key, MPa."""
    return 2 * torque * _N_MM / (d * _above(width) * _above(length))


def key_torque(pressure: float, d: float, proud: float, length: float) -> float:
    """What a key carries at a pressure, N m."""
    return pressure * d * proud * length / 2 / _N_MM


def ring_force(torque: float, count: int, circle: float) -> float:
    """On each of ``count`` dowels on a circle, N; milled holes let all but one carry: give one less."""
    if count < 1:
        raise GeometryError("a joint by dowels needs one at least")
    return 2 * torque * _N_MM / (count * circle)


def pin_shear(force: float, d: float, planes: int = 1) -> float:
    """Mean shear stress of a pin that is cut in one plane or in two, MPa."""
    return force / (planes * math.pi / 4 * d * d)


def pin_pressure(force: float, d: float, length: float) -> float:
    """Of a pin in its hole, MPa."""
    return force / (d * length)


def cross_pin(torque: float, shaft: float, d: float, wall: float) -> tuple[float, float, float]:
    """Through shaft and hub: shear in the pin, pressure in the shaft and in the hub's ``wall``, MPa.

    >>> [round(value, 2) for value in cross_pin(3, 10, 3, 5)]
    [42.44, 60.0, 13.33]
    """
    t = torque * _N_MM
    return (
        4 * t / (math.pi * shaft * d * d),
        6 * t / (d * shaft * shaft),
        t / (d * wall * (shaft + wall)),
    )


def stud_bending(force: float, arm: float, d: float) -> float:
    """In a stud clamped at one end, loaded ``arm`` off, MPa."""
    return 32 * force * arm / (math.pi * d**3)


def stud_shear(force: float, d: float) -> float:
    """Greatest shear stress, on the neutral axis, MPa: 16 F/(3 π d²)."""
    return 16 * force / (3 * math.pi * d * d)


def stud_pressure(force: float, arm: float, d: float, depth: float) -> float:
    """At the mouth of the hole that a stud stands in, in which it tilts, MPa: F (6 l + 4 s)/(d s²).

    >>> stud_pressure(100, 0, 5, 10), stud_pressure(100, 5, 5, 10)
    (8.0, 14.0)
    """
    return force * (6 * arm + 4 * depth) / (d * depth * depth)


def stud_deflection(force: float, arm: float, d: float, modulus: float) -> tuple[float, float]:
    """Under the load, mm, and the slope there, rad."""
    stiff = modulus * math.pi * d**4 / 64
    return force * arm**3 / (3 * stiff), force * arm**2 / (2 * stiff)


def stud_diameter(force: float, arm: float, allowed: float) -> float:
    """The least diameter, mm, at a bending stress, MPa."""
    return math.cbrt(32 * force * arm / (math.pi * allowed))


def press_fit_torque(pressure: float, d: float, length: float, friction: float) -> float:
    """What a press fit carries, N m: π/2 μ p d² l."""
    return math.pi / 2 * friction * pressure * d * d * length / _N_MM


def circlip_load(groove: float, ring: float | None) -> float:
    """The axial load that may act on a circlip, N, of what its groove and the ring bear."""
    return min(groove, groove if ring is None else ring) / RING_SAFETY


def _above(value: float) -> float:
    """A length, or lengths (...), mm, that bear."""
    least = float(np.min(value))
    if not least > 0:
        raise GeometryError(f"a key that bears on {least:g} mm carries nothing")
    return value
