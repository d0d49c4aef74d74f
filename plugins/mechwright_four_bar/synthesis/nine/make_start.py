"""Make the start of nine points: ``python -m mechwright_four_bar.synthesis.nine.make_start`` (minutes).

One linkage is drawn by lot, and points that its curve passes through. Closed loops of the points lead its
solution to others (monodromy), those again to others, until their number is that of the literature and loops
bring nothing new. The points are then moved to where the worst of the solutions is least ill-conditioned, and
the loops are done again there.
"""

import sys
from itertools import pairwise

import numpy as np

from mechwright import Array
from mechwright.mechanics.planar import Plane
from mechwright_four_bar.synthesis.nine.equations import POINTS, evaluate
from mechwright_four_bar.synthesis.nine.start import FILE, any_points
from mechwright_four_bar.synthesis.nine.tracking import ARRIVED, Paths, settle, tracked
from mechwright_four_bar.synthesis.nine.triples import TRIPLES, keys, members, new_ones

SEED = 23
"""Of all that is drawn."""

QUIET = 3
"""Loops in turn that bring nothing new, after which the solutions are taken to be all."""

PLACES = 10
"""Sets of points among which the best conditioned one is taken."""

SETTLED = 1e-9
"""Last step of Newton of what is kept."""


def any_linkage(rng: np.random.Generator) -> tuple[Plane, Plane]:
    """A solution (1, 8) and its points (2, 8).

    For a turn T both dyads are of the form δ δ̄ + l δ + m δ̄ + n = 0, and their difference is linear.
    """
    z = rng.normal(size=8) + 1j * rng.normal(size=8)
    turns = np.exp(2j * np.pi * rng.random(POINTS)) * rng.uniform(0.7, 1.4, POINTS)
    (l1, m1, n1), (l2, m2, n2) = (
        (x_ / turns - a_, x * turns - a, x * a_ + a * x_ - x * a_ * turns - x_ * a / turns)
        for x, x_, a, a_ in (z[:4], z[4:])
    )
    slope, offset = -(l1 - l2) / (m1 - m2), -(n1 - n2) / (m1 - m2)
    linear, constant = offset + l1 + m1 * slope, m1 * offset + n1
    d = (-linear + np.sqrt(linear**2 - 4 * slope * constant)) / (2 * slope)
    return z[None], np.stack((d, slope * d + offset))


def moved(known: Plane, *stations: Plane) -> Plane:
    """Those of the solutions (n, 8) that come from the first station to the last."""
    for begin, end in pairwise(stations):
        paths: Paths = tracked(known, begin, end)
        known = paths.ends[paths.how == ARRIVED]
    last = np.empty(len(known))
    settle(known, stations[-1], 3, last)
    return known[last < SETTLED]


def looped(known: Plane, points: Plane, rng: np.random.Generator) -> Plane:
    """The solutions (n, 8) with those that a loop of the points leads to."""
    found = moved(known, points, any_points(rng), any_points(rng), points)
    return np.concatenate((known, found[new_ones(found, keys(known))]))


def closed(known: Plane, points: Plane, rng: np.random.Generator) -> Plane:
    """All solutions that loops lead to, until :data:`QUIET` of them bring nothing new."""
    quiet = 0
    while quiet < QUIET:
        more = looped(known, points, rng)
        quiet = 0 if len(more) > len(known) else quiet + 1
        known = more
    return known


def conditions(known: Plane, points: Plane) -> Array:
    """Reciprocal conditions (n,) of solutions (n, 8), rows scaled by their largest entries."""
    values, slopes, along = np.empty(8, complex), np.empty((8, 8), complex), np.empty(8, complex)
    answer = np.empty(len(known))
    for i, z in enumerate(known):
        evaluate(z, points, points, values, slopes, along)
        answer[i] = 1 / np.linalg.cond(slopes / np.abs(slopes).max(axis=1, keepdims=True))
    return answer


def made(seed: int = SEED) -> tuple[Plane, Plane]:
    """Points (2, 8) and solutions (n, 8), the best conditioned of each triple."""
    rng = np.random.default_rng(seed)
    known, points = any_linkage(rng)
    known = closed(known, points, rng)
    places = [any_points(rng) for _ in range(PLACES)]
    found = [moved(known, points, place) for place in places]
    worst = [float(conditions(one, place).min()) for one, place in zip(found, places, strict=True)]
    best = int(np.argmax(worst))
    points, known = places[best], closed(found[best], places[best], rng)
    choices = members(known)
    each = np.stack([conditions(np.ascontiguousarray(choices[:, i]), points) for i in range(3)], axis=1)
    return points, np.take_along_axis(choices, each.argmax(axis=1)[:, None, None], axis=1)[:, 0]


def main() -> int:
    """Write the file; 1 where the number is not that of the literature, and nothing is written."""
    points, solutions = made()
    worst = conditions(solutions, points).min()
    sys.stdout.write(f"{len(solutions)} triples, the least reciprocal condition {worst:.2g}\n")
    if len(solutions) != TRIPLES:
        return 1
    np.savez_compressed(FILE, points=points, solutions=solutions.astype(np.complex64))
    return 0


if __name__ == "__main__":
    sys.exit(main())
