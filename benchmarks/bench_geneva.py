"""The Geneva mechanism against its targets: ``python benchmarks/bench_geneva.py``.

One design: motion, contour and all checks in 20 ms. A sweep of 100,000 designs: at least 20,000 a second on
one core. Targets hold for a machine on which a plain loop of array operations takes as long as
``ANCHOR_SECONDS``; they are scaled by what that loop takes here and now.
"""

import itertools
import sys

import numpy as np
from harness import race, report, require

from mechwright import Array
from mechwright_geneva.defaults.dimensions import complete, mechanism_of
from mechwright_geneva.family import Geneva
from mechwright_geneva.kinematics.slot_limits import SWEEP_SAMPLES
from mechwright_geneva.parameters import GenevaParams
from mechwright_geneva.parts.slot_outline import Slot
from mechwright_geneva.rules.slot_search import allowed, trial

DESIGNS = 100_000
ANCHOR, ANCHOR_SECONDS = "complex arrays, 200 times 100,000", 0.38
"""What the anchor takes on the machine that the targets are for."""

FAMILY = Geneva()
_sizes = itertools.count(1)


def anchor() -> float:
    z = np.linspace(0, 1, 100_000) * (1 + 1j)
    for _ in range(200):
        z = z * np.exp(0.001j * z.real) + 0.001
    return float(np.abs(z).max())


def one_design() -> int:
    """A design that has not been seen: nothing is cached."""
    params = GenevaParams(
        entry_radius=100 + 0.01 * next(_sizes), crank_half_angle=50, offset_angle=5, roller_radius=5
    )
    findings = FAMILY.check(params)
    motion = FAMILY.solve(params, 361)
    m = mechanism_of(params)
    loop, _ = Slot(m).loop()
    return len(findings) + motion.samples + len(loop.segments)


def sweep() -> int:
    rng = np.random.default_rng(1)
    half, offset = rng.uniform(35, 70, DESIGNS), rng.uniform(-15, 15, DESIGNS)
    return _valid(half, offset, rng.uniform(2, 8, DESIGNS))


def measured_throughout() -> int:
    """The same number of designs of which none falls out before it is measured."""
    rng = np.random.default_rng(2)
    return _valid(rng.uniform(46, 56, DESIGNS), rng.uniform(6, 12, DESIGNS), np.full(DESIGNS, 3.0))


def _valid(half: Array, offset: Array, radius: Array) -> int:
    columns = {"crank_half_angle": half, "offset_angle": offset, "roller_radius": radius}
    return int(allowed(trial(complete(GenevaParams()), DESIGNS, SWEEP_SAMPLES, **columns)).sum())


def main() -> int:
    timings = race(
        {
            ANCHOR: anchor,
            "one design: motion, contour, checks": one_design,
            "100,000 designs": sweep,
            "100,000 designs, all measured": measured_throughout,
        },
        rounds=5,
    )
    ratios = report("Geneva mechanism", timings, ANCHOR, str)
    print("\nlimits, as multiples of the anchor")
    kept = [
        require("one design in 20 ms", ratios["one design: motion, contour, checks"], 0.02 / ANCHOR_SECONDS),
        require("100,000 designs in 5 s", ratios["100,000 designs"], 5 / ANCHOR_SECONDS),
        require("all measured in 5 s", ratios["100,000 designs, all measured"], 5 / ANCHOR_SECONDS),
    ]
    return 0 if all(kept) else 1


if __name__ == "__main__":
    sys.exit(main())
