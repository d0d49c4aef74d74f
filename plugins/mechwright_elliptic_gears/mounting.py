"""Where the shafts of a pair stand, and what loads them."""

import math

from mechwright import DesignError, Hub, Mounting, Spindle
from mechwright_elliptic_gears.gear import ellipse_of
from mechwright_elliptic_gears.params import EllipticGearParams


def mounting_of(params: EllipticGearParams) -> Mounting:
    """Both shafts of a pair; raises DesignError for a train, and for gears without a bore.

    At the pitch radii r2 and r4 a torque T on gear 2 is T r4/r2 on gear 4, and presses the teeth together
    with T/(r2 cos α): both are greatest where r2 is least, a (1 - e), and r4 is a (1 + e).
    """
    if params.stages > 1:
        raise DesignError(
            "machine.frame: a train stands on its own base plate with its own shafts, and no other frame is "
            'built for it; leave frame out, or set frame = "none"'
        )
    if params.bore == 0:
        raise DesignError("parameters.bore: gears without a bore have no shafts; set bore = 10")
    ellipse = ellipse_of(params)
    a, e = ellipse.semi_major, params.eccentricity
    force = 1000 / (a * (1 - e) * math.cos(math.radians(params.pressure_angle)))
    hub = Hub(0.0, params.thickness, params.bore, params.keyway_width, material=params.material)
    return Mounting(
        (
            Spindle("2", "gear-2", (0.0, 0.0), hub, "parameters.bore", drives=True, force=force),
            Spindle(
                "4", "gear-4", (2 * a, 0.0), hub, "parameters.bore", torque=(1 + e) / (1 - e), force=force
            ),
        )
    )
