"""What is told first of a program, and what to do: the cause before its effects, and a remedy that mends it."""

import re

import pytest
from machine_programs import job_of, text_of
from test_named_states import put, reasons

from mechwright_cam.proof.report import Check, Proof


def test_lines_are_told_in_their_order() -> None:
    """Units that change at the last tool are told where they first matter, not where the program ends."""
    text = text_of("linuxcnc").replace("T3 M6", "T3 M6\nG20")
    found = reasons(text, job_of("linuxcnc"), "linuxcnc")
    lines = [line for line, _ in found.values()]
    assert len(found) > 3
    assert lines == sorted(lines, key=lambda line: (line is None, line))


def test_of_several_files_the_first_is_told_first() -> None:
    late, early = Check(False, "late", 3, name="late", file=1), Check(False, "early", 9, name="early")
    nowhere = Check(False, "nowhere", name="nowhere")
    checks = {check.name: check for check in (nowhere, late, early)}
    proof = Proof("part", checks, 0.0, 0.0, 0.0, 0.0, (), 0, 0.0, 0.0)
    assert [check.name for check in proof.failures] == ["early", "late", "nowhere"]
    assert "file" not in proof.as_dict()["checks"]["late"]


def test_what_the_path_cuts_is_no_question_of_tolerance() -> None:
    text = text_of("linuxcnc").replace("G83 X0 Y0", "G83 X4 Y0")
    found = reasons(text, job_of("linuxcnc"), "linuxcnc")
    assert list(found) == ["edges", "gouge"]  # it drills beside its spot, and into the wall


@pytest.mark.parametrize("control", ["linuxcnc", "grbl"])
def test_a_spindle_that_stands_asks_for_no_power(control: str) -> None:
    found = reasons(text_of(control).replace("S8000", "S0"), job_of(control), control)
    assert next(iter(found)) == "spindle"
    assert "power" not in found


@pytest.mark.parametrize(
    ("control", "unit"),
    [("linuxcnc", "P is in seconds"), ("fanuc", "P without a decimal point is in milliseconds")],
)
def test_a_long_wait_names_the_unit_of_the_control(control: str, unit: str) -> None:
    text, line = put(text_of(control), text_of(control).splitlines().index("M30"), "G4 P20000")
    found = reasons(text, job_of(control), control)["dwells"]
    assert found[0] == line
    assert unit in found[1]


@pytest.mark.parametrize(("z", "other"), [("Z3", "set cam.clearance if nothing"), ("Z-1", "feed there")])
def test_a_low_rapid_says_what_else_would_do(z: str, other: str) -> None:
    text = re.sub(r"^Z2$", z + "\nG0 Y-11\nY-12", text_of("linuxcnc"), flags=re.MULTILINE)
    assert other in reasons(text, job_of("linuxcnc"), "linuxcnc")["rapid-height"][1]
