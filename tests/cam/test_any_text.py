"""Any text at all: one line with the place, or a run; never a traceback, and never without an end."""

import re

import numpy as np
import pytest
from by_control import BY_NAME, CONTROLS, interpret
from by_night import NIGHT, examples
from golden_operations import made
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from mutants import FAULTS, mutant

from mechwright.errors import ProgramError
from mechwright_cam.controls.reading import Kind
from mechwright_cam.controls.reading.recorder import MOST_STEPS

HEAD = "G17 G21 G40 G80 G90 G94\nG54\nF100.\nG0 X0. Y0. Z5.\n"
ONE_LINE = re.compile(r"line \d+: [^\n]+")
any_text = settings(max_examples=examples(60, 150), deadline=None, suppress_health_check=list(HealthCheck))


def one_line_or_a_run(text: str, control: str) -> None:
    run, said = None, ""
    try:
        run = interpret(text, BY_NAME[control], diameters={1: 6.0, 2: 3.0})
    except ProgramError as error:
        said = str(error)
    if run is None:
        assert ONE_LINE.fullmatch(said), repr(said)
        assert int(said[5:].partition(":")[0]) <= text.count("\n") + 1
        return
    moving = run.cutting | (run.kind == Kind.RAPID)
    places = np.concatenate((run.start[moving], run.end[moving]))
    assert (np.isnan(places) | np.isposinf(places) | (np.abs(places) <= 1e5)).all()
    assert (run.feed[run.cutting] > 0).all()


@given(st.binary(max_size=200), st.sampled_from(CONTROLS))
@any_text
def test_bytes(data: bytes, control: str) -> None:
    one_line_or_a_run(data.decode("latin-1"), control)
    one_line_or_a_run(HEAD + data.decode("utf-8", "replace"), control)


@given(st.text(max_size=120), st.sampled_from(CONTROLS))
@any_text
def test_characters(text: str, control: str) -> None:
    one_line_or_a_run(HEAD + text + "\nM30\n", control)


number = st.one_of(
    st.integers(-99, 999).map(str),
    st.floats(-50, 50).map("{:.3f}".format),
    st.sampled_from(
        ["", "-", ".", "1e9", "1e999", "9" * 30, "-0.", "#1", "[1+1]", "[1/0]", "#<a>", "1.2.3", "[[[1]]]"]
    ),
)
word = st.tuples(st.sampled_from("GGGGMMXYZIJKRFSTHDPQLNOABC@^#/%(;"), number).map("".join)
code = st.sampled_from(
    [f"G{n}" for n in range(100)] + [f"M{n}" for n in range(100)] + ["G91.1", "G43.1", "G41.1"]
)
STRUCTURE = (
    *("O1 sub", "O1 endsub", "O1 call", "O1 call [1] [2]", "O2 if [#1 GT 0]", "O2 else", "O2 endif", "O3 while [#2 LT 3]"),
    *("O3 endwhile", "#2=[#2+1]", "O4 repeat [3]", "O4 endrepeat", "O1 return [1]", "M98 P5 L2", "O5", "M99", "O3 break"),
    *("O6 do", "O6 while [0]", "O3 continue", "#1=[sqrt[-1]]", "#1=[acos[2]]", "#1=[0**-1]", "#1=[ln[0]]", "#1=[exp[999]]"),
    *("G1 X[atan[0]/[0]]", "#1=[1 mod 0]", "G1 X[tan[90]]", "#[#1]=1", "#5220=1", "%", "G1 X#5420", "M2", "(a", "/G1 X1"),
)  # fmt: skip
structure = st.sampled_from(STRUCTURE)
line = st.one_of(st.lists(st.one_of(word, code), max_size=5).map(" ".join), structure)


@given(st.lists(line, max_size=25), st.sampled_from(CONTROLS))
@any_text
def test_words(lines: list[str], control: str) -> None:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("mechwright_cam.controls.reading.macros.MOST_LINES", 2_000)
        patch.setattr("mechwright_cam.controls.reading.recorder.MOST_STEPS", 20_000)
        one_line_or_a_run(HEAD + "\n".join(lines) + "\nM30\n", control)


@given(st.data())
@any_text
def test_programs_with_letters_changed(data: st.DataObject) -> None:
    control = data.draw(st.sampled_from(CONTROLS))
    text = made(data.draw(st.sampled_from(["pocket-contour", "peck", "thread"])), control)[0].text
    for _ in range(data.draw(st.integers(1, 4))):
        at = data.draw(st.integers(0, len(text) - 1))
        new = data.draw(
            st.sampled_from(["", " ", "\n", "%", "(", ")", "\r", "\x0c", "/", "\u0661", "G", "9", "-", "."])
        )
        text = text[:at] + new + text[at + data.draw(st.integers(0, 3)) :]
    one_line_or_a_run(text, control)


@pytest.mark.parametrize("control", CONTROLS)
def test_programs_with_one_fault(control: str) -> None:
    rng = np.random.default_rng(16)
    # By day a third of the faults on each control, all of them between the controls.
    kinds = list(FAULTS) if NIGHT else list(FAULTS)[CONTROLS.index(control) % 3 :: 3]
    for operation in ("pocket-contour", "peck"):
        text = made(operation, control)[0].text
        for kind in kinds:
            if (wrong := mutant(text, kind, rng)) is not None:
                one_line_or_a_run(wrong.text, control)


@pytest.mark.parametrize(
    ("lines", "said"),
    [
        ("T99999999999999999999 M6", "T1e.20 is a number"),
        ("G18 G2 X1 Z5 I.5 K0 P1000\n" * 20, f"more than {MOST_STEPS} moves"),
        ("".join(f"G98 G83 X{k} Y1 Z-5 R1 Q.001\n" for k in range(60)), f"more than {MOST_STEPS} moves"),
        ("O9 sub\nO9 call\nO9 call\nO9 endsub\nO9 call", "nested more than 10 deep"),
        ("G1 X" + "[" * 50 + "1" + "]" * 50, "nested more than 40 deep"),
        ("#1=" + "[" * 40 + "1" + "]" * 40, None),
        ("G1 X" + "9" * 100, "is a number that no control reads"),
        ("#1=[10**300]\n#1=[#1*#1]\nG1 X#1", "has no value|no number"),
        ("#1=[10**300]\nG1 X#1", "is a number that no control reads"),
    ],
)
def test_hostile_lines_end_in_one_line(lines: str, said: str | None) -> None:
    text = HEAD + lines + "\nM30\n"
    if said is None:
        interpret(text)
        return
    with pytest.raises(ProgramError, match=rf"^line \d+: .*({said})"):
        interpret(text)


@pytest.mark.parametrize(
    "lines",
    ["#1=0\nO1 while [1]\n#1=[#1+1]\nO1 endwhile", "M98 P9 L99999999\nM2\nO9\n#1=1\nM99", "O1 do\nO1 while [1]", "O1 repeat [99999999]\nO1 endrepeat"],
)  # fmt: skip
def test_endless_programs_end(lines: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mechwright_cam.controls.reading.macros.MOST_LINES", 20_000)
    with pytest.raises(
        ProgramError, match=r"^line \d+: more than 20000 lines are run; does a loop not end\?"
    ):
        interpret(HEAD + lines + "\nM30\n")
