"""Published figures of fused filament printing that hold until a coupon is measured.

Sources: 3dprintcalcs.uk, common tolerances (holes, clearances, accuracy); OrcaSlicer's published profiles
(first layer); makers' data sheets of filament (densities). The spread between sources is as large as the
figures: a printer is known when its coupon is measured.

Glossary
--------
deviation
    Printed size less drawn size, mm: a hole that comes out small has a negative one.
foot
    By how much the first layer stands out on each side, because it is squeezed onto the bed.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np

JointKind = Literal["press", "snug", "sliding", "loose", "turning"]
"""What a shaft does in its hole, from tight to free."""

HOLE_DEVIATIONS = ((2.5, -0.40), (5.0, -0.30), (10.0, -0.25), (20.0, -0.20), (30.0, -0.15))
"""Diameter of an upright hole and its deviation, mm: the middles of the published ranges, nozzle 0.4, PLA."""

PUBLISHED: dict[JointKind, float] = {
    "press": 0.05,
    "snug": 0.125,
    "sliding": 0.2,
    "loose": 0.35,
    "turning": 0.5,
}
"""Clearance on each side that is drawn for a kind of joint, mm: the middles of the published ranges, PLA."""
TIGHTER = 0.1
"""On each side a printed hole is tighter than it was drawn for these, mm: half of what sources agree on."""
CLEARANCES = {kind: round(drawn - TIGHTER, 6) for kind, drawn in PUBLISHED.items()}
"""Clearance on each side of what is printed, mm: holes here are corrected, and those were not."""

LINE = 1.05
"""Width of a printed line in diameters of the nozzle: 0.42 mm of 0.4."""
LINES = 2
"""A wall, a tooth's tip or a pin takes so many lines: one has no second side, and breaks off."""
BRIDGE = 10.0
"""Longest bridge without support, mm; handbook, unchecked."""
STEEP = 45.0
"""Least slope of a wall that stands without support, degrees from the bed."""


@dataclass(frozen=True, slots=True)
class Filament:
    """A material of filament: density in g/cm³, and what all its clearances take more than PLA, mm."""

    name: str
    title: str
    density: float
    more: float = 0.0


FILAMENTS = {
    one.name: one
    for one in (
        Filament("pla", "PLA", 1.24),
        Filament("petg", "PETG", 1.27, 0.075),
        Filament("abs", "ABS", 1.04, 0.075),
        Filament("asa", "ASA", 1.07, 0.075),
        Filament("pa", "PA (nylon)", 1.12, 0.075),
    )
}
"""Filaments by name."""


def hole_deviation(diameter: float) -> float:
    """Deviation of an upright hole of a printer that is not measured, mm; straight between the figures.

    >>> hole_deviation(5.0), hole_deviation(1.0), hole_deviation(50.0)
    (-0.3, -0.4, -0.15)
    """
    sizes, off = zip(*HOLE_DEVIATIONS, strict=True)
    return float(np.interp(diameter, sizes, off))
