"""Stroke and time ratio from the simulated motion alone, as a proof of the closed forms."""

import math

import numpy as np

from mechwright import KinematicsError
from mechwright_slider_crank.kinematics.slider_crank import SliderCrank

_GRID = 4096
"""Positions of a turn; two reversals less than a tenth of a degree apart belong to no crank that turns."""

_STEPS = 60
"""Halvings that bring an interval of a turn down to the rounding of its angle."""


def simulated(linkage: SliderCrank) -> tuple[float, float]:
    """Stroke, mm, and time ratio, at least 1, from where the slider's velocity changes its sign.

    Raises
    ------
    KinematicsError
        The crank does not get round, or the slider does not reverse exactly twice.

    Examples
    --------
    >>> stroke, ratio = simulated(SliderCrank(50.0, 150.0, 20.0))
    >>> round(stroke, 9), round(ratio, 9)
    (101.01789771, 1.066563892)
    """
    grid = np.linspace(0, math.tau, _GRID + 1)
    velocity = linkage.velocities(grid)
    if not np.isfinite(velocity).all():
        raise KinematicsError("the crank does not get round: the linkage cannot be assembled everywhere")
    velocity[-1] = velocity[0]  # one place: without an offset the slider reverses just there
    rising = velocity > 0
    turns = np.flatnonzero(rising[:-1] != rising[1:])
    if turns.size != 2:
        raise KinematicsError(f"the slider reverses {turns.size} times in a turn, not twice")
    low, high, before = grid[turns], grid[turns + 1], rising[turns]
    for _ in range(_STEPS):
        middle = (low + high) / 2
        same = (linkage.velocities(middle) > 0) == before
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    ends = (low + high) / 2
    position = linkage.positions(ends)
    arc = float(ends[1] - ends[0])
    longer = max(arc, math.tau - arc)
    return abs(float(position[1] - position[0])), longer / (math.tau - longer)
