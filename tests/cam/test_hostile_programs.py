"""What a hostile machinist found: modes of an earlier program, comments in words, words of macros."""

from pathlib import Path

import pytest
from by_control import BY_NAME, interpret, prove
from golden_operations import made
from rs274 import RS274, needs_rs274, run_rs274

from mechwright.errors import ProgramError

HEAD = "G21 G90 G17 G40 G49 G80 G94\nG0 X0 Y0 Z5\nF100\n"
IN_WORDS = [
    *("G1 X(a)6", "G1 X6(a).5", "G1 X6(a)5", "G(a)1 X1", "G1 X-(a)1", "(a) / G1 X1", "(a) N5 G1 X1"),
    *("#1=(a)5\nG1 X#1", "G1 X[1+(a)2]", "G1 X[1 (a)]", "#(a)1=5\nG1 X#1", "#1(a)=5\nG1 X#1"),
    *("o1(a) sub\no1 endsub\nG1 X1", "o1 if (a) [1]\nG1 X1\no1 endif", "(a) o1 if [1]\nG1 X1\no1 endif"),
]
BETWEEN = [
    *("G1 X6 (a)", "G1 (a) X6", "(a) G1 X6 (b)", "G1 (a)(b) X6 Y2", "/ (a) G1 X6"),
    *("N5 (a) G1 X6", "G1 X6 ;a (b) c", "o1 sub (a)\no1 endsub\nG1 X6", "#1=6 (a)\nG1 (b) X#1 (c) Y[1]"),
]


@pytest.mark.parametrize("lines", IN_WORDS)
def test_a_comment_inside_of_a_word_is_refused(lines: str) -> None:
    with pytest.raises(
        ProgramError, match=r"^line 4: a (comment stands inside of a word|line number stands)"
    ):
        interpret(HEAD + lines + "\nM2\n")


@pytest.mark.parametrize("lines", BETWEEN)
def test_a_comment_between_words_is_read(lines: str) -> None:
    assert interpret(HEAD + lines + "\nM2\n").end[-1, 0] == 6.0


@needs_rs274
@pytest.mark.parametrize(("lines", "taken"), [(IN_WORDS, False), (BETWEEN, True)])
def test_linuxcnc_takes_the_same_comments(lines: list[str], taken: bool, tmp_path: Path) -> None:
    for one in lines:
        assert run_rs274(HEAD + one + "\nM2\n", tmp_path).ok == taken, one


@needs_rs274
@pytest.mark.parametrize("words", ["G0 X#0", "#2=0\nG0 X##2", "G0 X[#-1]", "#2=99999\nG0 X EXISTS[###2]"])
def test_there_is_no_parameter_0(words: str, tmp_path: Path) -> None:
    with pytest.raises(ProgramError, match=r"there is no parameter #|kept by the machine"):
        interpret(HEAD + words + "\nM2\n")
    assert not run_rs274(HEAD + words + "\nM2\n", tmp_path).ok


@pytest.mark.parametrize("words", ["IF[#1EQ0]GOTO10", "GOTO 10", "WHILE[#1LT5]DO1", "END1"])
@pytest.mark.parametrize("control", ["fanuc", "haas"])
def test_jumps_of_macros_are_called_so(words: str, control: str) -> None:
    with pytest.raises(ProgramError, match=r"^line 2: jumps and loops of macros \([A-Z]+\) are not read"):
        interpret("G21\n" + words, BY_NAME[control])


@pytest.mark.parametrize("code", ["G16", "G52.5", "G86", "M98", "M66"])
def test_of_a_code_that_is_not_read_it_is_not_said_that_the_control_has_none(code: str) -> None:
    with pytest.raises(ProgramError, match=rf"^line 2: {code} is no code that is read in programs for Fanuc"):
        interpret(f"G21\n{code}", BY_NAME["fanuc"])


def said(text: str, control: str, operation: str) -> str:
    found = prove(text, made(operation, control)[0].job, BY_NAME[control])
    return "" if found.ok else found.failures[0].message


@pytest.mark.parametrize("control", ["linuxcnc", "fanuc", "haas", "mach3"])
def test_a_cycle_says_how_far_up_it_goes(control: str) -> None:
    """G99 of an earlier program would leave the drill at the R plane: LinuxCNC begins so."""
    text = made("drill", control)[0].text
    line = next(k for k, words in enumerate(text.splitlines(), 1) if "G81" in words)
    assert said(text.replace("G98 ", ""), control, "drill").startswith(f"line {line}: moves before G98")
    assert said(text.replace("G98 ", "").replace("G80 G90", "G80 G90 G98"), control, "drill") == ""


@needs_rs274
def test_linuxcnc_begins_with_the_r_plane(tmp_path: Path) -> None:
    cycle = HEAD.replace("Z5", "Z9") + "{} G81 X1 Y1 Z-1 R2\nM2\n"
    up = [run_rs274(cycle.format(word), tmp_path).ends[-1, 2] for word in ("", "G98", "G99")]
    assert up == pytest.approx([2.0, 9.0, 2.0])


@pytest.mark.parametrize(
    ("control", "stays"), [("fanuc", True), ("mach3", True), ("haas", False), ("linuxcnc", False)]
)
def test_feeds_by_revolution_may_be_left_over(control: str, stays: bool) -> None:
    text = made("pocket-contour", control)[0].text
    without = said(text.replace(" G94", "", 1), control, "pocket-contour")
    assert ("moves before G94" in without) == stays


@pytest.mark.parametrize("control", ["linuxcnc", "fanuc", "mach3"])
def test_speeds_by_minute_may_be_said(control: str) -> None:
    text = made("pocket-contour", control)[0].text
    assert said(text.replace("G17 ", "G97 G17 ", 1), control, "pocket-contour") == ""
    assert "feeds T23" in said(text.replace("Z1", "G97 S500\nZ1", 1), control, "pocket-contour")


@pytest.mark.parametrize("control", ["linuxcnc", "mach3", "grbl"])
def test_an_origin_shift_may_be_taken_back_before_the_work(control: str) -> None:
    text = made("pocket-contour", control)[0].text
    assert said(text.replace("G17 ", "G92.1\nG17 ", 1), control, "pocket-contour") == ""
    assert "from an unknown" in said(text.replace("X6.6", "G92.1\nX6.6", 1), control, "pocket-contour")


@pytest.mark.parametrize("control", ["fanuc", "haas"])
def test_what_stands_behind_a_percent_sign_is_not_run(control: str) -> None:
    text = made("pocket-contour", control)[0].text
    assert text.startswith("%")
    lines = text.splitlines()
    lines.insert(21, "%")
    assert said("\n".join(lines), control, "pocket-contour").startswith("line 23: this stands behind")


BESIDE_ARCS = ["G4 P0.5 G3 X2 Y0 I1 J0", "G3 X2 Y0 R1.5 G4 P1", "G3 X2 Y0 I1 J0\nG4 P1 X0 Y0 I-1 J0"]


@pytest.mark.parametrize("lines", BESIDE_ARCS)
def test_p_is_no_time_and_number_of_turns_at_once(lines: str, tmp_path: Path) -> None:
    with pytest.raises(ProgramError, match=r"^line [45]: G4 beside G3: both take P; write each in a line"):
        interpret(HEAD + lines + "\nM2\n")
    if RS274 and "\n" not in lines:  # in a line without G2 or G3 LinuxCNC takes P twice
        assert not run_rs274(HEAD + lines + "\nM2\n", tmp_path).ok
    assert interpret("G91.1\n" + HEAD + lines + "\nM2\n", BY_NAME["grbl"]).seconds.max() <= 1.0


@pytest.mark.parametrize("words", ["G4 P500 Y1.", "G4 P500 G1 Z1.", "G4 X1. Y1.", "G4 P500 X1."])
def test_whether_a_dwell_comes_first_fanuc_and_haas_do_not_say(words: str) -> None:
    for control in ("fanuc", "haas"):
        with pytest.raises(ProgramError, match=r"^line 2: G4 beside G[01]: which of them comes first, noth"):
            interpret(f"G21 G90 G17 G40 G80 G94 G0 X0. Y0. Z5. F9.\n{words}\nM30\n", BY_NAME[control])
        for alone in ("G4 P500", "G4 P500 M3 S100", *(["G4 X1."] if control == "fanuc" else [])):
            interpret(f"G21 G90 G17 G40 G80 G94 G0 X0. Y0. Z5.\n{alone}\nM30\n", BY_NAME[control])
    assert interpret(f"{HEAD}G4 P1 X1\nM2\n").seconds.max() == 1.0  # LinuxCNC waits first
