"""The solutions of one set of complex points, from which those of all others are followed.

The file ``start.npz`` was made by :mod:`mechwright_four_bar.synthesis.nine.make_start`, which makes it again.
"""

from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np

from mechwright.mechanics.planar import Plane
from mechwright_four_bar.synthesis.nine.equations import POINTS
from mechwright_four_bar.synthesis.nine.tracking import settle

FILE = Path(__file__).with_name("start.npz")
"""``points`` (2, 8) complex128 and ``solutions`` (n, 8) complex64: some seven digits, which settle."""

SETTLING = 8
"""Newton's steps from seven digits to all that doubles hold."""


@dataclass(frozen=True)
class Start:
    """Points and the solutions there, one of each triple.

    Parameters
    ----------
    points
        (2, 8) δ and δ̄ of the points after the first, independent of each other.
    solutions
        (n, 8).
    """

    points: Plane
    solutions: Plane


def any_points(rng: np.random.Generator) -> Plane:
    """Points (2, 8) in general position, of about one size."""
    turns = np.exp(2j * np.pi * rng.random((2, POINTS)))
    points: Plane = turns * rng.uniform(0.6, 1.4, (2, POINTS))
    return points


@cache
def start() -> Start:
    """The start that is kept as data, in full precision."""
    with np.load(FILE) as kept:
        points, solutions = kept["points"], kept["solutions"].astype(np.complex128)
    settle(solutions, points, SETTLING, np.empty(len(solutions)))
    return Start(points, solutions)
