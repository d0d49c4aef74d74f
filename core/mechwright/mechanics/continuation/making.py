"""Starts, made: a solution drawn by lot, and loops until they bring nothing new."""

import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np

from mechwright.mechanics.continuation.complete import Start
from mechwright.mechanics.continuation.loops import closed
from mechwright.mechanics.continuation.system import System
from mechwright.mechanics.continuation.trace import EXACT, keep_cut, trace, whole_cut
from mechwright.mechanics.planar import Plane

SEED = 23
"""Of all that is drawn."""

QUIET = 8
"""Loops in turn that bring nothing new, after which the solutions are taken to be all."""


def make(
    system: System,
    any_solution: Callable[[np.random.Generator], tuple[Plane, Plane]],
    any_parameters: Callable[[np.random.Generator], Plane],
    file: Path,
    expected: int,
) -> int:
    """Write ``parameters`` (k,) and all ``solutions`` (n, m) there.

    Parameters
    ----------
    any_solution
        Draws a solution (1, m) and its parameters (k,).
    any_parameters
        Draws parameters (k,).
    expected
        How many solutions there are.

    Returns
    -------
    int
        0, or 1 where the number is another, and nothing is written.
    """
    rng = np.random.default_rng(SEED)
    known, parameters = any_solution(rng)

    def heard(count: int) -> None:
        sys.stderr.write(f"{count} solutions\n")

    solutions = closed(system, known, parameters, lambda: any_parameters(rng), QUIET, heard)
    sys.stdout.write(f"{len(solutions)} solutions\n")
    if len(solutions) != expected:
        return 1
    np.savez_compressed(file, parameters=parameters, solutions=solutions)
    return 0


def make_cut(system: System, start: Start, moving: int, file: Path) -> int:
    """Write the cut of a line of parameters that proves how many solutions there are.

    Parameters
    ----------
    moving
        How many of the parameters move on the line, the first ones.

    Returns
    -------
    int
        0, or 1 where the sums say another number than that of the start, and nothing is written.
    """

    def heard(count: int) -> None:
        sys.stderr.write(f"{count} points\n")

    cut = whole_cut(system, start, 0, moving, np.random.default_rng(SEED), heard)
    found = trace(system, cut)
    sys.stdout.write(f"{found}\n")
    if found is None or not found.proves(len(start.solutions), EXACT):
        return 1
    keep_cut(cut, file)
    return 0
