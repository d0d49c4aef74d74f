"""Crank angles in the order of the points."""

import math

import numpy as np

from mechwright.arrays import Array

TURN = math.tau * (1 - 1e-9)
"""Most that the crank turns from the first point to the last."""

MANY = 64
"""Points up to which all sequences at once are the quicker way; its time grows with the square."""


def isotonic(values: Array) -> Array:
    """The nearest sequences (..., n) that do not fall, by least squares.

    The greatest over i ≤ k of the least over j ≥ k of the means from i to j: what pooling adjacent violators
    gives, for many sequences at once. Points that want to step back share an angle.

    >>> isotonic(np.array([0.0, 3.0, 1.0, 2.0, 5.0])).tolist()
    [0.0, 2.0, 2.0, 2.0, 5.0]
    """
    n = values.shape[-1]
    sums = np.concatenate([np.zeros_like(values[..., :1]), np.cumsum(values, axis=-1)], axis=-1)
    counts = np.arange(n)[None, :] - np.arange(n)[:, None] + 1
    inside = counts > 0
    means = (sums[..., None, 1:] - sums[..., :-1, None]) / np.where(inside, counts, 1)
    low = np.where(inside, means, np.inf)[..., ::-1]
    low = np.minimum.accumulate(low, axis=-1)[..., ::-1]  # least over j from k on, for each i
    low = np.where(inside, low, -np.inf)
    return np.asarray(low.max(axis=-2))


def one_way(theta: Array, sense: Array, slack: float = 0.0) -> Array:
    """The nearest angles (s, n), rad, that go one way within a turn of the crank, for senses (s, 1).

    ``slack`` is the angle by which a point may lie before the one before it.
    """
    back = slack * np.arange(theta.shape[-1])
    along = theta * sense + back
    found = (isotonic(along) if along.shape[-1] <= MANY else _isotonic_each(along)) - back
    return np.asarray(np.minimum(found, found[..., :1] + TURN) * sense)


def _isotonic_each(values: Array) -> Array:
    """The same as :func:`isotonic`, one sequence after the other, in time in proportion to its length."""
    from scipy.optimize import isotonic_regression  # half a second: requirements are read without it

    rows = values.reshape(-1, values.shape[-1])
    found = [isotonic_regression(row).x if np.isfinite(row).all() else row for row in rows]
    return np.asarray(found).reshape(values.shape)


def assigned(costs: Array) -> tuple[Array, np.ndarray]:
    """Least sums (...) of costs (..., t, n), and the samples (..., n) that give them, in rising order.

    Dynamic programming: each point takes a sample at or after that of the point before it.
    """
    samples, points = costs.shape[-2:]
    sums = costs[..., 0]
    back = []
    for point in range(1, points):
        best = np.minimum.accumulate(sums, axis=-1)
        here = np.arange(samples)
        back.append(np.maximum.accumulate(np.where(sums == best, here, 0), axis=-1))
        sums = costs[..., point] + best
    last = sums.argmin(axis=-1)
    chosen = [last]
    for one in reversed(back):
        chosen.append(np.take_along_axis(one, chosen[-1][..., None], axis=-1)[..., 0])
    return sums.min(axis=-1), np.stack(chosen[::-1], axis=-1)
