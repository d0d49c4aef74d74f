"""The points of a path: which of very many are searched with, and the crank angles of starts."""

import math

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array

SEARCHED = 40
"""Points that a search looks at; of more, so many are taken, and what is found is fitted to all."""

SMOOTHED = 9
"""Points of the running mean along which very many points are told apart: noise would lengthen the way."""

LEAST_SPAN, MOST_SPAN = math.radians(20), math.radians(355)
"""Turn of a free crank over all points of an open path in the starts."""

MOST_SWAY = 0.8
"""Greatest sway of the speed at which a start passes the points, over its mean."""


def in_plane(points: NDArray[np.complex128]) -> Array:
    """Points of the plane, x + i y, as (..., 2)."""
    return np.stack((points.real, points.imag), axis=-1)


def thinned(targets: Array, closed: bool) -> NDArray[np.intp]:
    """Indices of at most :data:`SEARCHED` of the points (n, d), even along the path.

    >>> thinned(np.arange(1000.0)[:, None], False)[[0, -1]].tolist()
    [0, 999]
    """
    n = len(targets)
    if n <= SEARCHED:
        return np.arange(n)
    half = SMOOTHED // 2
    padded = np.concatenate((targets[-half:], targets, targets[:half])) if closed else _ends(targets, half)
    sums = np.concatenate((np.zeros((1, targets.shape[1])), np.cumsum(padded, axis=0)))
    smooth = (sums[SMOOTHED:] - sums[:-SMOOTHED]) / SMOOTHED
    way = along(smooth, closed)
    wanted = np.linspace(0, way[-1], SEARCHED + 1)[:-1] if closed else np.linspace(0, way[-1], SEARCHED)
    return np.unique(np.clip(np.searchsorted(way[:n], wanted - 1e-9 * way[-1]), 0, n - 1))


def _ends(targets: Array, half: int) -> Array:
    return np.pad(targets, ((half, half), (0, 0)), "edge")


def along(targets: Array, closed: bool) -> Array:
    """Length of the path of points (n, d) up to each; of a closed one also back to the first, (n + 1,)."""
    steps = np.diff(np.concatenate((targets, targets[:1])) if closed else targets, axis=0)
    return np.concatenate(([0.0], np.cumsum(np.linalg.norm(steps, axis=1))))


def all_angles(chosen: NDArray[np.intp], phi: Array, count: int, closed: bool) -> Array:
    """Crank angles (count,) for all points from those of the chosen ones."""
    if closed:
        way = math.copysign(math.tau, phi[-1] - phi[0])
        chosen, phi = np.append(chosen, chosen[0] + count), np.append(phi, phi[0] + way)
    angles: Array = np.interp(np.arange(count), chosen, phi)
    return angles


def random_angles(
    count: int, targets: Array, turns: Array | None, way: int, closed: bool, rng: np.random.Generator
) -> Array:
    """Crank angles (count, n), rad, for points (n, d).

    These are the given ``turns`` (n,) from a random start, or a pass in the sense ``way`` at a swaying speed.
    """
    first = rng.uniform(0, math.tau, (count, 1))
    if turns is not None:
        return first + turns
    n = len(targets)
    chords = along(targets, closed)
    even = np.arange(n) / (n if closed else n - 1)
    mix = rng.uniform(0, 1, (count, 1))
    passed = mix * even + (1 - mix) * (chords[:n] / chords[-1])
    sway, phase = rng.uniform(0, MOST_SWAY, (count, 1)), rng.uniform(0, math.tau, (count, 1))
    passed = passed + sway / math.tau * (np.sin(math.tau * passed + phase) - np.sin(phase))
    span = math.tau if closed else rng.uniform(LEAST_SPAN, MOST_SPAN, (count, 1))
    angles: Array = first + way * span * passed
    return angles
