"""Cylindrical helical extension springs of round wire: rate, stress and fatigue.

Sources: EN 13906-2 for rate, correction factor, initial stress and permissible stress; EN 10270-1 for the
strength of the wire; for fatigue Zimmerli's limits with Goodman's line (Shigley's Mechanical Engineering
Design, chapter 10). With wire d, mean diameter D, w = D/d, and n coils

    R = G d⁴/(8 D³ n)          τ = 8 D F/(π d³)          k = (w + 0.5)/(w - 0.75) (Bergsträsser)

k τ is the stress on the inside of a coil. The hook bends by (4 w² - w - 1)/(4 w (w - 1)) 16 D F/(π d³) +
4 F/(π d²).
"""

import math

SHEAR_MODULUS = 81500.0
"""G of patented cold drawn wire, MPa: EN 13906-2."""

DENSITY = 7.85e-3
"""Of wire, g/mm³."""

PERMISSIBLE = 0.45
"""Greatest uncorrected shear stress under a static load, in shares of the tensile strength: EN 13906-2."""

SWING_LIMIT, MEAN_LIMIT = 241.0, 379.0
"""Zimmerli: amplitude and mean of the shear stress, MPa, that wire without shot peening bears for ever."""

SHEAR_SHARE, BENDING_SHARE = 0.67, 0.577
"""Shear strength over tensile strength; endurance of shear over that of bending."""


def tensile_strength(wire: float) -> float:
    """Least tensile strength of wire SM of EN 10270-1, MPa, by its diameter, mm.

    >>> tensile_strength(1.0)
    1980.0
    """
    return 1980.0 - 740.0 * math.log10(wire)


def spring_rate(wire: float, mean: float, coils: float) -> float:
    """R, N/mm.

    >>> round(spring_rate(1.0, 9.0, 20.0), 4)
    0.6987
    """
    return SHEAR_MODULUS * wire**4 / (8 * mean**3 * coils)


def shear_stress(force: float, wire: float, mean: float) -> float:
    """Uncorrected τ, MPa."""
    return 8 * mean * force / (math.pi * wire**3)


def correction(wire: float, mean: float) -> float:
    """k, the stress on the inside of a coil over the uncorrected one.

    >>> correction(1.0, 8.0).__round__(4)
    1.1724
    """
    w = mean / wire
    return (w + 0.5) / (w - 0.75)


def hook_stress(force: float, wire: float, mean: float) -> float:
    """Greatest tension in a full hook as wide as the coils, MPa."""
    w = mean / wire
    curved = (4 * w**2 - w - 1) / (4 * w * (w - 1))
    return curved * 16 * mean * force / (math.pi * wire**3) + 4 * force / (math.pi * wire**2)


def initial_stress(wire: float, mean: float) -> float:
    """Shear stress with which an automatic coiler winds the coils onto each other, MPa: EN 13906-2.

    >>> initial_stress(1.0, 8.0)
    89.1
    """
    return tensile_strength(wire) * (0.075 - 0.00375 * mean / wire)


def greatest_force(wire: float, mean: float) -> float:
    """Under a static load, N."""
    return PERMISSIBLE * tensile_strength(wire) * math.pi * wire**3 / (8 * mean)


def fatigue_safety(least: float, most: float, wire: float, mean: float) -> float:
    """Safety of coils and hooks under a force that swings between two values for ever, N.

    >>> round(fatigue_safety(20.0, 20.0, 1.0, 8.0), 3)
    2.143
    """
    strength = tensile_strength(wire)
    shear = SHEAR_SHARE * strength
    reversed_shear = SWING_LIMIT / (1 - MEAN_LIMIT / shear)
    swing, middle = (most - least) / 2, (most + least) / 2
    k = correction(wire, mean)
    coils = k * (shear_stress(swing, wire, mean) / reversed_shear + shear_stress(middle, wire, mean) / shear)
    hooks = (
        hook_stress(swing, wire, mean) * BENDING_SHARE / reversed_shear
        + hook_stress(middle, wire, mean) / strength
    )
    return 1 / max(coils, hooks)
