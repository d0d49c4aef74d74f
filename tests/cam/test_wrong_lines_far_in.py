"""A wrong line far inside of plain ones, which are read at once: refused with its own number and reason."""

import pytest
from by_control import BY_NAME, interpret
from shop import SPOT

from mechwright.designs.inches import Units
from mechwright.errors import ProgramError

HEAD = (
    "G21 G17 G90 G94 G40 G49 G80 G64 P0.004 Q0",
    "T1 M6",
    "S1000 M3",
    "G0 X0 Y0",
    "G43 H1 Z5",
    "G1 Z-1 F100",
)


def program(line: str, place: int) -> str:
    """400 plain lines, and one of them, from 0, is another."""
    plain = [f"X{number % 7} Y{number % 5}" for number in range(400)]
    plain[place] = line
    return "\n".join([*HEAD, *plain, "G0 Z5", "M5", "M2"]) + "\n"


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("5 X1", "a number without its letter"),
        ("X. Y5", "X is followed by no number"),
        ("X1 Y.", "Y is followed by no number"),
        ("X..5", "X is followed by no number"),
        ("X1 F0", "a feed move without a feed"),
        ("X1 F-1", "F is below 0"),
    ],
)
@pytest.mark.parametrize("place", [0, 1, 200, 399])
def test_a_wrong_line_is_told_with_its_number(line: str, said: str, place: int) -> None:
    interpret(program("X1 Y2", place), BY_NAME["linuxcnc"])
    with pytest.raises(ProgramError, match=rf"^line {len(HEAD) + place + 1}: .*{said}"):
        interpret(program(line, place), BY_NAME["linuxcnc"])


def test_without_a_tolerance_there_is_an_exact_stop() -> None:
    assert BY_NAME["linuxcnc"].rounding(0.0) == ["G61"]
    assert BY_NAME["linuxcnc"].rounding(0.004) == ["G64", "P0.004", "Q0"]


def test_a_length_offset_without_its_number_is_told_by_its_code() -> None:
    with pytest.raises(ProgramError, match=r"^line 5: G43 without H takes what Fanuc had last; write H"):
        interpret("%\nO1234\nG21 G17 G90 G94 G40 G49 G80\nT1 M6\nG0 G43 Z5.\n", BY_NAME["fanuc"])


@pytest.mark.parametrize(("more", "line"), [("", 0), ("(a note)\n", 0), ("\n(a note)\nG0 Z9\n", 412)])
def test_code_behind_the_end_is_told_with_its_line(more: str, line: int) -> None:
    """Lines 1 to 409 are the program."""
    assert interpret(program("X1 Y2", 7) + more, BY_NAME["linuxcnc"]).beyond == line


@pytest.mark.parametrize(("units", "said"), [("mm", "D 6 mm:"), ("inch", "D 0.23622 in:")])
def test_a_tool_is_noted_in_the_units_of_the_program(units: Units, said: str) -> None:
    assert said in BY_NAME["linuxcnc"].speaking(units).tool_note(SPOT)
