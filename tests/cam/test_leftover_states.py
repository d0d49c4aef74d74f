"""What an earlier program has left in force: the program says it anew, or is refused, or sheet and proof tell it."""

from dataclasses import replace
from pathlib import Path

import pytest
from by_control import BY_NAME, CONTROLS, asked, interpret, prove
from golden_operations import made
from machine_programs import at_the_end, job_of, text_of
from rs274 import needs_rs274, run_rs274

from mechwright.errors import ProgramError
from mechwright_cam.controls.reading import motion_lines
from mechwright_cam.pages.setup_sheet.procedure import BEFORE, steps
from mechwright_cam.proof.report import Check

HEAD = "G21 G90 G17 G40\nG0 X10 Y0 Z5\n"


def modes_of(text: str, control: str) -> Check:
    return prove(text, made("profile-outside", control)[0].job, BY_NAME[control]).checks["modes"]


@needs_rs274
def test_absolute_centres_stay_at_the_end_of_a_program_on_linuxcnc(tmp_path: Path) -> None:
    """An arc around X0 Y0 written by distances, and the same words with G90.1 in force."""
    arc = "G2 X0 Y10 I-10 J0 F100\nM2\n"
    assert run_rs274(HEAD + arc, tmp_path).ok
    assert not run_rs274(f"{HEAD}G90.1\n{arc}", tmp_path).ok


@pytest.mark.parametrize("control", CONTROLS)
def test_centres_are_by_distance_where_the_control_could_have_it_otherwise(control: str) -> None:
    text = made("profile-outside", control)[0].text
    line = next(k for k, words in enumerate(text.splitlines(), 1) if words.startswith(("G2 ", "G3 ")))
    found = modes_of(text.replace(" G91.1", ""), control)
    assert (" G91.1" in text) == (control in {"linuxcnc", "mach3", "grbl"})
    assert found.passed == (control != "mach3")
    assert found.told == (control == "linuxcnc")
    if control == "mach3":
        assert found.message.startswith(f"line {line}: moves before G91.1")
    if control == "linuxcnc":
        assert found.message.startswith(f"line {line}: moves as G91.1 says")


def test_feeds_per_minute_may_have_been_left_otherwise_by_a_program_that_was_broken_off() -> None:
    text = made("profile-outside", "linuxcnc")[0].text
    assert not modes_of(text, "linuxcnc").told
    assert " moves as G94 says" in modes_of(text.replace(" G94", ""), "linuxcnc").message


@pytest.mark.parametrize("least", [1, 10**9])
@pytest.mark.parametrize(
    ("arc", "unsaid"),
    [
        ("G2 X0 Y10 I-10 J0", (5, "G91.1")),
        ("G2 X0 Y10 R10", None),
        ("G91.1\nG2 X0 Y10 I-10 J0", None),
        ("G90.1\nG2 X0 Y10 I0 J0", None),
        ("G18 G2 X20 Z1 I5", (5, "G91.1")),
    ],
)
def test_only_centres_hang_on_it(
    arc: str, unsaid: tuple[int, str] | None, least: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(motion_lines, "FEWEST_LINES", least)
    text = f"{HEAD}G94\nG1 Z1 F100\n{arc}\nM2\n"
    assert interpret(text, BY_NAME["linuxcnc"]).hoped == unsaid
    assert interpret(text, BY_NAME["mach3"]).unsaid == unsaid


@pytest.mark.parametrize(
    ("control", "word"),
    [
        ("linuxcnc", "G92.1"),
        ("mach3", "G92.1, G50 and G69"),
        ("grbl", "G92.1"),
        ("haas", "G50"),
        ("fanuc", "G69"),
    ],
)
def test_shifts_that_no_program_shows_are_told(control: str, word: str) -> None:
    one = made("profile-outside", control)[0]
    told = one.proof.checks["modes"].message
    assert "not told by any program is an origin shift (G92" in told
    assert word in told
    first = steps(one.job, BY_NAME[control], [23], file_names=["a.nc"], deepest=-4)[0]
    assert first.title == BEFORE
    assert any(word in line and "earlier program" in line for line in first.lines)


@pytest.mark.parametrize("control", [name for name in CONTROLS if name != "grbl"])
def test_the_length_of_a_tool_that_is_none_of_the_job_is_refused_though_nothing_moves(control: str) -> None:
    """LinuxCNC stops there, as its table has no such tool."""
    text, line = at_the_end(text_of(control), "G43 H99")
    if control == "fanuc":  # which may move by such a block
        with pytest.raises(ProgramError, match=rf"line {line}: G43 without a height to go to"):
            asked("length-offset", text, job_of(control), BY_NAME[control])
        return
    found = asked("length-offset", text, job_of(control), BY_NAME[control])
    assert not found.passed
    assert found.message.startswith(
        f"line {line + 1}: H99 is in force here, the length of no tool of this job"
    )
    for number in (1, 3):
        assert asked(
            "length-offset", text.replace("H99", f"H{number}"), job_of(control), BY_NAME[control]
        ).passed


@pytest.mark.parametrize("length", [1.0, -1.0, 77.0])
def test_a_length_in_the_program_of_a_tool_that_is_touched_off_is_refused(length: float) -> None:
    """Touched off with no length in force, the tool goes by so much too high or too deep."""
    (one,) = made("profile-outside", "grbl")
    head, after = one.text.split("(operation: bore: finish)\n", 1)
    text = f"{head}G43.1 Z{length}\n{after}"
    found = asked("length-offset", text, one.job, BY_NAME["grbl"])
    line = head.count("\n") + 2
    assert not found.passed
    assert found.message.startswith(
        f"line {line}: G43.1 Z{length:g} while the length of T23 is not known; set"
    )
    assert asked("length-offset", text.replace(f"Z{length}\n", "Z0.\n"), one.job, BY_NAME["grbl"]).passed
    known = tuple(tool.model_copy(update={"length": 77.0}) for tool in one.job.tools)
    measured = asked("length-offset", text, replace(one.job, tools=known), BY_NAME["grbl"])
    assert measured.passed == (length == 77.0)
