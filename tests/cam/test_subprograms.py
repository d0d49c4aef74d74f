"""M98 and M99, O numbers and calls, arcs at the limit: LinuxCNC's interpreter reads and refuses the same."""

import tempfile
from pathlib import Path

import numpy as np
import pytest
from by_control import BY_NAME, interpret
from rs274 import needs_rs274, run_rs274
from test_samples import TABLE, ours

from mechwright.errors import ProgramError
from mechwright_cam.controls.reading import Kind

HEAD = "G17 G21 G40 G90 G94\nG0 X0 Y0 Z5\nF100\n"


def ends(text: str) -> list[list[float]]:
    run = interpret(text, start=(0.0, 0.0, 0.0))
    return run.end[run.kind == Kind.FEED].tolist()


def alike(text: str) -> None:
    """Both go to the same places."""
    with tempfile.TemporaryDirectory() as folder:
        canon = run_rs274(text, Path(folder), TABLE)
    assert canon.ok, canon.error
    theirs = canon.ends[np.abs(np.diff(canon.ends, axis=0, prepend=np.zeros((1, 3)))).max(axis=1) > 1e-4]
    found = ours(interpret(text, start=(0.0, 0.0, 0.0)))[1:]
    scale = 25.4 if "G20" in text else 1.0
    np.testing.assert_allclose(found, theirs * scale, atol=1.1e-4 * scale, rtol=0)


SUBS = {
    "called, and three times": "M98 P7\nM98 P7 L3\nM2\nO7\nG91 G1 X1 Y2\nG90\nM99\n",
    "called no time": "G1 X3\nM98 P7 L0\nM2\nO7\nG1 X9\nM99\n",
    "zeros before a number": "M98 P0007\nM2\nO07\nG1 X1\nM99\n",
    "a line number and another order": "N5 m98 l2 p7\nN6 M2\nO7\nG91 G1 X1\nM99\n",
    "one inside of another": "M98 P1 L2\nM2\nO1\nG91 G1 X1\nM98 P2 L2\nM99\nO2\nG91 G1 Y1\nM99\n",
    "the caller's parameters": "#1=2\nM98 P7\nG1 X#1\nM2\nO7\n#1=[#1+3]\nM99\n",
    "the number worked out": "#5=3\nM98 P[#5+4]\nM2\nO7\nG1 X1\nM99\n",
    "both kinds": "M98 P7\nO8 call [4]\nM2\nO7\nG1 X1\nM99\nO8 sub\nG1 X#1\nO8 endsub\n",
    "a label worked out": "O8 sub\nG1 X#1\nO8 endsub\n#<n>=8\nO#<n> call [5]\nO[4*2] call [6]\nM2\n",
    "what a call gives": "O8 sub\nO8 endsub [7]\nO9 sub\nO9 endsub\nO8 call\nG1 X#<_value>\nO9 call\nG1 Y#<_value>\nM2\n",
    "a program with a number": "O1\nG1 X1\nM2\n",
}


@needs_rs274
@pytest.mark.parametrize("name", SUBS)
def test_subprograms_are_read_as_linuxcnc_does(name: str) -> None:
    alike(HEAD + SUBS[name])


def test_the_places_of_a_repeated_subprogram() -> None:
    assert ends(HEAD + SUBS["called, and three times"])[-1] == [4.0, 8.0, 5.0]
    assert ends(HEAD + SUBS["one inside of another"])[-1] == [2.0, 4.0, 5.0]
    assert ends(HEAD + SUBS["the caller's parameters"]) == [[5.0, 0.0, 5.0]]


@pytest.mark.parametrize(
    ("lines", "said"),
    [
        ("M98 L2\nM2", "line 4: M98 without the number of a subroutine"),
        ("M98 P3\nM2", "line 4: there is no subroutine 3 in this file"),
        ("M98 P3 X5\nM2\nO3\nM99", "line 4: M98 has P and L only"),
        ("M98 P1.5\nM2", "line 4: 1.5 is no whole number"),
        ("O3 call\nM2\nO3\nG1 X1\nM99", "line 4: there is no subroutine 3"),
        ("M98 P3\nM2\nO3 sub\nG1 X1\nO3 endsub", "line 4: there is no subroutine 3"),
        ("M98 P3\nM2\nO3\nG1 X1\nO3 endsub", "line 8: O sub is called by call and ends with endsub"),
        ("O3 sub\nG1 X1\nM99\nO3 endsub\nO3 call\nM2", "line 6: O sub is called by call"),
        ("G1 X1\nM99", "line 5: M99 in the main program begins it again, without end"),
        ("O1\nG1 X1\nM98 P1\nM2", "line .*nested more than 10 deep"),
        ("O3 sub\nO4 sub\nO4 endsub\nO3 endsub\nM2", "line 4: a subroutine is defined inside of O3"),
        ("%\nG1 X1\nO3 call\nM2", "line 4: a % without one in the first line"),
    ],
)
@needs_rs274
def test_subprograms_that_both_refuse(lines: str, said: str) -> None:
    with pytest.raises(ProgramError, match=f"^{said}"):
        interpret(f"{HEAD}{lines}\n", start=(0.0, 0.0, 0.0))
    if "M99 in" not in said and "P and L only" not in said:  # to rs274 M99 is an end there, and X nothing
        with tempfile.TemporaryDirectory() as folder:
            assert not run_rs274(f"{HEAD}{lines}\n", Path(folder), TABLE).ok


def test_what_stands_behind_the_closing_percent_is_no_part_of_the_program() -> None:
    with pytest.raises(ProgramError, match=r"^line 5: there is no subroutine 3"):
        interpret(f"%\n{HEAD}O3 call\nM2\n%\nO3 sub\nG1 X1\nO3 endsub\n", start=(0.0, 0.0, 0.0))


ARCS = (
    *("G2 X10 Y0 R4.9995", "G2 X10 Y0 R-4.9995", "G20 G2 X10 Y0 R4.99996", "G20\nG2 X10 Y0 I5.0015"),
    *("G20\nG2 X2 Y0 I1.0013", "G2 X1999 Y0 I1000", "G2 X0 Y0 I0.002", "G2 X10 Y0 I5.01 J0 P2"),
)
BAD_ARCS = (
    *(
        "G2 X10 Y0 R4.9985",
        "G20 G2 X10 Y0 R4.99994",
        "G2 X10 Y0 I5.02",
        "G2 X0 Y0 I0.001",
        "G2 X100 Y0 I50.06",
    ),
    *("G2 X6000 Y0 I3001.42", "G20\nG2 X2 Y0 I1.0015", "G2 X10 Y0 I5 J0 P0", "G2 X0 Y0.001 J0.0005"),
)


@needs_rs274
@pytest.mark.parametrize("arc", ARCS)
def test_arcs_that_linuxcnc_draws_are_read(arc: str) -> None:
    interpret(f"{HEAD}{arc}\nM2\n", start=(0.0, 0.0, 0.0))
    with tempfile.TemporaryDirectory() as folder:
        assert run_rs274(f"{HEAD}{arc}\nM2\n", Path(folder), TABLE).ok


@needs_rs274
@pytest.mark.parametrize("arc", BAD_ARCS)
def test_arcs_that_linuxcnc_refuses(arc: str) -> None:
    with pytest.raises(ProgramError, match=rf"^line {3 + len(arc.splitlines())}: "):
        interpret(f"{HEAD}{arc}\nM2\n", start=(0.0, 0.0, 0.0))
    with tempfile.TemporaryDirectory() as folder:
        assert not run_rs274(f"{HEAD}{arc}\nM2\n", Path(folder), TABLE).ok


def test_fanuc_turns_compensation_on_along_a_line() -> None:
    text = "G17 G21 G40 G90 G54 F100.\nG0 X-9. Y0. Z5.\nG41 D1\nG2 X0. Y0. I4.5 J0.\nG40\nG1 Y9.\nM30\n"
    with pytest.raises(
        ProgramError, match=r"^line 4: compensation is turned on along an arc; enter on a line"
    ):
        interpret(text, BY_NAME["fanuc"], start=(0.0, 0.0, 0.0), diameters={1: 2.0})
    interpret(text, start=(0.0, 0.0, 0.0), diameters={1: 2.0})
