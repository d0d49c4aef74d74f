"""Life and load of deep-groove ball bearings (ISO 281, ISO 76), and of plain bushes.

A turn of the ring counts, not time: mean loads are weighted by angle where the speed varies.
"""

import math
from collections.abc import Sequence

import numpy as np

from mechwright.arrays import Array
from mechwright.errors import GeometryError

X = 0.56
"""Share of the radial load where the axial one counts (ISO 281, normal clearance)."""

_AXIAL = (
    (0.172, 0.19, 2.30), (0.345, 0.22, 1.99), (0.689, 0.26, 1.71), (1.03, 0.28, 1.55), (1.38, 0.30, 1.45),
    (2.07, 0.34, 1.31), (3.45, 0.38, 1.15), (5.17, 0.42, 1.04), (6.89, 0.44, 1.00),
)  # fmt: skip
"""f0 Fa/C0 to e and Y (ISO 281); between them straight lines, outside the nearest."""

STATIC_SAFETY = 2.0
"""Least C0/P0 where a bearing has to run quietly; ISO 76 asks 1 of normal running."""

LEAST_LOAD = 0.01
"""Of the dynamic rating: below it balls slide."""

RELIABILITY = {0.90: 1.0, 0.95: 0.64, 0.96: 0.55, 0.97: 0.47, 0.98: 0.37, 0.99: 0.25}
"""Reliability to a1 (ISO 281:2007 but 0.64 at 95 %)."""

SINTERED_PRESSURE, SINTERED_SPEED, SINTERED_PV = 10.0, 5.0, 1.8
"""Limits of sintered bronze: MPa, m/s, MPa m/s; handbook."""

POM_PRESSURE, POM_SPEED, POM_PV = 5.0, 1.0, 0.1
"""The same of POM, dry; handbook."""


def life(rating: float, load: float, speed: float, a1: float = 1.0) -> float:
    """L10h in hours: a1 (C/P)³ 10⁶/(60 n); infinite without load or motion.

    >>> round(life(3450, 150, 120))
    1689861
    """
    if load == 0 or speed == 0:
        return math.inf
    return a1 * (rating / load) ** 3 * 1e6 / (60 * speed)


def axial_factors(relative: float) -> tuple[float, float]:
    """E and Y at f0 Fa/C0.

    >>> axial_factors(0.689)
    (0.26, 1.71)
    """
    at, e, y = np.array(_AXIAL).T
    return float(np.interp(relative, at, e)), float(np.interp(relative, at, y))


def equivalent_load(radial: float, axial: float, relative: float) -> float:
    """P of a radial and an axial load, N; ``relative`` is f0 Fa/C0, f0 of the maker's sheet (12 to 14)."""
    e, y = axial_factors(relative)
    if axial <= e * radial:
        return radial
    return X * radial + y * axial


def static_load(radial: float, axial: float = 0.0) -> float:
    """P0, N: 0.6 Fr + 0.5 Fa, and the radial load at least (ISO 76)."""
    return max(radial, 0.6 * radial + 0.5 * axial)


def mean_load(loads: Sequence[float], shares: Sequence[float]) -> float:
    """Of loads over shares of all turns of the ring, N: (Σ q P³)^(1/3); the shares add up to 1."""
    if abs(sum(shares) - 1) > 1e-9 or len(loads) != len(shares):
        raise GeometryError(f"shares of turns add up to {sum(shares):g}; one for each load, and 1 in all")
    return math.cbrt(sum(share * load**3 for load, share in zip(loads, shares, strict=True)))


def mean_over_turn(load: Array) -> float:
    """Of loads (n,) at equal steps of one turn without its end, N."""
    return math.cbrt(float(np.mean(np.abs(load) ** 3)))


def swing_speed(half_swing: float, cycles: float) -> float:
    """The speed, rev/min, that wears as much as swinging ± ``half_swing``, rad, so many times a minute."""
    return cycles * half_swing / (math.pi / 2)


def bush_pressure(force: float, d: float, length: float) -> float:
    """Over the projected area, MPa."""
    return force / (d * length)


def bush_speed(d: float, speed: float) -> float:
    """Of sliding, m/s."""
    return math.pi * d / 1000 * speed / 60
