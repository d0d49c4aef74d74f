"""HEIDENHAIN Klartext: what its blocks are read as, what is refused by name, and programs with one fault."""

import re
from dataclasses import replace
from itertools import pairwise

import pytest
from by_control import BY_NAME, asked, interpret, prove
from golden_operations import made
from golden_programs import every_operation
from klartext_blocks import anew, numbered
from machine_programs import job_of, text_of

from mechwright.contracts.finding import errors
from mechwright.errors import ProgramError
from mechwright_cam.controls.heidenhain_tnc import HeidenhainTnc
from mechwright_cam.controls.reading import Kind
from mechwright_cam.machining import Machined
from mechwright_cam.pages.setup_sheet.procedure import steps
from mechwright_cam.shop.settings import CamSettings

NAME = "heidenhain-tnc"
TNC = BY_NAME[NAME]
HEAD = (
    "BEGIN PGM P MM",
    "CYCL DEF 247 DATUM SETTING ~",
    "Q339=+1 ;DATUM NUMBER",
    "L Z+0 R0 FMAX M91",
    "TOOL CALL 1 Z S900",
    "M3",
    "L X+0 Y+0 R0 FMAX",
    "L Z+5 R0 FMAX",
)
AT = len(HEAD) + 1
"""The line behind the head."""


def program(*blocks: str) -> str:
    return numbered(*HEAD, *blocks, "M30", "END PGM P MM")


def meant(*blocks: str) -> list[str]:
    """What the interpreter is given for blocks behind the head."""
    return TNC.dialect.translate(program(*blocks), False).split("\n")[len(HEAD) : -3]  # type: ignore[misc]


def said(*blocks: str) -> str:
    """What is said of blocks behind the head; nothing if they are read."""
    try:
        interpret(program(*blocks), TNC)
    except ProgramError as error:
        return str(error)
    return ""


@pytest.mark.parametrize(
    ("block", "words"),
    [
        ("L X+1.5 Y-,5 R0 FMAX M3", "G0 G40 X1.5 Y-.5 M3"),
        ("l x+10 f90", "G1 X10 F90"),
        ("L Z+2,5 F MAX", "G0 Z2.5"),
        ("L Z-1 R0 FMAX M91", "G53 G0 G40 Z-1"),
        ("L M8", "M8"),
        ("L F500", "F500"),
        ("M13", "M3 M8"),
        ("M9 M5", "M9 M5"),
        ("STOP", "M0"),
        ("TOOL CALL 7 Z S12000 DL+0 DR-0.0", "T7 M6 G43 S12000 G17"),
        ("TOOL CALL 7 Z S800 F120", "T7 M6 G43 S800 F120 G17"),
        ("TOOL CALL 0 Z", "T0 M6 G49 G17"),
        ("TOOL CALL Z S1200", "S1200 G17"),
        ("TOOL DEF 9", "T9"),
        ("CYCL DEF 247 BEZUGSPUNKT SETZEN Q339=+3 ;BEZUGSPUNKT-NUMMER", "G56 ;BEZUGSPUNKT-NUMMER"),
        ("CR X+5 Y+5 R-7.5 DR- F90", "G2 X5 Y5 R-7.5 F90"),
        ("/ L X+3 R0 FMAX ; skip (here)", "/G0 G40 X3 ; skip (here)"),
        ("* - roughing", "; - roughing"),
        ("BLK FORM 0.1 Z X-5 Y-5 Z-10", ""),
    ],
)
def test_a_block_means(block: str, words: str) -> None:
    assert [" ".join(line.split()) for line in meant(block)] == [words]


def test_blocks_that_belong_together() -> None:
    assert meant("CC X+5 Y+0", "C X+5 Y+5 DR+ F90") == ["", "G3 X5 Y5 I5 J0 F90"]
    assert meant("CYCL DEF 9.0 DWELL TIME", "CYCL DEF 9.1 DWELL 1,5") == ["", "G4 P1.5"]
    assert meant("CYCL DEF 32.0 TOLERANCE", "CYCL DEF 32.1 T0.01") == ["", "G64 P0.01 Q0"]
    assert meant("CYCL DEF 32.0 TOLERANCE", "CYCL DEF 32.1") == ["", "G64"]
    assert meant("CC X+5 Y+0", "CP IPA+90 IZ-2 DR+ F90") == ["", "G3 X5 Y-5 Z3 I5 J0 F90"]


def test_a_tolerance_is_the_width_of_the_corridor() -> None:
    run = interpret(program("CYCL DEF 32.0 TOLERANCE", "CYCL DEF 32.1 T0.01", "L X+1 F90"), TNC)
    assert run.of_states(lambda state: state.off_path)[run.cutting].tolist() == [0.01]


def test_feeds_in_inches_are_in_tenths() -> None:
    text = program("L X+1 F90").replace("MM", "INCH")
    run = interpret(text, TNC)
    assert run.feed[run.cutting] == pytest.approx([9 * 25.4])


@pytest.mark.parametrize(
    ("blocks", "why"),
    [
        (("L X+5 RL F90",), "cutter compensation is not read"),
        (("L IX+5 F90",), "write places as absolute"),
        (("L X+5 A+3 F90",), "three-axis"),
        (("L X+Q1 F90",), "X+Q1 is a Q parameter; write X with a plain number"),
        (("L X+5 FAUTO",), "write the feed"),
        (("L X+5 F-3",), "F is below 0"),
        (("L X+5 X+6 F9",), "two X words"),
        (("L X+5 F100 M91",), "machine coordinates are read with FMAX alone"),
        (("L X+5 FMAX M92",), "write M91"),
        (("L X+5 FMAX M0",), "acts at its end"),
        (("L X+5 FMAX M30",), "acts at its end"),
        (("L M140 MB MAX",), "no word that is read"),
        (("L X+5 FMAX M99",), "cycles are not read"),
        (("L X+5 FMAX M3 M8 M13",), "more than 2 M functions"),
        (("M6",), "write TOOL CALL"),
        (("M128",), "M128 is no word that is read"),
        (("G1 X5",), "G is no word that is read"),
        (("LBL 1",), "LBL 1 before M30"),
        (("LBL 0",), "has not begun"),
        (("CYCL DEF 32.0 TOLERANCE G42",), "the name of the cycle stands there and no word"),
        (("CYCL DEF 9.0 DWELL 3",), "the name of the cycle stands there and no word"),
        (("L5 X+3 F90",), "L5 is no word"),
        (("CC7 X+3 Y+0",), "CC7 is no word"),
        (('LBL "A"',), "parameters, jumps and calls are not read"),
        (("CALL LBL 1",), "there is no O1 in this file"),
        (("CALL LBL 1 REP 2",), "by number and once"),
        (("M30\nLBL 1\nLBL 2",), "LBL 2 within LBL 1"),
        (("M30\nLBL 1\nLBL 0\nLBL 1",), "LBL 1 stands twice"),
        (("Q1 = 5",), "parameters, jumps and calls"),
        (("FN 0: Q1 = 5",), "parameters, jumps and calls"),
        (("RND R5",), "write L, C with CC, CR or CP"),
        (("APPR LCT X+5 Y+5 R2 RL",), "write L, C with CC"),
        (("PLANE RESET STAY",), "shifts or turns the work"),
        (("TCH PROBE 421 MEASURE HOLE",), "cycles are not read"),
        (("CYCL DEF 200 DRILLING",), "CYCL DEF 200 is no cycle that is read"),
        (("CYCL DEF 7.0 DATUM SHIFT",), "shifts or turns the work"),
        (("CYCL CALL M8",), "cycles are not read"),
        (("CYCL DEF 247 DATUM SETTING",), "needs Q339"),
        (("CYCL DEF 247 DATUM SETTING Q339=+7",), "preset 7"),
        (("CYCL DEF 9.1 DWELL 3",), "without CYCL DEF 9.0"),
        (("CYCL DEF 9.0 DWELL TIME\nL X+5 F90",), "has to follow CYCL DEF 9.0"),
        (("CYCL DEF 32.0 TOLERANCE\nCYCL DEF 32.1 T0",), "has to be above 0"),
        (("CYCL DEF 32.0 TOLERANCE\nCYCL DEF 32.1 T0.01 HSC-MODE:1",), "read with T alone"),
        (('TOOL CALL "MILL" Z S900',), "call tools by number"),
        (("TOOL CALL 3 S900",), "without the tool axis Z"),
        (("TOOL CALL 3 X S900",), "without the tool axis Z"),
        (("TOOL CALL 3 Z S900 DL+0.1",), "another than in the tool table"),
        (("TOOL CALL Z",), "says nothing"),
        (("TOOL DEF 3 L+0 R+5",), "call tools by number"),
        (("CC X+5",), "CC is read with X and Y"),
        (("CC IX+5 IY+0",), "absolute coordinates"),
        (("C X+5 Y+5 DR+ F90",), "write CC before it"),
        (("CC X+5 Y+0\nC X+5 Y+5 F90",), "C needs X, Y and DR"),
        (("CC X+5 Y+0\nC X+5 Y+5 DR+ FMAX",), "an arc at FMAX"),
        (("CC X+5 Y+0\nC X+5 Y+5.1 DR+ F90",), "arc"),
        (("CC X+5 Y+0\nCP PA+90 DR+ F90",), "write IPA"),
        (("CC X+5 Y+0\nCP IPA-90 DR+ F90",), "different sides"),
        (("CC X+5 Y+0\nCP IPA+100000 IZ-2 DR+ F90",), "99999.9999 degrees at most"),
        (("CC X+5 Y+0\nCP IPA+0.00001 IZ-2 DR+ F90",), "not by 0"),
        (("L X+0 FMAX M91\nCC X+5 Y+0\nCP IPA+90 DR+ F90",), "that the text has not said"),
        (("STOP M5",), "before STOP"),
        (("BLK FORM CYLINDER Z R50 L105",), "a blank is BLK FORM 0.1"),
        (("BEGIN PGM Q MM",), "keep one program in a file"),
        (("END PGM Q MM",), "ends with END PGM P MM"),
        (("M30\nL X+5 R0 FMAX",), "behind the end of the program"),
        (("END PGM P MM\nL X+5 R0 FMAX",), "behind END PGM"),
        (("L X+5 ä",), "no character of a program"),
        (("L X+5 " + " " * 128,), "reads 128 in a block"),
    ],
)
def test_what_is_not_modelled_is_refused_by_name_in_its_line(blocks: tuple[str], why: str) -> None:
    lines = blocks[0].split("\n")
    found = said(*lines)
    assert re.match(rf"line {AT + len(lines) - 1}: ", found), found
    assert why in found


def test_numbers_of_blocks_are_consecutive() -> None:
    text = program("L X+1 F90", "L X+2", "L X+3")
    assert interpret(text, TNC).ended
    lines = text.splitlines()
    for gone in range(AT - 1, len(lines) - 1):
        with pytest.raises(ProgramError, match=rf"line {gone + 1}: block \d+ where block \d+ is due"):
            interpret("\n".join(lines[:gone] + lines[gone + 1 :]), TNC)
    with pytest.raises(ProgramError, match="without its number"):
        interpret(text.replace("9 L X+3", "L X+3"), TNC)
    with pytest.raises(ProgramError, match="without END PGM"):
        interpret("\n".join(lines[:-1]), TNC)
    with pytest.raises(ProgramError, match="a block before BEGIN PGM"):
        interpret("0 L X+1 FMAX\n", TNC)


def test_a_feed_and_a_radius_word_hold_and_fmax_does_not() -> None:
    run = interpret(program("L X+1 F90", "L X+2 FMAX", "L X+3"), TNC)
    assert run.feed[run.cutting].tolist() == [90, 90]
    assert "G1 without a feed" in said("L X+1")


def test_an_arc_is_as_exact_as_the_control_wants_it() -> None:
    assert not said("CC X+5 Y+0", "C X+10 Y+0.3 DR+ F90")  # 9 µm
    assert "arc" in said("CC X+500 Y+0", "C X+1000.02 Y+0 DR+ F90")


def test_lengths_hang_on_tool_call() -> None:
    one = made("drill", NAME)[0]
    text = re.sub(r"(?m)^(\d+) TOOL CALL (\d+) Z S", r"\1 TOOL CALL 0 Z S", one.text, count=1)
    found = asked("tools", text, one.job, TNC)
    assert not found.passed
    second = re.sub(r"TOOL CALL \d+ Z", "TOOL CALL Z", one.text)
    assert not asked("tools", second, one.job, TNC).passed


def test_the_sheet_speaks_of_presets_and_of_no_word_of_others() -> None:
    one = made("drill", NAME)[0]
    text = "\n".join(
        line
        for step in steps(one.job, TNC, [1, 7], file_names=["drill.h"], deepest=-5)
        for line in (step.title, *step.lines)
    )
    for words in (
        "No length offset active: TOOL CALL 0 Z",
        "Set preset 1 X and Y",
        "Z in row 1 of the preset table = N − h",
        "Enter L of Tn = Zn − N",
        "by hand: TOOL CALL 1 Z, preset 1, then L Z+50 R0 FMAX",
        "SPA, SPB and SPC",
        "select the program anew",
    ):
        assert words in text, words
    assert not re.search(r"G43|G49|G10|\bHn\b|G53|G54|G0 ", text)


def test_what_the_control_lacks_is_found_in_the_design() -> None:
    cam = CamSettings.model_validate(
        {"control": NAME, "work_offset": "G59.1", "compensation": "wear", "post": {"offsets": True}}
    )
    found = errors(HeidenhainTnc().check(cam))
    assert [one.parameter for one in found] == ["cam.work_offset", "cam.compensation", "cam.post.offsets"]
    assert "G54 to G59" in found[0].remedy
    with pytest.raises(ProgramError, match="write no row of the preset table"):
        TNC.write(replace(every_operation(), posting=CamSettings.model_validate(cam).post))


def test_steps_of_block_numbers_are_refused_and_gone_where_they_are_left_out() -> None:
    stepped, plain = (
        CamSettings.model_validate({"control": NAME, "post": post}) for post in ({"line_numbers": 10}, {})
    )
    (found,) = errors(HeidenhainTnc().check(stepped))
    assert (found.code, found.parameter) == ("cam.line-numbers", "cam.post.line_numbers")
    assert found.remedy == "leave line_numbers out"
    assert not errors(HeidenhainTnc().check(plain))


def test_the_tool_table_has_the_columns_of_the_control() -> None:
    tools = every_operation().tools
    name, text = TNC.tool_table([tool.model_copy(update={"length": 81.5}) for tool in tools])
    assert name == "heidenhain-tools.csv"
    assert text.splitlines()[:2] == ["T,NAME,L,R,R2,DL,DR,DOC", "1,SPOT-6,81.5,3,0,0,0,spot-drill"]


def verdict(text: str, one: Machined) -> str:
    """What is said of a program that is refused."""
    try:
        failures = prove(text, one.job, TNC).failures
    except ProgramError as error:
        return str(error)
    return "; ".join(check.message for check in failures)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        *((" MM", " INCH"), (" R0 FMAX M91", " R0 FMAX"), ("Q339=+1", "Q339=+2"), ("M3\n", "M4\n")),
        *(("M8\n", "M7\n"), ("FMAX\n", "F9000\n"), ("DR-", "DR+"), ("DR+", "DR-"), ("CC X+14", "CC X-14")),
        *(("M0\n", "M1\n"), ("M30", "M0"), ("T0.02", "T0.2"), ("S8754", "S875"), ("S8754", "S99999")),
        *(("TOOL CALL 23", "TOOL CALL 24"), ("Z-", "Z+"), ("L Z+0 R0 FMAX M91", "L Z-50 R0 FMAX M91")),
        *(("L Z+0 R0 FMAX M91", wrong) for wrong in ("L Z+300 R0 FMAX M91", "L X+5000 Z+0 R0 FMAX M91")),
    ],
)
def test_a_fault_is_refused_in_a_line(old: str, new: str) -> None:
    one = made("profile-outside", NAME)[0]
    head, code = one.text[: one.text.index("CYCL DEF 247")], one.text[one.text.index("CYCL DEF 247") :]
    if old == " MM":
        head, code = "", one.text
    assert old in code
    found = verdict(head + code.replace(old, new, -1 if old == " MM" else 1), one)
    assert re.search(r"\bline \d+: ", found), found


LOST = (
    "CYCL DEF 247",
    "L Z+0 R0 FMAX M91",
    "TOOL CALL",
    "M3",
    "M8",
    "M5",
    "M9",
    "M30",
    "CC X",
    "C X",
    "L Z-",
)


@pytest.mark.parametrize("start", LOST)
def test_a_block_that_is_lost_is_refused_though_the_rest_is_numbered_anew(start: str) -> None:
    one = made("profile-outside", NAME)[0]
    lines = one.text.splitlines()
    begun = one.text.index("outside: finish") if start in {"C X", "CC X"} else 0
    finish = one.text[:begun].count("\n")
    at = next(k for k in range(finish, len(lines)) if re.match(rf"\d+ {re.escape(start)}", lines[k]))
    width = 2 if lines[at].endswith("~") else 1
    assert verdict(anew("\n".join(lines[:at] + lines[at + width :])), one)


def test_a_number_that_is_off_is_refused() -> None:
    """Places of the cuts: another one, the other sign, or the point lost."""
    one = made("pocket-contour", NAME)[0]
    places = list(re.finditer(r"(?m)^\d+ (?:L|CC|C) .*?([XYZ])([+-]\d+\.\d+)", one.text))[::9]
    assert len(places) > 5
    for match in places:
        off = f"{float(match[2]) + (-3 if match[1] == 'Z' else 30):+.3f}"
        sign = {"+": "-", "-": "+"}[match[2][0]] + match[2][1:]
        signs = [sign] if abs(float(match[2])) > 1 and " L " not in match[0] else []
        for new in (off, *signs, match[2].replace(".", "")):
            found = verdict(one.text[: match.start(2)] + new + one.text[match.end(2) :], one)
            assert re.search(r"\bline \d+: ", found), (match[0], new)


def test_a_helix_that_turns_or_falls_otherwise_is_refused() -> None:
    one = made("helix", NAME)[0]
    assert "CP IPA" in one.text
    for pattern, new in (("IZ-", "IZ-1"), ("IZ-", "IZ+"), (" IPA+", " IPA+2"), ("DR\\+ F", "DR- F")):
        found = verdict(re.sub(pattern, new, one.text, count=1), one)
        assert re.search(r"\bline \d+: ", found), (pattern, found)


def test_lines_that_a_switch_skips_are_proven_both_ways() -> None:
    one = made("pocket-contour", NAME)[0]
    harmless = anew(one.text.replace(" M9\n", " / ; nothing\n0 M9\n", 1))
    assert prove(harmless, one.job, TNC).ok
    found = verdict(re.sub(r"(?m)^(\d+) (TOOL CALL)", r"\1 / \2", one.text, count=1), one)
    assert "with lines that start with / skipped" in found


def test_the_kept_blocks_are_in_the_order_that_is_safe() -> None:
    """Each change stands behind a retract; spindle, place, height and coolant follow in that order."""
    lines = [re.sub(r"^\d+ ", "", line) for line in made("drill", NAME)[0].text.splitlines()]
    lines = [line for line in lines if not line.startswith(";")]
    for before, line in pairwise(lines):
        if line.startswith("TOOL CALL"):
            assert before == "L Z+0 R0 FMAX M91"
            at = lines.index(line)
            kinds = [re.sub(r"[-+.\d]+", "#", words) for words in lines[at : at + 5]]
            assert kinds == ["TOOL CALL # Z S#", "M#", "L X# Y# R# FMAX", "L Z# R# FMAX", "M#"]


def test_every_rapid_says_r0_and_every_arc_its_centre() -> None:
    lines = made("profile-outside", NAME)[0].text.splitlines()
    for before, line in pairwise(lines):
        assert ("FMAX" in line) == ("R0" in line)
        if re.match(r"\d+ (C|CP) ", line):
            assert re.match(r"\d+ CC X\S+ Y\S+$", before)


def test_a_dwell_and_a_stop_are_read() -> None:
    run = interpret(program("CYCL DEF 9.0 DWELL TIME", "CYCL DEF 9.1 DWELL 2.5", "M5", "M0"), TNC)
    assert run.seconds[run.kind == Kind.DWELL].tolist() == [2.5]
    assert (run.kind == Kind.STOP).sum() == 1


def test_a_spindle_that_stops_beside_a_move_stops_behind_it() -> None:
    """Up with M5 is how retracts end; along the work it would stop in the material."""
    text = text_of("heidenhain-tnc")
    up = re.sub(r"(L Z\+5 R0 FMAX)\n\d+ M9\n\d+ M5", r"\1 M9 M5", text)
    assert up.count("M9 M5") == 3
    assert prove(anew(up), job_of("heidenhain-tnc"), TNC).ok
    cut = re.sub(r"(L X\+22)(?=\n)", r"\1 M5", text, count=1)
    (said, *_) = prove(cut, job_of("heidenhain-tnc"), TNC).failures
    assert "while the spindle turns not at all" in said.message or "starts or stops while T3" in said.message
    assert said.line is not None
