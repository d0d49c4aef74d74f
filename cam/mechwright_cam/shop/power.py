"""What a cut asks of the spindle, and what the spindle has.

Kienzle's law: a chip h mm thick is cut with k_c = k_c1.1 h^-m N/mm² on its cross-section. A tooth of a mill
that is fed f_z per tooth meets h = f_z sin φ sin κ, with φ from 0 where it enters the material to the
engagement φ_s, and κ the angle of its edge (90 degrees for a flat end). The mean over that way is

    k = k_c1.1 (f_z sin κ)^-m ∫ sin^(1-m) φ dφ / (1 - cos φ_s),

and the power that goes into chips is k times the rate of removal: exact for a cylinder, where the usual rule
with a mean chip is 2 to 4 % above it.
"""

import math
from functools import cache
from typing import Any

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.materials import Material
from mechwright_cam.shop.machine import Machine

THINNEST = 0.002
"""Thinnest chip, mm, that the law is asked about, and feed per tooth below which edges rub: about the radius
of an edge that is new."""
NARROWEST = 0.02
"""Least engagement, rad: below it the quotient of integral and width is one of rounding errors."""
ANGLES = np.linspace(0.0, math.pi, 18001)
WATTS = 1 / 60
"""N/mm² times cm³/min: a joule per cm³, in a minute."""


@cache
def _integral(exponent: float) -> Array:
    """Integral of sin^(1-m) from 0 to each of ``ANGLES``, by the rule of trapezia."""
    height = np.sin(ANGLES).clip(0.0) ** (1 - exponent)
    steps = (height[1:] + height[:-1]) / 2 * np.diff(ANGLES)
    return np.concatenate(([0.0], np.cumsum(steps)))


def milling_force(stuff: Material, tooth: Any, engagement: Any) -> Array:
    """Mean specific force (n,), N/mm², of teeth that take ``tooth`` mm (f_z sin κ) over an engagement, rad.

    Examples
    --------
    A slot of a 6 mm mill with 3 teeth in aluminium, 3 mm deep at 11671 rev/min and 0.042 mm per tooth:

    >>> from mechwright.contracts.materials import material
    >>> removal = 6 * 3 * 11671 * 3 * 0.042 / 1000  # cm³/min
    >>> round(float(milling_force(material("aluminium"), 0.042, math.pi)) * removal * WATTS, 1)
    741.1
    """
    engagement = np.clip(engagement, NARROWEST, math.pi)
    m = stuff.force_exponent
    share = np.interp(engagement, ANGLES, _integral(m)) / (1 - np.cos(engagement))
    out: Array = stuff.force * np.maximum(tooth, THINNEST) ** -m * share
    return out


def drilling_force(stuff: Material, chip: Any) -> Array:
    """Specific force (n,), N/mm², of an edge that never leaves the material, with chips this thick, mm."""
    out: Array = stuff.force * np.maximum(chip, THINNEST) ** -stuff.force_exponent
    return out


def available(machine: Machine, rpm: Any) -> Array:
    """Power (n,), kW, that the spindle has for the cut at a speed, rev/min: its torque is the limit below.

    >>> machine = Machine(spindle_power=2.2, spindle_torque=10.5, spindle_efficiency=0.8)
    >>> [round(float(available(machine, n)), 3) for n in (1000, 2000, 8000)]
    [0.88, 1.759, 1.76]
    """
    by_torque = machine.spindle_torque * 2 * math.pi * np.asarray(rpm, dtype=np.float64) / 60 / 1000
    out: Array = machine.spindle_efficiency * np.minimum(machine.spindle_power, by_torque)
    return out


def slower(stuff: Material, needed: float, given: float) -> float:
    """Share of the feed at which a cut that needs so much power needs no more than is given.

    Power goes with f_z^(1-m): thinner chips are harder to cut.
    """
    return float((given / needed) ** (1 / (1 - stuff.force_exponent)))
