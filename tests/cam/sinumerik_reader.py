"""A reader of SINUMERIK programs of other hands as a witness: where it has the tool after each block.

``nc-gcode-interpreter`` of PyPI brings 370 MB, so it is none of the test packages: it lives in an environment of its
own, whose Python ``MECHWRIGHT_SINUMERIK`` names, and runs as a child. It is a witness of end points alone, where both
accept a program: it takes ``SUPA`` for a place in the work, the last of two X words, and arcs without a centre.
"""

import json
import os
import re
import subprocess
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from by_control import BY_NAME, interpret

from mechwright.errors import ProgramError
from mechwright_cam.controls.reading import Kind

PYTHON = os.environ.get("MECHWRIGHT_SINUMERIK", "")
needs_witness = pytest.mark.skipif(
    not PYTHON or not Path(PYTHON).exists(),
    reason="MECHWRIGHT_SINUMERIK names no Python with nc-gcode-interpreter (PyPI)",
)
OTHERWISE = re.compile(r"\bG(?:91|700)\b")
"""It gives inches as they stand, and a distance for the place."""
NEAR = 1e-6
"""Places that are read alike, mm."""

CHILD = """
import json, sys
from nc_gcode_interpreter import nc_to_dataframe
found = []
for text in json.load(sys.stdin):
    try:
        frame, _ = nc_to_dataframe(text)
    except Exception as error:
        found.append(str(error))
        continue
    columns = [frame[axis].to_list() if axis in frame.columns else [None] * len(frame) for axis in "NXYZ"]
    found.append([list(row) for row in zip(*columns)])
json.dump(found, sys.stdout)
"""


def numbered(text: str) -> str:
    """A program whose blocks have their lines' numbers, by which the answers are found."""
    lines = text.splitlines()
    plain = (";", "MSG", "SUB_", "CALL", "%")
    return "\n".join(
        line if not line or line.startswith(plain) else f"N{number} {line}"
        for number, line in enumerate(lines, 1)
    )


def theirs(texts: Sequence[str]) -> list[dict[int, list[float | None]] | str]:
    """Line to the place behind it, of each program; or why it is refused."""
    done = subprocess.run(
        [PYTHON, "-c", CHILD],
        input=json.dumps([*map(numbered, texts)]),
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr[-500:]
    return [
        said if isinstance(said, str) else {int(row[0]): row[1:] for row in said if row[0] is not None}
        for said in json.loads(done.stdout)
    ]


def differences(texts: Sequence[str]) -> tuple[int, list[str]]:
    """How many places both have alike, and what they have otherwise, of programs that both accept."""
    alike, wrong = 0, []
    for text, read in zip(texts, theirs(texts), strict=True):
        try:
            run = interpret(text, BY_NAME["siemens-840d"])
        except ProgramError:
            continue
        if isinstance(read, str) or OTHERWISE.search(text):
            continue
        lines = text.splitlines()
        last = {int(line): step for step, line in enumerate(run.line.tolist())}
        for line, step in last.items():
            if run.kind[step] not in {Kind.RAPID, Kind.FEED, Kind.ARC} or line not in read:
                continue
            for axis, ours, other in zip("XYZ", run.end[step].tolist(), read[line], strict=True):
                if not np.isfinite(ours) or other is None:
                    continue
                alike += 1
                if abs(ours - other) > NEAR:
                    wrong.append(
                        f"line {line} {lines[line - 1]!r}: {axis}{ours:g} here, {axis}{other:g} there"
                    )
    return alike, wrong
