"""Least and greatest values over a period, refined between samples; of one linkage or of a table."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.linkage.kinematics.period import inputs_at, phases_of
from mechwright.mechanics.linkage.planar_table import AnyPlanarTable
from mechwright.mechanics.planar.positions import Solution

SAMPLES = 181
"""Phases over a period among which an extreme is sought first: one every two degrees."""

FINER, ROUNDS = 8, 5
"""Points on each side of the best phase, and how often the grid is made finer about it: the last step is
6e-5 degrees, where a smooth extreme is flat to 1e-13 of the value."""

Value = Callable[[Solution], Array]
"""A value (..., m) of positions at m phases."""


@dataclass(frozen=True)
class Extreme:
    """A value and the phase at which it is reached; numbers or columns (n, 1)."""

    value: Array
    phase: Array


def least(table: AnyPlanarTable, value: Value, turn: float = 0.0) -> Extreme:
    """The least value over a period.

    With a ``turn`` values are angles, counted on over the samples: those that differ by turns are one.
    """
    phases, coarse = table.once("positions by phase", lambda: _coarse(table))
    phases = np.broadcast_to(phases, (table.size, SAMPLES))
    step = (phases[:, -1:] - phases[:, :1]) / (SAMPLES - 1)
    values, rows = _known(value(coarse), phases.shape), np.arange(table.size)[:, None]
    for _ in range(ROUNDS):
        best = values.argmin(axis=-1)[:, None]
        centre, before = phases[rows, best], values[rows, best]
        phases = centre + step / FINER * np.arange(-FINER, FINER + 1)
        step = step / FINER
        values = _known(value(table.solved_at(inputs_at(table, phases), 0)), phases.shape)
        if turn:
            values = values + turn * np.round((before - values[:, FINER : FINER + 1]) / turn)
    best = values.argmin(axis=-1)[:, None]
    return Extreme(values[rows, best], phases[rows, best])


def extent(table: AnyPlanarTable, value: Value, turn: float = 0.0) -> Array:
    """Greatest less least value (n, 1) over a period; of an angle that turns on, how far it turns."""
    low, high = least(table, value, turn), least(table, lambda found: -value(found), turn)
    reach = -high.value - low.value
    if not turn:
        return np.asarray(reach)
    whole = _known(value(table.once("positions by phase", lambda: _coarse(table))[1]), (table.size, SAMPLES))
    turned = np.abs(whole[:, -1:] - whole[:, :1])
    return np.where(turned > turn / 2, turned, reach)


def _coarse(table: AnyPlanarTable) -> tuple[Array, Solution]:
    phases = phases_of(SAMPLES)
    return phases, table.solved_at(inputs_at(table, phases), 0)


def _known(values: Array, shape: tuple[int, ...]) -> Array:
    return np.broadcast_to(np.where(np.isnan(values), math.inf, values), shape)
