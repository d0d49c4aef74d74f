"""What commands cost, in processor time, by the clock and in memory: ``python benchmarks/bench_commands.py``.

Each command runs in a process of its own, with kept results switched off; the least of a few rounds counts.
Times are told in s and in times of ``import cadquery`` in the same run. ``--changes`` builds five machines,
changes one key, and builds again with the results of the first build: what the change costs, and which files
have the same bytes.
"""

import argparse
import os
import shutil
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

EXAMPLES = Path(__file__).parents[1] / "examples"
STORE = "MECHWRIGHT_STORE"
COMMAND = "from mechwright.__main__ import program; program()"
ANCHOR = "import cadquery"

MACHINES = (
    "four-bar",
    "slider-crank",
    "geneva",
    "elliptic-pair",
    "spur-gears",
    "figure-eight",
    "spherical-five-bar",
)
CHANGES = (
    ("four-bar-machine", "crank = 30", "crank = 29"),
    ("four-bar-machine", "screw_offset = 42", "screw_offset = 43"),
    ("slider-crank-machine", "rod = 110", "rod = 112"),
    ("slider-crank-machine", "load = -7", "load = -6"),
    ("geneva-machine", "floor = 3", "floor = 3.5"),
    ("geneva-machine", 'work_offset = "G54"', 'work_offset = "G55"'),
    ("elliptic-pair-machine", "semi_major = 50", "semi_major = 51"),
    ("elliptic-pair-machine", "load = 0.1", "load = 0.09"),
    ("spur-gears-machine", "mate_teeth = 45", "mate_teeth = 46"),
    ("spur-gears-machine", "load = 1\n", "load = 0.9\n"),
)


@dataclass(frozen=True)
class Cost:
    """Processor time and time by the clock, s, and the most memory of one process, MB."""

    processor: float
    clock: float
    memory: float

    def least(self, other: "Cost") -> "Cost":
        """The least of each figure."""
        return Cost(*map(min, vars(self).values(), vars(other).values()))


@dataclass(frozen=True)
class Row:
    """A command, and what it may cost: processor time and clock, s or times of the anchor, and memory, MB."""

    title: str
    arguments: tuple[str, ...]
    processor: float
    clock: float = float("inf")
    memory: float = float("inf")
    in_anchors: bool = False


def rows() -> Iterator[Row]:
    """The commands."""
    yield Row("--help", ("--help",), 0.03, in_anchors=True)
    pair = str(EXAMPLES / "elliptic-pair.toml")
    yield Row("build of the README's example", ("build", pair), 2.0, 1.5, in_anchors=True)
    yield Row("check of a machine", ("check", str(EXAMPLES / "four-bar-machine.toml")), 1.5)
    for name in MACHINES:
        yield Row(f"build of {name}-machine", ("build", str(EXAMPLES / f"{name}-machine.toml")), 15, 10, 700)


def run(code: str, arguments: Sequence[str], store: str = "off") -> Cost:
    """Run code in a process of its own; raises OSError where it fails."""
    environment = {**os.environ, STORE: store}
    start = time.perf_counter()
    silent = os.open(os.devnull, os.O_WRONLY)
    actions = [(os.POSIX_SPAWN_DUP2, silent, 1), (os.POSIX_SPAWN_DUP2, silent, 2)]
    line = [sys.executable, "-c", code, *arguments]
    process = os.posix_spawn(sys.executable, line, environment, file_actions=actions)
    _, status, used = os.wait4(process, 0)
    os.close(silent)
    if status:
        raise OSError(f"{' '.join(arguments)} ended with {os.waitstatus_to_exitcode(status)}")
    return Cost(used.ru_utime + used.ru_stime, time.perf_counter() - start, used.ru_maxrss / 1024)


def measured(row: Row, rounds: int) -> Cost:
    """The least cost of a row."""
    found = Cost(*[float("inf")] * 3)
    for _ in range(rounds):
        with tempfile.TemporaryDirectory() as folder:
            output = () if row.arguments[0] != "build" else ("-o", str(Path(folder) / "out"))
            found = found.least(run(COMMAND, (*row.arguments, *output)))
    return found


def changed(name: str, old: str, new: str) -> tuple[Cost, Cost, float]:
    """The cost of a build, that of the next one after a change, and the share of files that stay."""
    text = (EXAMPLES / f"{name}.toml").read_text(encoding="utf-8")
    if text.count(old) != 1:
        raise ValueError(f"{name}: {old!r} stands {text.count(old)} times in the file")
    with tempfile.TemporaryDirectory() as folder:
        design, output = Path(folder) / f"{name}.toml", Path(folder) / "out"
        store, before = str(Path(folder) / "store"), Path(folder) / "before"
        design.write_text(text, encoding="utf-8")
        first = run(COMMAND, ("build", str(design), "-o", str(output)), store)
        shutil.copytree(output, before)
        design.write_text(text.replace(old, new), encoding="utf-8")
        second = run(COMMAND, ("build", str(design), "-o", str(output)), store)
        files = [file.name for file in output.iterdir()]
        same = [
            name
            for name in files
            if (before / name).exists() and _bytes(before, name) == _bytes(output, name)
        ]
        return first, second, len(same) / len(files)


def _bytes(folder: Path, name: str) -> bytes:
    return (folder / name).read_bytes()


def main() -> int:
    """Print the table; 1 where a figure is missed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--changes", action="store_true")
    parser.add_argument("--only", default="", help="rows with this text in their title")
    asked = parser.parse_args()
    if asked.changes:
        print(f"{'change':58} {'first':>7} {'next':>7} {'share':>6} {'same files':>10}")
        for name, old, new in CHANGES:
            if asked.only in name:
                first, second, same = changed(name, old, new)
                share = second.processor / first.processor
                took = f"{first.processor:6.1f}s {second.processor:6.1f}s {share:6.2f} {same:10.0%}"
                print(f"{f'{name}: {new.strip()}':58} {took}", flush=True)
        return 0
    anchor = min((run(ANCHOR, ()) for _ in range(asked.rounds)), key=lambda cost: cost.processor)
    print(f"{ANCHOR}: {anchor.processor:.2f} s of processor time, {anchor.clock:.2f} s by the clock")
    print(f"{'command':36} {'processor':>18} {'clock':>18} {'memory':>15}")
    missed = 0
    for row in rows():
        if asked.only not in row.title:
            continue
        cost = measured(row, asked.rounds)
        by = (anchor.processor, anchor.clock) if row.in_anchors else (1.0, 1.0)
        unit = "IC" if row.in_anchors else "s"
        found = (cost.processor / by[0], cost.clock / by[1], cost.memory)
        limits = (row.processor, row.clock, row.memory)
        said = [
            _told(value, limit, u) for value, limit, u in zip(found, limits, (unit, unit, "MB"), strict=True)
        ]
        print(f"{row.title:36} {said[0]:>18} {said[1]:>18} {said[2]:>15}", flush=True)
        missed += any(value > limit for value, limit in zip(found, limits, strict=True))
    return int(missed > 0)


def _told(value: float, limit: float, unit: str) -> str:
    shown = f"{value:.0f}" if unit == "MB" else f"{value:.2f}"
    return f"{shown} {unit}" if limit == float("inf") else f"{shown} of {limit:g} {unit}"


if __name__ == "__main__":
    sys.exit(main())
