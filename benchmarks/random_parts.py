"""Hundreds of random parts, planned, posted and proven.

``python benchmarks/random_parts.py [COUNT [FIRST [OPERATION ...]]]``

Each seed gives one part for every operation, with random cutters, settings and control. Prints how many were
proven, and how many planning refused. Ends with 1 if one failed.
"""

import collections
import multiprocessing
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "cam"))
from random_outcomes import run
from random_parts import OPERATIONS

PROCESSES = 2


def one(case: tuple[str, int]) -> tuple[str, int, str, list[str]]:
    """Operation, seed, why planning refused it if it did, and what the proof found."""
    outcome = run(*case)
    return (*case, outcome.refusal, outcome.failures)


def main(count: int = 40, first: int = 0, *operations: str) -> int:
    cases = [(name, seed) for seed in range(first, first + count) for name in operations or OPERATIONS]
    proven, refused, failed = collections.Counter(), collections.Counter(), []
    start = time.perf_counter()
    with multiprocessing.Pool(PROCESSES) as pool:
        for operation, seed, refusal, failures in pool.imap_unordered(one, cases):
            refused[operation] += bool(refusal)
            proven[operation] += not refusal and not failures
            if failures:
                failed.append((operation, seed, failures))
                print(f"FAILED {operation} {seed}: {failures}", flush=True)
    for operation in operations or OPERATIONS:
        print(f"{operation:15} {proven[operation]:5d} proven {refused[operation]:5d} refused")
    print(f"{sum(proven.values())} of {len(cases)} proven; {time.perf_counter() - start:.0f} s")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:3]), *sys.argv[3:]))
