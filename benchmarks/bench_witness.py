"""Every LinuxCNC example through LinuxCNC's real trajectory planner: ``python benchmarks/bench_witness.py``.

``python benchmarks/bench_witness.py [--faster K] [--part PART] [EXAMPLE ...]``

Plans the examples, proves them, runs each program on a machine of 2 and one of 0.5 m/s², and prints a table
in Markdown: moving time of the real control and of the estimate; how far the real path is from the programmed
one, the greatest of all samples and what 99.9 % of them keep, in operations that are run loosely and in those
that finish; and the corridor that is claimed of them. The exit code is 1 if one sample is outside of its
corridor, or one time more than 2 % off. A run with a sample outside is made once more, slower: a busy
computer may feed the control's queue too late, so that it meets corners otherwise. Both are told. It takes
the better part of an hour.
"""

import argparse
import re
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "cam"))
from planner_path import Compared, compared, times
from planner_witness import FASTER, SLOWER, Mill, WitnessError, sample

from mechwright.cli.hosting import open_host
from mechwright.pipeline import Build, Wanted
from mechwright_cam.machining import Machined, Machining
from mechwright_cam.shop.machine import Machine

ROOT = Path(__file__).parents[1]
ACCELERATIONS = (2.0, 0.5)
"""Of the machines, m/s²: a machining centre's, and a slow router's."""
CLOSE = 0.02
"""The estimate may be off by so much, as a share of the time."""
TIMES_SLOWER = 4
"""A run may take so many times longer than it should before it is given up."""
HEAD = (
    "| program | m/s² | real s | estimate s | off | loose: max, 99.9 %, corridor µm "
    "| finish: max, 99.9 %, corridor µm |\n| --- | --- | --- | --- | --- | --- | --- |"
)


def examples() -> list[str]:
    """Names of the design files that are for LinuxCNC, which is the control of those that name none."""
    texts = {path.stem: path.read_text() for path in sorted((ROOT / "examples").glob("*.toml"))}
    milled = {
        name: re.findall(r'^control = "(.*)"', text, re.M) for name, text in texts.items() if "\n[cam" in text
    }
    return [
        name
        for name, controls in milled.items()
        if controls in ([], ["linuxcnc"]) and not name.endswith(("-requirement", "-study"))
    ]


def made(name: str) -> tuple[list[Machined], str]:
    """The proven programs of an example, and the text of the tool table."""
    with Build(ROOT / "examples" / f"{name}.toml", open_host(), Wanted("verify")) as build:
        machining = build.made(Machining)
        return machining.proven_programs, machining.table[1]


def row(name: str, item: Machined, table: str, acceleration: float, faster: int) -> tuple[str, bool]:
    """A row of the table, and whether the program keeps to what is claimed of it."""
    machine = item.job.settings.machine.model_copy(update={"acceleration": acceleration})
    run, motion = item.scene.run, item.scene.control.lookahead.motion(item.scene.run, machine)
    limit = TIMES_SLOWER * float((motion.seconds + run.seconds).sum()) / faster + 30
    sampled, again = sample(item.text, mill_of(machine), table, limit, faster), ""
    found = compared(run, motion, sampled)
    if found.beyond.max() > 0 and faster > SLOWER:
        beyond = 1e3 * found.beyond.max()
        again = f" (at pace {faster} line {worst(item, found)} was outside by {beyond:.2f} µm; run again)"
        sampled = sample(item.text, mill_of(machine), table, SLOWER * limit, faster // SLOWER)
        found = compared(run, motion, sampled)
    real, estimate = times(run, motion, sampled)
    loosest = item.scene.control.tolerances[0]
    loose = run.of_states(lambda state: state.blend) >= loosest
    cells = []
    for which in (loose, ~loose):
        off, claimed = found.off[which[found.step]], motion.off[run.cutting & which]
        cells.append(
            f"{1e3 * off.max():.1f}, {1e3 * np.quantile(off, 0.999):.1f}, {1e3 * claimed.max():.1f}"
            if off.size and claimed.size
            else ""
        )
    share = estimate / real - 1
    kept = bool(abs(share) <= CLOSE and found.beyond.max() <= 0)
    note = "" if kept else f" OUTSIDE by {1e3 * found.beyond.max():.2f} µm, line {worst(item, found)}"
    cells = [
        f"{name}/{item.program.name}",
        f"{acceleration:g}",
        f"{real:.1f}",
        f"{estimate:.1f}",
        f"{100 * share:+.2f} %",
        *cells,
    ]
    return f"| {' | '.join(cells)} |{note}{again}", kept


def worst(item: Machined, found: Compared) -> int:
    """Line of the sample that is furthest outside."""
    return int(item.scene.run.line[found.step[np.argmax(found.beyond)]])


def mill_of(machine: Machine) -> Mill:
    """What the planner knows of a machine; the way to its upper end is what the estimate takes it for."""
    z = None if machine.rapid_z is None else machine.rapid_z / 60
    return Mill(machine.acceleration * 1000, machine.rapid / 60, z, machine.travel_z / 2)


def main() -> int:
    asked = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    asked.add_argument("examples", nargs="*", default=examples())
    asked.add_argument("--faster", type=int, default=FASTER, help="times faster than a clock")
    asked.add_argument("--part", help="this one alone")
    given = asked.parse_args()
    print(HEAD, flush=True)
    kept = True
    for name in given.examples:
        programs, table = made(name)
        for item in programs:
            if given.part not in (None, item.program.name):
                continue
            for acceleration in ACCELERATIONS:
                try:
                    text, good = row(name, item, table, acceleration, given.faster)
                except WitnessError as error:
                    text, good = f"| {name}/{item.program.name} | {acceleration:g} | FAILED: {error} |", False
                print(text, flush=True)
                kept &= good
    return 0 if kept else 1


if __name__ == "__main__":
    sys.exit(main())
