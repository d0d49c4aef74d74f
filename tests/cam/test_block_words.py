"""Words that a control drops, or refuses beside each other: what is read is what the control does with it."""

import re
from pathlib import Path

import pytest
from by_control import BY_NAME, interpret
from random_blocks import by_rs274, programs
from rs274 import needs_rs274, run_rs274

from mechwright.errors import ProgramError

START = "G21 G90 G17 G94 G91.1 G40 G49 G54\nG0 X0 Y0 Z5\nG1 X1 F100\n"

GRBL_REFUSES = (
    ("G0\nZ5 G49", "drops X, Y and Z beside G49"),
    ("G0 G53 Z-5\nZ-5 G49", "drops X, Y and Z beside G49"),
    ("X3 Y2 G49", "drops X, Y and Z beside G49"),
    ("G1 G49 Z-2", "G1 and G49 both take the axes"),
    ("G10 L2 P1 X0 G49", "G10 and G49 both take the axes"),
    ("G28 G43.1 Z1", "G28 and G43.1 both take the axes"),
    ("G80\nG10 L2 P1 X0", "takes no X, Y or Z while G80 is in force"),
    ("G80\nG43.1 Z1", "takes no X, Y or Z while G80 is in force"),
    ("G80\nG91 G28 Z0", "takes no X, Y or Z while G80 is in force"),
    ("G43.1 Z1 G80", "takes no X, Y or Z while G80 is in force"),
    ("G43.1 X1 Z2", "G43.1 takes Z alone"),
    ("G2 X3 Y0 I1 J0\nI1", "takes no arc without X or Y"),
    ("M3 G2 I1", "takes no arc without X or Y"),
    ("G18\nG2 Y2 I1", "takes no arc without Z or X"),
    ("G2 X3 Y0 I1 J0\nG28 I1", "means nothing in this line"),
    ("T256", "takes up to T255"),
    ("G2 X1.0001 Y0 I0 J-300", "below 1e-06 rad for a full circle"),
    ("G18\nG2 X1.0001 Z5 I0 K300", "below 1e-06 rad for a full circle"),
    ("M7 M8", "exclude each other (coolant)"),
    ("G10 L2 P7 X0", "has P0 to P6"),
    ("G10 L2 P1", "G10 L2 without a value"),
    ("G10 L20 P1 X0 R1", "R means nothing in this line"),
    ("X1." + "0" * 77, "reads at most 79"),
    ("X0000000012", "drops the others: it reads X0000000000"),
    ("X0000 0000.5", "drops the others: it reads X00000000.0"),
    ("X0000000.12345", "drops the others: it reads X0000000.10000"),
    ("G0000000001 X2", "drops the others: it reads G0000000000"),
    ("X2 F0.000000005", "drops the others: it reads F0.000000000"),
    ("M0000000003 S10", "drops the others: it reads M0000000000"),
    ("T000000256", "drops the others: it reads T000000250"),
    ("G3 X1.001 Y0 R.0005", "just half the distance between the ends"),
    ("G2 X1.2 Y0 R-0.1", "just half the distance between the ends"),
)
"""Lines that Grbl 1.1 refuses, or whose numbers or axis words it drops (gcode.c), and what is said of them."""

LONG = ("X123.456789", "X1.12345678", "X000000000", "X2 (0000000012)", "G2 X1.2 Y0 R0.1002", "T0000001")
"""Numbers of many digits that Grbl reads as they are, and an R that its rounding does not make too small."""

LINUXCNC_KEEPS = (
    ("G0 X#100", "#100 is read before the program sets it"),
    ("G0 X#5", "#5 is read before the program sets it"),
    ("O1 if [#31 EQ 0]\nG0 X1\nO1 endif", "#31 is read before the program sets it"),
    ("O1 if [EXISTS[#<_depth>]]\nG0 X1\nO1 endif", "#<_depth> has no value in this program"),
    ("O1 if [EXISTS[#<depth>]]\nG0 X1\nO1 endif", "#<depth> has no value in this program"),
    ("G0 X#<_value>", "#<_value> has no value in this program"),
    ("G0 X#<_rpm>", "#<_rpm> is what an earlier program has left; write S before"),
    ("G0 X#<_selected_tool>", "#<_selected_tool> is what an earlier program has left; write T before"),
    ("G0 X#<_current_tool>", "#<_current_tool> is what an earlier program has left; write T and M6"),
)
"""Values that hang on an earlier program: LinuxCNC keeps them until it is shut down."""

LINUXCNC_REFUSES = (
    ("#100=3 N12", "a line number stands at the start of its line"),
    ("G2 X3 Y0 I1 J0\nG64 P0.01 X1 I-1", "G64 beside G2: both take P"),
    ("G64 P0.01 G3 X3 Y0 I1 J0", "G64 beside G3: both take P"),
    ("G10 L2 P1 X0 I1", "I means nothing in this line"),
    ("G10 L2 P10 X0", "G10 L2 P10: LinuxCNC has P0 to P9"),
    ("G10 L1 P0 Z0", "has P1 on"),
    ("G81 X1 Y1 Z-1 R2 @3 ^20", "polar coordinates beside X or Y"),
    ("G18\n@3 ^20", "polar coordinates are read in the XY plane only"),
    ("@3 ^20 G91 G28 Z0", "means nothing in this line"),
    ("N.5 X3", "line numbers are whole"),
    ("N1. X3", "line numbers are whole"),
    ("G42.1 D2 G0 Z4", "goes nowhere in X and Y"),
    ("G1 G41.1 D1", "goes nowhere in X and Y"),
    ("G64 P0.01 G41.1 D1", "G64 while compensation is on"),
    ("G98 G42.1 D2", "G98 while compensation is on"),
    ("G42.1 D4\nG1 X9 Y3\nY2 Z4", "does not fit into the inner corner"),
    ("G41.1 D4\nG1 X9 Y3\nX8.5", "does not fit into the inner corner"),
    ("O6 if 1\nG0 X3\nO6 endif", "in brackets, [...]; found '1'"),
    ("#1=0\nO6 while #1\nO6 endwhile", "in brackets, [...]; found '#1'"),
    ("O6 repeat 2\nO6 endrepeat", "in brackets, [...]; found '2'"),
    ("O1 sub\nO1 endsub 4\nO1 call", "in brackets, [...]; found '4'"),
    ("O6 if [0]\nO6 elseif 1\nO6 endif", "line 6: an O-word takes its value in brackets"),
    ("O6 if [1]\nO6 elseif [1/0]\nO6 endif", "line 6: 1 / 0 has no value"),
    ("O6 if [1]\nO6 elseif [1]\nO6 elseif [1 E7]\nO6 endif", "line 7: ] expected at 'e7]'"),
    ("O8 continue", "O8 continue stands in no while or do"),
    ("O8 break", "O8 break stands in no while or do"),
)
"""Lines that LinuxCNC refuses, as its interpreter shows."""


@pytest.mark.parametrize(("lines", "said"), GRBL_REFUSES)
def test_grbl_uses_each_axis_word_once(lines: str, said: str) -> None:
    with pytest.raises(ProgramError, match=re.escape(said)) as caught:
        BY_NAME["grbl"].read(f"{START}{lines}\nM2\n")
    assert str(caught.value).startswith(f"line {4 + lines.count(chr(10))}: ")


@pytest.mark.parametrize(
    "lines",
    ["G49\nZ4", "G80\nG0\nG10 L2 P1 X0", "G43.1 Z0", "G2 X3 I1", "T255", "G28", "X1." + "0" * 76, *LONG],
)
def test_grbl_takes_what_it_uses(lines: str) -> None:
    assert BY_NAME["grbl"].read(f"{START}{lines}\nM2\n").ended


@pytest.mark.parametrize("count", [1, 12])
def test_an_arc_without_an_end_is_refused_in_a_stretch_too(count: int) -> None:
    arcs = "G2 X3 Y0 I1 J0\nG2 X1 Y0 I-1 J0\n" * count
    with pytest.raises(ProgramError, match=f"^line {4 + 2 * count}: .* takes no arc without X or Y"):
        BY_NAME["grbl"].read(f"{START}{arcs}I1\n{arcs}M2\n")


@pytest.mark.parametrize(("lines", "said"), LINUXCNC_KEEPS + LINUXCNC_REFUSES)
def test_linuxcnc_takes_nothing_twice_and_nothing_from_earlier(lines: str, said: str) -> None:
    with pytest.raises(ProgramError, match=re.escape(said)):
        BY_NAME["linuxcnc"].read(f"{START}G98\n{lines}\nM2\n")


@needs_rs274
@pytest.mark.parametrize("lines", [lines for lines, _ in LINUXCNC_REFUSES])
def test_linuxcnc_refuses_them_itself(lines: str, tmp_path: Path) -> None:
    assert not run_rs274(f"{START}G98\n{lines}\nM2\n", tmp_path).ok


@pytest.mark.parametrize(
    "lines", ["#100=2\nG0 X#100", "O1 sub\nG0 X#5\nO1 endsub\nO1 call", "F90\nG0 X[#<_feed>/100]"]
)
def test_what_the_program_has_set_is_read(lines: str) -> None:
    assert interpret(f"{START}{lines}\nM2\n").ended


def test_a_name_of_a_subroutine_is_new_in_each_call() -> None:
    sub = "O1 sub\nO2 if [EXISTS[#<a>]]\nG0 X9\nO2 endif\n#<a>=1\nO1 endsub\nO1 call\nO1 call\n"
    assert interpret(f"{START}{sub}M2\n").end[:, 0].max() == 1.0


@needs_rs274
def test_random_blocks_are_read_as_linuxcnc_reads_them() -> None:
    """A sample; ``python benchmarks/block_witness.py linuxcnc 20000`` asks more by night."""
    accepted = 0
    for text in programs("linuxcnc", 500, 42):
        taken, why = by_rs274(text)
        assert not why, text
        accepted += taken
    assert accepted > 80
