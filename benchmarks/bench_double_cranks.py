"""Random double cranks and rockers, up to proven programs: ``python benchmarks/bench_double_cranks.py``.

Every design has links or arcs at random, all else by default, and a transmission angle above 20 degrees. All
are checked, which finds their layers and compares the plates over the turn. Of the first ones all bodies are
compared as solids, and the first are built: drawings, programs, and the proof of every program.

    python benchmarks/bench_double_cranks.py spherical --checked 150 --built 10 --first 40

starts at number 40; ``--seed`` gives other designs.
"""

import argparse
import math
import sys
import tempfile
import time
from collections.abc import Iterator
from itertools import islice
from pathlib import Path

import numpy as np
from harness import require
from typer.testing import CliRunner

from mechwright.cli.app import make_app
from mechwright_four_bar.kinematics.dimensions import FourBar, Kind
from mechwright_spherical.kinematics.linkage import linkage_of
from mechwright_spherical.kinematics.mobility import input_ways, kind
from mechwright_spherical.parameters import FourBarTable, SphericalParams
from mechwright_spherical.rules.assembly import weakest

LEAST = math.radians(20)
"""Least transmission angle, rad."""

SIZES = (12.0, 100.0)
"""Links, mm: from the shortest coupler whose bores, with pins and rims by default, leave each other room."""

ARCS = (15.0, 90.0)
"""Arcs, degrees."""

NAMES = {
    "planar": "planar double cranks",
    "spherical": "spherical double cranks",
    "rockers": "spherical double rockers",
}

SHORTEST_SWING = 10
"""Degrees that a rocker swings at least."""


def planar(seed: int) -> Iterator[str]:
    """Tables of four-bars whose crank and follower turn fully, in their order."""
    rng = np.random.default_rng(seed)
    while True:
        bar = FourBar(*(round(float(size), 2) for size in rng.uniform(*SIZES, 4)))
        branch, angle = rng.choice(["open", "crossed"]), round(float(rng.uniform(-180, 180)), 1)
        if bar.kind is Kind.DOUBLE_CRANK and bar.least_transmission_angle() > LEAST:
            names = ("crank", "coupler", "follower", "ground")
            rows = [f"{name} = {size}" for name, size in zip(names, bar.lengths, strict=True)]
            rows += [f'branch = "{branch}"', f"ground_angle = {angle}"]
            yield "\n".join(['family = "four-bar"', "[parameters]", *rows])


def spherical(seed: int) -> Iterator[str]:
    """Tables of spherical four-bars whose input and output turn fully."""
    rng = np.random.default_rng(seed)
    while True:
        arcs = [round(float(angle), 1) for angle in rng.uniform(*ARCS, 4)]
        names = ("ground", "input", "coupler", "output")
        if kind(*np.radians(arcs).tolist()) != "double crank":
            continue
        table = FourBarTable.model_validate(dict(zip(names, arcs, strict=True)))
        design = SphericalParams(kind="four-bar", radius=80.0, four_bar=table)
        if weakest(linkage_of(design).shown)[1] > math.sin(LEAST):
            rows = [f"{name} = {angle}" for name, angle in zip(names, arcs, strict=True)]
            head = ['family = "spherical"', "[parameters]", 'kind = "four-bar"', "radius = 80"]
            yield "\n".join([*head, "[parameters.four_bar]", *rows])


def rockers(seed: int) -> Iterator[str]:
    """Tables of spherical Grashof double rockers, each over the swing that keeps the transmission angle."""
    rng = np.random.default_rng(seed)
    names = ("ground", "input", "coupler", "output")
    while True:
        arcs = [round(float(angle), 1) for angle in rng.uniform(*ARCS, 4)]
        radians = np.radians(arcs).tolist()
        if kind(*radians) != "Grashof double rocker":
            continue
        low, high = max(input_ways(*radians, LEAST), key=lambda way: way[1] - way[0], default=(0.0, 0.0))
        start, end = math.ceil(math.degrees(low)), math.floor(math.degrees(high))
        if end - start >= SHORTEST_SWING:
            rows = [f"{name} = {angle}" for name, angle in zip(names, arcs, strict=True)]
            head = ['family = "spherical"', "[parameters]", 'kind = "four-bar"', "radius = 80"]
            rows += [f"start = {start}", f"travel = {end - start}"]
            yield "\n".join([*head, "[parameters.four_bar]", *rows])


def passed(texts: list[str], first: int, *command: str) -> int:
    """How many designs a command accepts; says what it says of the others, one line for each."""
    good, start = 0, time.perf_counter()
    with tempfile.TemporaryDirectory() as folder:
        for number, text in enumerate(texts, start=first):
            path, out = Path(folder) / f"{number}.toml", Path(folder) / str(number)
            path.write_text(text, encoding="utf-8")
            more = [] if command[0] == "check" else ["-o", str(out)]
            done = CliRunner().invoke(make_app(), [*command, str(path), *more])
            good += done.exit_code == 0
            if done.exit_code == 0:
                print(f"  {number}: {command[0]} passed", flush=True)  # a run that is ended early counts too
            if done.exit_code:
                faults = [line for line in done.output.splitlines() if "error" in line]
                print(
                    f"  {number}: {' '.join(text.split()[3:])}\n    {(faults or ['?'])[0][:300]}", flush=True
                )
    seconds = time.perf_counter() - start
    print(f"{command[0]}: {good} of {len(texts)}, {seconds:.0f} s", flush=True)
    return good


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("kind", nargs="?", choices=("planar", "spherical", "rockers"), default="planar")
    parser.add_argument("--seed", type=int, default=18)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--checked", type=int, default=150)
    parser.add_argument("--modelled", type=int, default=20)
    parser.add_argument("--built", type=int, default=5)
    asked = parser.parse_args()
    source = {"planar": planar, "spherical": spherical, "rockers": rockers}[asked.kind](asked.seed)
    most = max(asked.checked, asked.modelled, asked.built)
    texts = list(islice(source, asked.first, asked.first + most))
    kept = []
    steps = (("check", asked.checked), ("model", asked.modelled), ("build", asked.built))
    for command, count in steps:
        if count:
            refused = count - passed(texts[:count], asked.first, command)
            kept.append(require(f"{NAMES[asked.kind]} that {command} refuses", refused, 0.0))
    return 0 if all(kept) else 1


if __name__ == "__main__":
    sys.exit(main())
