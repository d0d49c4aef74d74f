"""Programs of LinuxCNC's own interpreter tests, read by its interpreter and by ours.

``python benchmarks/linuxcnc_interp.py FOLDER`` (such as ``tests/interp`` of a checkout of LinuxCNC)

Each program is run by ``rs274`` (Debian package ``linuxcnc-uspace``) and by our reader, from X0 Y0 Z0 with
the tools of the ``.tbl`` beside it. Both end at the same places, or both refuse it, or ours refuses it by
name: anything else is told, and the exit code is 1.
"""

import re
import subprocess
import sys
import tempfile
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))
sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "cam"))
from by_control import interpret
from rs274 import Canon, run_rs274
from test_rs274 import distinct

from mechwright.errors import ProgramError
from mechwright_cam.controls.reading import Kind, Run

PLACE = 1.1e-4
"""Canon prints four decimals, of mm or inches."""
MOVES = (Kind.RAPID, Kind.FEED, Kind.ARC, Kind.HOME)
RIGHT = ("agree", "both refuse", "refused by name", "no moves")


@dataclass(frozen=True)
class Verdict:
    name: str
    word: str
    said: str


def ends(run: Run) -> np.ndarray:
    """Ends (n, 3) of all moves, mm, as canon has them: a machine's place is 0."""
    found = run.end[np.isin(run.kind, MOVES) & ~run.piece].copy()
    found[~np.isfinite(found)] = 0.0
    return distinct(np.concatenate((np.zeros((1, 3)), found)))


def tools_of(table: str) -> dict[int, float]:
    """Diameters, mm, of a table that rs274 takes for inches."""
    rows = re.findall(r"T(\d+)[^;\n]*?D([-+.\d]+)", table, re.IGNORECASE)
    return {int(number): 25.4 * float(diameter) for number, diameter in rows}


def theirs(text: str, table: str) -> Canon | None:
    """What rs274 says; None if it does not end."""
    with tempfile.TemporaryDirectory() as folder:
        try:
            return run_rs274(text, Path(folder), table)
        except subprocess.TimeoutExpired:
            return None


def compare(name: str, text: str, table: str) -> Verdict:
    try:
        run = interpret(text, start=(0.0, 0.0, 0.0), diameters=tools_of(table))
    except ProgramError as error:
        canon = theirs(text, table)
        word = "refused by name" if canon is not None and canon.ok else "both refuse"
        return Verdict(name, word, str(error))
    canon = theirs(text, table)
    if canon is None or not canon.ok:
        if not run.ended:
            return Verdict(name, "both refuse", "the program does not end (check program-end)")
        error = "it does not end" if canon is None else " / ".join(canon.error.splitlines()[-2:])
        return Verdict(name, "accepted by us alone", error)
    inches = "USE_LENGTH_UNITS(CANON_UNITS_INCHES)" in canon.text.partition("SET_FEED_REFERENCE")[2]
    scale = 25.4 if inches else 1.0
    one, two = ends(run), distinct(np.concatenate((np.zeros((1, 3)), canon.ends * scale)))
    if one.shape != two.shape:
        return Verdict(name, "different", f"{len(one) - 1} moves, there {len(two) - 1}")
    off = np.abs(one - two).max()
    if off > PLACE * scale:
        at = int(np.abs(one - two).max(axis=1).argmax())
        return Verdict(
            name, "different", f"{off:.4f} mm apart at {one[at].round(4)}, there {two[at].round(4)}"
        )
    return Verdict(name, "agree" if len(one) > 1 else "no moves", f"{len(one) - 1} moves, {off:.5f} mm")


def main(folder: str) -> int:
    found = []
    for path in sorted(Path(folder).rglob("*.ngc")):
        tables = sorted(path.parent.glob("*.tbl"))
        table = tables[0].read_text(errors="replace") if tables else ""
        one = compare(str(path.relative_to(folder)), path.read_text(errors="replace"), table)
        found.append(one)
        print(f"{one.name:58} {one.word:22} {one.said}", flush=True)
    count = Counter(one.word for one in found)
    print(f"{len(found)} programs: " + ", ".join(f"{n} {word}" for word, n in count.most_common()))
    return int(any(one.word not in RIGHT for one in found))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
