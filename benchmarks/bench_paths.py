"""Linkages found again from points of their paths: ``python benchmarks/bench_paths.py [COUNT]``.

Each requirement is made from a random linkage with a full crank: 6 to 40 points of its coupler curve, open
or closed, timed or not, and as limits its own lengths, its own least transmission angle and, in half of
the four-bars, the rectangle of the fixed pivots, with one percent of room. A linkage that meets the points
exactly and keeps the limits is thus known to exist. It counts as found if the root mean square distance is
at most 1e-6 of the size of the path.
"""

import argparse
import math
import sys
import time
from collections import Counter

import numpy as np
from harness import require
from known_paths import Problem, five_bar, kind_of, passed, quiet, slider_crank, spherical

from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.synthesis.paths.asked import Limits, PathProblem
from mechwright_four_bar.synthesis.paths.search import ROUND as FOUR_BAR_ROUND
from mechwright_four_bar.synthesis.paths.search import path, search
from mechwright_four_bar.synthesis.paths.starts import link_lengths

NEAR = 1e-6
SECONDS = 10.0
SHARE = 0.95


def four_bar(rng: np.random.Generator) -> Problem:
    """A path of a four-bar's coupler point."""
    least = math.radians(rng.uniform(20, 45))
    while True:
        b, c = 100 * np.exp(rng.uniform(-1, 0, 2))
        p1, p2 = np.sort(rng.uniform(0, 1, 2))
        double = bool(rng.random() < 0.25)
        a, f = map(float, link_lengths(double, b, c, p1, p2, least))
        if min(a, b, c, f) > 8:
            break
    branch = int(rng.choice((-1, 1)))
    bar = FourBar(a, float(c), float(b), f, float(rng.uniform(0, math.tau)), branch)
    pivot, point = (
        complex(*rng.uniform(-50, 50, 2)),
        complex(c / 2 + c * rng.uniform(-0.9, 0.9), c * rng.uniform(-0.9, 0.9)),
    )
    phi, timed, closed = passed(rng)
    pivots = np.array([pivot, pivot + f * np.exp(1j * bar.ground_angle)])
    room = 0.01 * f
    frame = (
        float(pivots.real.min() - room),
        float(pivots.imag.min() - room),
        float(pivots.real.max() + room),
        float(pivots.imag.max() + room),
    )
    longest = max(*bar.lengths, abs(point), abs(point - c)) * 1.01
    angle = bar.least_transmission_angle() / 1.01
    limits = Limits(min(bar.lengths) / 1.01, longest, angle, frame if rng.random() < 0.5 else None)
    targets = path(bar, pivot, point, phi)
    turns = phi - phi[0] if timed else None
    problem = PathProblem(targets, turns, (1, -1), closed, 0.0, limits)

    def run(rounds: int) -> float:
        result = search(problem, rounds * 2 * FOUR_BAR_ROUND, 1, 0, quiet)
        return result.solutions[0].mean / problem.size if result.solutions else math.inf

    return run, kind_of(timed, closed), phi.size


FAMILIES = {"four-bar": four_bar, "slider-crank": slider_crank, "spherical": spherical, "five-bar": five_bar}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("count", nargs="?", type=int, default=200)
    parser.add_argument("--family", choices=FAMILIES, action="append")
    parser.add_argument("--first", type=int, default=0, help="number of the first: for parts of a long run")
    parser.add_argument("--rounds", type=int, default=12)
    asked = parser.parse_args()
    numbers = range(asked.first, asked.first + asked.count)
    kept = [of_family(name, numbers, asked.rounds) for name in asked.family or FAMILIES]
    return 0 if all(kept) else 1


def of_family(name: str, numbers: range, rounds: int) -> bool:
    """Whether enough paths of a family are found."""
    all_of, found, spent = Counter[str](), Counter[str](), []
    FAMILIES[name](np.random.default_rng(0))[0](1)  # compiles
    for number in numbers:
        run, said, points = FAMILIES[name](np.random.default_rng([23, number]))
        start = time.process_time()
        miss = run(rounds)
        spent.append(time.process_time() - start)
        met = miss <= NEAR and spent[-1] <= SECONDS
        all_of[said] += 1
        found[said] += met
        if not met:
            print(f"  {number}: {said}, {points} points, missed by {miss:.2g}, {spent[-1]:.1f} s", flush=True)
    for said, many in sorted(all_of.items()):
        print(f"{name}, {said}: {found[said]} of {many}")
    median, most = np.quantile(spent, (0.5, 0.9))
    print(f"seconds: median {median:.2f}, 90 % within {most:.2f}, greatest {max(spent):.2f}", flush=True)
    return require(f"{name}: share not found", 1 - found.total() / all_of.total(), 1 - SHARE)


if __name__ == "__main__":
    sys.exit(main())
