"""The kept program of every operation on every control: its text, its proof, and what other programs read in it."""

import difflib
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from by_control import EVERY, interpret
from by_night import by_night, thinned
from golden_case import MORE
from golden_cases import CASES
from golden_operations import FOLDER, made, texts
from rs274 import needs_rs274, run_rs274
from test_rs274 import LAST_DECIMAL, distinct, our_ends

from mechwright.plugins.host import host
from mechwright_cam.controls.contract import Control
from mechwright_cam.machining import Machined
from mechwright_cam.operations.table import BUILT_IN
from mechwright_cam.planning.assign import Assignments
from mechwright_cam.shop.tool import ToolKind


@pytest.mark.parametrize(
    ("operation", "control"),
    [
        case
        for case in (*thinned(1, CASES, EVERY[:1]), *thinned(len(EVERY) - 1, CASES, EVERY[1:]))
        if case.values[1] in CASES[case.values[0]].controls
    ],
)
def test_the_text_is_as_it_was_reviewed(operation: str, control: str) -> None:
    """By day on LinuxCNC and one control in turn; ``golden_programs.py`` has every kind of line on each."""
    for name, text in texts(operation, control).items():
        kept = (FOLDER / operation / name).read_text(encoding="ascii")
        changed = "\n".join(difflib.unified_diff(kept.splitlines(), text.splitlines(), "kept", "now", n=1))
        assert not changed, (
            f"{operation}/{name}; read it, then: python tests/cam/golden_operations.py {operation}\n{changed}"
        )

    assert all(m.proof.ok and m.proof.cutting_length_mm > 0 for m in made(operation, control))


@by_night
def test_no_text_is_kept_that_nothing_writes() -> None:
    kept = {f"{path.parent.name}/{path.name}" for path in FOLDER.glob("*/*")}
    assert kept == {
        f"{operation}/{name}"
        for operation in CASES
        for control in CASES[operation].controls
        for name in texts(operation, control)
    }


@pytest.mark.parametrize("operation", CASES)
def test_the_part_shows_the_operation(operation: str) -> None:
    case = CASES[operation]
    one = made(operation, "linuxcnc")
    named = [o.name for m in one for section in m.program.sections for o in section.operations]
    assert tuple(named) == case.expected
    assert case.says in "".join(m.text for m in one)


@needs_rs274
@pytest.mark.parametrize("operation", CASES)
def test_linuxcnc_reads_its_own(operation: str, tmp_path) -> None:
    read_alike(made(operation, "linuxcnc"), tmp_path)


@needs_rs274
@pytest.mark.parametrize("operation", thinned(8, CASES))
def test_linuxcnc_reads_its_own_in_inches(operation: str, tmp_path) -> None:
    """The same programs, written and proven in inches."""
    programs = made(operation, "linuxcnc", "inch")
    assert all("G20" in one.text and one.proof.ok for one in programs)
    read_alike(programs, tmp_path)


def read_alike(programs: Sequence[Machined], folder: Path) -> None:
    post = host().get(Control, "linuxcnc")
    for one in programs:
        canon = run_rs274(one.text, folder, post.tool_table(one.program.tools)[1])
        assert canon.ok, canon.error
        unit = 25.4 if "G20" in one.text else 1.0  # canon speaks the units of the program
        ours, theirs = distinct(our_ends(interpret(one.text)) / unit), distinct(canon.ends)
        assert ours.shape == theirs.shape
        np.testing.assert_allclose(ours, theirs, atol=LAST_DECIMAL, rtol=0)


def test_every_operation_has_a_program_on_every_control() -> None:
    """Each that is built in claims something in a case; a control is left out only where it has no such cycle."""
    claimed: set[str] = set()
    for name, case in CASES.items():
        assignments = Assignments(control=host().get(Control, "linuxcnc"))
        for one in made(name, "linuxcnc"):
            claimed |= {task.operation.name for task in assignments.of(one.job).every()}
        tools = [MORE.get(tool) for tool in case.tools]
        for control in set(EVERY) - set(case.controls):
            post = host().get(Control, control)
            assert any(tool.kind is ToolKind.TAP and post.cannot_tap(tool) for tool in tools), (name, control)
        for control in case.controls:
            assert list((FOLDER / name).glob(f"{control}*.nc")), (name, control)
    assert claimed == {operation.name for operation in BUILT_IN}
