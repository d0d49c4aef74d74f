"""Hundreds of random pockets, planned and proven: ``python benchmarks/random_pockets.py [COUNT [FIRST]]``.

Prints how many were proven, how many planning refused and why, and the thickest stock that stayed where a
cutter of the program could have gone. Ends with 1 if one failed.
"""

import collections
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "cam"))
from random_pockets import case


def main(count: int = 500, first: int = 0) -> int:
    reasons, thickest, failed = collections.Counter(), 0.0, []
    start = time.process_time()
    for seed in range(first, first + count):
        found = case(seed)
        if isinstance(found, str):
            reasons[found.split(" of part")[0].split("pocket")[0].strip()] += 1
            continue
        reasons["proven"] += found.ok
        thickest = max(thickest, found.leftover_reachable_max_mm)
        if not found.ok:
            failed.append((seed, [check.message for check in found.failures]))
    for reason, number in reasons.most_common():
        print(f"{number:5d}  {reason}")
    print(f"thickest reachable stock left: {thickest:.4f} mm; {time.process_time() - start:.1f} s")
    for seed, messages in failed:
        print(f"FAILED seed {seed}: {messages}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:])))
