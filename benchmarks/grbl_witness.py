"""Programs of machines without switches, as Grbl itself and LinuxCNC's interpreter read them.

    python benchmarks/grbl_witness.py --moves GMOVES FOLDER ...

GMOVES is Grbl's own parser and motion control with the validator of grbl-sim around it (both GPL, built
apart from this project): it reads a file, ends with 0 if every line is ok, and writes ``x y z feed rapid`` to
standard error for each move that the planner gets, arcs as the chords that Grbl makes of them. For every
program below the FOLDERs that has no machine coordinate

* Grbl accepts each line,
* its moves end where this project's reader ends them, in that order, to 2 µm, with the same feeds,
* what is fed is as long,
* rs274 accepts it, and ends its moves there too.
"""

import argparse
import re
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "cam"))
from by_control import BY_NAME, interpret
from rs274 import RS274, run_rs274

from mechwright_cam.controls.reading import Kind, Run

NEAR = 0.002
"""Ends of moves are the same to this, mm: three decimals."""
TABLE = "T1 P1 Z0 D0.125\nT2 P2 Z0 D0.0787\nT3 P3 Z0 D0.0394\n"
"""Tools of rs274; a T in a file that loads nothing has to be in its table."""
AHEAD = 4000
"""No arc has more chords."""
LENGTH = 0.003
"""Lengths are the same to this share: Grbl makes chords of arcs, and they turn up to 0.002 mm beside them."""


def moves_of_grbl(binary: Path, program: Path) -> tuple[str, np.ndarray]:
    """What Grbl objects to, empty if nothing, and (n, 5) x, y, z, feed and whether it is a rapid."""
    with tempfile.TemporaryDirectory() as folder:  # it keeps a file of settings where it runs
        command = [binary.resolve(), program.resolve()]
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode:
        return next((line for line in done.stdout.splitlines() if "rror" in line), "refused"), np.empty(
            (0, 5)
        )
    rows = [line.split() for line in done.stderr.splitlines()]
    return "", np.array(rows, dtype=float).reshape(-1, 5)


def differs(run: Run, ends: np.ndarray) -> str:
    """In what moves (n, 3) or (n, 5) differ from those of the project's reader; empty if in nothing."""
    moved = (run.start != run.end).any(axis=1) | (run.kind == Kind.ARC)
    at = 0
    for step in np.flatnonzero(moved & np.isfinite(run.end).all(axis=1)).tolist():
        near = (np.abs(ends[at : at + AHEAD, :3] - run.end[step]) <= NEAR).all(axis=1)
        if not near.any():
            return f"no move ends at {run.end[step]} of line {int(run.line[step])}"
        at += int(np.argmax(near))
        fed = run.kind[step] != Kind.RAPID
        if ends.shape[1] == 5 and (
            bool(ends[at, 4]) == fed or (fed and abs(ends[at, 3] - run.feed[step]) > 1)
        ):
            return f"another feed in line {int(run.line[step])}: {ends[at, 3]:g}, not {run.feed[step]:g}"
    return ""


def length_differs(run: Run, ends: np.ndarray) -> str:
    """Whether what is fed is longer or shorter than the reader's; empty if it is not."""
    ours = float(run.length[(run.kind != Kind.RAPID) & np.isfinite(run.length)].sum())
    way = np.linalg.norm(np.diff(ends[:, :3], axis=0), axis=1)
    theirs = float(way[ends[1:, 4] == 0].sum())
    return "" if abs(ours - theirs) <= LENGTH * ours + 1 else f"{theirs:.0f} mm long, not {ours:.0f}"


def main() -> int:
    """Read every program, and print what differs and how many there were."""
    reader = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    reader.add_argument("--moves", type=Path, required=True)
    reader.add_argument("folder", type=Path, nargs="+")
    said = reader.parse_args()
    counts: Counter[str] = Counter()
    for program in sorted(one for folder in said.folder for one in folder.rglob("*.nc")):
        text = program.read_text()
        if "Grbl" not in text.split("\n", 1)[0] or re.search(r"^[^(]*G53", text, flags=re.M):
            continue
        run = interpret(text, BY_NAME["grbl"])
        refused, ends = moves_of_grbl(said.moves, program)
        found = [refused] if refused else [differs(run, ends), length_differs(run, ends)]
        counts["programs"] += 1
        counts["lines"] += text.count("\n")
        counts["moves of Grbl"] += len(ends)
        if RS274 is not None:
            with tempfile.TemporaryDirectory() as folder:
                canon = run_rs274(text, Path(folder), TABLE)
            found.append("" if canon.ok else f"rs274: {canon.error[-200:]}")
            found.append(differs(run, canon.ends) if canon.ok else "")
            counts["read by rs274"] += canon.ok
        counts["longest line"] = max(counts["longest line"], *map(len, text.splitlines()))
        for one in filter(None, found):
            counts["differences"] += 1
            print(f"{program}: {one}", flush=True)
    print(", ".join(f"{what} {count}" for what, count in counts.items()))
    return int(counts["differences"] > 0 or not counts["programs"])


if __name__ == "__main__":
    sys.exit(main())
