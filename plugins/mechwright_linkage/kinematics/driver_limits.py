"""How far a driver goes: inputs at which a linkage no longer closes, on both sides of its drawn position."""

from math import tau

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.planar.assembly_order import Cluster, assembly_order
from mechwright.mechanics.planar.machine import Machine
from mechwright.mechanics.planar.positions import solve
from mechwright.mechanics.planar.rigid import Turning

SAMPLES = 1440
"""Of chains of dyads over a turn on each side: a gap shorter than a quarter of a degree is overlooked."""
FOLLOWED = 360
"""Of other linkages, which are followed from sample to sample."""
HALVINGS = 50


def driver_limits(machine: Machine, start: float) -> tuple[Array, Array]:
    """The range of the driver about a position in which the linkage closes.

    Parameters
    ----------
    machine
        A machine with one drive; numbers may be columns (n, 1).
    start
        Input at which it is drawn, rad.

    Returns
    -------
    low, high
        Both (...), rad, within a turn from ``start``: -inf and inf where the driver turns fully, NaN where
        the linkage does not close at ``start``. Both are to rounding for chains of dyads. Of other linkages
        they are the last sample that closes, within a degree of the limit.
    """
    order = assembly_order(machine)
    refined = not any(isinstance(group, Cluster) for group in order)
    samples = SAMPLES if refined else FOLLOWED
    steps = np.arange(samples + 1) * (tau / samples)
    limits = []
    for sense in (-1.0, 1.0):
        at = start + sense * steps
        closes = solve(machine, [Turning.of(np.sort(at), 1.0)], order).closes
        closes = closes if sense > 0 else closes[..., ::-1]
        first = np.argmin(closes, axis=-1)
        low, high = steps[np.maximum(first - 1, 0)], steps[first]
        for _ in range(HALVINGS if refined else 0):
            middle = (low + high) / 2
            inputs = start + sense * middle[..., None]
            inside = solve(machine, [Turning.of(inputs, 1.0)], order).closes[..., 0]
            low, high = np.where(inside, middle, low), np.where(inside, high, middle)
        limit = np.where(closes.all(axis=-1), sense * np.inf, start + sense * low)
        limits.append(np.where(closes[..., 0], limit, np.nan))
    return limits[0], limits[1]
