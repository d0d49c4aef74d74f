"""What a curved slot must satisfy, as array conditions: the one place for checks, sweeps and syntheses."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mechwright import Array
from mechwright.mechanics.laws import Law
from mechwright_geneva.kinematics import Frame
from mechwright_geneva.limits import SWEEP_SAMPLES, Measures, measure

LEAST_TIP = 0.5
"""Least radius of the island's tip, mm: a sharper one chips, and cannot be measured."""

LEAST_BITE = 2.0
"""Least depth of a concave arc in the wheel, mm: less is worn away before it locks anything."""

LEAST_LOCKED = math.radians(5)
"""Least turn of the crank between two strokes over which the disc locks the wheel, rad."""


@dataclass(frozen=True, slots=True)
class Walls:
    """What a design asks of every wall; mm.

    Parameters
    ----------
    least
        Thinnest wall anywhere.
    hub
        Radius of shaft opening or hub, around which that wall stays.
    driver
        Radius about the crank's axis that the relief must leave to the locking disc.
    clearance
        Of the locking disc.
    rollers
        On the driver.
    """

    least: float
    hub: float
    driver: float
    clearance: float
    rollers: int


def possible(frame: Frame, radius: Array, walls: Walls) -> dict[str, NDArray[np.bool_]]:
    """Condition that needs no stroke to which of m designs satisfy it, (m,) each; ``radius`` is (m, 1)."""
    entry = frame.entry_angle
    mouth = frame.entry_radius * np.sin(np.abs(frame.offset))
    held = {
        "angles": (entry + frame.crank_half / 2 < math.pi / 2) & (entry > 0),
        "rollers": frame.crank_half <= math.pi / walls.rollers - LEAST_LOCKED / 2,
        "bottom": frame.bottom - radius >= walls.hub + walls.least,
        "driver": frame.axes - frame.entry_radius - walls.clearance >= walls.driver,
        "mouth": mouth > radius * np.sin(frame.wheel_half + frame.crank_half),
    }
    return {name: np.broadcast_to(values, radius.shape)[:, 0] for name, values in held.items()}


def measured(frame: Frame, radius: Array, found: Measures, walls: Walls) -> dict[str, NDArray[np.bool_]]:
    """The same for the conditions on what has been measured."""
    r = radius[:, 0]
    overlap = np.broadcast_to(frame.axes - frame.entry_radius, radius.shape)[:, 0]
    greatest_lock = found.nearest - r - walls.clearance - walls.least
    return {
        "side": found.mouth > 0,
        "undercut": (found.island_limit > r) & (found.hub_limit > r),
        "tip": found.island_limit - r >= LEAST_TIP,
        "loop": found.width > 0,
        "island": 2 * found.neck >= walls.least,
        "web": found.web >= walls.least,
        "lock": greatest_lock + walls.clearance >= overlap + LEAST_BITE,
    }


def sound(
    law: Law,
    wheel_half: ArrayLike,
    crank_half: ArrayLike,
    offset: ArrayLike,
    entry_radius: ArrayLike,
    radius: ArrayLike,
    walls: Walls,
    samples: int = SWEEP_SAMPLES,
) -> NDArray[np.bool_]:
    """Which of m designs satisfy all conditions.

    Parameters
    ----------
    law
        Any but the straight slot's.
    wheel_half, crank_half, offset
        θw0, θd0, θoff, rad; scalars or (m,), at least one of them (m,).
    entry_radius, radius
        l and half the width of a slot, mm; scalars or (m,).
    walls
        What every design must keep.
    samples
        Of half a stroke.

    Returns
    -------
    sound
        (m,) bool.
    """
    shape = np.broadcast_shapes(*map(np.shape, (wheel_half, crank_half, offset, entry_radius, radius)))
    crank = np.broadcast_to(np.asarray(crank_half, dtype=float), shape)
    frame = Frame.of(wheel_half, crank, offset, entry_radius)
    wide = np.broadcast_to(np.asarray(radius, dtype=float), shape)[:, None]
    # Most designs of a sweep fail a condition that costs nothing: only the rest are measured.
    able = np.logical_and.reduce(list(possible(frame, wide, walls).values()))
    good = np.zeros(shape, dtype=bool)
    if able.any():
        part = frame.rows(able)
        found = measure(part, law, wide[able], samples)
        good[able] = np.logical_and.reduce(list(measured(part, wide[able], found, walls).values()))
    return good
