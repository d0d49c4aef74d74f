"""Tolerances: a million mechanisms of every family, against drawing their deviations.

``python benchmarks/bench_tolerances.py`` prints times and ratios of one run, and which limits they keep. The
anchor draws four lengths and four pins of a million four-bars in plain numpy, and closes nothing.
"""

import os
import sys
import time

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # one core, whatever the machine has

import numpy as np
from harness import race, report, require

from mechwright import Tolerances
from mechwright.contracts.tolerance_settings import ToleranceSettings
from mechwright.mechanics.tolerance import analyse
from mechwright.plugins.host import host

MILLION = 1_000_000
MOST = 10.0
"""Seconds of one core for a million mechanisms."""
MOST_RATIO = 6.0
"""Times of drawing alone: closing the loop, and looking at a whole turn of gears, costs no more."""

DESIGNS = {
    "four-bar": {"coupler_point_x": 40, "coupler_point_y": 20},
    "slider-crank": {},
    "geneva": {},
    "geneva, straight": {"law": "straight"},
    "elliptic-gears": {},
    "elliptic-gears, train": {"stages": 2},
    "spherical": {"kind": "four-bar"},
    "spherical, five-bar": {},
}


def drawn():
    """Deviations of a million four-bars: truncated normal lengths and diameters, uniform directions."""
    rng = np.random.default_rng(1)
    found = []
    for _ in range(4 + 4 * 2):
        values = rng.standard_normal(MILLION)
        while (beyond := np.abs(values) > 3).any():
            values[beyond] = rng.standard_normal(int(beyond.sum()))
        found.append(values)
    for _ in range(4):
        turn = rng.uniform(0, 2 * np.pi, MILLION)
        found.append(np.cos(turn) + 1j * np.sin(turn))
    return found


def mechanisms(name, table):
    family = host().family(name.split(",")[0])
    params = family.Params.model_validate(table)
    asked = Tolerances(ToleranceSettings(samples=MILLION))

    def run():
        start = time.process_time()
        result = analyse(family.tolerances(params, asked), asked)
        return time.process_time() - start, ", ".join(one.output.name for one in result.results)

    return run


def remark(made):
    return f"{made[0]:.2f} s of the processor: {made[1]}" if isinstance(made, tuple) else ""


def main():
    work = {"drawing": drawn} | {name: mechanisms(name, table) for name, table in DESIGNS.items()}
    times = race(work, rounds=1, warm=0)
    ratios = report(f"{MILLION} mechanisms", times, "drawing", remark)
    kept = [require(f"{name}, s of the processor", times[name].result[0], MOST) for name in DESIGNS]
    kept += [require(f"{name} over drawing", ratios[name], MOST_RATIO) for name in DESIGNS]
    return 0 if all(kept) else 1


if __name__ == "__main__":
    sys.exit(main())
