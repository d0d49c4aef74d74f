"""How fast what is sampled changes: differences of eighth order, over the number of the sample."""

from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array

WIDTH = 9
"""Samples that a difference is taken of; among 1441 of a turn it is exact to 1e-9 of a 10th harmonic."""


def _weights() -> Array:
    """(WIDTH, 2, WIDTH): for each place in a window the weights of the first and second difference."""
    offsets = np.arange(WIDTH, dtype=float)
    found = np.empty((WIDTH, 2, WIDTH))
    for place in range(WIDTH):
        powers = (offsets - place)[None, :] ** np.arange(WIDTH)[:, None]
        wanted = np.zeros((WIDTH, 2))
        wanted[1, 0], wanted[2, 1] = 1.0, 2.0
        found[place] = np.linalg.solve(powers, wanted).T
    return found


_WEIGHTS = _weights()


def differences(values: Array) -> tuple[Array, Array]:
    """First and second differences (n, ...) of samples (n, ...), n at least 9.

    >>> one, two = differences(np.arange(12.0) ** 3)
    >>> [round(float(x), 6) for x in (one[0], one[5], two[11])]
    [0.0, 75.0, 66.0]
    """
    windows = np.lib.stride_tricks.sliding_window_view(values, WIDTH, axis=0)
    at = np.arange(len(values))
    first = np.clip(at - WIDTH // 2, 0, len(values) - WIDTH)
    both = np.einsum("nkw,n...w->kn...", _WEIGHTS[at - first], windows[first])
    return both[0], both[1]


@dataclass(frozen=True, eq=False)
class Timed:
    """Frames of a body with their first and second derivative over time, (n, 3, 4) each."""

    frames: Array
    first: Array
    second: Array


def over_time(values: Array, time: Array) -> tuple[Array, Array]:
    """Derivatives of samples (n, ...) over time (n,), s, whose steps may differ."""
    one, two = differences(values)
    shape = (-1, *[1] * (values.ndim - 1))
    pace, change = (each.reshape(shape) for each in differences(time))
    return one / pace, (two - one * change / pace) / pace**2
