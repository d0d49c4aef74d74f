"""A parser of other hands reads every control's program as we do.

pygcode is under the GPL, and one of its dependencies breaks pytest, so it is none of the test packages: it lives in
a folder of its own (``pip install --target FOLDER pygcode``), which the environment names, and runs as a child.
"""

import json
import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from golden_programs import CONTROLS, every_operation, with_options
from planning_parts import bore, job, plate

from mechwright.host import host
from mechwright.tooling import Posting
from mechwright_cam.interpreter import DIALECTS, Kind, interpret
from mechwright_cam.pipeline import machine

FOLDER = os.environ.get("MECHWRIGHT_PYGCODE", "")
pytestmark = pytest.mark.skipif(
    not (Path(FOLDER) / "pygcode").is_dir(), reason="MECHWRIGHT_PYGCODE names no folder with pygcode (PyPI)"
)

# Frames and the way to the reference point are no moves in the work.
CHILD = """
import json, sys
from pygcode import Line, Machine
mill, out = Machine(), []
for number, raw in enumerate(sys.stdin.read().split("\\n"), start=1):
    if raw.strip() == "%" or raw.startswith("O") or "G28" in raw:
        continue
    line = Line(raw)
    before = mill.pos
    mill.process_block(line.block)
    here = [mill.pos.values[axis] for axis in "XYZ"]
    words = {word.letter: float(word.value) for word in line.block.words if word.letter in "IJ"}
    centre = [before.values["X"] + words["I"], before.values["Y"] + words["J"]] if words else None
    out.append([number, here, centre])
json.dump(out, sys.stdout)
"""


def theirs(text: str) -> dict[int, tuple[list[float], list[float] | None]]:
    """Line to the place after it, and to the centre of its arc if it is one."""
    done = subprocess.run(
        [sys.executable, "-c", CHILD],
        input=text,
        env={"PYTHONPATH": FOLDER},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr[-500:]
    return {number: (here, centre) for number, here, centre in json.loads(done.stdout)}


def agree(text: str, control: str, upper_end: float) -> int:
    run = interpret(text, DIALECTS[control], upper_end=upper_end)
    read, seen = theirs(text), 0
    for step in range(len(run)):
        if run.kind[step] not in (Kind.FEED, Kind.ARC, Kind.RAPID) or not np.isfinite(run.end[step]).all():
            continue
        here, centre = read[int(run.line[step])]
        np.testing.assert_allclose(here, run.end[step], atol=1e-4)
        if run.kind[step] == Kind.ARC:
            np.testing.assert_allclose(centre, run.centre[step], atol=1e-4)
        seen += 1
    return seen


@pytest.mark.parametrize("control", CONTROLS)
@pytest.mark.parametrize("program", [every_operation, with_options], ids=lambda f: f.__name__)
def test_kept_programs(control: str, program) -> None:
    made = program()
    # It takes a cycle for one move to the bottom; written out, every move can be compared.
    made = replace(made, posting=made.posting.model_copy(update={"cycles": False}))
    assert agree(host().post(control).write(made), control, made.machine.retract_z) > 50


@pytest.mark.parametrize("control", CONTROLS)
def test_planned_programs(control: str) -> None:
    settings = {"control": control, "post": Posting(cycles=False)}
    made = machine(job(plate(bore(12.0)), "spot-6", "drill-8", "mill-6", **settings), host().post(control))
    assert agree(made.text, control, 0.0) > 150
