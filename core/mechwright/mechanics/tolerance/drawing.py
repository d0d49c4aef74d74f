"""Deviations of mechanisms made at random."""

from collections.abc import Sequence

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.tolerances import CUT, Contributor, Zone


def draw(contributors: Sequence[Contributor], rng: np.random.Generator, count: int) -> list[Array]:
    """Deviations (m, count) of each contributor."""
    return [_one(contributor, rng, count) for contributor in contributors]


def _one(contributor: Contributor, rng: np.random.Generator, count: int) -> Array:
    total = np.zeros(count)
    for zone in contributor.zones:
        total += _within(zone, rng, count)
    if contributor.directions == 0:
        return total[None]
    total += contributor.nominal
    # Half the clearance; parts that would not go together are fitted until they do.
    radius = np.maximum(total, 0.0) / 2
    if contributor.directions == 1:
        return (radius * (2.0 * rng.integers(0, 2, count) - 1.0))[None]
    turn = rng.random(count) * (2 * np.pi)
    return np.stack([radius * np.cos(turn), radius * np.sin(turn)])


def _within(zone: Zone, rng: np.random.Generator, count: int) -> Array:
    """Deviations (count,) of one zone."""
    if zone.half == 0:
        return np.full(count, zone.middle)
    if zone.distribution == "uniform":
        return rng.uniform(zone.lower, zone.upper, count)
    if zone.distribution == "triangular":
        return rng.triangular(zone.lower, zone.middle, zone.upper, count)
    found = rng.standard_normal(count)
    while (beyond := np.flatnonzero(np.abs(found) > CUT)).size:
        found[beyond] = rng.standard_normal(beyond.size)
    return zone.middle + zone.half / CUT * found
