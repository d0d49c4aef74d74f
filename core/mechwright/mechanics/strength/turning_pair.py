"""Strength of a turning pair of a linkage: a pin pressed into one plate, on which another one turns.

The pin stands out of its plate, and the other plate presses on it in the middle of its thickness. Sources:
Roloff/Matek, Maschinenelemente, for pins and plain bushes; forces and speeds are those of the dynamics.
"""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.materials import material
from mechwright.mechanics.strength.allowed import PIN_BENDING, PIN_SHEAR, allowed
from mechwright.mechanics.strength.bearings_life import (
    POM_PV,
    POM_SPEED,
    SINTERED_PV,
    SINTERED_SPEED,
    bush_pressure,
)
from mechwright.mechanics.strength.fastening import pin_shear, stud_bending
from mechwright.mechanics.strength.judging import STUD_SHARE, Stress


@dataclass(frozen=True)
class TurningPair:
    """A joint over a period, lengths in mm.

    Parameters
    ----------
    name
        For findings.
    force
        Its size (n,), N.
    turning
        Of one body over the other (n,), rad/s.
    pin, arm
        Diameter of the pin, and from the plate that holds it to the middle of the one that turns.
    width, bore, rim
        Thickness of the plate that turns, its bore, bushing included, and the material beside it.
    plate
        Material of that plate.
    bushed
        Whether it has a plain bushing.
    """

    name: str
    force: Array
    turning: Array
    pin: float
    arm: float
    width: float
    bore: float
    rim: float
    plate: str
    bushed: bool

    @property
    def greatest(self) -> float:
        """N."""
        return float(np.abs(self.force).max())

    @property
    def sliding(self) -> Array:
        """Speed of the pin's surface in its bore (n,), m/s."""
        return np.asarray(np.abs(self.turning) * self.pin / 2000)

    @property
    def warmth(self) -> float:
        """Mean of pressure and sliding speed over the samples, MPa m/s: what heats the bearing."""
        pressure = bush_pressure(1.0, self.pin, self.width) * np.abs(self.force)
        return float(np.mean(pressure * self.sliding))


def pin_stresses(pairs: Iterable[TurningPair]) -> list[Stress]:
    """Shear and bending of hardened pins, whose load turns over."""
    found = []
    for pair in pairs:
        shear, bending = pin_shear(pair.greatest, pair.pin), stud_bending(pair.greatest, pair.arm, pair.pin)
        found += [
            Stress(f"{pair.name} is sheared with", shear, PIN_SHEAR["hardened, alternating"]),
            Stress(f"{pair.name} is bent with", bending, PIN_BENDING),
        ]
    return found


def eye_stresses(pairs: Iterable[TurningPair]) -> list[Stress]:
    """Tension of the plates beside their bores."""
    return [
        Stress(
            f"the plate beside {pair.name} is pulled with",
            pair.greatest / (2 * pair.rim * pair.width),
            STUD_SHARE * allowed(pair.plate).endurance,
            material(pair.plate).strength,
        )
        for pair in pairs
    ]


def bush_stresses(pairs: Iterable[TurningPair]) -> list[Stress]:
    """What heats and wears plain bearings: of bushings, and of pins in bare POM.

    Pins in other bare metal are for swings by hand: nobody has a figure for them.
    """
    found = []
    for pair in pairs:
        if not pair.bushed and pair.plate != "pom":
            continue
        heat, speed = (SINTERED_PV, SINTERED_SPEED) if pair.bushed else (POM_PV, POM_SPEED)
        fastest = float(pair.sliding.max())
        found += [
            Stress(f"pressure times sliding speed at {pair.name} is", pair.warmth, heat, unit="MPa m/s"),
            Stress(f"{pair.name} slides with", fastest, speed, unit="m/s"),
        ]
    return found
