"""How many random designs build, and how many ``fix`` makes build: ``python benchmarks/bench_fix.py``.

A design counts as mended if a change of at most ten keys was found with which it builds: up to the parts, as
the family judges and makes them; by its check alone, which is faster; or up to machining, as ``check`` and
``build`` judge it, which is slow.
"""

import argparse
import json
import sys
import time
import warnings
from collections import Counter
from pathlib import Path

from harness import require
from random_designs import WAYS, designs

from mechwright import Design, Family, Stage, host
from mechwright.remedies import MOST_CHANGES, Repair, nearest, of_family, repaired
from mechwright.remedies.repair import FAMILY

GOAL = 0.95
"""Share of random designs that build, as they are or mended."""


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument(
        "--first", type=int, default=0, help="number of the first design, to go on with a run"
    )
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--way", choices=WAYS, default="likely")
    parser.add_argument("--to", choices=("check", "parts", "machining"), default="parts")
    parser.add_argument("--seconds", type=float, default=1e9, help="no further design after so long")
    parser.add_argument("--log", type=Path, help="a file that gets a line of JSON for every design")
    parser.add_argument("families", nargs="*", default=sorted(host().of(Family)))
    asked = parser.parse_args()
    warnings.simplefilter("ignore")  # of arrays, in designs nobody would ask for
    end = time.monotonic() + asked.seconds
    kept = True
    for name in asked.families:
        kept &= one_family(name, asked, end)
    return 0 if kept else 1


def checked(design: Design) -> Repair:
    """A repair by the family's check alone."""
    bench = of_family(design, FAMILY)
    stood = bench.errors({}) or []
    change, beyond = nearest(bench), None
    if change is not None and len(change) > MOST_CHANGES:
        change, beyond = None, change
    return Repair(stood, change, stood if change is None else [], bench, beyond)


def one_family(name: str, asked: argparse.Namespace, end: float) -> bool:
    found, family = host(), host().family(name)
    numbers = range(asked.first, asked.first + asked.count)
    builds, refused, sizes, failed, times = 0, 0, Counter[int](), Counter[str](), []
    for number, design in zip(numbers, designs(family, found, asked.seed, numbers, asked.way), strict=True):
        if time.monotonic() > end:
            break
        start = time.process_time()
        repair = checked(design) if asked.to == "check" else repaired(design, found, Stage(asked.to))
        times.append(time.process_time() - start)
        if repair.change is None:
            refused += repair.nearest is not None
            failed[repair.left[0].code if repair.left else "?"] += 1
        elif repair.change:
            sizes[len(repair.change)] += 1
        else:
            builds += 1
        if asked.log:
            with asked.log.open("a", encoding="utf-8") as log:
                codes = [finding.code for finding in repair.found]
                log.write(json.dumps([name, number, codes, repair.change, round(times[-1], 3)]) + "\n")
    count = max(len(times), 1)
    share = (builds + sizes.total()) / count
    print(f"\n{name}, {asked.way}, up to {asked.to}: {len(times)} designs, seed {asked.seed}")
    print(f"  as they are {100 * builds / count:.1f} %, with fix {100 * share:.1f} %")
    print(f"  keys changed: {', '.join(f'{keys}: {n}' for keys, n in sorted(sizes.items()))}")
    print(f"  processor time: mean {sum(times) / count:.2f} s, most {max(times, default=0):.1f} s")
    if failed:
        print(f"  not mended: {', '.join(f'{code} {n}' for code, n in failed.most_common(12))}")
        print(f"  of them with the nearest design that builds: {refused}")
    return require("not mended", 1 - share, 1 - GOAL)


if __name__ == "__main__":
    sys.exit(main())
