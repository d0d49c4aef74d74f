"""Where what a program may say begins and ends: the last that is read, and the first that is not."""

import numpy as np
import pytest
from by_control import interpret

from mechwright.errors import ProgramError
from mechwright_cam.controls.reading import parameters
from mechwright_cam.controls.reading.recorder import MOST_PECKS

HEAD = "G17 G21 G40 G49 G80 G90 G94\nG0 X0 Y0 Z5\n"


def test_a_cycle_pecks_as_often_as_it_may_and_no_more() -> None:
    depth = 1.0
    run = interpret(f"{HEAD}G83 X0 Y0 R0 Z-{depth} Q{depth / MOST_PECKS} F100\nG80\nM2")
    assert run.end[:, 2].min() == -depth
    with pytest.raises(ProgramError, match=f"line 3: G83 would peck more than {MOST_PECKS} times; Q is too"):
        interpret(f"{HEAD}G83 X0 Y0 R0 Z-{depth + 1e-4} Q{depth / MOST_PECKS} F100\nG80\nM2")


@pytest.mark.parametrize(("first", "last", "what"), parameters._KEPT)
def test_what_the_machine_keeps_is_named_from_the_first_to_the_last(first: int, last: int, what: str) -> None:
    said = f"holds {what}, which the machine keeps"
    for number in {first, last}:
        with pytest.raises(ValueError, match=f"^#{number} {said}; a program writes #"):
            parameters.check_writable(float(number))
    others = {number for one, end, _ in parameters._KEPT for number in (one, end)}
    for number in {first - 1, last + 1} - others:
        with pytest.raises(ValueError, match=f"^#{number} is no program's; a program writes #"):
            parameters.check_writable(float(number))


@pytest.mark.parametrize(
    ("plane", "arc", "said"), [(18, "X5 Z10 I9 K1", "Z and X (G18)"), (19, "Y5 Z10 J9 K1", "Y and Z (G19)")]
)
def test_a_wrong_arc_of_another_plane_says_which(plane: int, arc: str, said: str) -> None:
    with pytest.raises(ProgramError) as caught:
        interpret(f"{HEAD}G{plane}\nG2 {arc} F100\nM2")
    assert str(caught.value).startswith("line 4: the arc ends 3.3985 mm nearer")
    assert str(caught.value).endswith(f"; it lies in the plane of {said}")


@pytest.mark.parametrize("head", [HEAD, "G21 G90\nG0 X0 Y0 Z5\n"])
def test_a_feed_is_said_before_the_first_cut(head: str) -> None:
    with pytest.raises(ProgramError, match="line 3: G1 without a feed; write F above 0"):
        interpret(f"{head}G1 X1\nM2")


def test_a_length_holds_up_to_g49_and_the_height_is_lost_with_both() -> None:
    run = interpret(f"{HEAD}G43 H1\nG0 X1\nG0 Z9\nG49\nG0 X2\nM2")
    told = {line: run.states[state].length_offset for line, state in zip(run.line, run.state, strict=True)}
    assert {line: told[line] for line in (2, 4, 5, 7)} == {2: 0, 4: 1, 5: 1, 7: 0}
    heights = {line: place[2] for line, place in zip(run.line, run.end, strict=True)}
    assert (heights[2], heights[5]) == (5.0, 9.0)
    assert np.isnan([heights[4], heights[7]]).all()


def test_what_stands_behind_the_second_percent_sign_is_no_part_of_the_program() -> None:
    text, sub = "%\n{0}G21 G90\nO1 call\nM2\n%\n{1}", "O1 sub\nG0 X1\nO1 endsub\n"
    assert interpret(text.format(sub, "")).end[0][0] == 1.0
    with pytest.raises(ProgramError, match="line 3: there is no subroutine 1 in this file"):
        interpret(text.format("", sub))
