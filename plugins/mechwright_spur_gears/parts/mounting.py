"""Where the shafts of a pair stand and what loads them."""

import math

from mechwright import Mounting, MountingError
from mechwright.mechanics.gearing.pair_parts import pair_mounting
from mechwright_spur_gears.gear_table import GearTable


def mounting_of(m: GearTable) -> Mounting:
    """Both shafts: a torque T on gear 1 presses the teeth together with T/(r_w1 cos α_w).

    Raises MountingError for gears without a bore, for a ring, which has no shaft, and for a rack.
    """
    if m.straight:
        raise MountingError(
            "parameters.arrangement: a rack slides in a guide, and a frame has none; leave the frame out"
        )
    if m.ring:
        raise MountingError(
            "parameters.arrangement: a ring is screwed to what turns with it, and has no shaft for a frame; "
            "leave the frame out"
        )
    pair = m.pair
    force = 1000 / (float(pair.operating(0)) * math.cos(float(pair.operating_angle)))
    return pair_mounting(m.given, float(m.distance), force, 1 / abs(float(m.ratio)))
