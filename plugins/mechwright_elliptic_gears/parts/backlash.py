"""The least backlash with which gears as made go together and turn.

What a wall keeps takes play away, and so does an axis that stands off its place. With D the greatest
thickness left on two flanks that meet, c the greatest error of the centre distance, α the pressure angle and
e the eccentricity, a pair whose driven gear finds its own angle turns at every position with a backlash of

    2 (D + c sin α / √(1 - e²)) / cos α

because the common tangent of the pitch curves tilts by arcsin e at the worst, and both flanks share what
there is. Where keys and a coupler fix the angles of the gears, each flank needs its own, whichever way an
axis is off:

    2 (D + c) / cos α
"""

from typing import Any

import numpy as np

from mechwright.contracts.design_table import number
from mechwright.mechanics.gearing.backlash import LEFT, PLANNED, pair_backlash, whole
from mechwright.tolerances import OFF_CENTRE
from mechwright_elliptic_gears.parameters import EllipticGearParams


def least_backlash(params: EllipticGearParams) -> Any:
    """Backlash, mm, of the pair or train; a column of a table.

    Examples
    --------
    >>> least_backlash(EllipticGearParams()), least_backlash(EllipticGearParams(stages=2))
    (0.067, 0.107)
    """
    return _backlash(params, LEFT, OFF_CENTRE)


def jamming_backlash(params: EllipticGearParams) -> Any:
    """Backlash, mm, below which walls as they are planned jam at the exact centre distance.

    >>> jamming_backlash(EllipticGearParams())
    0.011
    """
    return _backlash(params, PLANNED, 0.0)


def _backlash(params: EllipticGearParams, left: float, off_centre: float) -> Any:
    alpha = np.radians(params.pressure_angle)
    if params.stages == 1:
        # The common tangent of two equal ellipses tilts by arcsin e at the worst.
        upright = np.sqrt(1 - np.square(params.eccentricity))
        return number(pair_backlash(upright, alpha, left, off_centre))
    return number(whole(2 * (left + off_centre) / np.cos(alpha)))


def backlash_of(params: EllipticGearParams) -> Any:
    """The design's backlash, mm."""
    return least_backlash(params) if params.backlash is None else params.backlash


def with_backlash(params: EllipticGearParams, backlash: float) -> EllipticGearParams:
    """The same design with another backlash, mm."""
    return params.model_copy(update={"backlash": backlash})
