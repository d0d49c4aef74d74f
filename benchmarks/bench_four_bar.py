"""Four-bar loci and syntheses against their targets: ``python benchmarks/bench_four_bar.py``."""

import math
import sys
import time
from fractions import Fraction

import numpy as np
from harness import require

from mechwright_four_bar.kinematics.locus import locus
from mechwright_four_bar.synthesis.paths.asked import Limits, PathProblem
from mechwright_four_bar.synthesis.paths.search import search as path_search
from mechwright_four_bar.synthesis.poles.equations import PoleProblem
from mechwright_four_bar.synthesis.poles.search import search as pole_search

LINE = 20 + 1j * np.arange(20.0, 46.0, 5.0)
CLOSED = np.array(
    [
        *(0.5 + 1.1j, 0.4 + 1.1j, 0.3 + 1.1j, 0.2 + 1j, 0.1 + 0.9j, 0.005 + 0.75j, 0.02 + 0.6j, 0.5j, 0.4j),
        *(0.03 + 0.3j, 0.1 + 0.25j, 0.15 + 0.2j, 0.2 + 0.3j, 0.3 + 0.4j, 0.4 + 0.5j, 0.5 + 0.7j, 0.6 + 0.9j),
        0.6 + 1j,
    ]
)
POLES = np.array([2.34 + 4.09j, -0.53 + 5.86j, 2.98 + 5.83j])


def timed(work):
    """Processor time, s, and the result."""
    start = time.process_time()
    result = work()
    return time.process_time() - start, result


def problem_of(points, turns, shortest, angle):
    """Points within links that nobody would miss."""
    return PathProblem(points, turns, (1, -1), False, 0.0, Limits(shortest, 1000.0, math.radians(angle)))


def quiet(part):
    pass


def main() -> int:
    kept = []
    generic = [Fraction(text) for text in ("41.37", "120.12", "80.25", "101.5")]
    for plane in ("fixed", "coupler"):
        seconds, curve = timed(lambda plane=plane: locus.__wrapped__(*generic, plane))
        kept.append(require(f"locus, {plane}, degree {curve.degree}, s", seconds, 6.0))
    turns = np.radians(20 * np.arange(18))
    seconds, found = timed(lambda: path_search(problem_of(CLOSED, turns, 0.01, 1), 100_000, 5, 0, quiet))
    kept.append(require("18 timed points, s", seconds, 30.0))
    share = found.solutions[0].squares / 0.00992
    kept.append(require("18 timed points, sum of squares over 0.00992", share, 1.0))
    seconds, found = timed(lambda: path_search(problem_of(LINE, None, 10.0, 20), 100_000, 5, 0, quiet))
    kept.append(require("straight line, s", seconds, 30.0))
    kept.append(require("straight line, sum of squares over 1e-20", found.solutions[0].squares / 1e-20, 1.0))
    problem = PoleProblem(POLES, np.radians([0.0, 50.0, 150.0]), None, None, 1, full_turn=True)
    seconds, solved = timed(lambda: pole_search(problem, 5000, 0, quiet))
    kept.append(require(f"three poles, {len(solved.solutions)} linkages, s", seconds, 15.0))
    return 0 if all(kept) else 1


if __name__ == "__main__":
    sys.exit(main())
