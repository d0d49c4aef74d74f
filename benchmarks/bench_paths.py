"""Linkages found again from points of their paths: ``python benchmarks/bench_paths.py [COUNT]``.

Each requirement is made from a random linkage with a full crank: 6 to 40 points of its coupler curve, open
or closed, timed or not, and as limits its own lengths, its own least transmission angle and, in half of
them, the rectangle of its fixed pivots, with one percent of room. A linkage that meets the points exactly
and keeps the limits is thus known to exist. It counts as found if the root mean square distance is at most
1e-6 of the size of the path.
"""

import argparse
import math
import sys
import time
from collections import Counter

import numpy as np
from harness import require

from mechwright_four_bar.dimensions import FourBar
from mechwright_four_bar.paths.asked import Limits, PathProblem
from mechwright_four_bar.paths.search import path, search
from mechwright_four_bar.paths.starts import link_lengths

NEAR = 1e-6
SECONDS = 10.0
SHARE = 0.95


def known(rng: np.random.Generator) -> tuple[PathProblem, str]:
    """A requirement that a linkage meets, and what kind it is."""
    least = math.radians(rng.uniform(20, 45))
    while True:
        b, c = 100 * np.exp(rng.uniform(-1, 0, 2))
        p1, p2 = np.sort(rng.uniform(0, 1, 2))
        double = bool(rng.random() < 0.25)
        a, f = map(float, link_lengths(double, b, c, p1, p2, least))
        if min(a, b, c, f) > 8:
            break
    branch, way = (int(one) for one in rng.choice((-1, 1), 2))
    bar = FourBar(a, float(c), float(b), f, float(rng.uniform(0, math.tau)), branch)
    pivot, point = (
        complex(*rng.uniform(-50, 50, 2)),
        complex(c / 2 + c * rng.uniform(-0.9, 0.9), c * rng.uniform(-0.9, 0.9)),
    )
    n, timed, closed = int(rng.integers(6, 41)), bool(rng.random() < 0.3), bool(rng.random() < 0.5)
    span = math.tau * (1 - 1 / n) if closed else math.radians(rng.uniform(90, 320))
    steps = rng.uniform(0.5, 1.5, n - 1)
    phi = rng.uniform(0, math.tau) + way * span * np.concatenate(([0], np.cumsum(steps) / steps.sum()))
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
    said = f"{'timed' if timed else 'free'}, {'closed' if closed else 'open'}"
    return PathProblem(targets, turns, (1, -1), closed and not timed, 0.0, limits), said


def quiet(part):
    pass


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("count", nargs="?", type=int, default=200)
    parser.add_argument("--starts", type=int, default=100_000)
    asked = parser.parse_args()
    all_of, found, spent = Counter[str](), Counter[str](), []
    search(known(np.random.default_rng(0))[0], 200, 1, 0, quiet)  # compiles
    for number in range(asked.count):
        problem, said = known(np.random.default_rng([23, number]))
        start = time.process_time()
        result = search(problem, asked.starts, 1, 0, quiet)
        spent.append(time.process_time() - start)
        miss = result.solutions[0].mean / problem.size if result.solutions else math.inf
        met = miss <= NEAR and spent[-1] <= SECONDS
        all_of[said] += 1
        found[said] += met
        if not met:
            print(
                f"  {number}: {said}, {problem.targets.size} points, missed by {miss:.2g}, {spent[-1]:.1f} s",
                flush=True,
            )
    for said, count in sorted(all_of.items()):
        print(f"{said}: {found[said]} of {count}")
    print(f"seconds: median {np.median(spent):.2f}, greatest {max(spent):.2f}, sum {sum(spent):.0f}")
    share = found.total() / all_of.total()
    return 0 if require("share not found", 1 - share, 1 - SHARE) else 1


if __name__ == "__main__":
    sys.exit(main())
