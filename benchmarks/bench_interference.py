"""Interference over the whole motion against its targets: ``python benchmarks/bench_interference.py``.

Bodies that slide along each other at a small distance (a slider in its rails, a locking disc in its wheel)
and solids with leaning faces (the wheels of a spherical five-bar). Processor time counts, against that of
importing the CAD kernel in the same run.
"""

import sys
import time
from functools import partial
from pathlib import Path

from harness import require

from mechwright.designs.design import load
from mechwright.plugins.host import host
from mechwright_cad.interference import interference, smooth_motion

EXAMPLES = Path(__file__).parents[1] / "examples"
LIMITS = {"slider-crank-quick-return": 0.7, "geneva-cycloidal": 0.7, "spherical-five-bar-projected": 2.5}
"""Design to the most that it may take, in imports of the CAD kernel: 0.5, 0.5 and 2.2 were seen."""


def cpu(work) -> float:
    start = time.process_time()
    work()
    return time.process_time() - start


def main() -> int:
    anchor = cpu(lambda: __import__("cadquery"))
    print(f"import cadquery: {anchor:.2f} s of processor time")
    kept = True
    for name, limit in LIMITS.items():
        design = load(EXAMPLES / f"{name}.toml", host())
        design.family.check(design.params)
        parts = design.family.parts(design.params)
        from mechwright_cad.solids.solid import part_solid

        for part in parts:
            part_solid(part)
        motion = smooth_motion(partial(design.family.solve, design.params), parts)
        seconds = cpu(lambda parts=parts, motion=motion: interference(parts, motion))
        kept &= require(name, seconds / anchor, limit)
    return 0 if kept else 1


if __name__ == "__main__":
    sys.exit(main())
