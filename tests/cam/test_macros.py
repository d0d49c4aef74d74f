"""Parameters, expressions, O-words and polar coordinates: against their mathematics, and against rs274."""

import math

import numpy as np
import pytest
from by_control import BY_NAME, CONTROLS, interpret
from hypothesis import given, settings
from hypothesis import strategies as st
from rs274 import needs_rs274, run_rs274
from test_rs274 import distinct

from mechwright.errors import ProgramError
from mechwright_cam.controls.reading.expressions import Reader

ZERO = (0.0, 0.0, 0.0)


def value(text: str) -> float:
    def none(name: object) -> float:
        raise ValueError(f"{name} has no value")

    return Reader(text.replace(" ", "").lower(), none).real()


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("[1 + 2 * 3]", 7.0),
        ("[2 ** 3 * 2]", 16.0),
        ("[10 - 4 - 3]", 3.0),
        *(("[-7 MOD 3]", 2.0), ("[7 MOD -3]", 1.0), ("[-7 MOD -3]", 2.0), ("[6 MOD -3]", 0.0)),
        ("[1 LT 2 AND 3 GE 3]", 1.0),
        ("[1 EQ 2 OR 2 NE 2]", 0.0),
        ("[1 XOR 1]", 0.0),
        ("SIN[30]", 0.5),
        ("ATAN[1]/[-1]", 135.0),
        ("ROUND[-2.5]", -3.0),
        ("FIX[-2.5]", -3.0),
        ("FUP[-2.5]", -2.0),
        ("SQRT[ABS[-16]]", 4.0),
        ("LN[EXP[2]]", 2.0),
        ("ACOS[0.5]", 60.0),
        ("-[3]", -3.0),
        ("[[1+2]*[3-1]]", 6.0),
    ],
)
def test_expressions(text: str, expected: float) -> None:
    assert value(text) == pytest.approx(expected)


@given(st.floats(-50, 50), st.floats(-50, 50), st.floats(0.5, 9))
def test_identities(a: float, b: float, c: float) -> None:
    a, b, c = (round(x, 6) for x in (a, b, c))
    assert value(f"[{a:f} + {b:f} - {b:f}]") == pytest.approx(a, abs=1e-9)
    assert value(f"[SIN[{a:f}] ** 2 + COS[{a:f}] ** 2]") == pytest.approx(1)
    assert value(f"[[{a:f} / {c:f}] * {c:f}]") == pytest.approx(a, abs=1e-6)
    assert value(f"[{a:f} LT {b:f}]") + value(f"[{a:f} GE {b:f}]") == 1


PROGRAMS = {
    "loop": "#1 = 0\nO10 while [#1 LT 5]\nG1 X[#1 * 2] Y#1 F100\n#1 = [#1 + 1]\nO10 endwhile\n",
    "do": "#1 = 0\nO10 do\nG1 X#1 F100\n#1 = [#1 + 1]\nO10 while [#1 LT 3]\n",
    "repeat": "O20 repeat [4]\nG91 G1 X1 Y-0.5 F50\nO20 endrepeat\nG90\n",
    "branch": "#2 = 7\nO1 if [#2 LT 5]\nG1 X1 F9\nO1 elseif [#2 LT 8]\nG1 X2 F9\nO1 else\nG1 X3 F9\nO1 endif\n",
    "nested": "O1 repeat [3]\nO2 repeat [2]\nG91 G1 X1 F9\nO2 endrepeat\nG1 Y1\nO1 endrepeat\nG90\n",
    "break": "#1=0\nO1 while [1]\n#1=[#1+1]\nO2 if [#1 EQ 3]\nO1 continue\nO2 endif\nO3 if [#1 GT 5]\nO1 break\n"
    "O3 endif\nG1 X#1 F9\nO1 endwhile\n",
    "sub": "O100 sub\n#<r> = #1\nG1 X#<r> Y#2 F90\nO100 endsub [#1 + #2]\n#1 = 40\nO100 call [3] [4]\n"
    "G1 X#1 Y#<_value>\n",
    "named sub": "O<hole> sub\nG0 X#1\nO5 if [#1 GT 3]\nO<hole> return\nO5 endif\nG1 Z-1 F9\nG0 Z5\nO<hole> endsub\n"
    "O<hole> call [2]\nO<hole> call [9]\n",
    "recursion": "O9 sub\nO8 if [#1 GT 0]\nG1 X#1 F9\nO9 call [#1 - 1]\nG1 Y#1\nO8 endif\nO9 endsub\nO9 call [4]\n",
    "late": "#3 = 1\n#3 = 6 G1 X#3 F9\nG1 Y#3\n",
    "indirect": "#5 = 6\n#6 = 2.5\nG1 X##5 F9\n",
    "polar": "G0 X5 Y0\nG1 @10 ^30 F99\n^120\n@4\nG91 ^15\n@-1 ^10\nG90 G1 X0\n",
    "place": "G1 X3 Y4 F9\nG1 X[#5420 + 1] Y[#<_y> * 2]\n",
}


@needs_rs274
@pytest.mark.parametrize("name", PROGRAMS)
def test_linuxcnc_runs_them_alike(name: str, tmp_path) -> None:
    text = f"G17 G21 G40 G90 G94\nG0 X0 Y0 Z0\n{PROGRAMS[name]}M2\n"
    canon = run_rs274(text, tmp_path)
    assert canon.ok, canon.error
    ours = interpret(text, start=ZERO)
    moved = ours.end[ours.kind <= 2]
    assert len(moved) > 1
    np.testing.assert_allclose(distinct(moved), distinct(canon.ends), atol=1.1e-4)


@pytest.mark.parametrize(
    ("line", "told", "place"),
    [
        ("G0 X[1 + 1] (here)", ["here"], 2.0),
        ("G0 X[1 + 1] ; here", ["here"], 2.0),
        ("G0 X#1 (one)Z[#1 + 1](two)", ["one", "two"], 5.0),
        ("#1 = 4 (set alone)", ["set alone"], 0.0),
        ("G0 X[#1 - 1] M8", [], 4.0),
        ("N7 X-[#1] (only words of places)", ["only words of places"], -5.0),
    ],
)
def test_comments_beside_values_are_remarks_of_their_line(line: str, told: list[str], place: float) -> None:
    run = interpret(f"G21 G90\n#1 = 5\nG0 X0\n{line}\nG0 Y1\nM2")
    assert [(one.line, one.text.strip()) for one in run.remarks] == [(4, text) for text in told]
    assert run.end[run.line == 5][-1][0] == place


@given(st.lists(st.floats(-40, 40), min_size=1, max_size=6), st.integers(0, 5))
@settings(max_examples=40)
def test_a_loop_over_parameters(values: list[float], times: int) -> None:
    lines = [f"#{100 + i} = {v:.6f}" for i, v in enumerate(values)]
    text = "\n".join(
        [
            "G21 G90 G17 F100",
            *lines,
            f"O1 repeat [{times}]",
            "#1 = 0",
            f"O2 while [#1 LT {len(values)}]",
            "G1 X#[100 + #1]",
            "#1 = [#1 + 1]",
            "O2 endwhile",
            "O1 endrepeat",
            "M2",
        ]
    )
    run = interpret(text, start=ZERO)
    expected = [round(v, 6) for v in values] * times
    assert run.end[run.cutting][:, 0].tolist() == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize(
    ("lines", "said"),
    [
        ("G1 X[1 + F9", "no value at|] expected"),
        ("G1 X[1/0] F9", "has no value"),
        ("G0 X#<nothing>", "#<nothing> has no value"),
        ("G0 X#5220", "is kept by the machine"),
        ("#1.5 = 3", "no whole number"),
        ("#1 3", "= expected"),
        ("O1 call", "there is no subroutine 1 in this file"),
        ("O1 sub", "has no endsub"),
        ("O1 endwhile", "has no while"),
        ("O1 if [0]", "has no else or elseif or endif"),
        ("O1 endsub", "was not called"),
        ("O1 while [0]", "has no endwhile"),
        ("G0 @5 X3 ^3", "beside X or Y"),
        ("G0 X0 Y0\nG1 ^30 F9", "without a direction"),
        ("G0 X[SQRT[-1]]", "math domain|value"),
        ("G0 X" + "[" * 50 + "1" + "]" * 50, "nested more than 40 deep"),
    ],
)
def test_mistakes_name_their_line(lines: str, said: str) -> None:
    text = "G21 G90 G17\n" + lines
    with pytest.raises(ProgramError, match=rf"^line {text.count(chr(10)) + 1}: .*({said})") as caught:
        interpret(text, start=ZERO)
    assert "\n" not in str(caught.value)


def test_an_endless_loop_and_an_endless_descent_end(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mechwright_cam.controls.reading.macros.MOST_LINES", 5_000)
    with pytest.raises(ProgramError, match="nested more than 10 deep"):
        interpret("O1 sub\nO1 call\nO1 endsub\nO1 call\nM2")
    with pytest.raises(ProgramError, match="does a loop not end"):
        interpret("O1 while [1]\n#1 = 2\nO1 endwhile\nM2")


def test_a_place_that_nothing_stated_has_no_value() -> None:
    with pytest.raises(ProgramError, match="does not say where the tool is"):
        interpret("G21 G90\nG0 X[#5420 + 1]")


@pytest.mark.parametrize("control", [name for name in CONTROLS if name != "linuxcnc"])
@pytest.mark.parametrize("line", ["G0 X#5", "G0 X[1+2]", "#1=5", "O<one> SUB"])
def test_other_controls_programs_are_read_without_macros(control: str, line: str) -> None:
    with pytest.raises(ProgramError, match=r"^line 2: .*(O-words|starts no word)"):
        interpret("G21\n" + line, BY_NAME[control])


def test_the_angle_of_polar_coordinates() -> None:
    run = interpret("G21 G90 G17\nG0 X7 Y0\nG1 @10 ^30 F9\nM2", start=ZERO)
    assert run.end[run.cutting][0, :2] == pytest.approx(
        [10 * math.cos(math.pi / 6), 10 * math.sin(math.pi / 6)]
    )
