"""Planar linkages: kinematics against plain numpy, exact loci, and synthesis through acceleration poles.

``python benchmarks/bench_planar.py`` prints times and ratios of one run, and which limits they keep.
"""

import math
import sys
from fractions import Fraction

import numpy as np
from harness import race, report, require

from mechwright_slider_crank.kinematics.locus import locus
from mechwright_slider_crank.kinematics.slider_crank import SliderCrank
from mechwright_slider_crank.synthesis.poles.synthesis import through_poles

POSITIONS = 100_000
SLIDER = SliderCrank(50.0, 150.0, 20.0)
PHI = np.random.default_rng(0).uniform(0, math.tau, POSITIONS)


def plain():
    """Position, velocity and acceleration of the slider as a textbook writes them, in numpy."""
    a, c, e = SLIDER.crank, SLIDER.rod, SLIDER.offset
    sin, cos = np.sin(PHI), np.cos(PHI)
    t = e - a * sin
    w = np.sqrt(c**2 - t**2)
    omega = -a * cos / w
    alpha = (a * sin + t * omega**2) / w
    return a * cos + w, -a * sin - t * omega, -a * cos - w * omega**2 - t * alpha


def fresh_locus(*lengths):
    def run():
        locus.cache_clear()
        return locus(*(Fraction(v) for v in lengths[:3]), lengths[3])[0].degree

    return run


def silent(done, what):
    pass


def poles(rotations, *places):
    def run():
        found, _ = through_poles(np.array(places), np.radians(rotations), 6000, 1, silent)
        return f"{len(found)} solutions"

    return run


def main():
    kept = []
    times = race(
        {
            "plain numpy": plain,
            "numpy": lambda: SLIDER.rates(PHI),
        },
        rounds=21,
    )
    ratios = report(f"slider, {POSITIONS} positions", times, "plain numpy", lambda _: "")
    kept.append(require("numpy over plain numpy", ratios["numpy"], 1.5))
    work = {
        f"{plane} {name}": fresh_locus(*lengths, plane)
        for name, lengths in {
            "1, 3, 1/2": ("1", "3", "1/2"),
            "17 digits": ("51.23710482942299", "113.28305527097052", "50"),
        }.items()
        for plane in ("fixed", "coupler")
    }
    times = race(work)
    report("locus of the slider-crank", times, "fixed 1, 3, 1/2", lambda degree: f"degree {degree}")
    kept += [require(f"locus {name}, s", timing.seconds, 0.5) for name, timing in times.items()]
    times = race(
        {
            "two poles": poles([47.0], 3.0 - 0.63j, 2.06 + 2.08j),
            "three poles": poles([], 6.09 - 1.93j, 2.64 - 2.37j, 3.26 - 0.34j),
        },
        rounds=3,
    )
    report("slider-crank through poles", times, "two poles", str)
    kept += [require(f"{name}, s", timing.seconds, 3.0) for name, timing in times.items()]
    return 0 if all(kept) else 1


if __name__ == "__main__":
    sys.exit(main())
