"""Designs sought with no limit given, checked through all stages: ``python benchmarks/bench_synthesis.py``.

Each requirement says what is wanted and nothing of how large, how far or how much: sizes, angles and numbers
of designs are those by default. Every design that is found is checked as ``mechwright check`` does, with
cutters, controls and the comparison of plates.
"""

import argparse
import sys
import tempfile
import time
from pathlib import Path

from harness import require
from typer.testing import CliRunner

from mechwright.cli.app import make_app

WANTED = {
    "figure-eight": 'family = "elliptic-gears"\n[requirement]\nkind = "longest-window"',
    "least-acceleration": 'family = "elliptic-gears"\n[requirement]\nkind = "least-acceleration"',
    "line": 'family = "four-bar"\n[requirement]\nkind = "path"\n'
    "points = [[20, 20], [20, 25], [20, 30], [20, 35], [20, 40], [20, 45]]",
    "three-poles": 'family = "four-bar"\n[requirement]\nkind = "poles"\n'
    "poles = [[37.7, -57.1], [120.4, 45.7], [-17.1, 122.8]]\ncrank_turns = [0, 60, 150]",
    "stops": 'family = "geneva"\n[requirement]\nkind = "indexing"',
    "three-stops": 'family = "geneva"\n[requirement]\nkind = "indexing"\nslots = 3',
    "twelve-stops": 'family = "geneva"\n[requirement]\nkind = "indexing"\nslots = 12',
    "least-jerk": 'family = "elliptic-gears"\n[requirement]\nkind = "least-jerk"',
    "five-poses": 'family = "four-bar"\n[requirement]\nkind = "poses"\n'
    "poses = [[7, -6, -27], [14, -17, -40], [23, -24, -61], [28, -25, -72], [37, -19, -91]]",
    "cam": 'family = "cam-follower"\n[requirement]\nkind = "size"',
    "lever": 'family = "cam-follower"\n[requirement]\nkind = "size"\nfollower = "oscillating"',
    "even-index": 'family = "noncircular-gears"\n[requirement]\nkind = "geneva"',
    "even-slide": 'family = "noncircular-gears"\n[requirement]\nkind = "slider"',
    "quick-return": 'family = "noncircular-gears"\n[requirement]\nkind = "quick-return"',
    "approach": 'family = "noncircular-gears"\n[requirement]\nkind = "approach"',
    "stroke": 'family = "slider-crank"\n[requirement]\nkind = "stroke"\nstroke = 120\ntime_ratio = 1.5',
    "short-stroke": 'family = "slider-crank"\n[requirement]\nkind = "stroke"\nstroke = 8',
    "two-poles": 'family = "slider-crank"\n[requirement]\nkind = "poles"\n'
    "poles = [[60, -12.6], [41.2, 41.6]]\nrotations = [47]",
    "path-on-sphere": 'family = "spherical"\n[requirement]\nkind = "four-bar-path"\nclosed = true\n'
    "points = [\n"
    "[0.26, 0, 0.9656], [0.235, 0.115, 0.9652], [0.13, 0.195, 0.9721], [-0.01, 0.205, 0.9787],\n"
    "[-0.135, 0.155, 0.9787], [-0.205, 0.05, 0.9775], [-0.2, -0.07, 0.9773], [-0.115, -0.15, 0.982],\n"
    "[0.025, -0.175, 0.9843], [0.175, -0.13, 0.9759],\n]",
    "two-phases": 'family = "spherical"\n[requirement]\nkind = "adjustable-path"\n'
    "path = [[0.1816, 1.8993], [0.275703803, 1.864862941], [0.357404873, 1.794555644],"
    " [0.420821618, 1.689103786]]\nturns = [0, 4.822766357, 9.876178938, 15.266704249]\n"
    "path_n = [[0.1816, 1.8993], [0.356471847, 1.907318759], [0.523629022, 1.887228156]]\n"
    'turns_n = [0, -0.048091902, 0.314200663]\nprojection_length = 5\nunknowns = "twelve"',
    "five-bar-phases": 'family = "five-bar"\n[requirement]\nkind = "adjustable-path"\nphases = [\n'
    "[[-5.77, 187.59], [12.64, 173.08], [24.84, 144.31], [29, 103.49]],\n"
    "[[-5.77, 187.59], [28.22, 186.44], [56.97, 173.65], [76.03, 150.46]],\n"
    "[[-5.77, 187.59], [-6.61, 148.02], [-3.45, 91.61], [0.55, 34.6]],\n]",
}


def refused(text: str) -> tuple[int, int]:
    """How many designs were found, and how many of them do not pass every check."""
    with tempfile.TemporaryDirectory() as folder:
        asked, out = Path(folder) / "requirement.toml", Path(folder) / "designs"
        asked.write_text(f"format = 1\n{text}\n", encoding="utf-8")
        run = CliRunner().invoke(make_app(), ["synthesize", str(asked), "-o", str(out)])
        designs = sorted(out.glob("*.toml"))
        if run.exit_code or not designs:
            print(f"  {run.output.strip()[-400:]}")
        bad = 0
        for design in designs:
            checked = CliRunner().invoke(make_app(), ["check", str(design)])
            bad += checked.exit_code != 0
            for line in checked.output.splitlines():
                if line.startswith("error"):
                    print(f"  {design.stem}: {line[:300]}")
        return len(designs), bad


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", default=list(WANTED))
    kept = True
    for name in parser.parse_args().names:
        start = time.process_time()
        found, bad = refused(WANTED[name])
        print(f"{name}: {found} designs, {bad} refused, {time.process_time() - start:.0f} s", flush=True)
        kept &= require(f"{name}: refused, or none found", bad + (found == 0), 0.0)
    return 0 if kept else 1


if __name__ == "__main__":
    sys.exit(main())
