"""The smallest change of one parameter that makes a curved slot sound."""

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from mechwright import Array
from mechwright_geneva.limits import FINE_SAMPLES, SWEEP_SAMPLES
from mechwright_geneva.mechanism import Mechanism
from mechwright_geneva.openings import driver_opening, driver_radius, hub_radius, reach
from mechwright_geneva.sound import Walls, sound

_FIRST, _SECOND = 161, 41
"""Values tried over the whole range, and then between the first good one and its neighbour."""

WIDEST_OFFSET = math.radians(60)
"""Largest offset angle that the design table takes, rad."""

_STEP = 0.01
"""Remedies are given in hundredths, rounded to the safe side."""


def walls_of(mechanism: Mechanism) -> Walls:
    """What this design asks of its walls."""
    params = mechanism.params
    driver = driver_radius(reach(driver_opening(params)), params.least_wall, params.fixing)
    return Walls(params.least_wall, hub_radius(params), driver, params.lock_clearance, params.rollers)


def least_offset(mechanism: Mechanism) -> float | None:
    """The offset angle nearest to the present one that makes the slot sound, degrees; None if none does."""
    m = mechanism
    now = float(m.frame.offset)

    def good(values: Array, samples: int) -> NDArray[np.bool_]:
        return sound(m.law, m.wheel_half, m.crank_half, values, m.rim, m.groove, walls_of(m), samples)

    grid = np.linspace(-WIDEST_OFFSET, WIDEST_OFFSET, 2 * _FIRST - 1)
    return _nearest(grid, now, good, math.degrees)


def greatest_roller(mechanism: Mechanism) -> float | None:
    """The greatest roller radius below the present one that makes the slot sound, mm; None if none does."""
    m = mechanism
    clearance = m.params.groove_clearance / 2

    def good(values: Array, samples: int) -> NDArray[np.bool_]:
        offset = float(m.frame.offset)
        walls = walls_of(m)
        return sound(m.law, m.wheel_half, m.crank_half, offset, m.rim, values + clearance, walls, samples)

    grid = np.linspace(0.5, m.roller, _FIRST)
    return _nearest(grid, m.roller, good, float)


def slot_cure(mechanism: Mechanism) -> str:
    """The least offset angle and the greatest roller that make a curved slot sound; empty if neither does."""
    offset, roller = least_offset(mechanism), greatest_roller(mechanism)
    cures = []
    if offset is not None:
        cures.append(f"use offset_angle = {offset:.2f}")
    if roller is not None:
        cures.append(f"make roller_radius at most {roller:.2f}")
    return ", or ".join(cures)


def _nearest(
    grid: Array,
    now: float,
    good: Callable[[Array, int], NDArray[np.bool_]],
    unit: Callable[[float], float],
) -> float | None:
    """The good value nearest to ``now``, rounded away from it by less than a step."""
    able = grid[good(grid, SWEEP_SAMPLES)]
    if not able.size:
        return None
    best = float(able[np.argmin(np.abs(able - now))])
    towards = best - np.sign(best - now) * (grid[1] - grid[0])
    fine = np.linspace(best, towards, _SECOND)
    holds = good(fine, FINE_SAMPLES)
    if holds.any():
        # From the good end on, up to the first that fails.
        last = int(np.argmin(np.append(holds, False))) - 1
        best = float(fine[max(last, 0)])
    value = unit(best) / _STEP
    away = math.ceil(value - 1e-9) if best > now else math.floor(value + 1e-9)
    return away * _STEP
