"""Where the shafts of a pair stand and what loads them."""

import math

from mechwright import Hub, Mounting, MountingError, Spindle
from mechwright_spur_gears.gear_table import GearTable


def mounting_of(m: GearTable) -> Mounting:
    """Both shafts: a torque T on gear 1 presses the teeth together with T/(r_w1 cos α_w).

    Raises MountingError for gears without a bore.
    """
    params, pair = m.given, m.pair
    if params.bore == 0:
        raise MountingError(
            "parameters.bore: gears without a bore have no shafts; set bore = 10",
            ({"parameters.bore": 10.0},),
        )
    force = 1000 / (float(pair.operating(0)) * math.cos(float(pair.operating_angle)))
    hub = Hub(0.0, params.thickness, params.bore, params.keyway_width, material=params.material)
    axis, torque = (float(pair.distance), 0.0), 1 / float(m.ratio)
    return Mounting(
        (
            Spindle("1", "gear-1", (0.0, 0.0), hub, "parameters.bore", drives=True, force=force),
            Spindle("2", "gear-2", axis, hub, "parameters.bore", torque=torque, force=force),
        )
    )
