"""Planning of the Geneva example against its own past: ``python benchmarks/bench_planning.py``.

Planning is everything of ``mechwright cam`` but posting, proof and pages: the choice of cutters, laying out,
findings, and the programs of all three parts. Before every feature had its task it took ``BEFORE`` times as
long as the anchor; it takes at most half of that now.
"""

import sys
from pathlib import Path

import numpy as np
import shapely
from bench_pipeline import forget
from harness import race, report, require

from mechwright.designs.design import load
from mechwright.pipeline.process import plates_of
from mechwright.plugins.host import host
from mechwright_cam import planning
from mechwright_cam.planning.prepare import prepare

EXAMPLE = Path(__file__).parents[1] / "examples" / "geneva-cycloidal.toml"
ANCHOR, BEFORE = "a star of 2,000 corners, grown and shrunk", 20.8
"""What planning took on the last version that asked again and again, in anchors."""


def anchor() -> float:
    """Offsets of a shape as detailed as the example's: no code of the project's own."""
    t = np.linspace(0, 2 * np.pi, 2000, endpoint=False)
    r = 80 + 20 * np.tanh(4 * np.sin(9 * t))
    star = shapely.Polygon(np.column_stack((r * np.cos(t), r * np.sin(t))))
    grown = [shapely.buffer(star, 0.25 * number, quad_segs=24) for number in range(1, 41)]
    return float(sum(shapely.difference(one, shapely.buffer(one, -3, quad_segs=24)).area for one in grown))


def main() -> int:
    design = load(EXAMPLE, host())

    def planned() -> object:
        forget()
        memory = [planning.Assignments()] if hasattr(planning, "Assignments") else []
        _, jobs = prepare(design, plates_of(design.family.parts(design.params)), *memory)
        return sum(len(planning.plan(job, *memory).sections) for job in jobs)

    timings = race({ANCHOR: anchor, "planning of geneva-cycloidal": planned}, rounds=5)
    ratios = report("planning", timings, ANCHOR, str)
    print("\nlimits, as multiples of the anchor")
    kept = require("half of the time of before", ratios["planning of geneva-cycloidal"], BEFORE / 2)
    return 0 if kept else 1


if __name__ == "__main__":
    sys.exit(main())
