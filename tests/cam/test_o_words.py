"""O-words that LinuxCNC refuses: labels used twice, ends of nothing, words behind them."""

from contextlib import suppress
from pathlib import Path

import pytest
from by_control import interpret
from rs274 import needs_rs274, run_rs274

from mechwright.errors import ProgramError
from mechwright_cam.controls.reading.o_words import OWords

HEAD = "G21 G90 G17 G40 G91.1 G94\nG0 X1 Y1 Z5\n"
REFUSED = {
    "o1 endif": "line 3: O1 has no if",
    "o1 if [1]\no2 endif\no1 endif": "line 4: O2 has no if",
    "o1 endif [1]": "line 3: '\\[1]' stands behind O1 endif",
    "o1 else [1]\no1 endif": "line 3: '\\[1]' stands behind O1 else",
    "o1 do [1]\no1 while [0]": "line 3: '\\[1]' stands behind O1 do",
    "o1 sub [1]\no1 endsub": "line 3: '\\[1]' stands behind O1 sub",
    "o1 repeat [1]\no1 endrepeat [1]": "line 4: '\\[1]' stands behind O1 endrepeat",
    "o1 while [1]\no1 break [1]\no1 endwhile": "line 4: '\\[1]' stands behind O1 break",
    "o1 if [1] G1 X1": "line 3: 'g1x1' stands behind the value",
    "o1 while [0] X1\no1 endwhile": "line 3: 'x1' stands behind the value",
    "o1 repeat [1] X1\no1 endrepeat": "line 3: 'x1' stands behind the value",
    "o1 sub\no1 return [1] X\no1 endsub\no1 call": "line 4: 'x' stands behind the value",
    "o1 if [1]\no1 endif\no1 if [1]\no1 endif": "line 5: O1 begins something in line 3 already",
    "o1 while [0]\no1 endwhile\no1 while [0]\no1 endwhile": "line 5: O1 begins something in line 3 already",
    "o1 if [1]\no1 endif\no1 while [0]\no1 endwhile": "line 5: O1 begins something in line 3 already",
    "o1 repeat [1]\no1 endrepeat\no1 repeat [1]\no1 endrepeat": "line 5: O1 begins something in line 3 already",
    "o1 sub\no1 endsub\no1 sub\no1 endsub": "line 5: O1 begins something in line 3 already",
    "o1 if [0]\no1 if [1]\no1 endif\no1 endif": "line 3: O1 begins something in line 4 as well",
    "o1 repeat [2]\no1 break\no1 endrepeat": "line 4: O1 break stands in no while or do",
    "o1 repeat [2]\no1 continue\no1 endrepeat": "line 4: O1 continue stands in no while or do",
}
TAKEN = (
    "o1 sub\no9 if [1]\no9 endif\no1 endsub\no2 sub\no9 if [1]\no9 endif\no2 endsub\no1 call\no2 call",
    "o1 sub\no9 if [1]\no9 endif\no1 endsub\no9 if [1]\no9 endif\no1 call",
    "o1 sub\no1 endsub\no1 if [1]\no1 endif",
    "o1 if [1] (yes)\no1 endif (end)",
    "o1 if [0]\no1 elseif [1]\no1 else\no1 endif",
    "o1 sub\no1 return [1]\no1 endsub [2]\no1 call",
    "#1=0\no1 do\n#1=[#1+1]\no1 while [#1 lt 3]",
    "o1 while [1]\no1 break\no1 endwhile",
)


@pytest.mark.parametrize(("lines", "reason"), REFUSED.items())
def test_what_linuxcnc_refuses_of_labels(lines: str, reason: str) -> None:
    with pytest.raises(ProgramError, match=f"^{reason}"):
        interpret(f"{HEAD}{lines}\nG0 X2\nM2\n")


@pytest.mark.parametrize("lines", TAKEN)
def test_labels_as_linuxcnc_takes_them(lines: str) -> None:
    assert interpret(f"{HEAD}{lines}\nG0 X2\nM2\n").end[-1, 0] == 2


@needs_rs274
@pytest.mark.parametrize(
    ("lines", "taken"), [*((one, False) for one in REFUSED), *((one, True) for one in TAKEN)]
)
def test_linuxcnc_says_the_same_of_labels(lines: str, taken: bool, tmp_path: Path) -> None:
    assert run_rs274(f"{HEAD}{lines}\nG0 X2\nM2\n", tmp_path).ok == taken


@pytest.mark.parametrize(
    "body",
    [
        ["o1 sub", *["(on)"] * 500, "o1 endsub"],  # passed, and never called
        ["o2 if [1]", "#1 = 2", *["o2 elseif [1]"] * 500, "o2 endif"],
        ["o2 while [1]", *["o2 continue", "o2 break"] * 250, "o2 endwhile"],
        ["o2 while [1]", "o2 break", *["(on)"] * 500, "o2 endwhile"],
    ],
)
def test_where_structures_end_is_looked_for_once(body: list[str], monkeypatch: pytest.MonkeyPatch) -> None:
    """However often a loop passes them, and whatever stands between."""
    looked: list[int] = []
    find = OWords._find

    def counted(self: OWords, index: int, wanted: frozenset[str]) -> int:
        looked.append(index)
        return find(self, index, wanted)

    monkeypatch.setattr(OWords, "_find", counted)
    monkeypatch.setattr("mechwright_cam.controls.reading.macros.MOST_LINES", 5_000)
    with suppress(ProgramError):
        interpret("\n".join(["o9 repeat [1000]", *body, "o9 endrepeat", "M2"]))
    assert len(looked) == len(set(looked))


def test_every_branch_that_is_asked_is_a_line_that_is_run(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mechwright_cam.controls.reading.macros.MOST_LINES", 5_000)
    body = ["o2 if [0]", *["o2 elseif [0]"] * 500, "o2 endif"]
    with pytest.raises(ProgramError, match="more than 5000 lines are run"):
        interpret("\n".join(["o9 repeat [20]", *body, "o9 endrepeat", "M2"]))


def test_subroutines_may_name_their_branches_alike() -> None:
    body = ["o1 if [#1 gt 1]", "G1 X#1", "o1 else", "G1 X-1", "o1 endif"]
    text = ["o7 sub", *body, "o7 endsub", "o8 sub", *body, "o8 endsub", "G0 X0 Y0 Z5", "F100"]
    run = interpret("\n".join([*text, "o8 call [5]", "o7 call [1]", "M2"]))
    assert run.end[:, 0].tolist()[1:3] == [5, -1]
    with pytest.raises(ProgramError, match="line 3: O1 begins something in line 1 already"):
        interpret("o1 if [1]\no1 endif\no1 if [1]\no1 endif\nM2")
    with pytest.raises(ProgramError, match="line 3: O7 begins something in line 1 already"):
        interpret("o7 sub\no7 endsub\no7 sub\no7 endsub\nM2")


@pytest.mark.parametrize(("end", "good"), [("G40", False), ("g 040", False), ("G40\nG0 X40 Y40", True)])
def test_a_subroutine_ends_behind_g40_only_once_the_tool_has_left_the_contour(end: str, good: bool) -> None:
    """Where the tool stands then, LinuxCNC decides by what it has queued; so the line of the end is refused."""
    body = f"O1 sub\nG0 X0 Y0 Z5\nG41.1 D6 G1 X10 Y5 F500\nG1 X30\nG0 Z5\n{end}\nO1 endsub\n"
    program = f"{HEAD}{body}T1 M6\nS1000 M3\nO1 call\nG0 X50 Y50\nM2\n"
    if good:
        assert interpret(program).ended
    else:
        with pytest.raises(ProgramError, match="line 9: a subroutine ends between G40 and the next move"):
            interpret(program)
