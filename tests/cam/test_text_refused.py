"""Text that no control reads, or that a control carries out unseen, is refused with its line and the reason."""

import re
from pathlib import Path

import pytest
from by_control import BY_NAME, CONTROLS, interpret
from golden_operations import made
from rs274 import needs_rs274, run_rs274

from mechwright.errors import ProgramError
from mechwright_cam.controls.reading import plain, read
from mechwright_cam.controls.reading.comments_and_states import CommentsAndStates

START = "G17 G21 G40 G80 G90 G94\nG54\nF100.\nG0 X0. Y0. Z5.\n"
LINE = START.count("\n") + 1


def said(lines: str, control: str = "linuxcnc") -> str:
    """Why lines in the middle of a program are refused; empty if they are read."""
    try:
        interpret(f"{START}{lines}\nM30\n", BY_NAME[control], diameters={1: 6.0})
    except ProgramError as error:
        return str(error)
    return ""


NOWHERE = (
    *("G1 X\uff11.", "G1 X\u0661.", "G1 X\u00a01.", "G1\u2003X1.", "G1 X1. \u017f500", "\u0131 5", "G1 X1.\x0cY1."),
    *("G1 X1.\x0bY1.", "G1 X1.\x1cY1.", "G1 X1.\x85Y1.", "G1 X1.\x00", "\x00", "\ufeffG1 X1.", "G1 X\u20121."),
    *("N-5 G1 X1.", "N+5 G1 X1.", "N G1 X1.", "N5 N6 G1 X1.", "G1 N5 X1.", "%", "G1 X1. %", "% G1 X1."),
    *("G1 X1. X2.", "G1 X.", "G1 X-.", "G1 X1,5", "G1 X1_0", "G1 Xnan", "G1 Xinf", "G1 X0x1", "//G1 X1."),
    *("G1 X1. /", "G1 /X1.", "/2 G1 X1.", "( a ( b )", "(a", "G1 X1. a)", "G1 X1.\rG1 X2.", "$H", "$J=X1"),
    *("G1 X1. Y" + "9" * 400, "F1e999", "M5.1", "T1.5 M6", "S-5 M3", "G1 X1. F-1.", "M3 M5", "M8 M9"),
)  # fmt: skip
"""What no control reads."""


@pytest.mark.parametrize("control", CONTROLS)
@pytest.mark.parametrize("lines", NOWHERE)
def test_what_no_control_reads(lines: str, control: str) -> None:
    assert said(lines, control).startswith(f"line {LINE}: ")


@needs_rs274
@pytest.mark.parametrize("lines", [text for text in NOWHERE if "\0" not in text])
def test_linuxcnc_refuses_it_as_well(lines: str, tmp_path: Path) -> None:
    assert not run_rs274(f"{START}{lines}\nM30\n", tmp_path).ok


@pytest.mark.parametrize(
    ("control", "lines", "reason"),
    [
        ("linuxcnc", "G1 X\u00a01.", r"U\+00A0 \(NO-BREAK SPACE\) stands outside of comments"),
        ("linuxcnc", "G1 X1.\rG1 X2.", "a carriage return .* save the program with line feeds"),
        ("linuxcnc", "%", "a % without one in the first line"),
        ("linuxcnc", "N-5 G1 X1", "N-5: line numbers are whole, from 0 to 99999999"),
        ("linuxcnc", "G1 X" + "9" * 20, "X1e.20 is a number that no control reads"),
        ("linuxcnc", "T999999999 M6", "T999999999: LinuxCNC takes up to T99999"),
        ("linuxcnc", "M7 M8", r"M7 and M8 exclude each other \(coolant\)"),
        ("linuxcnc", "G0 G91 G28 Z0", "G0 and G28 both take the axes"),
        ("linuxcnc", "G1 G43.1 Z5", "G1 and G43.1 both take the axes"),
        ("linuxcnc", "(a\x07b)", r"U\+0007 stands in a comment"),
        ("grbl", "G0 G28 Z0", "G0 and G28 both take the axes"),
        ("grbl", "(\u00e0)", r"U\+00E0 .* stands in a comment, and Grbl 1.1 does not take it there"),
        ("grbl", "N10000001 G1 X1", "line numbers are whole, from 0 to 10000000"),
        ("fanuc", "(\u00e0)", r"U\+00E0 .* stands in a comment"),
        ("fanuc", "g1 X1.", "the small letter 'g' is no word to Fanuc; write words in capitals"),
        ("haas", "G1 x1.", "the small letter 'x' is no word to Haas"),
        ("fanuc", "N100000 G1 X1.", "from 0 to 99999"),
        ("mach3", "N5.5 G1 X1", "line numbers are whole"),
        ("fanuc", "S900 M3 M8", "several M codes; Fanuc obeys one in a line"),
        ("fanuc", "O0002", "a program number begins another program"),
        ("haas", ":2", "a program number begins another program"),
        ("fanuc", "G12 I5", "G12 is no code"),
        ("fanuc", "G5.1 Q1 R5", "write R10"),
        ("fanuc", "G5.1", "G5.1 needs Q"),
        ("fanuc", "G5.1 R10", "G5.1 needs Q"),
        ("fanuc", "G8", "G8 needs P"),
        ("fanuc", "G5.1 Q2", r"G5\.1 Q2 lets Fanuc round corners further .* write Q1"),
        ("fanuc", "G8 P3", r"G8 P3 lets Fanuc round corners further .* write P1"),
        ("fanuc", "M3.0", r"M3\.0 has a decimal point, and Fanuc takes M whole"),
        ("fanuc", "G4 P0.5", r"P0\.5 has a decimal point, and Fanuc takes P whole"),
        ("fanuc", "G82 X1. Y1. Z-1. R1. P250.", r"P250\. has a decimal point"),
        *((c, "G20", "G20 in a program with other units") for c in ("fanuc", "haas")),
        *((c, "M3 M19", "M3 and M19 exclude each other") for c in ("fanuc", "haas")),
    ],
)
def test_the_reason_is_the_right_one(control: str, lines: str, reason: str) -> None:
    assert re.match(f"line {LINE}: .*{reason}", said(lines, control))


@pytest.mark.parametrize(
    ("control", "lines"),
    [
        *(("linuxcnc", t) for t in ("N5.5 G1 X1", "g1 x1", "G1\tX1", "(\u00e0 \u4e2d)", "; (a", "(a) G1 (b) X1")),
        *(("linuxcnc", t) for t in ("(MSG, hello)", "(DEBUG, #5420)", "(PRINT, a)", "(py is a snake)", "/G1 X1")),
        *(("fanuc", t) for t in ("G5.1 Q1", "G05.1 Q1", "(small letters)", "N99999 G1 X1.", "G8 P1", "G1X1.Y2.")),
        *(("grbl", t) for t in ("M7", "N10000000 G1 X1", ";py, x", "(PROBEOPEN x)")),
    ],
)  # fmt: skip
def test_what_a_control_reads_is_read(control: str, lines: str) -> None:
    assert said(lines, control) == ""


@pytest.mark.parametrize(
    "comment",
    [
        *("(py, x = 1)", ";py, x = 1", "( PY, x)", "(PYRUN, x)", "(pyreload)", "(LOGOPEN,out.txt)"),
        *("(LogAppend, out.txt)", "(PROBEOPEN out.txt)", "(ABORT, x)", "G1 X1 (py, x)", "O1 if [1] (py, x)"),
    ],
)
def test_comments_that_linuxcnc_carries_out(comment: str) -> None:
    assert re.match(f"line {LINE}: LinuxCNC carries out the comment '.*take it out", said(comment))


def test_bad_characters_count_where_the_program_gets_to() -> None:
    """Prose behind the end may be in any script; a line that is not obeyed still has to be one."""
    interpret(START + "M30\n\u00fcber das Ende hinaus\n")
    with pytest.raises(ProgramError, match=f"^line {LINE + 1}: "):
        interpret(f"{START}O1 if [0]\n\u00fc\nO1 endif\nM30\n")


def test_a_line_is_as_long_as_it_is_written() -> None:
    """What an expression gives is shorter than the expression."""
    text = "G1 X[1" + "+1" * 130 + "]"
    assert "267 characters; LinuxCNC reads at most 255" in said(text)


@pytest.mark.parametrize("control", CONTROLS)
def test_a_line_that_is_too_long_is_not_looked_at(control: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Patterns take a hundred bytes for each of its characters, and a line may have millions."""
    seen = []
    monkeypatch.setattr(
        plain,
        "CommentsAndStates",
        lambda lines, dialect: seen.extend(lines) or CommentsAndStates(lines, dialect),
    )
    monkeypatch.setattr(read, "uses_macros", lambda text: seen.extend(text.split("\n")) or False)
    assert re.match(rf"line {LINE}: 500\d characters; ", said("G1 X1. Y" + "1" * 5000, control))
    assert START.count("\n") < len(seen)
    assert max(map(len, seen)) <= 255
    # Behind the end it is none of the program.
    assert interpret(f"{START}M30\n{'X' * 5000}\n", BY_NAME[control]).ended


def test_a_feed_in_machine_coordinates_needs_a_feed() -> None:
    with pytest.raises(ProgramError, match=r"^line 2: a feed move without a feed"):
        interpret("G21 G90 G17 G40\nG53 G1 Z0\nM2\n")
    interpret("G21 G90 G17 G40 F100\nG53 G1 Z0\nM2\n")


@pytest.mark.parametrize("ends", ["\n", "\r\n"])
def test_both_ends_of_lines_are_read_alike(ends: str) -> None:
    text = made("floor", "linuxcnc")[0].text
    one, two = interpret(text), interpret(text.replace("\n", ends))
    assert one.end.tobytes() == two.end.tobytes()
    assert one.line.tolist() == two.line.tolist()


def test_old_line_ends_are_named() -> None:
    with pytest.raises(ProgramError, match=r"^line 1: a carriage return \(CR\) ends no line"):
        interpret(made("floor", "linuxcnc")[0].text.replace("\n", "\r"))


STATES = {
    "G92 G92.3 G52 G44 G51 G51.1 G68 G16 G12.1 G93 G95 G96 G5 G5.2 G60 G31 G38.2 G33 G76 G65": (
        "linuxcnc", "fanuc", "haas", "mach3", "grbl",
    ),
    "G92.1": ("fanuc", "haas"),
    "G92.2": ("fanuc", "haas", "mach3", "grbl"),
    "G43.2 G28.1 G30.1 G7 G8 M48 M50 M60 M61 M62 M64 M66 M70 M72 M73 M100": ("linuxcnc",),
    "G10.6 G43.1 G50.1 G66 G107 M99 M61": ("fanuc", "haas"),
    "M29": ("haas",),
    "G59.3 G54.1 G154 G43 G41 G42 G81 G73 G98 M6 M19": ("grbl",),
}  # fmt: skip
"""Words that change the machine's state, and controls whose reader does not model them."""


@pytest.mark.parametrize(("words", "controls"), STATES.items())
def test_states_that_are_not_modelled_are_refused_by_name(words: str, controls: tuple[str, ...]) -> None:
    for word in words.split():
        for control in controls:
            name = re.escape(word)
            found = re.match(
                f"line {LINE}: {name} is (no code that|not supported)", said(f"{word} P1", control)
            )
            assert found, (control, word, said(f"{word} P1", control))


NO_CALL = "is no code that is read in programs for"


@pytest.mark.parametrize(
    ("control", "line", "reason"),
    [
        *((c, "M97 P1", "M97 is not read here; write M98") for c in ("fanuc", "mach3")),
        ("haas", "M98 P1", "M98 is not read here; a subprogram of this file is called by M97"),
        *((c, "M98 P1", "there is no O1 in this file; no other is read") for c in ("fanuc", "mach3")),
        ("haas", "M97 P1", "there is no N1 in this file; no other is read"),
        *((c, word, f"{word} {NO_CALL}") for c in ("fanuc", "haas", "mach3") for word in ("M97", "M98")),
        *((c, f"M97 P1 {x}", f"M97 {NO_CALL}") for c in ("fanuc", "haas", "mach3") for x in ("Q1", "X1.")),
        *(("grbl", f"{word} P1", f"{word} {NO_CALL}") for word in ("M97", "M98")),
        ("linuxcnc", "M97 P1", f"M97 {NO_CALL}"),
        ("linuxcnc", "M98 P1", "there is no subroutine 1 in this file; no other is read"),
    ],
)
def test_subprograms_that_are_not_called_are_refused_by_name(control: str, line: str, reason: str) -> None:
    assert said(line, control).startswith(f"line {LINE}: {reason}")


@pytest.mark.parametrize(
    "line",
    [
        *("#5221=10", "#5161=1", "#5403=1", "#0=1", "#<_x>=1", "#5220=2", "#[5220+1]=3", "#-1=1", "##1=5"),
        *("#5001=1", "#1.5=1", "#1000000=1"),
    ],
)
def test_parameters_of_the_machine_are_not_written(line: str) -> None:
    assert said(line).startswith(f"line {LINE}: ")
    assert said("#31=1\n#<mine>=2\n#<_mine>=3\n#5000=1") == ""


@pytest.mark.parametrize(
    "line", ["#500=1", "#3000=1(STOP)", "#3006=1", "#100=5.", "IF[#1EQ1]GOTO5", "G65 P9000"]
)
@pytest.mark.parametrize("control", ["fanuc", "haas", "mach3", "grbl"])
def test_macros_of_other_controls_are_refused(line: str, control: str) -> None:
    assert said(line, control).startswith(f"line {LINE}: ")


@pytest.mark.parametrize(("control", "home"), [("fanuc", "G28"), ("fanuc", "G30"), ("haas", "G28")])
def test_a_cycle_is_ended_before_the_way_to_a_reference_point(home: str, control: str) -> None:
    hole, up = "G81 X1. Y1. Z-1. R1.", f"G91 {home} Z0.\nG90"
    reason = f"line {LINE + 1}: {home} while G81 is in force; write G80 before"
    assert said(f"{hole}\n{up}", control) == reason
    assert said(f"{hole}\nG80\n{up}", control) == said(f"{hole}\nG0 Z5.\n{up}", control) == ""
    assert home != "G28" or said(f"{hole}\n{up}") == ""  # LinuxCNC goes there
