"""LinuxCNC's own interpreter as a witness: runs a program and gives back where its tool went.

Traps of the packaged version: exit code 0 after errors unless ``-n 2`` is given; tool tables are read in
inches whatever the INI file says (so the tables here have no lengths); it keeps a file in ``$HOME``.
"""

import re
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

RS274 = shutil.which("rs274")
needs_rs274 = pytest.mark.skipif(
    RS274 is None, reason="rs274 is not installed (Debian package linuxcnc-uspace)"
)
_CALL = re.compile(r"^\s*\d+\s+N\S*\s+(\w+)\((.*)\)\s*$")


@dataclass(frozen=True)
class Canon:
    """What the control would do: whether it accepts, its error, and the ends of all moves (n, 3), mm."""

    ok: bool
    error: str
    text: str
    kinds: tuple[str, ...]
    ends: np.ndarray


def run_rs274(text: str, folder: Path, tools: str = "") -> Canon:
    """Run a program through ``rs274`` in ``folder``; ``tools`` is the text of the tool table."""
    assert RS274 is not None
    (folder / "program.ngc").write_text(text)
    (folder / "tool.tbl").write_text(tools)
    (folder / "empty.var").write_text("")
    done = subprocess.run(
        [RS274, "-g", "-n", "2", "-t", "tool.tbl", "-v", "empty.var", "program.ngc", "canon.txt"],
        cwd=folder,
        env={"HOME": str(folder), "PATH": "/usr/bin:/bin"},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    canon = folder / "canon.txt"
    calls = canon.read_text(errors="replace") if canon.exists() else ""
    kinds, ends = _ends(calls)
    return Canon(done.returncode == 0, (done.stdout + done.stderr).strip(), calls, kinds, ends)


def _ends(canon: str) -> tuple[tuple[str, ...], np.ndarray]:
    kinds, ends, plane = [], [], "XY"
    for line in canon.splitlines():
        match = _CALL.match(line)
        if match is None:
            continue
        numbers = match[2].split(",")
        if match[1] == "SELECT_PLANE":
            plane = match[2].rpartition("_")[2]
        if match[1] in {"STRAIGHT_FEED", "STRAIGHT_TRAVERSE"}:
            kinds.append("rapid" if match[1].endswith("TRAVERSE") else "feed")
            ends.append([float(n) for n in numbers[:3]])
        elif match[1] == "RIGID_TAP":  # in, and back to where it began
            kinds += ["feed", "feed"]
            ends += [[float(n) for n in numbers[:3]], ends[-1]]
        elif match[1] == "ARC_FEED":
            kinds.append("arc")
            first, second, across = float(numbers[0]), float(numbers[1]), float(numbers[5])
            # In the planes XZ and YZ the axes come in the order of a right-handed turn.
            at = {"XY": (first, second, across), "XZ": (second, across, first), "YZ": (across, first, second)}
            ends.append(at[plane])
    return tuple(kinds), np.array(ends, dtype=float).reshape(-1, 3)
