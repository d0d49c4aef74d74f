"""What is one answer: the six solutions of a triple, which have one coupler curve.

The dyads of a four-bar can be exchanged, and Roberts' other two four-bars draw the same curve. With P the
coupler point, which is the origin at first, λ = (P - x) / (y - x) and C₀ = a + λ (b - a), they have the dyads

    (a - x, a), (C₀ + λ (y - b), C₀)   and   (C₀ + (1 - λ) (x - a), C₀), (b - y, b)

and the same with all bars.
"""

from typing import Any

import numpy as np
from scipy.spatial import cKDTree

from mechwright import Array
from mechwright.mechanics.planar import Plane

TRIPLES = 1442
"""Triples of nine points in general position (Wampler, Morgan and Sommese 1992: 8,652 solutions)."""

SAME = 1e-6
"""Difference of keys, in sizes of the points or of an order, below which two triples are taken for one."""


def members(z: Plane) -> Plane:
    """The three four-bars (n, 3, 8) of the triples of solutions (n, 8), the solution itself first."""
    x, a, y, b = (z[:, [i, i + 1]] for i in (0, 2, 4, 6))
    share = -x / (y - x)
    c = a + share * (b - a)
    two = a - x, a, c + share * (y - b), c
    three = c + (1 - share) * (x - a), c, b - y, b
    return np.stack([np.concatenate(one, axis=1) for one in ((x, a, y, b), two, three)], axis=1)


def fingerprints(z: Any) -> Any:
    """(n, 6) numbers, or balls, that are the same for all six solutions of a triple, of solutions (n, 8).

    They are the elementary symmetric functions of its fixed pivots, and these with bars, each as the first
    power of a length.
    """
    x, a, y, b = (z[:, [i, i + 1]] for i in (0, 2, 4, 6))
    c = (a * y - b * x) / (y - x)
    with np.errstate(over="ignore", invalid="ignore"):
        return np.concatenate((a + b + c, a * b + b * c + c * a, a * b * c), axis=1)


def keys(z: Plane) -> Array:
    """(n, 12) fingerprints as real numbers of moderate size: equal ones lie near, far pivots included."""
    prints = fingerprints(z)
    size = np.abs(prints)
    moderate = prints * (np.arcsinh(size) / np.maximum(size, 1e-300))
    return np.concatenate((moderate.real, moderate.imag), axis=1)


def new_ones(z: Plane, known: Array) -> list[int]:
    """Indices of the solutions (n, 8) whose triple is not among ``known`` keys (m, 12) nor earlier ones."""
    found = keys(z)
    fine = np.flatnonzero(np.isfinite(found).all(axis=1))
    tree = cKDTree(np.concatenate((known, found[fine])))
    nearest = [min(near) for near in tree.query_ball_point(tree.data[len(known) :], SAME, p=np.inf)]
    return [int(fine[i]) for i, near in enumerate(nearest) if near == len(known) + i]
