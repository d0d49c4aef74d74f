"""Can each desktop machine make three mechanisms of six materials? A table, and what stands in the way.

    python benchmarks/bench_makers.py [MACHINE ...]     by default every machine that has a control here

For each machine and material the shop is written by one command, with three mills and a sheet of 6 mm, and
three designs are made of it by ``new``: a Geneva wheel, a pair of elliptic gears, a four-bar linkage. Each is
checked up to the proven programs. "yes" is proven; else the code that refuses it stands there. A sheet is as
large as the machine travels, at most 300 x 200 mm.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

from mechwright_cam.shop.machine import known_machines

MATERIALS = ("acrylic", "plywood", "mdf", "pom", "hdpe", "aluminium")
FAMILIES = ("geneva", "elliptic-gears", "four-bar")
MOST = (300.0, 200.0)
"""Length and width of the largest sheet, mm."""


def run(folder: Path, *words: str) -> subprocess.CompletedProcess[str]:
    """A command, in a folder."""
    command = [sys.executable, "-m", "mechwright", *words]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)


def answer(folder: Path, family: str) -> str:
    """What becomes of a family in the shop of a folder."""
    made = run(folder, "new", family, "--shop", "shop.toml", "-o", f"{family}.toml")
    if made.returncode:
        return made.stderr.strip().splitlines()[-1][:60]
    checked = run(folder, "check", "--to", "output", f"{family}.toml")
    if checked.returncode == 0:
        return "yes"
    codes = [
        line.partition("[")[2].partition("]")[0] for line in checked.stdout.splitlines() if "error [" in line
    ]
    return codes[0] if codes else checked.stderr.strip().splitlines()[-1][:60]


def main(names: list[str]) -> None:
    """Print a row for each machine and material."""
    machines = known_machines()
    chosen = names or [
        name for name, (row, preset) in machines.items() if preset.control and "rigidity" in row
    ]
    print(f"| machine | class | material | {' | '.join(FAMILIES)} |")
    print(f"| --- | --- | --- | {' | '.join('---' for _ in FAMILIES)} |")
    for name in chosen:
        row, preset = machines[name]
        x, y = min(row["travel_x"] - 10, MOST[0]), min(row["travel_y"] - 10, MOST[1])
        spindle = ["--spindle", "10000-30000"] if "spindle" in preset.unknown else []
        for material in MATERIALS:
            with tempfile.TemporaryDirectory() as folder:
                sheet = f"{x:g}x{y:g}x6 {material}"
                words = ["--machine", name, "--mills", "3.175,2,1", "--sheet", sheet, *spindle]
                made = run(Path(folder), "shop", *words, "-o", "shop.toml")
                if made.returncode:
                    print(f"| {name} | {row['rigidity']} | {material} | {made.stderr.strip()} |", flush=True)
                    break
                found = [answer(Path(folder), family) for family in FAMILIES]
                print(f"| {name} | {row['rigidity']} | {material} | {' | '.join(found)} |", flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
