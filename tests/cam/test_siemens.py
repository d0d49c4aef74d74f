"""SINUMERIK 840D: what its words are read as, what is refused by name, and programs with one fault."""

import re
from dataclasses import replace
from itertools import pairwise

import pytest
from by_control import BY_NAME, asked, interpret, prove
from golden_operations import made
from machine_programs import LENGTHS, PLACE, at_the_end, in_cut, job_of, judged, refused, scene_of, text_of
from test_text_refused import NOWHERE

from mechwright.contracts.finding import Severity
from mechwright.errors import ProgramError
from mechwright_cam.controls.reading import Kind
from mechwright_cam.controls.reading.sinumerik import translated
from mechwright_cam.controls.siemens_840d import Siemens840D
from mechwright_cam.machining import Machined
from mechwright_cam.pages.setup_sheet.procedure import steps
from mechwright_cam.proof.machine_moves import machine_moves
from mechwright_cam.proof.motion_rules import travel
from mechwright_cam.proof.offset_rules import offset_tables
from mechwright_cam.shop.settings import CamSettings

NAME = "siemens-840d"
SIEMENS = BY_NAME[NAME]
HEAD = "G17 G710 G40 G90 G94 COMPOF\nG64\nG0 SUPA Z0 D0\nT1\nM6\nG54 S900 M3\nG0 X0 Y0\nD1 Z5\n"
AT = HEAD.count("\n") + 1


def said(line: str, head: str = HEAD) -> str:
    """What is said of a line behind the head; nothing if it is read."""
    try:
        interpret(f"{head}{line}\nM30\n", SIEMENS)
    except ProgramError as error:
        return str(error)
    return ""


@pytest.mark.parametrize(
    ("line", "meant"),
    [
        ("N10 g0 x1.5 y-.5", "N10 G0 X1.5 Y-.5"),
        ("G1X10Y=2F90", "G1 X10 Y2 F90"),
        ("G02 X5 Y5 CR=-7.5", "G2 X5 Y5 R-7.5"),
        ("N20 G4 F1.5", "G4 P1.5"),
        ("/G60 ; slowly (here)", "/G61 ; slowly (here)"),
        ('N30 MSG("load T3; then start")', "; load T3; then start"),
        ("MSG()", ""),
        ('MSG("load T3; then start") ; by hand', "; load T3; then start"),
        ("T3 M06", "T3 M6 G49"),
        ("G0 SUPA Z-2 D0", "G0 G53 Z-2 G49"),
        ("D1 Z5", "G43 Z5"),
        ("$P_UIFR[2]=CTRANS(X,-1.5,Y,2,Z,-3)", "G10 L2 P2 X-1.5 Y2 Z-3"),
        ("G17 COMPOF G700", "G17 G20"),
    ],
)
def test_a_line_means(line: str, meant: str) -> None:
    assert " ".join(translated(line, False).split()) == meant


def test_a_program_is_read_up_to_its_end_from_an_archive_too() -> None:
    run = interpret("%_N_GEAR_MPF\n;$PATH=/_N_MPF_DIR\n" + HEAD + "G4 F2.5\nM30\nas you like it", SIEMENS)
    assert run.ended
    assert run.seconds[run.kind == Kind.DWELL].tolist() == [2.5]
    assert not run.beyond


@pytest.mark.parametrize(
    ("line", "why"),
    [
        ("G41 X5 F90", "G41 is no word that is read"),
        ("G71", "leaves feeds and offsets in other units"),
        ("G700", "G700 in a program that has begun with G710"),
        ("G53 Z0", "write SUPA"),
        ("G59 X3", "shifts or turns the work"),
        ("G505", "G505 is no word that is read"),
        ("TRANS X5", "shifts or turns the work"),
        ("G641 ADIS=0.5", "rounds corners as far as its settings let it"),
        ("CYCLE832(0.05,1)", "rounds corners as far"),
        ("COMPCAD", "puts curves through lines"),
        ("MCALL CYCLE81(5,0,1,-13)", "cycles are not read"),
        ("CYCLE83(5,0,1,-13)", "cycles are not read"),
        ("R1=5", "parameters, jumps and calls are not read"),
        ("X=R1", "X=R1 is worked out; write X with a plain number"),
        ("X=AC(5)", "X=AC(5) is worked out"),
        ("GOTOF END", "parameters, jumps and calls"),
        ("GEAR_L1 P2", "post the program without it"),
        ("M17", "parameters, jumps and calls"),
        ('T="MILL_6"', "call tools by number"),
        ("(a note)", "comments stand behind ;"),
        ("G2 X5 Y0 I2.5 J0 TURN=2 F90", "a block for each turn"),
        ("G4 F1 X5", "stands in a block of its own"),
        ("G4 S10", "stands in a block of its own"),
        ("G4 F1 F2", "stands in a block of its own"),
        ("D2 Z5", "D2 is an edge"),
        ("T1 D1 M6", "D beside M6"),
        ("G0 SUPA Z0", "SUPA counts the tool's length in"),
        (
            "$P_UIFR[1]=CTRANS(X,1,Y,2,Z,3)\nG0 X5",
            "a work offset that is written holds from its next call on",
        ),
        ("/2 G0 X5", "/2 is a level of its own"),
        ("M3=5", "M3 is no word"),
        ("S2=500 M2=3", "S2 is no word"),
        ("G1.5", "G1.5 is no whole number"),
        ("G1 X1 X2 F9", "two X words"),
        ("G0 G1 X1", "exclude each other"),
        ("G2 X5 Y5 I3 J0 F90", "arc"),
        ("CR=5", "R means nothing in this line"),
        ("NORM", "NORM is no word that is read"),
    ],
)
def test_what_is_not_modelled_is_refused_by_name_in_its_line(line: str, why: str) -> None:
    found = said(line)
    assert re.match(rf"line {AT + line.count(chr(10))}: ", found), found
    assert why in found


@pytest.mark.parametrize("line", NOWHERE)
def test_what_no_control_reads(line: str) -> None:
    assert re.match(rf"line {AT}: ", said(line)), said(line)


def test_an_arc_is_as_exact_as_the_control_wants_it() -> None:
    """0.01 mm or a thousandth of the radius, whichever is more."""
    assert not said("G2 X10 Y0.009 I5 J0 F90")
    assert "arc" in said("G2 X10.015 Y0 I5 J0 F90")
    assert not said("G2 X100.04 Y0 I50 J0 F90")


def test_lengths_hang_on_d_and_on_nothing_else() -> None:
    """D0 of a retract, and every change of tool, takes the length back."""
    one = made("drill", NAME)[0]
    assert one.text.count("\nD1 Z5\n") == 2
    first, second = one.text.rsplit("\nD1 Z5\n", 1)
    for text in (f"{first}\nZ5\n{second}", one.text.replace("\nD1 Z5\n", "\nZ5\n", 1)):
        found = asked("length-offset", text, one.job, SIEMENS)
        assert "Z is moved without a length offset" in found.message
        assert "; write D1, at " in found.message


def test_the_sheet_speaks_of_d1_and_of_no_word_of_others() -> None:
    one = made("drill", NAME)[0]
    text = "\n".join(
        line
        for step in steps(one.job, SIEMENS, [1, 7], file_names=["drill.mpf"], deepest=-5)
        for line in step.lines
    )
    assert "No length offset active: D0" in text
    assert "$P_UIFR[1,Z,TR]=N − h" in text
    assert "The program calls D1 after every tool change" in text
    assert "Reset" in text
    assert not re.search(r"G43|G49|G10|\bHn\b|G53", text)


def test_files_have_names_that_the_control_takes() -> None:
    program = made("drill", NAME)[0].program
    names = [next(iter(Siemens840D().files(replace(program, name=name)))) for name in ("a-b", "a_b", "4-bar")]
    assert names == ["P_a_b", "P_a_Ub", "P_4_bar"]


def test_what_the_control_lacks_is_found_in_the_design() -> None:
    cam = CamSettings.model_validate({"control": NAME, "work_offset": "G58", "compensation": "control"})
    found = Siemens840D().check(cam)
    assert [one.severity for one in found] == [Severity.ERROR] * 2
    assert "G54 to G57" in found[0].remedy
    assert "without cutter compensation" in found[1].message


def test_it_sets_its_own_work_offset_and_no_other() -> None:
    text, job = text_of(NAME, measured=True), job_of(NAME, measured=True)
    assert prove(text, job, SIEMENS).failures == ()
    (write,) = scene_of(NAME, text, job).run.writes
    assert write.values == {axis.upper(): value for axis, value in PLACE.items()}
    assert len(LENGTHS) == 3  # they are typed into the tool list
    for value in PLACE.values():
        wrong = text.replace(f"{value}", f"{value + 0.01:.3f}", 1)
        line = text[: text.index(f"{value}")].count("\n") + 1
        refused(offset_tables, NAME, wrong, line, job)
    other, line = at_the_end(text, "$P_UIFR[2]=CTRANS(X,-312.5,Y,-201.25,Z,-388.012)")
    assert "leaves alone" in refused(offset_tables, NAME, other, line, job).message


def test_machine_coordinates_lie_anywhere_in_the_work() -> None:
    text, line = in_cut(text_of(NAME), "G0 SUPA X0 Y0 D0")
    refused(machine_moves, NAME, text, line)
    assert judged(machine_moves, NAME, at_the_end(text_of(NAME), "G0 SUPA X0 Y0")[0]).passed
    low, line = at_the_end(text_of(NAME), "G0 SUPA Z-100")
    refused(machine_moves, NAME, low, line)


@pytest.mark.parametrize("place", ["Z300 D0", "X5000", "Y-401"])
def test_machine_coordinates_lie_within_both_ends(place: str) -> None:
    text, line = at_the_end(text_of(NAME), f"G0 SUPA {place}")
    found = refused(travel, NAME, text, line)
    assert (
        f"goes to machine {place[0]} {place[1:].removesuffix(' D0')}, and {place[0]} travels" in found.message
    )


def verdict(text: str, one: Machined) -> str:
    """What is said of a program that is refused."""
    try:
        failures = prove(text, one.job, SIEMENS).failures
    except ProgramError as error:
        return str(error)
    return "; ".join(check.message for check in failures)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        *(
            (word, "")
            for word in (" G710", " G90", " G94", "G17", " G40", " SUPA", "M3", "M8", "G54 ", "M6\n")
        ),
        *((word, "") for word in ("T23\n", "D1 ", " D0\n", "M5\n", "M30")),
        *(("G710", "G700"), ("G710", "G71"), ("G54", "G55"), ("M3", "M4"), ("M8", "M7"), ("G17", "G18")),
        *(("T23", "T24"), ("D1", "D2"), ("D1", "D0"), ("SUPA Z0", "SUPA Z-50")),
        *(("G90", "G91"), ("G94", "G95"), ("G2 ", "G3 "), ("G64", "G641 ADIS=1"), ("SUPA", "G53")),
        *(("M0\n", ""), ("S8754", "S875"), ("S8754", "S99999"), ("M30", "M0")),
    ],
)
def test_a_fault_is_refused_in_a_line(old: str, new: str) -> None:
    one = made("profile-outside", NAME)[0]
    head, code = one.text[: one.text.index("G17")], one.text[one.text.index("G17") :]
    assert old in code
    found = verdict(head + code.replace(old, new, 1), one)
    assert re.search(r"\bline \d+: ", found), found


def test_a_number_that_is_off_is_refused() -> None:
    """Places of the cuts: another one, or the point lost."""
    one = made("pocket-contour", NAME)[0]
    places = list(re.finditer(r"(?m)^(?!;).*?([XYZ])(-?\d+\.\d+)", one.text))[::7]
    assert len(places) > 5
    for match in places:
        off = f"{float(match[2]) + (-3 if match[1] == 'Z' else 30):.3f}"
        for new in (off, match[2].replace(".", "")):
            found = verdict(one.text[: match.start(2)] + new + one.text[match.end(2) :], one)
            assert re.search(r"\bline \d+: ", found), (match[0], new)


def test_lines_that_a_switch_skips_are_proven_both_ways() -> None:
    one = made("pocket-contour", NAME)[0]
    assert prove(one.text.replace("\nM9\n", "\n/; nothing\nM9\n"), one.job, SIEMENS).ok
    found = verdict(one.text.replace("\nD1 Z5\n", "\n/D1\nZ5\n", 1), one)
    assert "with lines that start with / skipped" in found


def test_the_kept_lines_are_in_the_order_that_is_safe() -> None:
    """Each change stands behind a retract; spindle, place, length and coolant follow in that order."""
    lines = [line for line in made("drill", NAME)[0].text.splitlines() if not line.startswith(";")]
    for before, line in pairwise(lines):
        if re.fullmatch(r"T\d+", line):
            assert before == "G0 SUPA Z0 D0"
            at = lines.index(line)
            kinds = [re.sub(r"[-\d.]+", "#", words) for words in lines[at : at + 6]]
            assert kinds == ["T#", "M#", "G# S# M#", "G# X# Y#", "D# Z#", "M#"]


def test_a_called_block_is_read_behind_the_end_and_a_line_as_long_as_the_control_takes() -> None:
    head = "G17 G710 G40 G90 G94 G54\nG0 X0 Y0 Z5\nG1 F100\n"
    for call in ("CALL BLOCK AB_1 TO AB_2", "N30 call block ab_1 to ab_2 ; twice"):
        run = interpret(f"{head}{call}\nX9\n{call}\nM30\nAB_1:\nX5\nX1\nAB_2:\n", SIEMENS)
        assert run.end[run.kind == Kind.FEED, 0].tolist() == [5, 1, 9, 5, 1]
    for spaces, taken in ((505, True), (506, False)):
        text = f"{head}G1 X1{' ' * spaces}Y1\nM30\n"
        assert len(text.splitlines()[3]) == 7 + spaces
        if taken:
            assert interpret(text, SIEMENS).end[-1, 1] == 1
        else:
            with pytest.raises(
                ProgramError, match=r"^line 4: 513 characters; SINUMERIK 840D reads at most 512"
            ):
                interpret(text, SIEMENS)
