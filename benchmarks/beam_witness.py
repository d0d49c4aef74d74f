"""Programs of beams as Grbl itself and LinuxCNC's interpreter read them.

    python benchmarks/beam_witness.py [--moves MOVES] FOLDER ...

MOVES is Grbl's own parser and motion control with the validator of grbl-sim around it (both GPL, built apart
from this project), in laser mode with $30=1000: it reads a file, ends with 0 if every line is ok, and writes
``x y feed rapid S state`` to standard error for each move that the planner gets, arcs as the chords that Grbl
makes of them; the state is 4 after M4, 3 after M3. It keeps a file in the folder in which it runs. Of each
``.nc`` below the FOLDERs

* Grbl accepts each line, and turns the beam on by M4 alone,
* its moves end where the proof's reader ends them, with the same power, and none in rapids,
* the way of the beam is the same to 8 µm: Grbl's chords along the reader's way, and this along the chords.

Of each ``.ngc`` rs274 accepts every line, and ends its moves where the reader does.
"""

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import shapely

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "cam"))
from rs274 import run_rs274

from mechwright_cut.proof.reading import Motion, read_beam
from mechwright_cut.proof.swept import runs, way

NEAR = 0.002
"""Ends of moves are the same to this, mm: Grbl's floats and four decimals."""
ALONG = 0.008
"""The ways are the same to this, mm. Grbl makes chords of arcs, by $12 = 0.002 mm beside them, and rounds
their number down: an arc of almost two chords becomes one, which is four times as far beside it."""


def by_grbl(binary: Path, program: Path) -> list[str]:
    """What is wrong with a program of Grbl; nothing where both read the same."""
    with tempfile.TemporaryDirectory() as folder:
        command = [binary.resolve(), program.resolve()]
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode:
        return [next((line for line in done.stdout.splitlines() if "rror" in line), "refused")]
    rows = np.array([line.split() for line in done.stderr.splitlines()], dtype=float).reshape(-1, 6)
    ours = read_beam(program.read_text(encoding="utf-8"), "grbl-laser").motions
    lit = rows[:, 4] > 0
    found = []
    if (rows[lit, 3] > 0).any():
        found.append("power in a rapid")
    if (rows[lit, 5] != 4).any():
        found.append("the beam is on without M4")
    found += _ends(rows, ours)
    theirs = shapely.MultiLineString(
        [np.vstack((rows[k - 1, :2], rows[k, :2])) for k in np.flatnonzero(lit) if k]
    )
    way_of_beam = shapely.union_all([way(run) for run in runs(ours)])
    for one, other, whose in ((theirs, way_of_beam, "Grbl's"), (way_of_beam, theirs, "the reader's")):
        points = shapely.points(shapely.get_coordinates(one))
        shapely.prepare(other)
        off = float(shapely.distance(points, other).max())
        if off > ALONG:
            found.append(f"{whose} way is {off:.4f} mm beside the other")
    return found


def _ends(rows: np.ndarray, ours: list[Motion]) -> list[str]:
    """Each of our moves ends at a place of Grbl's, in order, with the same power and feed."""
    at = 0
    for move in ours:
        if move.start == move.end and move.centre is None:
            continue
        while at < len(rows) and np.hypot(*(rows[at, :2] - move.end)) > NEAR:
            at += 1
        if at == len(rows):
            return [f"line {move.line}: Grbl does not come to its end"]
        if abs(rows[at, 4] - move.power) > NEAR and not move.rapid:
            return [f"line {move.line}: S{move.power:g} is S{rows[at, 4]:g} to Grbl"]
        at += 1
    return []


def by_linuxcnc(program: Path) -> list[str]:
    """The same of LinuxCNC's interpreter."""
    text = program.read_text(encoding="utf-8")
    with tempfile.TemporaryDirectory() as folder:
        canon = run_rs274(text, Path(folder))
    if not canon.ok:
        return [canon.error.splitlines()[-1]]
    ours = np.array([move.end for move in read_beam(text, "linuxcnc-beam").motions])
    if canon.ends.shape[0] != len(ours):
        return [f"{canon.ends.shape[0]} moves, not {len(ours)}"]
    off = float(np.abs(canon.ends[:, :2] - ours).max())
    return [f"ends are {off:.4f} mm apart"] if off > NEAR else []


def main() -> int:
    """Print what is wrong with each program, and the counts; 1 where something is."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--moves", type=Path, help="the binary; without it programs of Grbl are passed over")
    parser.add_argument("folders", nargs="+", type=Path)
    args = parser.parse_args()
    wrong = read = 0
    for folder in args.folders:
        for program in sorted(folder.rglob("*.n*")):
            if program.suffix == ".nc" and args.moves:
                said = by_grbl(args.moves, program)
            elif program.suffix == ".ngc":
                said = by_linuxcnc(program)
            else:
                continue
            read += 1
            wrong += bool(said)
            for one in said:
                print(f"{program}: {one}")
    print(f"{read} programs, {wrong} read otherwise")
    return min(wrong, 1)


if __name__ == "__main__":
    sys.exit(main())
