"""Stress in round shafts, static and in fatigue.

Sources: Roloff/Matek, Maschinenelemente (nominal stresses, key seats); Shigley, Mechanical Engineering Design
(endurance limit by Marin's factors, DE-Goodman criterion).
"""

import math
from dataclasses import dataclass

import numpy as np

from mechwright.errors import GeometryError

_N_MM = 1000.0
"""Newton millimetres in a newton metre."""

SAFE = 1.5
"""Least safety against fatigue by the Goodman criterion."""


@dataclass(frozen=True)
class Notch:
    """Fatigue stress concentration in bending and in torsion."""

    bending: float = 1.0
    torsion: float = 1.0


KEY_SEAT = Notch(2.14, 3.0)
"""An end-milled key seat, radius 0.02 d at its floor (Shigley)."""


@dataclass(frozen=True)
class Load:
    """Moments of a section, N m: alternating and mean bending, alternating and mean torque.

    A steady force on a turning shaft bends it to and fro: that is ``bending``.
    """

    bending: float = 0.0
    torque: float = 0.0
    mean_bending: float = 0.0
    mean_torque: float = 0.0


def second_moment(d: float) -> float:
    """Second moment of area of a circle, mm⁴: π d⁴/64."""
    return math.pi * d**4 / 64


def bending_stress(d: float, moment: float) -> float:
    """σ = 32 M/(π d³), MPa.

    >>> round(bending_stress(12, 8), 3)
    47.157
    """
    return 32 * moment * _N_MM / (math.pi * _size(d) ** 3)


def torsion_stress(d: float, torque: float) -> float:
    """τ = 16 T/(π d³), MPa."""
    return 16 * torque * _N_MM / (math.pi * _size(d) ** 3)


def von_mises(d: float, moment: float, torque: float) -> float:
    """√(σ² + 3 τ²), MPa, in the skin of a round section.

    At a key seat of depth t1, statically, the section is taken for a circle of d - t1.
    """
    return math.hypot(bending_stress(d, moment), math.sqrt(3) * torsion_stress(d, torque))


def notched_von_mises(d: float, moment: float, torque: float, notch: Notch = KEY_SEAT) -> float:
    """The same with the concentration of a notch on both stresses, MPa."""
    return von_mises(d, notch.bending * moment, notch.torsion * torque)


def least_diameter(moment: float, torque: float, allowed: float) -> float:
    """The diameter, mm, at which the von Mises stress is what is allowed, MPa.

    >>> round(least_diameter(8, 5, 60), 3)
    11.559
    """
    both = math.hypot(moment, math.sqrt(0.75) * torque) * _N_MM
    return math.cbrt(32 / (math.pi * _size(allowed)) * both)


def endurance_limit(strength: float, d: float) -> float:
    """Endurance limit of a machined steel shaft in bending, MPa, from its tensile strength.

    4.51 Su^-0.265 for the surface, 1.24 d^-0.107 for the size (2.8 to 51 mm), and half the strength.
    """
    return 4.51 * math.pow(strength, -0.265) * 1.24 * math.pow(_size(d), -0.107) * strength / 2


def goodman_safety(d: float, load: Load, endurance: float, strength: float, notch: Notch = KEY_SEAT) -> float:
    """Safety against fatigue (DE-Goodman); infinite without a load.

    ``endurance`` and tensile ``strength`` are in MPa.
    """
    alternating = math.hypot(2 * notch.bending * load.bending, math.sqrt(3) * notch.torsion * load.torque)
    mean = math.hypot(2 * notch.bending * load.mean_bending, math.sqrt(3) * notch.torsion * load.mean_torque)
    used = (alternating / endurance + mean / strength) * _N_MM * 16 / (math.pi * _size(d) ** 3)
    return math.inf if used == 0 else 1 / used


def _size(value: float) -> float:
    """A diameter or stress, or an array of them."""
    least = float(np.min(value))
    if not least > 0:
        raise GeometryError(f"a diameter or stress of {least:g} carries nothing; it has to be above 0")
    return value
