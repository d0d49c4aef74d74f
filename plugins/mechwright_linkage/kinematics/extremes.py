"""The least value over a period, refined between samples; of one linkage or of a table."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mechwright import Array
from mechwright.mechanics.planar.positions import Solution
from mechwright_linkage.kinematics.linkage_table import LinkageTable
from mechwright_linkage.kinematics.period import inputs_at, phases_of

SAMPLES = 181
"""Phases over a period among which an extreme is sought first: one every two degrees."""

FINER, ROUNDS = 8, 5
"""Points on each side of the best phase, and how often the grid is made finer about it: the last step is
6e-5 degrees, where a smooth extreme is flat to 1e-13 of the value."""

Value = Callable[[Solution], Array]
"""A value (..., m) of the motion at m phases."""


@dataclass(frozen=True)
class Extreme:
    """A value and the phase at which it is reached; numbers or columns (n, 1)."""

    value: Array
    phase: Array


def least(table: LinkageTable, value: Value, order: int = 0) -> Extreme:
    """The least value over a period; ``order`` is the highest rate of the motion that the value needs."""
    phases = np.broadcast_to(phases_of(table, SAMPLES), (table.size, SAMPLES))
    step = (phases[:, -1:] - phases[:, :1]) / (SAMPLES - 1)

    def at(places: Array) -> Array:
        found = value(table.solved_at(inputs_at(table, places), order))
        return np.broadcast_to(np.where(np.isnan(found), np.inf, found), places.shape)

    values, rows = at(phases), np.arange(table.size)[:, None]
    for _ in range(ROUNDS):
        best = values.argmin(axis=-1)[:, None]
        centre = phases[rows, best]
        phases = centre + step / FINER * np.arange(-FINER, FINER + 1)
        step, values = step / FINER, at(phases)
    best = values.argmin(axis=-1)[:, None]
    return Extreme(values[rows, best], phases[rows, best])
