"""The torque of a screwed joint: the least of what its screw, thread, clamped part and holder bear.

Sources: VDI 2230 (strip area of the nut's and the bolt's thread), ISO 898-1; shear of rubber bonds by makers'
sheets. Figures of materials are those of :mod:`mechwright.mechanics.strength.allowed`.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from mechwright.mechanics.strength.bolts import (
    PROOF,
    friction_of,
    preload,
    stress_area,
    tightening_torque,
    yield_preload,
)

RUN_OUT = 0.8
"""Turns of an engaged thread that bear nothing: its countersink and the screw's point."""

STRIP_SAFETY = 1.5
"""Of a thread against stripping while it is tightened."""

LEAST_ENGAGED = 0.8
"""Length of thread that a screw has to engage in any case, in diameters: five turns of a coarse one."""

SCREW_SHEAR = {"8.8": 480.0, "10.9": 624.0, "12.9": 732.0, "A2-70": 420.0}
"""Strength class to the shear strength of the screw's own turns, MPa: 0.6 of the tensile strength."""

BOND = 0.5
"""Shear stress that the bond of rubber on metal bears for good, MPa; handbook."""

_ABOVE = 1.005
"""A torque is rounded up by less than this: half a percent is nothing to a torque wrench."""

Limit = Literal["screw", "thread", "head", "holder"]


@dataclass(frozen=True)
class Clamped:
    """A part under the head of a screw, or under its washer.

    Parameters
    ----------
    outside, hole
        Diameters of what presses on it and of its hole, mm.
    pressure
        That it bears, MPa.
    """

    outside: float
    hole: float
    pressure: float

    @property
    def force(self) -> float:
        """That it bears, N."""
        return self.pressure * math.pi / 4 * (self.outside**2 - self.hole**2)


@dataclass(frozen=True)
class Tightening:
    """What a screw is tightened to: torque, N m, preload, N, and what does not bear more."""

    torque: float
    force: float
    limit: Limit


def torque_text(torque: float) -> str:
    """A torque, N m, to two digits, and never half a percent above itself.

    >>> torque_text(5.449), torque_text(4.971), torque_text(0.785)
    ('5.4', '4.9', '0.78')
    """
    if torque <= 0:
        return "0"
    digit = 10.0 ** (math.floor(math.log10(torque)) - 1)
    return f"{math.floor(torque * _ABOVE / digit) * digit:.2g}"


def strip_force(size: float, pitch: float, engaged: float, shear: float, grade: str = "8.8") -> float:
    """At which the thread of a screw strips in a hole whose material bears ``shear``, MPa; N.

    >>> round(strip_force(5, 0.8, 10, 188.5), -1)
    24250.0
    """
    bearing = max(engaged - RUN_OUT * pitch, 0.0)
    pitch_diameter, core = size - 0.6495 * pitch, size - 1.0825 * pitch
    nut = math.pi * size / pitch * (pitch / 2 + (size - pitch_diameter) / math.sqrt(3))
    bolt = math.pi * core / pitch * (pitch / 2 + (pitch_diameter - core) / math.sqrt(3))
    return bearing * min(nut * shear, bolt * SCREW_SHEAR[grade])


def bond_torque(diameter: float) -> float:
    """That the bond of a round rubber buffer bears, N m: π/16 τ D³.

    >>> round(bond_torque(20), 3)
    0.785
    """
    return math.pi / 16 * BOND * diameter**3 / 1000


def tightening(
    screw: tuple[float, float, float, float],
    grade: str,
    strips_at: float,
    clamped: Sequence[Clamped] = (),
    most: float = math.inf,
) -> Tightening:
    """Torque and preload of a joint.

    Parameters
    ----------
    screw
        Size, pitch, diameter of the head and of the clearance hole under it, mm.
    grade
        Strength class.
    strips_at
        Force at which its thread strips, N.
    clamped
        What lies under the head.
    most
        Torque that the holder of the thread bears, N m.

    Examples
    --------
    >>> tightening((5, 0.8, 8.5, 5.5), "8.8", 24250).limit
    'screw'
    """
    size, pitch, head, hole = screw
    friction, proof = friction_of(grade), PROOF[grade]
    own = min(preload(stress_area(size, pitch), proof), yield_preload(size, pitch, proof, friction))
    forces: list[tuple[float, Limit]] = [
        (own, "screw"),
        (strips_at / STRIP_SAFETY, "thread"),
        *((one.force, "head") for one in clamped),
    ]
    force, limit = min(forces, key=lambda one: one[0])
    torque = tightening_torque(force, size, pitch, head, hole, friction)
    if torque <= most:
        return Tightening(torque, force, limit)
    return Tightening(most, force * most / torque, "holder")
