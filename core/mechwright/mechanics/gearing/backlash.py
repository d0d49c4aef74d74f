"""The least backlash with which gears as made go together and turn.

What a wall keeps takes play away, and so does an axis that stands off its place. With D the greatest
thickness left on two flanks that meet, c the greatest error of the centre distance, α the pressure angle and
ν the greatest tilt of the common pitch tangent, a pair whose driven gear finds its own angle turns at every
position with a backlash of

    2 (D + c sin α / cos ν) / cos α

because both flanks share what there is.
"""

import numpy as np

from mechwright.arrays import Array
from mechwright.tolerances import OFF_CENTRE, TOLERANCES

LEFT = 2 * TOLERANCES.leftover
"""mm, on two flanks that meet: what the proof of a program lets pass on each."""

PLANNED = 2 * (TOLERANCES.arc_fit + TOLERANCES.flatten)
"""mm, on two flanks that meet: what a path that keeps its own tolerance may leave of each. With less room
than that a pair as made is sure to jam at some position, however exact its axes are."""

STEP = 1e-3
"""mm: backlashes are whole micrometres, upwards."""


def pair_backlash(
    upright: Array | float, alpha: Array | float, left: float = LEFT, off_centre: float = OFF_CENTRE
) -> Array:
    """Backlash (...), mm, of pairs with cos ν ``upright`` (...) and pressure angles ``alpha`` (...), rad.

    Examples
    --------
    >>> float(pair_backlash(1.0, 0.349))
    0.065
    """
    share = np.sin(alpha) / upright
    return whole(2 * (left + off_centre * share) / np.cos(alpha))


def whole(backlash: Array) -> Array:
    """Up to whole micrometres, mm (...)."""
    up: Array = np.round(np.ceil(backlash / STEP) * STEP, 6)
    return up
