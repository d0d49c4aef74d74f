"""Where the shafts of a pair stand and what loads them."""

import math

from mechwright import Mounting, MountingError
from mechwright.mechanics.gearing.pair_parts import pair_mounting
from mechwright_noncircular_gears.kinematics.law import GRID
from mechwright_noncircular_gears.table import GearTable


def mounting_of(m: GearTable) -> Mounting:
    """Both shafts. A torque T on gear 1 is T/i on gear 2 and presses the teeth together with T/(r1 cos α).

    Raises MountingError for gears without a bore, and for a ring, which has no shaft.
    """
    if m.given.internal:
        raise MountingError(
            "parameters.internal: a ring is screwed to what turns with it, and has no shaft for a frame; "
            "leave the frame out",
        )
    phi = m.law.grid(GRID)
    cos = math.cos(math.radians(m.given.pressure_angle))
    force = float(1000 / (m.pair.pitch_radii(phi)[0].min() * cos))
    return pair_mounting(m.given, m.pair.distance, force, 1 / float(m.law.rates(phi)[0].min()))
