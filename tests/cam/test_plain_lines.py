"""Stretches of plain lines are run at once; line by line and word by word the same has to come out."""

import math
import re
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
import pytest
from by_control import BY_NAME, interpret
from by_night import examples
from hypothesis import example, given, settings
from hypothesis import strategies as st

from mechwright.errors import ProgramError
from mechwright_cam.controls.reading import Dialect, Kind, Remark, Run, motion_lines
from mechwright_cam.controls.reading.blocks import Block, read_block
from mechwright_cam.controls.reading.plain import LETTERS, PlainLines

NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)"
PLAIN = re.compile(rf" *(?:[{LETTERS}]{NUMBER} *)*", re.IGNORECASE)
WORD = re.compile(rf"([{LETTERS}])({NUMBER})", re.IGNORECASE)
COLUMNS = ("kind", "line", "start", "end", "centre", "sweep", "arc_error", "feed", "seconds", "state")


@contextmanager
def stretches_from(lines: int) -> Iterator[None]:
    """Run stretches at once from so many lines on."""
    before = motion_lines.FEWEST_LINES
    motion_lines.FEWEST_LINES = lines
    try:
        yield
    finally:
        motion_lines.FEWEST_LINES = before


def outcome(
    text: str, dialect: Dialect, lines: int, *, skipping: bool = False, by_words: bool = False
) -> Run | str:
    with stretches_from(lines), pytest.MonkeyPatch.context() as patch:
        if by_words:
            patch.setattr(PlainLines, "block", lambda plain, index: None)
        try:
            return interpret(text, dialect, block_delete=skipping, diameters={1: 0.2})
        except ProgramError as error:
            return str(error)


def assert_alike(text: str, dialect: Dialect, *, skipping: bool = False) -> None:
    by_words = outcome(text, dialect, 10**9, skipping=skipping, by_words=True)
    for lines in (1, 10**9):
        assert_same(outcome(text, dialect, lines, skipping=skipping), by_words, text)


def assert_same(at_once: Run | str, singly: Run | str, text: str) -> None:
    if isinstance(at_once, str) or isinstance(singly, str):
        assert at_once == singly
        return
    for name in COLUMNS:
        np.testing.assert_allclose(
            getattr(at_once, name), getattr(singly, name), rtol=1e-12, atol=1e-12, err_msg=f"{name}\n{text}"
        )
    assert at_once.states == singly.states
    assert at_once.remarks == singly.remarks
    assert at_once.ended == singly.ended


number = st.sampled_from(["0", "1", "-1", "2.5", "-.5", "+3.", "0.0", "10", "007.250", "0.3333"])
TAILS = [
    "",
    "",
    "",
    "",
    " ",
    "  ",
    " (then)",
    ";",
    "M8",
    "M9",
    "\t",
    "%",
    "M3",
    " S800",
    "S0",
    "; (so)",
    "(a)(b)",
]
tail = st.sampled_from(
    [*TAILS, "(py,1)", ";py,", " M30", "(no", "G90 (on)", "N7", "G91.1", "G94 G17", "M4M8", "S-5"]
)


WORDS = [
    "",
    "X",
    "Y",
    "XY",
    "XYZ",
    "Z",
    "XIJ",
    "XYIJ",
    "XI",
    "YJ",
    "IJ",
    "XYZIJ",
    "F",
    "XYF",
    "XF",
    "R",
    "XYR",
    "YXR",
    "RX",
    "XYRI",
    "FX",
    "XYZR",
    "JI",
]


@st.composite
def lines(draw: st.DrawFn) -> str:
    """A line that is plain, or nearly."""
    letters = draw(st.sampled_from(WORDS))
    words = [letter + draw(number) for letter in letters]
    if draw(st.booleans()):
        words.insert(
            0,
            draw(
                st.sampled_from(
                    ["G0", "G1", "G01", "G2", "G3", "G03", "G1.", "g1", "G90", "G91", "G81", "G4"]
                )
            ),
        )
    if draw(st.integers(0, 9)) == 0:
        words.insert(0, f"N{draw(st.integers(1, 99))}")
    return draw(st.sampled_from(["", " "])).join(words) + draw(tail)


SAFE = "G21 G17 G90 G40\nG0 X0 Y0 Z0\nG1 X1 F200\n"
STATED = "G21 G17 G90 G94 G54\nS500 M3 M8\nG0 X0 Y0 Z0\nG1 X1 F200\n"
STATES = [
    "",
    "",
    "G90",
    "G21 G17",
    "G91",
    "G94",
    "G20",
    "G40",
    "G41 D1 ",
    "G54",
    "G55 ",
    "M3",
    "M4",
    "M5 ",
    "M8",
    "M7",
    "M9",
    "G9 0",
]
beside = st.tuples(st.sampled_from(["", "", "S500", "S600", "S700."]), *[st.sampled_from(STATES)] * 2)
ARCS = ["G2 X2 Y0 I1 J0\nX0 I-1 J0", "G3 X0 Y2 I0 J1", "G2 I1 J0", "G3 X2 Y0 I1", "X0 Y0", "G3 X2 Y0 R-2"]
MORE = ["G91\nG2 X1 Y1 R1\nX-1 Y1 R-1", "G91\nG1 X.1\nY.2 X-.3\nZ1", "G90", "G2 X0 Y0 R3", "G53 G0 Z0"]
arcs = st.sampled_from([*ARCS, *MORE])


@settings(max_examples=examples(70, 200))
@given(
    st.sampled_from(["", SAFE]),
    st.lists(st.one_of(lines(), arcs), max_size=14),
    st.sampled_from(sorted(BY_NAME)),
)
def test_a_stretch_runs_as_its_lines_do(head: str, body: list[str], control: str) -> None:
    assert_alike(head + "\n".join(body), BY_NAME[control])


@settings(max_examples=examples(70, 200))
@given(
    st.sampled_from([STATED, STATED.replace(" M3", ""), SAFE]),
    st.lists(st.tuples(beside, lines()), max_size=14),
    st.sampled_from(sorted(BY_NAME)),
)
def test_words_of_state_and_speeds_beside_moves(
    head: str, body: list[tuple[tuple[str, ...], str]], control: str
) -> None:
    said = (" ".join([*filter(None, words), line]) for words, line in body)
    assert_alike(head + "\n".join(said), BY_NAME[control])


@settings(max_examples=examples(70, 200))
@given(
    st.sampled_from([STATED, SAFE]),
    st.lists(
        st.tuples(st.sampled_from(["", "", "/", "/ ", " /", "N7/", "//"]), beside, lines()), max_size=14
    ),
    st.sampled_from(sorted(BY_NAME)),
    st.booleans(),
    st.booleans(),
)
def test_lines_that_may_be_skipped(
    head: str, body: list[tuple[str, tuple[str, ...], str]], control: str, skipping: bool, looped: bool
) -> None:
    said = [start + " ".join([*filter(None, words), line]) for start, words, line in body]
    if looped and control == "linuxcnc":
        said = ["o1 repeat [2]", *said, "G1 X[1+1]", "o1 endrepeat"]
    assert_alike(head + "\n".join(said), BY_NAME[control], skipping=skipping)


steps = st.integers(-3000, 3000).map(lambda number: number / 1000)


@settings(max_examples=60)
@given(st.lists(st.tuples(st.sampled_from([0, 1, 2, 3]), steps, steps, steps), min_size=1, max_size=40))
def test_long_stretches_of_lines_and_arcs(moves: list[tuple[int, float, float, float]]) -> None:
    """Arcs to the other side of their centre are right however the tool got to where they start."""
    out, x, y = ["G21 G17 G90 G40", "G0 X0.0 Y0.0 Z1.0", "G1 Z0.0 F100.0"], 0.0, 0.0
    for motion, i, j, z in moves:
        if motion >= 2:
            i, j = (i, j) if i or j else (1.0, 0.0)
            x, y = x + 2 * i, y + 2 * j
            out.append(f"G{motion} X{x:.4f} Y{y:.4f} Z{z:.4f} I{i:.4f} J{j:.4f}")
        else:
            x, y = x + i, y + j
            out.append(f"G{motion} X{x:.4f} Y{y:.4f}")
    for control in ("linuxcnc", "fanuc"):
        assert_alike("\n".join([*out, "M30"]), BY_NAME[control])


@given(st.lists(st.text("NGXYZIJRFSgxK0123456789.+- \t(%", max_size=9), max_size=5))
@example(["S0", "X1S.0", "S-1", "S1", "F0", "F-1"])
@example(["X1Y2", "X1 N5", "N5X1Y2", "G1X1 F2Z3"])
def test_plain_lines_are_those_of_the_grammar(texts: list[str]) -> None:
    read = PlainLines("\n".join(texts), BY_NAME["linuxcnc"].dialect)
    for index, text in enumerate(texts):
        said = [(letter.upper(), float(value)) for letter, value in WORD.findall(text)]
        words = dict(said)
        once = len(words) == len(said) and "N" not in list(words)[1:]
        plain = PLAIN.fullmatch(text) is not None and once
        plain &= words.get("G", 0) in {0, 1, 2, 3} and not words.get("F", 0) < 0 and words.get("S", 1) > 0
        assert bool(read.plain[index]) == plain, text
        for row, letter in enumerate(LETTERS):
            expected = words.get(letter, math.nan) if plain else math.nan
            np.testing.assert_equal(read.words[row, index], expected)


def test_a_point_that_the_control_wants_makes_a_line_plain() -> None:
    text = "X1.Y2.5\nX1\nX0Y1.\nX1.F100"
    assert PlainLines(text, BY_NAME["fanuc"].dialect).plain.tolist() == [True, False, True, True]
    assert PlainLines(text, BY_NAME["linuxcnc"].dialect).plain.all()


@pytest.mark.parametrize("letter", "XYZIJR")
def test_every_length_without_its_point_is_refused_among_plain_lines(letter: str) -> None:
    """``X50`` are 50 µm to such a control, so that nobody knows what was meant."""
    lines = ["G21 G17 G90 G40", "G0 X0. Y0. Z0.", "G1 X1. F100", *["X2.", "X1."] * 20]
    words = {"I": "G2 X-1. I-1", "J": "G2 X1. Y2. I0. J1", "R": "G2 X2. Y1. R1"}
    lines += [words.get(letter, f"{letter}1"), *["X3."] * 20, "M30"]
    dialect = BY_NAME["fanuc"].dialect
    plain = PlainLines("\n".join(lines), dialect).plain
    assert [bool(plain[at]) for at in (42, 43, 44)] == [True, False, True]
    with pytest.raises(ProgramError, match=rf"^line 44: {letter}-?\d has no decimal point"):
        interpret("\n".join(lines), dialect)


def test_a_comment_beside_plain_words_moves_nothing() -> None:
    for comment in ("(X9)", "(G0 X9 Y9)", "; X9", "(Z-9) "):
        lines = "".join(f"X{k} {comment}\n" for k in range(30))
        text = f"G21 G17 G90 G40\nG0 X0 Y0 Z0\nG1 F100\n{lines}M2\n"
        assert_alike(text, BY_NAME["linuxcnc"])
        run = interpret(text, BY_NAME["linuxcnc"])
        assert run.end[1:, 0].tolist() == [*range(30)][1:] or run.end[-1, 0] == 29.0


@pytest.mark.parametrize("code", ["G0", "G1", "G2", "G3"])
def test_a_line_that_is_not_plain_goes_on_with_the_motion_of_those_before(code: str) -> None:
    ends = " I5 J0" if code in {"G2", "G3"} else ""
    lines = "".join(f"X{k % 2 * 10} Y0{ends if k % 2 else ends.replace('5', '-5')}\n" for k in range(1, 31))
    text = f"G21 G17 G90 G40\nG0 X0 Y0 Z0\nG1 F100\n{code} {lines}X10 Y0{ends} M8\nM2\n"
    assert_alike(text, BY_NAME["linuxcnc"])
    run = interpret(text, BY_NAME["linuxcnc"])
    assert run.kind[-2] == {"G0": Kind.RAPID, "G1": Kind.FEED}.get(code, Kind.ARC)
    assert run.end[-1, 0] == 10


@pytest.mark.parametrize("name", ["fanuc", "haas"])
def test_a_speed_with_a_point_is_plain_where_a_control_takes_it(name: str) -> None:
    dialect = BY_NAME[name].dialect
    lines = "".join(f"G1 X{k}. F100. S{900 + k}{{}}\n" for k in range(30))
    for point in ("", "."):
        plain = PlainLines(lines.replace("{}", point), dialect).plain[:30]
        taken = not point or dialect.words.of("S").point != "never"
        assert plain.all() == plain.any() == taken, (name, point)


def test_an_arc_from_an_unknown_height_is_no_plain_arc() -> None:
    arcs = "".join("G2 X10 Y0 I5 J0\nG2 X0 Y0 I-5 J0\n" for _ in range(20))
    for start in ("G0 X0 Y0\n", "G0 X0 Y0 Z5\n", "G0 X0 Y0 Z5\nG53 G0 Z0\n", "G0 Z5\nX0\n"):
        assert_alike(f"G21 G17 G90 G40\n{start}G1 F100\n{arcs}M2\n", BY_NAME["linuxcnc"])


def test_a_line_too_long_for_the_control_is_not_plain() -> None:
    text = "G1 X" + "0" * 80 + "1"
    assert not PlainLines(text, BY_NAME["grbl"].dialect).plain[0]
    assert PlainLines(text, BY_NAME["linuxcnc"].dialect).plain[0]


STRAIGHT = "".join(f"X{k}.\n" for k in range(1, 40))


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("G2 X5 Y5 I1 J0", r"line 43: the arc ends .* refuses it"),
        ("G2 X39 Y1 I0 J0", "line 43: an arc of radius 0"),
        ("G3 X5 Y5", "line 43: an arc without a centre"),
        ("X5 F0", "line 43: a feed move without a feed"),
        ("X5 F-1", "line 43: F is below 0"),
        ("X5 I1", "line 43: I means nothing in this line"),
        ("X1.2.3", "line 43: '.' starts no word"),
        ("X200000", "line 43: a coordinate or an arc's centre is beyond"),
    ],
)
def test_an_error_in_a_stretch_names_its_line(line: str, message: str) -> None:
    with pytest.raises(ProgramError, match=message):
        interpret(f"G21 G17 G90 G40\nG0 X0 Y0 Z0\nG1 F100\n{STRAIGHT}{line}\n{STRAIGHT}M2\n")


def test_a_number_beyond_all_numbers_is_an_error_and_no_warning() -> None:
    huge = "9" * 200 + "." + "9"
    with pytest.raises(ProgramError, match="line 43: Y1e\\+200 is a number"):
        interpret(f"G21 G17 G90 G40\nG0 X0 Y0 Z0\nG1 F100\n{STRAIGHT}Y{huge}\nG2 X0 Y0 I{huge} J1\nM2\n")


def test_a_stretch_in_a_loop_is_run_every_time() -> None:
    body = "".join(f"G1 X{k % 2} Y0\n" for k in range(20))
    text = f"G21 G17 G90 G40\nG0 X0 Y0 Z0\nF100\nO1 repeat [3]\n{body}G1 X[1+1]\nO1 endrepeat\nM2\n"
    with stretches_from(1):
        run = interpret(text)
    assert int((run.kind == Kind.FEED).sum()) == 63
    assert run.line[1:22].tolist() == list(range(5, 26)) == run.line[22:43].tolist()
    assert_alike(text, BY_NAME["linuxcnc"])


def test_lines_of_a_loop_count_however_they_are_run(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mechwright_cam.controls.reading.macros.MOST_LINES", 500)
    body = "".join(f"X{k % 2}\n" for k in range(100))
    with stretches_from(1), pytest.raises(ProgramError, match="more than 500 lines are run"):
        interpret(f"G21 G17 G90 G40\nG0 X0 Y0 Z0\nO1 while [1]\n{body}O1 endwhile\nM2\n")


def test_most_lines_of_a_program_are_run_in_stretches(monkeypatch: pytest.MonkeyPatch) -> None:
    """The quick way is taken at all; else every test here would hold for want of it."""
    read: list[int] = []

    def counted(line: int, text: str, dialect: Dialect) -> Block:
        read.append(line)
        return read_block(line, text, dialect)

    plainly = PlainLines.block

    def taken(plain: PlainLines, index: int) -> Block | None:
        block = plainly(plain, index)
        if block is not None:
            read.append(index + 1)
        return block

    monkeypatch.setattr("mechwright_cam.controls.reading.read.read_block", counted)
    monkeypatch.setattr(PlainLines, "block", taken)
    interpret(f"G21 G17 G90 G40\nG0 X0 Y0 Z0\nG1 F100\n{STRAIGHT}(again)\n{STRAIGHT}M2\n")
    assert read == [1, 2, 3, 83]


def test_lines_that_say_what_is_so_anyway_are_run_in_stretches(monkeypatch: pytest.MonkeyPatch) -> None:
    read: list[int] = []

    def counted(line: int, text: str, dialect: Dialect) -> Block:
        read.append(line)
        return read_block(line, text, dialect)

    monkeypatch.setattr("mechwright_cam.controls.reading.read.read_block", counted)
    every = "".join(f"G90 G1 X{k}. F{k} S{900 + k} M3 (to {k})\n" for k in range(1, 40))
    run = interpret(f"G21 G17 G90 G40\nS800 M3\nG0 X0 Y0 Z0\n{every}G91\n{every}M2\n")
    assert read == [1, 2, 83]
    assert [state.rpm for state in run.states[-3:]] == [937, 938, 939]
    assert [run.states[at].rpm for at in run.state[1:4]] == [901, 902, 903]
    assert run.remarks[5] == Remark(9, "to 6", 6)
