"""Where the shafts of a pair stand and what loads them."""

import math

import numpy as np

from mechwright import Hub, Mounting, MountingError, Spindle
from mechwright_noncircular_gears.gear import pair_of
from mechwright_noncircular_gears.law import GRID, law_of
from mechwright_noncircular_gears.params import NoncircularParams


def mounting_of(params: NoncircularParams) -> Mounting:
    """Both shafts. A torque T on gear 1 is T/i on gear 2 and presses the teeth together with T/(r1 cos α).

    Raises MountingError for gears without a bore, and for a ring, which has no shaft.
    """
    if params.internal:
        raise MountingError(
            "parameters.internal: a ring is screwed to what turns with it, and has no shaft for a frame; "
            "leave the frame out",
        )
    if params.bore == 0:
        raise MountingError(
            "parameters.bore: gears without a bore have no shafts; set bore = 10",
            ({"parameters.bore": 10.0},),
        )
    pair, law = pair_of(params), law_of(params)
    phi = law.grid(GRID)
    r1 = pair.pitch_radii(phi)[0]
    force = float(1000 / (r1.min() * math.cos(math.radians(params.pressure_angle))))
    slowest = float(np.min(law.rates(phi)[0]))
    hub = Hub(0.0, params.thickness, params.bore, params.keyway_width, material=params.material)
    return Mounting(
        (
            Spindle("1", "gear-1", (0.0, 0.0), hub, "parameters.bore", drives=True, force=force),
            Spindle(
                "2", "gear-2", (pair.distance, 0.0), hub, "parameters.bore", torque=1 / slowest, force=force
            ),
        )
    )
