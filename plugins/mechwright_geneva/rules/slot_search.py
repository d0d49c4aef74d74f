"""Searches among curved slots: which angles and rollers the rules of the slots allow."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright import Array, Stage
from mechwright.contracts.rule_list import in_turn
from mechwright_geneva.kinematics.horn_clearance import clear
from mechwright_geneva.kinematics.mechanism import Mechanism
from mechwright_geneva.kinematics.slot_limits import FINE_SAMPLES, SWEEP_SAMPLES
from mechwright_geneva.parameters import GenevaParams, Sizes
from mechwright_geneva.rules.body import DRIVER, LOCK_ROOM
from mechwright_geneva.rules.feasibility import BOTTOM_ANGLE, ENTRY_ANGLE, ROLLERS
from mechwright_geneva.rules.slots import BOTTOM, CURVED

LIMITS = in_turn(BOTTOM_ANGLE, ENTRY_ANGLE, ROLLERS, BOTTOM, DRIVER, CURVED, LOCK_ROOM)
"""What a slot must satisfy so that wheel, driver and locking disc can be made; the cheap rules first."""

WIDEST_OFFSET = 60.0
"""Largest offset angle that the design table takes, degrees."""

_FIRST, _SECOND = 161, 41
"""Values tried over the whole range, and then between the first good one and its neighbour."""

_STEP = 0.01
"""Remedies are given in hundredths, rounded to the safe side."""


def trial(params: GenevaParams, size: int, samples: int, **columns: Any) -> Mechanism:
    """Mechanisms (n,) that differ from a design in some numbers; those that are not given are left alone.

    Parameters
    ----------
    params
        The design; it need not be complete but for what the rules of the slots look at.
    size
        The number n of mechanisms.
    samples
        Of half a stroke.
    columns
        Keys to numbers or arrays (n,).
    """
    values: dict[str, Any] = {name: getattr(params, name, None) for name in Sizes.model_fields}
    values |= {name: one[:, None] if np.ndim(one) else one for name, one in columns.items()}
    return Mechanism(Sizes.model_construct(**values), size, samples)


def allowed(m: Mechanism) -> NDArray[np.bool_]:
    """Which mechanisms (n,) of a table the rules of the slots allow."""
    found = np.zeros(m.size, bool)
    with np.errstate(all="ignore"):
        _, places = LIMITS.allowed(m, Stage.PARTS, lambda *_: None)
    found[places] = True
    return found


def is_valid_at(m: Mechanism, half: float) -> bool:
    """Whether the slots can be made, and a disc locks the wheel, with another half angle of the crank."""
    other = trial(m.params, 1, SWEEP_SAMPLES, crank_half_angle=np.array([half]))
    return bool(allowed(other).all()) and locks(other, other.least_lock)


def locks(m: Mechanism, disc: Any) -> bool:
    """Whether the horns of one wheel leave the ends of a locking disc of this radius, mm."""
    frame = m.frame.columns(m.size)
    clearance = np.asarray(m.params.lock_clearance, dtype=float)
    return bool(clear(frame, m.law, np.ravel(disc), clearance).all())


def least_offset(m: Mechanism) -> float | None:
    """The offset angle nearest to the present one that the rules allow, degrees; None if none does."""

    def good(values: Array, samples: int) -> NDArray[np.bool_]:
        return allowed(trial(m.params, values.size, samples, offset_angle=values))

    grid = np.linspace(-WIDEST_OFFSET, WIDEST_OFFSET, 2 * _FIRST - 1)
    return _nearest(grid, math.degrees(m.frame.offset), good)


def greatest_roller(m: Mechanism) -> float | None:
    """The greatest roller radius below the present one that the rules allow, mm; None if none does."""

    def good(values: Array, samples: int) -> NDArray[np.bool_]:
        return allowed(trial(m.params, values.size, samples, roller_radius=values))

    return _nearest(np.linspace(0.5, m.roller, _FIRST), m.roller, good)


def slot_remedy(m: Mechanism) -> str:
    """The least offset angle and the greatest roller that the rules allow; empty if neither does."""
    offset, roller = least_offset(m), greatest_roller(m)
    remedies = []
    if offset is not None:
        remedies.append(f"use offset_angle = {offset:.2f}")
    if roller is not None:
        remedies.append(f"make roller_radius at most {roller:.2f}")
    return ", or ".join(remedies)


def _nearest(grid: Array, now: float, good: Callable[[Array, int], NDArray[np.bool_]]) -> float | None:
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
    value = best / _STEP
    away = math.ceil(value - 1e-9) if best > now else math.floor(value + 1e-9)
    return away * _STEP
