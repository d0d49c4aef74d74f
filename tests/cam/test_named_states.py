"""Programs once proven that would crash, one by one on each control: moves nobody sees, offsets, paths, text.

Each is a proven program with one thing put into it, proven whole, and refused in that line for that reason.
:mod:`test_named_cuts` has those that cut what they should not, and what was told wrongly.
"""

import re
from pathlib import Path

import pytest
from by_control import BY_NAME, CONTROLS, EVERY, prove
from by_night import by_night, thinned
from klartext_blocks import anew
from machine_programs import job_of, text_of

from mechwright.cli.hosting import open_host
from mechwright.errors import ProgramError
from mechwright.pipeline import Build, Wanted
from mechwright_cam.machining import Machining
from mechwright_cam.setup.job import Job

ROOT = Path(__file__).parents[2]


def reasons(text: str, job: Job, control: str) -> dict[str, tuple[int | None, str]]:
    """Why a program is refused: by rule, or ``reading``, the line and the message; empty if it is proven."""
    try:
        proof = prove(text, job, BY_NAME[control])
    except ProgramError as error:
        said = re.match(r"line (\d+): ", str(error))
        return {"reading": (int(said[1]) if said else None, str(error))}
    return {check.name: (check.line, check.message) for check in proof.failures}


def blamed(found: dict[str, tuple[int | None, str]], rule: str, line: int, word: str) -> None:
    """A rule names the line; or an arc behind it, which cannot be read, names the word and the line."""
    if "reading" in found:
        since = rf"from an unknown position, unknown since (?:{word} in )?line {line}; move to "
        assert re.search(since, found["reading"][1])
    else:
        assert found[rule][0] == line


def put(text: str, at: int, words: str) -> tuple[str, int]:
    """The program with lines in front of one, counted from 0, and the number of the last of them."""
    lines = text.splitlines()
    return anew("\n".join([*lines[:at], words, *lines[at:]]) + "\n"), at + 1 + words.count("\n")


def in_the_cut(text: str) -> int:
    return next(k for k, line in enumerate(text.splitlines()) if "Z-4.8" in line) + 1


def before_the_last_retract(text: str) -> int:
    return max(k for k, line in enumerate(text.splitlines()) if re.fullmatch(r"(?:\d+ )?M5", line)) + 1


def at_the_end(text: str) -> int:
    return max(k for k, line in enumerate(text.splitlines()) if re.fullmatch(r"(?:\d+ )?M30", line))


INSIDE = {"in the cut": (in_the_cut, "Z-4.8"), "at the clearance plane": (before_the_last_retract, "Z5")}
"""Places where X and Y pass what stands on the table, and the height there."""


# -- class 1: moves to places that the work does not know ---------------------------------------------------

HOME = {
    "G53 G0 X0. Y0.": CONTROLS,
    "G53 G0 X0. Y0. Z0.": CONTROLS,
    "G28": tuple(control for control in CONTROLS if control != "fanuc"),
    "G28 X0. Y0.": CONTROLS,
    "G91 G28 X0. Y0. Z0.": CONTROLS,
    "G0 SUPA X0 Y0": ("siemens-840d",),
    "G0 SUPA X0 Y0 Z0": ("siemens-840d",),
    "L X+0 Y+0 R0 FMAX M91": ("heidenhain-tnc",),
    "L X+0 Y+0 Z+0 R0 FMAX M91": ("heidenhain-tnc",),
}


@pytest.mark.parametrize(
    ("case", "place"), thinned(3, [(w, c) for w, controls in HOME.items() for c in controls], INSIDE)
)
def test_a_move_to_the_machine_s_own_places_is_not_made_inside_of_the_work(
    case: tuple[str, str], place: str
) -> None:
    words, control = case
    find, height = INSIDE[place]
    text, line = put(text_of(control), find(text_of(control)), words)
    text = text.replace(words + "\n", f"{words}\nG90\n") if "G91" in words else text
    found = reasons(text, job_of(control), control)
    if control == "siemens-840d":  # the length of the tool is still in force
        assert found["reading"][0] == line
        assert "SUPA counts the tool's length in" in found["reading"][1]
        return
    blamed(found, "machine-moves", line, "G28" if "G28" in words else "G53")
    if "reading" not in found:
        assert f"while Z is at {height}" in found["machine-moves"][1]


@pytest.mark.parametrize(("words", "control"), [(w, c) for w, controls in HOME.items() for c in controls])
def test_with_the_tool_up_it_is(words: str, control: str) -> None:
    text, _ = put(text_of(control), at_the_end(text_of(control)), words + ("\nG90" if "G91" in words else ""))
    assert reasons(text, job_of(control), control) == {}


def test_fanuc_goes_nowhere_by_g28_alone() -> None:
    text, line = put(text_of("fanuc"), in_the_cut(text_of("fanuc")), "G28")
    found = reasons(text, job_of("fanuc"), "fanuc")
    assert found["reading"] == (line, f"line {line}: G28 without an axis sends none home; write G91 G28 Z0")


@pytest.mark.parametrize("words", ["G74 X1=0 Y1=0", "G53 G0 X0 Y0", "G75 X1=0", "G153 G0 X0 Y0"])
def test_siemens_own_words_for_it_are_refused_by_name(words: str) -> None:
    text, line = put(text_of("siemens-840d"), before_the_last_retract(text_of("siemens-840d")), words)
    assert reasons(text, job_of("siemens-840d"), "siemens-840d")["reading"][0] == line


@by_night
@pytest.mark.parametrize("words", ["G53 G0 X0 Y0", "G28", "G53 G0 X0 Y0 Z0", "G91 G28 X0. Y0. Z0.\nG90"])
def test_in_the_elliptic_gear_neither(words: str) -> None:
    with Build(ROOT / "examples" / "elliptic-pair.toml", open_host(), Wanted("verify")) as build:
        (one, *_) = build.made(Machining).proven_programs
    text, line = put(one.text, before_the_last_retract(one.text), words)
    found = reasons(text, one.job, "linuxcnc")
    assert found["machine-moves"][0] == line - words.count("\n")
    text, _ = put(one.text, at_the_end(one.text), words)
    assert reasons(text, one.job, "linuxcnc") == {}


# -- class 3: what a program writes into the control --------------------------------------------------------

TABLES = (
    *("G10 L1 P3 R3.1", "G10 L1 P3 Z50.", "G10 L2 P1 X10.", "G10 L2 P1 R45.", "G10 L2 P1 X0. Y0. R5."),
    *("G10 L10 P3 Z50.", "G10 L10 P3 R50.", "G10 L11 P3 Z77.", "G10 L11 P3 R77.", "G10 L12 P3 R3.1"),
    *("G10 L20 P1 X0. Y0. Z0.", "G10 L2 P0 X10.", "G10 L20 P0 Z0.", "G10 L2 P1 Z-400."),
)
WRITES = ("#5221=10", "#5221 = 10", "#5403=1", "#5161=1", "#5220=2", "#0=1", "#5241=10.")
OWN_WRITES = {
    "siemens-840d": (
        "$P_UIFR[1,X,TR]=10",
        "$TC_DP6[3,1]=3.1",
        "$TC_DP3[3,1]=50",
        "R1=5",
        "$P_PFRAME=CTRANS(X,5)",
    ),
    "heidenhain-tnc": (
        "Q1 = +5",
        "FN 0: Q1 = +5",
        "CYCL DEF 7.0 DATUM SHIFT",
        "FN 17: SYSWRITE ID 530 NR2 = +5",
    ),
}
"""Controls with words of their own for it."""


@pytest.mark.parametrize(
    ("control", "words", "place"), thinned(5, CONTROLS, TABLES, ["in the cut", "at the end"])
)
def test_a_table_is_written_with_the_job_s_own_values_alone(control: str, words: str, place: str) -> None:
    find = in_the_cut if place == "in the cut" else at_the_end
    text, line = put(text_of(control), find(text_of(control)), words)
    found = reasons(text, job_of(control), control)
    at, said = found.get("reading", (None, ""))
    if at == line:  # this control has no such table, place or value
        assert re.match(rf"line {line}: (?:G10 L\d+[ :]|[A-Z] means nothing in this line)", said)
        return
    blamed(found, "offset-tables", line, "G10")
    if place == "at the end":
        assert list(found) == ["offset-tables"]
        assert "take it out" in found["offset-tables"][1] or "is not given" in found["offset-tables"][1]


@pytest.mark.parametrize("place", ["in the cut", "at the end"])
@pytest.mark.parametrize("control", EVERY)
def test_parameters_of_the_machine_are_not_written(control: str, place: str) -> None:
    find = in_the_cut if place == "in the cut" else at_the_end
    for words in OWN_WRITES.get(control, WRITES):
        text, line = put(text_of(control), find(text_of(control)), words)
        found = reasons(text, job_of(control), control)
        assert found.keys() <= {"reading", "offset-tables"}, (words, found)
        assert [one[0] for one in found.values()] == [line], (words, found)


# -- class 4: paths that nothing bounds ---------------------------------------------------------------------

OWN = "G64 P0.002 Q0\n"


@pytest.mark.parametrize(
    ("words", "why"),
    [
        ("G64 P2\n", "LinuxCNC may leave the path by 4 mm"),
        ("G64 P0.5 Q0.5\n", "LinuxCNC may leave the path by 1 mm"),
        ("G64\n", "nothing bounds how far LinuxCNC leaves the path at corners"),
        ("", "nothing bounds how far LinuxCNC leaves the path at corners"),
    ],
)
def test_a_path_that_nothing_bounds_is_none(words: str, why: str) -> None:
    assert reasons(text_of("linuxcnc"), job_of("linuxcnc"), "linuxcnc") == {}
    text = text_of("linuxcnc").replace(OWN, words)
    line, message = reasons(text, job_of("linuxcnc"), "linuxcnc")["path-tolerance"]
    first = next(k for k, one in enumerate(text.splitlines(), 1) if re.match(r"G0 X", one))
    assert line is not None
    assert line >= first
    assert why in message


@pytest.mark.parametrize("control", [c for c in EVERY if c != "linuxcnc"])
@pytest.mark.parametrize("words", ["G64 P2", "G64 P0.5 Q0.5"])
def test_elsewhere_no_word_loosens_it(control: str, words: str) -> None:
    text, line = put(text_of(control), in_the_cut(text_of(control)), words)
    assert reasons(text, job_of(control), control)["reading"][0] == line


# -- class 6: text that no control reads --------------------------------------------------------------------

NO_TEXT = {
    "fullwidth digits": "G1 X\uff11\uff10",
    "Arabic digits": "G1 X\u0661\u0660",
    "a no-break space": "G1\u00a0X1.",
    "a dotless i": "G2 X1. Y1. \u01310.5 J0.",
    "a long s": "\u017f8000 M3",
    "a form feed": "G1 X1.\x0cY1.",
    "a stray percent sign": "%",
    "a negative line number": "N-5 G1 X1.",
}
RUN = {"a comment that runs Python": ";py,x=1", "a comment that opens a file": "(LOGOPEN,out.txt)"}


@pytest.mark.parametrize(("control", "name"), thinned(2, EVERY, NO_TEXT))
def test_text_that_no_control_reads(control: str, name: str) -> None:
    text, line = put(text_of(control), in_the_cut(text_of(control)), NO_TEXT[name])
    found = reasons(text, job_of(control), control)
    if name == "a stray percent sign" and control in {"fanuc", "haas"}:
        # They begin with one, and read no more behind a second: the first line there is told.
        assert found["program-end"][0] == line + 1
        return
    assert list(found) == ["reading"]
    assert found["reading"][0] == line


IN_MACHINE = {"siemens-840d": "G1 SUPA Z0 D0", "heidenhain-tnc": "L Z+0 M91"}
"""Feed moves in machine coordinates, where they are not G53 G1."""


@pytest.mark.parametrize("control", EVERY)
def test_a_feed_in_machine_coordinates_without_f(control: str) -> None:
    """Before the first F of the program; the word for machine coordinates is each control's own."""
    text = text_of(control)
    words = IN_MACHINE.get(control, "G53 G1 Z0.")
    first = re.compile(r"T1|M6 T1|\d+ TOOL CALL 1 ")
    at = next(k for k, line in enumerate(text.splitlines()) if first.match(line))
    found = reasons(*put(text, at, words)[:1], job_of(control), control)
    assert found["reading"][0] == at + 1
    assert re.search(r"feed move without a feed|SUPA|G53|M91", found["reading"][1])


@pytest.mark.parametrize("name", RUN)
def test_comments_that_linuxcnc_carries_out(name: str) -> None:
    text, line = put(text_of("linuxcnc"), in_the_cut(text_of("linuxcnc")), RUN[name])
    found = reasons(text, job_of("linuxcnc"), "linuxcnc")
    assert found["reading"][0] == line
    assert "LinuxCNC carries out the comment" in found["reading"][1]


# -- without bounds -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("control", EVERY)
@pytest.mark.parametrize(
    "words", ["T99999999999999999999", "T99999999999999999999 M6", "S99999999999999999999999 M3"]
)
def test_a_number_beyond_all_tools_is_one_line(control: str, words: str) -> None:
    text, line = put(text_of(control), at_the_end(text_of(control)), words)
    found = reasons(text, job_of(control), control)
    assert list(found) == ["reading"] or words.startswith("S")
    assert line in {one[0] for one in found.values()}
