"""What scripts wait for: ``python benchmarks/bench_python.py``.

The package itself against typer, a small library that everybody imports without a thought; and a sweep of six
motions, imports not counted.
"""

import sys
import time

import numpy as np
from harness import child, race, report, require

import mechwright as mw

IMPORT = 2.5
"""Times ``import typer``."""
SWEEP = 2.0
"""s."""


def sweep() -> list[float]:
    """The peak acceleration of the driven gear over the eccentricity, each motion solved anew."""
    pair = mw.design("elliptic-gears", teeth=25)
    return [
        pair.with_(eccentricity=e + 1e-9 * np.random.default_rng().random())
        .motion.scalars["alpha4_max"]
        .value
        for e in np.linspace(0.1, 0.6, 6)
    ]


def main() -> int:
    timings = race({"import typer": child("import typer"), "import mechwright": child("import mechwright")})
    ratios = report("import", timings, "import typer")
    kept = require("import mechwright", ratios["import mechwright"], IMPORT)
    sweep()
    start = time.perf_counter()
    sweep()
    kept &= require("sweep of six motions, s", time.perf_counter() - start, SWEEP)
    return 0 if kept else 1


if __name__ == "__main__":
    sys.exit(main())
