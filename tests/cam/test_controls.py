"""The built-in controls: kept texts, the contract, options, and what each control reads."""

import re
from dataclasses import replace

import numpy as np
import pytest
from by_control import BY_NAME, EVERY, asked, interpret, prove
from by_night import examples, thinned
from golden_programs import FOLDER, as_taken, every_operation, texts, with_options
from hypothesis import given, settings
from hypothesis import strategies as st
from long_program import long_program
from planning_parts import bore, job, plate
from rs274 import needs_rs274, run_rs274
from shop import TOOLS, plate_job, plate_program
from test_rs274 import LAST_DECIMAL, distinct, our_ends

from mechwright.contracts.finding import Severity
from mechwright.errors import ProgramError
from mechwright.plugins.host import host
from mechwright_cam.controls.contract import Control
from mechwright_cam.controls.fanuc import Fanuc
from mechwright_cam.controls.grbl import Grbl
from mechwright_cam.controls.haas import Haas
from mechwright_cam.controls.heidenhain_tnc import HeidenhainTnc
from mechwright_cam.controls.linuxcnc import LinuxCnc
from mechwright_cam.controls.mach3 import Mach3
from mechwright_cam.controls.reading import Run
from mechwright_cam.controls.siemens_840d import Siemens840D
from mechwright_cam.machining import machine
from mechwright_cam.program.moves import Program
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.machine import Machine
from mechwright_cam.shop.posting import Measured, Posting
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import Tool
from mechwright_cam.testing import ControlContract, sample_program


def planned_job(**settings: object) -> Job:
    return job(plate(bore(12.0)), "spot-6", "drill-8", "mill-6", **settings)


def post_of(control: str) -> Control:
    return host().get(Control, control)


# -- the contract -------------------------------------------------------------------------------------------


class TestLinuxCnc(ControlContract):
    control = LinuxCnc


class TestFanuc(ControlContract):
    control = Fanuc


class TestHaas(ControlContract):
    control = Haas


class TestMach3(ControlContract):
    control = Mach3


class TestGrbl(ControlContract):
    control = Grbl
    longest_line = 79

    def length_offset(self, tool: Tool) -> str:
        return rf"T{tool.number}\nM0\n"  # touched off at the stop


class TestSiemens840D(ControlContract):
    control = Siemens840D

    def code(self, text: str) -> list[str]:
        """What MSG shows is no more a command than a comment."""
        return super().code(re.sub(r'MSG\("[^"()]*"\)', "", text))

    def length_offset(self, tool: Tool) -> str:
        return rf"T{tool.number}\nM6\n[^T]*\bD1\b"


class TestHeidenhainTnc(ControlContract):
    control = HeidenhainTnc
    longest_line = 128
    program_end = r"END PGM \w+ MM"

    def code(self, text: str) -> list[str]:
        """Without the numbers of blocks."""
        return [re.sub(r"^\d+ ", "", line) for line in super().code(text) if not re.fullmatch(r"\d+", line)]

    def work_offset(self, program: Program) -> str:
        return rf"Q339=\+{int(program.work_offset[1:]) - 53}(?!\d)"

    def length_offset(self, tool: Tool) -> str:
        return rf"TOOL CALL {tool.number} Z S\d+\nM3\n"


# -- kept texts ---------------------------------------------------------------------------------------------

TEXTS = texts()


@pytest.mark.parametrize("name", TEXTS)
def test_the_text_is_as_it_was_reviewed(name: str) -> None:
    assert TEXTS[name] == (FOLDER / name).read_text(encoding="ascii")


def test_no_text_is_kept_that_nothing_writes() -> None:
    assert {path.name for path in FOLDER.glob("*.nc")} == set(TEXTS)


# -- what every control reads -------------------------------------------------------------------------------


def read(control: str, program: Program) -> Run:
    text = post_of(control).write(as_taken(program, post_of(control)))
    return interpret(text, BY_NAME[control], upper_end=program.machine.retract_z)


def cuts(run: Run) -> np.ndarray:
    """Distinct ends of feed moves with their feeds and centres, (n, 6)."""
    rows = np.column_stack((run.end, run.feed, np.nan_to_num(run.centre)))
    return rows[run.cutting]


@pytest.mark.parametrize("program", [every_operation, with_options, sample_program], ids=lambda f: f.__name__)
def test_all_controls_cut_the_same(program) -> None:
    runs = {control: read(control, program()) for control in EVERY}
    for control, run in runs.items():
        # Grbl has no cycles: the others' expand to the same feeds.
        assert run.ended
        np.testing.assert_allclose(cuts(run), cuts(runs["linuxcnc"]), atol=1.01e-3, err_msg=control)
        assert run.seconds.sum() == pytest.approx(runs["linuxcnc"].seconds.sum())


@pytest.mark.parametrize("control", EVERY)
def test_a_program_for_any_control_is_proven_as_that_control_reads_it(control: str) -> None:
    settings = {"control": control, "machine": {"retract_z": -2.0}}
    program = replace(plate_program(), machine=Machine(retract_z=-2))
    text = post_of(control).write(program)
    proof = prove(text, plate_job(**settings), BY_NAME[control])
    assert proof.failures == ()


def test_a_program_for_another_control_does_not_pass_in_silence() -> None:
    texts = {control: post_of(control).write(plate_program()) for control in EVERY}
    job = plate_job()
    (astray,) = prove(texts["fanuc"], job, BY_NAME["linuxcnc"]).failures
    assert astray.message.startswith("line 17: nothing bounds how far LinuxCNC leaves the path")
    usual = texts["linuxcnc"].replace(" G91.1", "")
    with pytest.raises(ProgramError, match=r"^line 8: G91.1 is no code that is read in programs for Haas"):
        prove(texts["linuxcnc"], job, BY_NAME["haas"])
    with pytest.raises(ProgramError, match=r"^line 9: P means nothing in this line"):
        prove(usual, job, BY_NAME["haas"])
    with pytest.raises(ProgramError, match="no decimal point"):
        prove(usual.replace("G64 P0.002 Q0", "G64"), job, BY_NAME["haas"])
    assert not asked("tools", texts["grbl"], job, BY_NAME["mach3"]).passed
    with pytest.raises(ProgramError, match="G64 is no code that is read in programs for Grbl"):
        prove(texts["mach3"], job, BY_NAME["grbl"])


@pytest.mark.parametrize("control", EVERY)
def test_planned_programs_are_proven_for_every_control(control: str) -> None:
    job = planned_job(control=control, machine={"retract_z": -2.0}, post={"restart": True})
    made = machine(job, post_of(control))
    assert made.proof.ok
    assert made.proof.leftover_reachable_max_mm <= 0.010


def test_files_of_one_tool_each_are_proven_together() -> None:
    settings = {"control": "grbl", "machine": {"retract_z": -2.0}, "post": {"tool_change": "files"}}
    made = machine(planned_job(**settings), post_of("grbl"))
    assert len(made.files) == len(made.program.sections) >= 3
    assert made.proof.ok
    names = list(made.files)
    assert names[0].endswith("-1-t1")
    # A defect is named with its file.
    files = {name + ".nc": text for name, text in made.files.items()}
    last = [*files][-1]
    broken = {**files, last: files[last].replace("S", "S9", 1)}
    found = asked("speeds", broken, made.job, BY_NAME["grbl"])
    assert found.message.startswith(f"{last}: line ")
    with pytest.raises(ProgramError, match=rf"^{last}: line 1: "):
        prove({**files, last: "G1 X..2\n" + files[last]}, made.job, BY_NAME["grbl"])


@pytest.mark.parametrize(
    ("check", "old", "new", "says"),
    [
        ("modes", " G90", "", "moves before G90; set the modes first"),
        ("modes", " G21", "", "moves before G21; set the modes first"),
        ("modes", "G17 ", "", "moves before G17; set the modes first"),
        ("program-end", "G0 Z5\nM9\nM5\nG53 G0 Z-2\n", "M9\nM5\n", "the program ends with the tool down"),
        ("program-end", "M30\n", "", "the program has no end; write M30 or M2"),
    ],
)
def test_each_file_is_a_program_of_its_own(check: str, old: str, new: str, says: str) -> None:
    """Between two files hands move the machine, by the same words as a program."""
    settings = {"control": "grbl", "machine": {"retract_z": -2.0}, "post": {"tool_change": "files"}}
    made = machine(planned_job(**settings), post_of("grbl"))
    files = {name + ".nc": text for name, text in made.files.items()}
    for name in files:
        assert old in files[name]
        found = asked(check, {**files, name: files[name].replace(old, new)}, made.job, BY_NAME["grbl"])
        assert not found.passed
        assert found.message.startswith(f"{name}: ")
        assert says in found.message


# -- Grbl's published list of words -------------------------------------------------------------------------

GRBL_WORDS = re.compile(
    r"G(0|1|2|3|38\.[2-5]|80|4|10|17|18|19|20|21|28|28\.1|30|30\.1|40|43\.1|49|53|54|55|56|57|58|59|61"
    r"|90|91|91\.1|92|92\.1|93|94)|M(0|1|2|30|3|4|5|7|8|9)|[FIJKLNPRSTXYZ]-?\d+(\.\d+)?"
)
"""Grbl v1.1, "Supported G-codes" and the non-command words, as its wiki and gcode.h list them."""


def hold_to_grbl(text: str) -> None:
    for line in text.splitlines():
        code = re.sub(r"\([^()]*\)", "", line)
        assert len(line) <= 79
        assert not set(line) & set("?!~%$;")
        words = code.split()
        assert all(GRBL_WORDS.fullmatch(word) for word in words), line
        if {"G2", "G3"} & set(words):
            letters = {word[0] for word in words}
            assert letters & set("XY")
            assert letters & set("IJ")
        if "G53" in words:
            assert {"G0", "G1"} & set(words)


@pytest.mark.parametrize("name", [name for name in TEXTS if name.startswith("grbl")])
def test_grbl_programs_hold_to_its_list_of_words(name: str) -> None:
    hold_to_grbl(TEXTS[name])


def test_a_planned_program_holds_to_grbl_s_list_of_words() -> None:
    hold_to_grbl(machine(planned_job(control="grbl"), post_of("grbl")).text)


@settings(max_examples=examples(35, 100))
@given(st.text(max_size=60))
def test_no_comment_reaches_grbl_s_realtime_commands(words: str) -> None:
    program = replace(every_operation(), notes=(words,))
    assert not set(post_of("grbl").write(program)) & set("?!~%$;")
    fanuc = post_of("fanuc").write(program)
    assert fanuc.count("%") == 2
    assert ";" not in fanuc
    assert fanuc == fanuc.upper()


# -- rs274 and the options ----------------------------------------------------------------------------------


@needs_rs274
@pytest.mark.parametrize("program", [every_operation, with_options], ids=["plain", "options"])
def test_linuxcnc_s_own_interpreter_accepts_the_kept_texts(program, tmp_path) -> None:
    post = post_of("linuxcnc")
    made = program()
    canon = run_rs274(post.write(made), tmp_path, post.tool_table(made.tools)[1])
    assert canon.ok, canon.error
    assert len(canon.ends) > 40


@needs_rs274
def test_linuxcnc_s_own_interpreter_reads_twenty_thousand_moves_alike(tmp_path) -> None:
    program = long_program(20_000)
    text = post_of("linuxcnc").write(program)
    canon = run_rs274(text, tmp_path, post_of("linuxcnc").tool_table(TOOLS)[1])
    assert canon.ok, canon.error
    ours, theirs = distinct(our_ends(interpret(text))), distinct(canon.ends)
    assert len(ours) > 19_000
    np.testing.assert_allclose(ours, theirs, atol=LAST_DECIMAL, rtol=0)


@pytest.mark.parametrize("control", thinned(3, EVERY, first=1))
def test_a_long_program_is_read_and_proven(control: str) -> None:
    text = post_of(control).write(long_program(20_000))  # benchmarks/bench_controls.py times 100,000 moves
    assert prove(text, plate_job(), BY_NAME[control]).ok


@pytest.mark.parametrize(
    ("posting", "words"),
    [
        ({"program_number": 123}, "O0123"),
        ({"line_numbers": 7}, "N14 "),
        ({"restart": True}, "(RESTART POINT: T2 IN THE SPINDLE)"),
        ({"optional_stops": True}, "\nM1\n"),
        ({"cycles": False}, "\nG1 Z-7.5 F200.\n"),
        ({"exact_stop": True}, "\nG61\n"),
    ],
)
def test_every_option_is_seen_in_the_text(posting, words) -> None:
    post, program = post_of("fanuc"), every_operation()
    plain, other = post.write(program), post.write(replace(program, posting=Posting(**posting)))
    assert words in other
    assert words not in plain


@pytest.mark.parametrize(
    ("places", "words"),
    [
        ({"retract_z": -3.5}, "G53 G0 Z-3.5"),
        ({"change_x": 12.5}, "G53 G0 X12.5\nT1 M6"),
        ({"change_y": -8.0}, "G53 G0 Y-8\nT1 M6"),
        ({"home_x": 1.0, "home_y": 2.0}, "G53 G0 X1 Y2\nM30"),
        ({"spindle_delay": 2.5}, "S3000 M3\nG4 P2.5"),
    ],
)
def test_the_machine_s_places_are_in_the_text(places, words) -> None:
    text = post_of("mach3").write(replace(every_operation(), machine=Machine(**places)))
    assert words in text
    assert words not in post_of("mach3").write(every_operation())


def test_offsets_that_were_not_measured_cannot_be_written() -> None:
    program = replace(with_options(), measured=Measured(x=1, y=2))
    with pytest.raises(ProgramError, match=r"cam\.measured\.z is not given"):
        post_of("haas").write(program)
    program = replace(every_operation(), measured=Measured(x=1, y=2, z=3), posting=Posting(offsets=True))
    with pytest.raises(ProgramError, match=r"cam\.measured\.lengths\.spot-6 is not given"):
        post_of("haas").write(program)


@pytest.mark.parametrize(
    ("control", "offset", "has"),
    [
        *[(control, "G57", True) for control in EVERY],
        *[(control, "G59", control != "siemens-840d") for control in EVERY],
        ("linuxcnc", "G59.3", True),
        ("fanuc", "G59.1", False),
        ("fanuc", "G54.1 P48", True),
        ("fanuc", "G54.1 P49", False),
        ("haas", "G154 P99", True),
        ("haas", "G54.1 P1", False),
        ("linuxcnc", "G154 P1", False),
        ("grbl", "G59.1", False),
        ("mach3", "G59.1", False),
    ],
)
def test_an_offset_that_the_control_does_not_have_is_found(control: str, offset: str, has: bool) -> None:
    cam = CamSettings(control=control, work_offset=offset, machine={"retract_z": -2})
    found = post_of(control).check(cam)
    assert [f.severity for f in found] == ([] if has else [Severity.ERROR])
    if has:
        run = read(control, replace(every_operation(), work_offset=offset))
        assert {run.states[i].work_offset for i in run.state[run.cutting]} == {offset}
    else:
        assert offset in found[0].message
        assert f"G54 to G5{7 if control == 'siemens-840d' else 9}" in found[0].remedy


def test_a_tool_number_beyond_the_control_s_table_is_refused() -> None:
    program = every_operation()
    high = program.sections[0].tool.model_copy(update={"number": 300})
    program = replace(program, sections=(replace(program.sections[0], tool=high),))
    for control in ("haas", "mach3", "grbl"):
        with pytest.raises(ProgramError, match="has number 300"):
            post_of(control).write(program)
    assert "T300 M6" in post_of("fanuc").write(program)


def test_tool_tables() -> None:
    measured = [tool.model_copy(update={"length": 80.5 + tool.number}) for tool in TOOLS]
    assert post_of("fanuc").tool_table(TOOLS) == ("", "")
    assert "G10 L10 P3 R83.5\n" in post_of("haas").tool_table(measured)[1]
    assert "2,drill-8 drill,8,82.5\n" in post_of("mach3").tool_table(measured)[1]
    line = "T1 P1 Z81.5 D6 ;spot-6 spot-drill flute_length=8 point_angle=90\n"
    assert line in post_of("linuxcnc").tool_table(measured)[1]
    assert post_of("grbl").tool_table(measured) == ("", "")
    name, text = post_of("siemens-840d").tool_table(measured)
    assert name == "siemens-tools.csv"
    assert text.splitlines()[:2] == ["tool,edge,description,length 1,radius", "1,D1,spot-6 spot-drill,81.5,3"]
    fanuc = interpret(post_of("fanuc").tool_table(measured)[1], BY_NAME["fanuc"])
    assert fanuc.ended
