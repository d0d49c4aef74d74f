"""First order: what the zones of all contributors make of an output, by its sensitivities.

A *row* holds the sensitivities of one output, an array (c, m, ...) for each contributor; the axes behind are
positions, or none. An error is then the sum of sensitivity times deviation.
"""

from collections.abc import Sequence

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.tolerances import Contributor

Row = Sequence[Array]

_STEPS = 12
"""Steps of the search for the farthest corner: each goes to a corner at least as far, and they are few."""


def mean(contributors: Sequence[Contributor], row: Row) -> Array:
    """Mean error (c, ...): what is left of zones that do not lie evenly about the nominal size."""
    parts = zip(contributors, row, strict=True)
    return np.asarray(sum(s[:, 0] * one.mean for one, s in parts if one.mean) + 0.0 * row[0][:, 0])


def variances(contributors: Sequence[Contributor], row: Row) -> Array:
    """Variance (k, ...) of the error by contributor: of a point, of all its coordinates together."""
    return np.stack(
        [one.variance * (s * s).sum(axis=(0, 1)) for one, s in zip(contributors, row, strict=True)]
    )


def limits(contributors: Sequence[Contributor], row: Row) -> tuple[Array, Array]:
    """Least and greatest error (...) of an output of one component, all contributors at their worst."""
    low = high = np.zeros(row[0].shape[2:])
    for one, part in zip(contributors, row, strict=True):
        s = part[0]
        if one.directions:
            swing = one.reach * np.sqrt((s * s).sum(axis=0))
            low, high = low - swing, high + swing
        else:
            ends = np.stack([s[0] * one.lower, s[0] * one.upper])
            low, high = low + ends.min(axis=0), high + ends.max(axis=0)
    return low, high


def farthest(contributors: Sequence[Contributor], row: Row) -> Array:
    """Greatest length (...) of the error of an output of several components.

    The possible errors fill a convex body, whose farthest point is sought from many directions: the point
    farthest in one direction gives the next, which is never nearer.
    """
    components = row[0].shape[0]
    starts = _directions(components)
    shape = row[0].shape[2:]
    d = np.broadcast_to(starts.reshape(*starts.shape, *(1,) * len(shape)), (*starts.shape, *shape))
    best = np.zeros(shape)
    for _ in range(_STEPS):
        point = np.zeros(d.shape)
        for one, s in zip(contributors, row, strict=True):
            along = np.einsum("cm...,ck...->mk...", s, d)
            if one.directions:
                size = np.sqrt((along * along).sum(axis=0))
                place = one.reach * along / np.where(size > 0, size, 1.0)
            else:
                place = np.where(along > 0, one.upper, one.lower)
            point += np.einsum("cm...,mk...->ck...", s, place)
        length = np.sqrt((point * point).sum(axis=0))
        best = np.maximum(best, length.max(axis=0))
        d = point / np.where(length > 0, length, 1.0)
    return best


def _directions(components: int) -> Array:
    """Directions (c, k) all round."""
    if components == 2:
        turn = np.arange(16) * (np.pi / 8)
        return np.stack([np.cos(turn), np.sin(turn)])
    steps = np.array(np.meshgrid(*[(-1.0, 0.0, 1.0)] * components)).reshape(components, -1)
    length = np.sqrt((steps * steps).sum(axis=0))
    return np.asarray(steps[:, length > 0] / length[length > 0])
