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

import math

import numpy as np

from mechwright import TOLERANCES, Array
from mechwright_elliptic_gears.params import EllipticGearParams

LEFT = 2 * TOLERANCES.leftover
"""mm, on two flanks that meet: what the proof of a program lets pass on each."""

OFF_CENTRE = 4 * (TOLERANCES.gouge + TOLERANCES.leftover) / 2
"""mm. A hole that keeps the leftover limit on one side and is cut too deep by the gouge limit on the other
has its middle off by half of both. Two gears on two holes of a base have four such holes."""

PLANNED = 2 * (TOLERANCES.arc_fit + TOLERANCES.flatten)
"""mm, on two flanks that meet: what a path that keeps its own tolerance may leave of each. With less room
than that a pair as made is sure to jam at some position, however exact its axes are."""

STEP = 1e-3
"""mm: backlashes are whole micrometres, upwards."""


def least_backlash(params: EllipticGearParams) -> float:
    """Backlash, mm, of the pair or train.

    Examples
    --------
    >>> least_backlash(EllipticGearParams()), least_backlash(EllipticGearParams(stages=2))
    (0.067, 0.107)
    """
    return _backlash(params, LEFT, OFF_CENTRE)


def jamming_backlash(params: EllipticGearParams) -> float:
    """Backlash, mm, below which walls as they are planned jam at the exact centre distance.

    >>> jamming_backlash(EllipticGearParams())
    0.011
    """
    return _backlash(params, PLANNED, 0.0)


def _backlash(params: EllipticGearParams, left: float, off_centre: float) -> float:
    alpha = np.asarray(math.radians(params.pressure_angle))
    if params.stages == 1:
        return float(_of_pairs(np.asarray(params.eccentricity), alpha, left, off_centre))
    return float(_up(2 * (left + off_centre) / np.cos(alpha)))


def least_backlashes(eccentricity: Array, pressure_angle: Array) -> Array:
    """As :func:`least_backlash` of many pairs (n,), their angles in rad."""
    return _of_pairs(eccentricity, pressure_angle, LEFT, OFF_CENTRE)


def _of_pairs(eccentricity: Array, alpha: Array, left: float, off_centre: float) -> Array:
    share = np.sin(alpha) / np.sqrt(1 - eccentricity**2)
    return _up(2 * (left + off_centre * share) / np.cos(alpha))


def _up(backlash: Array) -> Array:
    up: Array = np.round(np.ceil(backlash / STEP) * STEP, 6)
    return up


def backlash_of(params: EllipticGearParams) -> float:
    """The design's backlash, mm."""
    return least_backlash(params) if params.backlash is None else params.backlash


def with_backlash(params: EllipticGearParams, backlash: float) -> EllipticGearParams:
    """The same design with another backlash, mm."""
    return params.model_copy(update={"backlash": backlash})
