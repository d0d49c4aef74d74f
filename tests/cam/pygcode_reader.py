"""A parser of other hands as a witness: runs pygcode on programs and compares where the tool went.

pygcode is under the GPL, and one of its dependencies breaks pytest, so it is none of the test packages: it lives in
a folder of its own (``pip install --target FOLDER pygcode``), which the environment names, and runs as a child.
"""

import json
import os
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from by_control import BY_NAME, interpret

from mechwright_cam.controls.reading import Kind

FOLDER = os.environ.get("MECHWRIGHT_PYGCODE", "")
needs_pygcode = pytest.mark.skipif(
    not (Path(FOLDER) / "pygcode").is_dir(), reason="MECHWRIGHT_PYGCODE names no folder with pygcode (PyPI)"
)

# Frames and the way to the reference point are no moves in the work.
CHILD = """
import json, sys
from pygcode import Line, Machine
found = []
for text in json.load(sys.stdin):
    mill, out = Machine(), []
    for number, raw in enumerate(text.split("\\n"), start=1):
        if raw.strip() == "%" or raw.startswith("O") or "G28" in raw:
            continue
        line = Line(raw)
        before = mill.pos
        mill.process_block(line.block)
        here = [mill.pos.values[axis] for axis in "XYZ"]
        words = {word.letter: float(word.value) for word in line.block.words if word.letter in "IJ"}
        centre = [before.values["X"] + words["I"], before.values["Y"] + words["J"]] if words else None
        out.append([number, here, centre])
    found.append(out)
json.dump(found, sys.stdout)
"""


Places = dict[int, tuple[list[float], list[float] | None]]
"""Line to the place after it, and to the centre of its arc if it is one."""


def theirs(texts: Sequence[str]) -> list[Places]:
    done = subprocess.run(
        [sys.executable, "-c", CHILD],
        input=json.dumps(texts),
        env={"PYTHONPATH": FOLDER},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr[-500:]
    return [{number: (here, centre) for number, here, centre in out} for out in json.loads(done.stdout)]


def agree(texts: Sequence[str], control: str, upper_end: float) -> int:
    """How many moves both read alike, in programs without cycles."""
    seen = 0
    for text, read in zip(texts, theirs(texts), strict=True):
        run = interpret(text, BY_NAME[control], upper_end=upper_end)
        for step in range(len(run)):
            moved = run.kind[step] in (Kind.FEED, Kind.ARC, Kind.RAPID)
            if not moved or not np.isfinite(run.end[step]).all():
                continue
            here, centre = read[int(run.line[step])]
            np.testing.assert_allclose(here, run.end[step], atol=1e-4)
            if run.kind[step] == Kind.ARC:
                np.testing.assert_allclose(centre, run.centre[step], atol=1e-4)
            seen += 1
    return seen
