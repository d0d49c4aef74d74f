"""Stresses of teeth and keys of a pair of gears under the loads of a turn.

A tooth carries alone at the pitch point: the root is that of a circular gear of the pitch curve's curvature,
loaded at its tip, the flanks press on each other with Hertz's pressure.
"""

import math
from typing import Protocol

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.materials import material
from mechwright.geometry.keyway import Opening
from mechwright.mechanics.strength.allowed import (
    PIN_SHEAR,
    REVERSING_KEY,
    REVERSING_ROOT,
    ROOT_SAFETY,
    allowed,
)
from mechwright.mechanics.strength.fastening import LONGEST_KEY, key_pressure, key_shear
from mechwright.mechanics.strength.hertz import contact_modulus, flank_radius, line_pressure, relative_radius
from mechwright.mechanics.strength.judging import Stress
from mechwright.mechanics.strength.tooth_bending import Rack, root_stress, virtual_teeth

KEY_STEEL = "steel"
"""Of keys."""


class Plate(Protocol):
    """What a design says of gears from one plate."""

    @property
    def thickness(self) -> float:
        """Face width, mm."""

    @property
    def material(self) -> str:
        """Of the gears."""


def bent_root(
    what: str, plate: Plate, force: Array, radius: Array, rack: Rack, module: float, *, reverses: bool
) -> Stress | None:
    """Bending at the roots of a gear; None where the model has no figure.

    ``force`` (n,), N, is along the pitch tangent, ``radius`` (n,), mm, that of the pitch curve's curvature.
    """
    with np.errstate(all="ignore"):  # a rack far from the standard one has no section of 30 degrees
        teeth = virtual_teeth(radius, module)
        value = float(root_stress(force, plate.thickness, module, teeth, rack=rack).max())
    if not math.isfinite(value):
        return None
    bears = allowed(plate.material).root
    return Stress(what, value, bears * (REVERSING_ROOT if reverses else 1.0), ROOT_SAFETY * bears)


def pressed_flanks(
    what: str, plate: Plate, force: Array, one: Array, two: Array, pressure_angle: float
) -> Stress:
    """Hertz pressure at the pitch point by the radii (n,), mm, of both pitch curves' curvature; it wears."""
    own = material(plate.material)
    radius = relative_radius(flank_radius(one, pressure_angle), flank_radius(two, pressure_angle))
    force = force / math.cos(pressure_angle)
    pressure = line_pressure(force, plate.thickness, radius, contact_modulus(own, own))
    return Stress(what, float(pressure.max()), allowed(plate.material).contact)


def loaded_key(
    plate: Plate, opening: Opening | None, torque: float, *, reverses: bool, gear: str = ""
) -> tuple[Stress, ...]:
    """Pressure on a hub and shear of its key under a torque, N m; none without a key.

    ``gear`` names the gear where keys differ.
    """
    if opening is None or not opening.has_keyway:
        return ()
    bore, own = opening.bore, material(plate.material)
    bears = min(plate.thickness, LONGEST_KEY * bore)
    limit = (REVERSING_KEY if reverses else 1.0) * allowed(plate.material).key
    key = f"the key of gear {gear}" if gear else "the key"
    return (
        Stress(
            f"{key} presses on {'it' if gear else 'its hub'} with",
            key_pressure(torque, bore, opening.key_top - bore / 2, bears),
            limit,
            own.strength,
        ),
        Stress(
            f"{key} is sheared with",
            key_shear(torque, bore, opening.width, bears),
            PIN_SHEAR["alternating" if reverses else "swelling"],
            material(KEY_STEEL).strength / 2,
        ),
    )
