"""Linkages to start a search from.

Every linkage with a full crank and a transmission angle of at least μ comes from exactly one set of coupler
c, follower b and 0 < p1 < p2 < 1: with L, U = b² + c² ∓ 2 b c cos μ the shortest and the longest diagonal
from A to B0 are D² = L + (U - L) p1 and L + (U - L) p2, and these are abs(f - a) and f + a.
"""

import math

import numpy as np

from mechwright import Array

MOST_RATIO = 100.0
"""Starts have no link longer than this many others, whatever is allowed."""

MOST_DRAWS = 10
"""How often as many shapes are drawn as are wanted: few keep a ratio of links near the least there is."""


def link_lengths(
    double: bool, b: Array, c: Array, p1: Array, p2: Array, least_angle: float
) -> tuple[Array, Array]:
    """Crank and ground of a crank-rocker, or of a double crank, from follower, coupler and two shares.

    Lengths in one unit, ``p1`` < ``p2`` in 0 to 1, ``least_angle`` rad.

    >>> sizes = (np.array(value) for value in (60.0, 80.0, 0.25, 0.7))
    >>> a, f = link_lengths(False, *sizes, math.radians(40))
    >>> round(float(a), 6), round(float(f), 6)
    (17.121995, 96.639205)
    """
    swing = 2 * b * c * math.cos(least_angle)
    low, wide = b * b + c * c - swing, 2 * swing
    near, far = np.sqrt(low + wide * p1), np.sqrt(low + wide * p2)
    short, long = (far - near) / 2, (far + near) / 2
    return (long, short) if double else (short, long)


def random_shapes(
    count: int, double: bool, ratio: float, least_angle: float, rng: np.random.Generator
) -> Array:
    """At most ``count`` shapes (m, 3) of the kernels, within a ratio of links and a transmission angle."""
    kept = np.empty((0, 3))
    for _ in range(MOST_DRAWS):
        kept = np.concatenate((kept, _shapes(count, double, ratio, least_angle, rng)))[:count]
        if len(kept) == count:
            break
    return kept


def _shapes(count: int, double: bool, ratio: float, least_angle: float, rng: np.random.Generator) -> Array:
    spread = math.log(min(ratio, MOST_RATIO))
    b, c = np.exp(rng.uniform(0, spread, (2, count)))
    p1, p2 = np.sort(rng.uniform(0, 1, (2, count)), axis=0)
    a, f = link_lengths(double, b, c, p1, p2, least_angle)
    links = np.stack((a, b, c, f))
    with np.errstate(divide="ignore"):
        shapes = np.column_stack(
            (np.log(a / f), np.log((b + c) / (a + f) - 1), np.arctanh((b - c) / np.abs(a - f)))
        )
    good = (links.max(axis=0) <= links.min(axis=0) * math.exp(spread)) & np.isfinite(shapes).all(axis=1)
    kept: Array = shapes[good]
    return kept
