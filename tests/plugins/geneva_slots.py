"""Curved slots by themselves: whether the rules of the slots allow them, whatever hub and driver need."""

import numpy as np

from mechwright import Stage
from mechwright.contracts.rule_list import in_turn
from mechwright_geneva.kinematics.slot_limits import FINE_SAMPLES
from mechwright_geneva.parameters import GenevaParams
from mechwright_geneva.rules.body import LOCK_ROOM
from mechwright_geneva.rules.slot_search import trial
from mechwright_geneva.rules.slots import BOTTOM, CURVED

SLOTS_ALONE = in_turn(BOTTOM, CURVED, LOCK_ROOM)
NOTHING = {"least_wall": 0.0, "bore": 0.0, "lock_clearance": 0.0, "groove_clearance": 0.0}


def valid_slots(law, slots, half, offset, rim, radius):
    """Which designs (n,) can be made, angles in degrees; nothing is asked of walls."""
    half, offset, radius = np.broadcast_arrays(*(np.atleast_1d(one) for one in (half, offset, radius)))
    columns = {"crank_half_angle": half, "offset_angle": offset, "roller_radius": radius}
    table = trial(
        GenevaParams(law=law, slots=slots), half.size, FINE_SAMPLES, **columns, entry_radius=rim, **NOTHING
    )
    found = np.zeros(half.size, bool)
    with np.errstate(all="ignore"):
        _, places = SLOTS_ALONE.allowed(table, Stage.PARTS, lambda *_: None)
    found[places] = True
    return found
