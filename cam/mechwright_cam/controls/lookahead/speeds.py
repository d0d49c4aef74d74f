"""Speeds along a row of stretches: what corners and feeds allow, and what acceleration makes of that."""

import numpy as np

from mechwright.arrays import Array

NO_LENGTH = 1e-6
"""A move shorter than this takes no time, mm."""


def reached(length: Array, acceleration: Array, allowed: Array) -> Array:
    """Speeds (n + 1,) at the ends of n stretches, mm/s.

    Parameters
    ----------
    length, acceleration
        (n,) mm and mm/s², of each stretch.
    allowed
        (n + 1,) greatest speed at each end, mm/s.

    Examples
    --------
    From rest, 1 mm at 50 mm/s² allows 10 mm/s:

    >>> reached(np.array([1.0, 9.0]), np.array([50.0, 50.0]), np.array([0.0, 80.0, 0.0])).tolist()
    [0.0, 10.0, 0.0]
    """
    square = allowed**2
    # v² may grow by 2aL along each stretch: a running minimum forwards, and another one backwards.
    gain = np.concatenate(([0.0], np.cumsum(2 * acceleration * length)))
    square = np.minimum.accumulate(square - gain) + gain
    back = gain[-1] - gain[::-1]
    square = (np.minimum.accumulate(square[::-1] - back) + back)[::-1]
    return np.asarray(np.sqrt(np.maximum(square, 0.0)))


def seconds(length: Array, acceleration: Array, speed: Array, ends: Array) -> Array:
    """Time (n,) of each stretch, s: a trapezoid between speeds ``ends`` (n + 1,), at most ``speed`` (n,)."""
    into, out_of = ends[:-1], ends[1:]
    peak = np.minimum(speed, np.sqrt((into**2 + out_of**2) / 2 + acceleration * length))
    ramps = (2 * peak**2 - into**2 - out_of**2) / (2 * acceleration)
    cruise = np.divide(np.maximum(length - ramps, 0.0), peak, out=np.zeros_like(peak), where=peak > 0)
    return np.where(peak > 0, (2 * peak - into - out_of) / acceleration + cruise, 0.0)
