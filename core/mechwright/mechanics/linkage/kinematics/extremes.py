"""Least and greatest values over a period, refined between samples; of one linkage or of a table."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.linkage.kinematics.period import inputs_at, phases_of
from mechwright.mechanics.linkage.planar_table import AnyPlanarTable
from mechwright.mechanics.planar.positions import Solution

if TYPE_CHECKING:
    from mechwright.mechanics.planar.compiled_chain import CompiledChain

SAMPLES = 181
"""Phases over a period among which an extreme is sought first: one every two degrees."""

FINER, ROUNDS = 8, 5
"""Points on each side of the best phase, and how often the grid is made finer about it: the last step is
6e-5 degrees, where a smooth extreme is flat to 1e-13 of the value."""


@dataclass(frozen=True)
class Quantity:
    """A number of the positions of a linkage.

    Parameters
    ----------
    of
        Its values (..., m) in a solution of m positions.
    row
        Its row in a compiled chain.
    measure
        The quantity from the values of the row, where these are another one.
    """

    of: Callable[[Solution], Array]
    row: "Callable[[CompiledChain], int]"
    measure: Callable[[Array], Array] | None = None

    def at(self, table: AnyPlanarTable, inputs: Array) -> Array:
        """Its values (n, m) at inputs (n, m); infinite where the linkage does not close."""
        chain, shape = table.chain, (table.size, inputs.shape[-1])
        if chain is None:
            values = self.of(table.solved_at(inputs, 0))
        else:
            values = chain.values(np.broadcast_to(inputs, shape), [self.row(chain)])[:, 0]
            values = values if self.measure is None else self.measure(values)
        return np.broadcast_to(np.where(np.isnan(values), math.inf, values), shape)


@dataclass(frozen=True)
class Extreme:
    """A value and the phase at which it is reached; numbers or columns (n, 1)."""

    value: Array
    phase: Array


def least(table: AnyPlanarTable, quantity: Quantity, turn: float = 0.0, sign: float = 1.0) -> Extreme:
    """The least value over a period of ``sign`` times a quantity.

    With a ``turn`` values are angles, counted on over the samples: those that differ by turns are one.
    """
    values = sign * _coarse(table, quantity)
    phases = np.broadcast_to(phases_of(SAMPLES), values.shape)
    step = (phases[:, -1:] - phases[:, :1]) / (SAMPLES - 1)
    rows = np.arange(table.size)[:, None]
    for _ in range(ROUNDS):
        best = values.argmin(axis=-1)[:, None]
        centre, before = phases[rows, best], values[rows, best]
        phases = centre + step / FINER * np.arange(-FINER, FINER + 1)
        step = step / FINER
        values = sign * quantity.at(table, inputs_at(table, phases))
        if turn:
            values = values + turn * np.round((before - values[:, FINER : FINER + 1]) / turn)
    best = values.argmin(axis=-1)[:, None]
    return Extreme(values[rows, best], phases[rows, best])


def extent(table: AnyPlanarTable, quantity: Quantity, turn: float = 0.0) -> Array:
    """Greatest less least value (n, 1) over a period; of an angle that turns on, how far it turns."""
    low, high = least(table, quantity, turn), least(table, quantity, turn, -1.0)
    reach = -high.value - low.value
    if not turn:
        return np.asarray(reach)
    whole = _coarse(table, quantity)
    turned = np.abs(whole[:, -1:] - whole[:, :1])
    return np.where(turned > turn / 2, turned, reach)


def _coarse(table: AnyPlanarTable, quantity: Quantity) -> Array:
    def found() -> Array:
        return quantity.at(table, inputs_at(table, phases_of(SAMPLES)))

    return table.once(("by phase", quantity), found)
