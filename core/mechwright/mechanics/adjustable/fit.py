"""Fits of adjustable linkages to the points of all their phases."""

from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.adjustable.task import Task
from mechwright.mechanics.tracing.descent import descend

WEIGHTS = (1.0, 10.0, 100.0)
"""Of the limits, one after the other: a start is led to them, then held."""


@dataclass(frozen=True, slots=True)
class Fit:
    """Fitted linkages: unknowns (s, k), crank angles (s, n), rad, and sums of squares (s,).

    ``squares`` are those of the points' distances, in sizes of the path; ``excess`` the most by which a limit
    is passed.
    """

    x: Array
    theta: Array
    squares: Array
    excess: Array

    def best(self, count: int) -> "Fit":
        """The nearest ones, first the nearest; limits that are passed count as distance."""
        order = np.argsort(self.squares + self.excess**2, kind="stable")[:count]
        return Fit(self.x[order], self.theta[order], self.squares[order], self.excess[order])


def fit(task: Task, x: Array, theta: Array, steps: int, weights: tuple[float, ...] = WEIGHTS) -> Fit:
    """Fit from starts (s, k) and (s, n); ``steps`` for each of the weights."""
    sense = senses(task, theta)
    for weight in weights:
        x, theta = descend(task, x, theta, sense, weight, steps, fine=True)
    squares = (task.misses(x, theta) ** 2).sum(axis=(-1, -2))
    return Fit(x, theta, squares, task.excess(x, theta).max(axis=-1))


def senses(task: Task, theta: Array) -> Array:
    """Sense (s, n) in which the crank goes through each point's phase, from the last one's angle."""
    last = np.array([np.flatnonzero(task.phase == k)[-1] for k in range(task.unknowns.phases)])
    return np.where(theta[:, last][:, task.phase] >= 0, 1.0, -1.0)
