"""Make the start of two poles: ``python -m mechwright_slider_crank.make_pole_start``, minutes of one core.

A linkage is drawn by lot, moved, and loops of its poles lead to the others, until they bring nothing new.
"""

import sys

import numpy as np

from mechwright.mechanics.continuation import closed
from mechwright.mechanics.planar import Plane
from mechwright_slider_crank.all_poles import FILE, SOLUTIONS
from mechwright_slider_crank.pole_system import TWO_POLES, any_parameters, any_solution

SEED = 23
"""Of all that is drawn."""

QUIET = 8
"""Loops in turn that bring nothing new, after which the solutions are taken to be all."""


def made(seed: int = SEED) -> tuple[Plane, Plane]:
    """Parameters (5,) and all solutions (n, 4) there."""
    rng = np.random.default_rng(seed)
    known, parameters = any_solution(rng)

    def heard(count: int) -> None:
        sys.stderr.write(f"{count} solutions\n")

    return parameters, closed(TWO_POLES, known, parameters, lambda: any_parameters(rng), QUIET, heard)


def main() -> int:
    """Write the file; 1 where the number is another than before, and nothing is written."""
    parameters, solutions = made()
    sys.stdout.write(f"{len(solutions)} solutions\n")
    if len(solutions) != SOLUTIONS:
        return 1
    np.savez_compressed(FILE, parameters=parameters, solutions=solutions)
    return 0


if __name__ == "__main__":
    sys.exit(main())
