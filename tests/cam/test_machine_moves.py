"""Moves in machine coordinates and to reference points: X and Y at the upper end of Z only, Z up only."""

import math
from dataclasses import replace

import pytest
from by_control import BY_NAME, CONTROLS, interpret
from by_night import examples
from hypothesis import given, settings
from hypothesis import strategies as st
from machine_programs import (
    RETRACT,
    at_the_end,
    before_the_last_retract,
    in_cut,
    job_of,
    judged,
    refused,
    scene_of,
    text_of,
)

from mechwright.errors import ProgramError
from mechwright_cam.proof import prove
from mechwright_cam.proof.machine_moves import machine_moves, positions
from mechwright_cam.proof.motion_rules import travel

ASIDE = (
    *("G53 G0 X0. Y0.", "G0 G53 X10.", "G53 G0 Y-5.", "G53 G1 X0. F500.", "G53 G0 X0. Y0. Z-2."),
    *("G28 X0. Y0.", "G91 G28 X0.\nG90", "G91 G28 X0. Y0. Z0.\nG90", "G91 G28 Y0.\nG90"),
)
"""Words that take X or Y to a place that the work does not know."""


@pytest.mark.parametrize("words", ASIDE)
@pytest.mark.parametrize("control", CONTROLS)
def test_in_the_work_x_and_y_stay_in_work_coordinates(control: str, words: str) -> None:
    text, line = in_cut(text_of(control), words)
    found = refused(machine_moves, control, text, line)
    assert "while Z is at Z-4.8, and what stands on the way is not known; before it, in a" in found.message


@pytest.mark.parametrize("words", ASIDE)
@pytest.mark.parametrize("control", CONTROLS)
def test_with_the_tool_up_they_go_anywhere(control: str, words: str) -> None:
    assert judged(machine_moves, control, at_the_end(text_of(control), words)[0]).passed


@pytest.mark.parametrize("words", ASIDE)
@pytest.mark.parametrize("control", CONTROLS)
def test_the_clearance_plane_is_not_above_what_stands_elsewhere(control: str, words: str) -> None:
    text, line = before_the_last_retract(text_of(control), words)
    assert "while Z is at Z5" in refused(machine_moves, control, text, line).message


@pytest.mark.parametrize("control", CONTROLS)
def test_a_program_may_end_far_away(control: str) -> None:
    text = at_the_end(text_of(control), "G53 G0 X0. Y0.\nG91 G28 X0. Y0. Z0.\nG90")[0]
    assert prove(text, job_of(control), BY_NAME[control]).ok


@pytest.mark.parametrize("control", ["fanuc", "mach3", "grbl"])
def test_the_second_reference_point_is_one_too(control: str) -> None:
    text, line = in_cut(text_of(control), "G30 X0. Y0.")
    refused(machine_moves, control, text, line)
    assert judged(machine_moves, control, at_the_end(text_of(control), "G91 G30 X0. Y0.\nG90")[0]).passed


@pytest.mark.parametrize("control", CONTROLS)
def test_a_reference_move_without_an_axis_is_one_of_all(control: str) -> None:
    text, line = in_cut(text_of(control), "G28")
    if control == "fanuc":
        with pytest.raises(ProgramError, match=f"^line {line}: G28 without an axis sends none home"):
            _ = scene_of(control, text).run
        return
    refused(machine_moves, control, text, line)
    assert judged(machine_moves, control, at_the_end(text_of(control), "G28")[0]).passed


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("G53 G0 X0. Y0. Z-100.", "while Z goes to an unknown height"),
        ("G28 X0. Y0. Z1.", "while Z is at Z1,"),
        ("G53 G0 Z-100.", "below Z-2, which may be in the work; retract with"),
    ],
)
@pytest.mark.parametrize("control", CONTROLS)
def test_nothing_comes_down_on_the_way(control: str, words: str, said: str) -> None:
    text, line = at_the_end(text_of(control), words)
    assert said in refused(machine_moves, control, text, line).message


@pytest.mark.parametrize("control", CONTROLS)
def test_a_rapid_from_there_does_not_come_down_blindly(control: str) -> None:
    """X and Y are not known after the move, so that nobody sees what a rapid down meets."""
    text, line = at_the_end(text_of(control), "G53 G0 X0. Y0.")
    for words in ("G0 Z2.", "G0 X0. Y0. Z2.", "G0 Z-3.", "G0 Z5.", "G0 X0. Y0. Z5.", "G0 X0. Z5."):
        low = text.replace("M30", f"{words}\nM30")
        said = refused(positions, control, low, line + 1).message
        assert said.endswith(tuple(f"Z{z:.3f}" for z in (2, -3, 5)))
        assert "then go to X and Y, then to Z" in said
    assert judged(positions, control, text.replace("M30", "G0 X0. Y0.\nZ5.\nZ2.\nM30")).passed


@pytest.mark.parametrize("control", CONTROLS)
def test_machine_coordinates_are_no_distances(control: str) -> None:
    """LinuxCNC refuses G53 with G91, Fanuc skips it: a retract that does not happen."""
    text, line = in_cut(text_of(control), "G91 G53 G0 Z0.")
    with pytest.raises(ProgramError, match=rf"^line {line}: G53 with distances \(G91\).* write G90 before"):
        _ = scene_of(control, text).run


def test_a_reference_move_does_not_end_compensation() -> None:
    text = "G21 G90 G17\nG0 X0 Y0 Z5\nG41 D1 X9\nG28 Z5\nM2"
    with pytest.raises(ProgramError, match=r"^line 4: G28 while compensation is on; write G40 before"):
        interpret(text, diameters={1: 2.0})


LINES = text_of("linuxcnc").splitlines()
AXES = st.dictionaries(
    st.sampled_from("XYZ"), st.floats(-100, 0).map(lambda value: round(value, 1)), min_size=1
)


@given(st.integers(9, LINES.index("M30")), AXES)
@settings(max_examples=examples(50, 150))
def test_wherever_it_stands_the_height_decides(at: int, axes: dict[str, float]) -> None:
    before = interpret("\n".join(LINES[:at]), upper_end=RETRACT)
    z = float(before.end[-1, 2]) if len(before) else math.nan
    words = "G53 G0 " + " ".join(f"{axis}{value}" for axis, value in axes.items())
    found = judged(machine_moves, "linuxcnc", "\n".join([*LINES[:at], words, "M30"]))
    goes_up = axes.get("Z", RETRACT) >= RETRACT
    assert found.passed == (goes_up and (not axes.keys() & {"X", "Y"} or z == math.inf))
    assert found.passed or found.line == at + 1


# -- both ends of every axis -----------------------------------------------------------------------------

OUTSIDE = (
    ("G53 G0 Z300.", "Z 300", "Z travels from -400 to 0"),
    ("G53 G0 Z5.", "Z 5", "Z travels from -400 to 0"),
    ("G53 G0 X5000.", "X 5000", "X travels from -500 to 500"),
    ("G53 G0 X0. Y-401.", "Y -401", "Y travels from -400 to 400"),
    ("G20\nG53 G0 Z1.\nG21", "Z 25.4", "Z travels from -400 to 0"),
)
"""Places in machine coordinates that no machine of the default travel has: line, place and ends."""


@pytest.mark.parametrize(("words", "place", "ends"), OUTSIDE)
@pytest.mark.parametrize("control", CONTROLS)
def test_machine_coordinates_lie_within_both_ends(control: str, words: str, place: str, ends: str) -> None:
    if "G20" in words and BY_NAME[control].dialect.one_unit:
        pytest.skip("this control keeps to one unit")
    text, line = at_the_end(text_of(control), words)
    found = refused(travel, control, text, line + ("G20" in words))
    assert f"goes to machine {place}, and {ends}; " in found.message


@pytest.mark.parametrize("control", CONTROLS)
def test_where_the_lower_end_is_known_the_upper_one_is(control: str) -> None:
    job = job_of(control)
    machine = job.settings.machine.model_copy(update={"low_z": -100.0, "low_x": 0.0})
    job = replace(job, settings=job.settings.model_copy(update={"machine": machine}))
    for words, good in (
        ("Z300.", True),
        ("Z301.", False),
        ("X500.", True),
        ("X501.", False),
        ("X-1.", False),
    ):
        text = at_the_end(text_of(control), f"G53 G0 {words}")[0]
        assert judged(travel, control, text, job).passed == good, words


def test_an_end_that_inches_round_is_within_the_travel() -> None:
    job = job_of("linuxcnc")
    machine = job.settings.machine.model_copy(update={"low_x": -500.0})
    job = replace(job, settings=job.settings.model_copy(update={"machine": machine}))
    for place, good in (("-19.68504", True), ("-19.6852", False)):  # -500.00002 and -500.004 mm
        text = at_the_end(text_of("linuxcnc"), f"G20\nG53 G0 X{place}\nG21")[0]
        assert judged(travel, "linuxcnc", text, job).passed == good
