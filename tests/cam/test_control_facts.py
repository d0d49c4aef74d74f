"""A control's facts stand in its one class: whoever inherits from it, under any name, is told of rightly everywhere."""

import ast
import re
from dataclasses import replace
from pathlib import Path

import pytest
from by_control import BY_NAME

import mechwright
import mechwright_cam
from mechwright.errors import ProgramError
from mechwright_cam.controls.fanuc import Fanuc
from mechwright_cam.controls.grbl import Grbl
from mechwright_cam.controls.linuxcnc import LinuxCnc
from mechwright_cam.controls.offsets import OffsetTables
from mechwright_cam.machining import machine
from mechwright_cam.pages.setup_sheet import setup_html, summary_html
from mechwright_cam.proof import prove
from mechwright_cam.testing import plate_job

SOURCES = [
    path
    for package in (mechwright, mechwright_cam)
    for path in Path(package.__file__).parent.rglob("*")
    if path.suffix in {".py", ".html"}
]


class Renamed(Fanuc):
    """Fanuc with tables and a name of its own."""

    name = "renamed"
    title = "Renamed"
    offsets = OffsetTables(d="radius")


class OwnGrbl(Grbl):
    name = "own-grbl"
    title = "Own Grbl"


def made(control, **settings):
    return machine(plate_job(control=control.name, **settings), control)


def pages(one, control, table=""):
    proof = one.proof.as_dict()
    rows = [(one.job, one.program, proof)]
    return setup_html(*rows[0], control, tool_table=table), summary_html(
        rows, control, name="job", tool_table=table
    )


def test_a_fanuc_of_another_name_has_one_d_in_program_table_and_sheet() -> None:
    control = Renamed()
    one = made(control, compensation="control")
    sheet, _ = pages(one, control, "tool-offsets.nc")
    assert "(D24 HOLDS THE RADIUS OF T24: 3 AS PLANNED" in one.text
    assert "D24: enter the radius of T24 as measured" in sheet
    assert "enter the diameter" not in sheet
    assert "G10 L12 P24 R3.\n" in control.offset_table(one.program.tools, one.job.settings)[1]
    assert "tool-offsets.nc is a program" in sheet
    # Its own tables have no setting and no column of wear; Fanuc's have.
    assert "has to take D" not in sheet
    assert "Geometry and wear" not in sheet
    theirs, _ = pages(made(Fanuc(), compensation="control"), Fanuc())
    assert "has to take D as a radius (commonly parameter 5004, bit 2). Geometry and wear" in theirs


def test_a_grbl_of_another_name_keeps_no_lengths() -> None:
    control = OwnGrbl()
    one = made(control, machine={"retract_z": -2})
    sheet, whole = pages(one, control)
    assert "The control keeps no lengths: T24 are touched off one by one" in sheet
    assert "Offsets to type in" not in sheet
    assert "H24" not in sheet + whole
    assert "touched off" in one.proof.checks["length-offset"].message
    (found,) = control.check(plate_job(compensation="wear", machine={"retract_z": -2}).settings)
    assert found.message == "Own Grbl has no cutter compensation (G41, G42)"


@pytest.mark.parametrize("word", ["G43.1", "G43.7", ""])
def test_the_word_that_writes_a_length_is_the_control_s(word: str) -> None:
    class Lengthless(OwnGrbl):
        offsets = replace(Grbl.offsets, length_word=word)

    job = plate_job(machine={"retract_z": -2})
    tools = tuple(tool.model_copy(update={"length": 77.5}) for tool in job.tools)
    page = setup_html(replace(job, tools=tools), made(Grbl()).program, None, Lengthless())
    assert (f"are in the program ({word})" in page) == bool(word)
    assert ("touched off one by one" in page) == (not word)


def test_its_own_words_are_written_read_and_advised() -> None:
    class Own(LinuxCnc):
        name, title = "own", "Own"
        # M2 and M3 change places; spindle off is M45.
        dialect = replace(LinuxCnc.dialect, m_words=((3, 2), (2, 3), (5, 45)))

        def length_words(self, tool: int | str) -> str:
            return f"G43 H{tool} (LENGTH)"

    control = Own()
    one = made(control)
    assert re.findall(r"^M45$", one.text, re.M)
    assert " M2\n" in one.text
    assert not re.search(r"\bM[35]\b", one.text)
    assert one.proof.ok
    sheet, _ = pages(one, control)
    assert "T24 M6, G54, G43 H24 (LENGTH), then G0 Z50" in sheet
    with pytest.raises(ProgramError, match=r"^line \d+: M5 is no code that is read in programs for Own"):
        prove(one.text.replace("M45", "M5"), one.job, control)
    still = prove(one.text.replace(" M2\n", "\n"), one.job, control).checks["spindle"]
    assert "write S and M2" in still.message
    without = prove(one.text.replace("G43 H24 (LENGTH) ", ""), one.job, control).checks["length-offset"]
    assert "write G43 H24 (LENGTH)" in without.message


def test_a_retract_of_its_own_is_written_and_advised() -> None:
    class Own(LinuxCnc):
        def retract_lines(self, z: float) -> tuple[str, ...]:
            return (f"G53 G00 Z{self.length(z)}",)

    one = made(Own())
    assert "\nG53 G00 Z0\n" in one.text
    low = prove(one.text.replace("G53 G00 Z0\n", ""), one.job, Own()).checks["positions"]
    assert "first retract with G53 G00 Z0, at" in low.message


def test_nobody_asks_for_a_control_by_its_name() -> None:
    """Names stand in the controls' own files, as the default of the design file, and with hosts that read one."""
    assert len(SOURCES) > 200
    quoted = re.compile(rf"""["']({"|".join(BY_NAME)})["']""")
    named = {
        path.name
        for path in SOURCES
        if path.parent.name != "controls" and quoted.search(path.read_text(encoding="utf-8"))
    }
    assert named == {"settings.py", "cncjs.py", "fluidnc.py"}
    for name in BY_NAME:
        path = Path(mechwright_cam.__file__).parent / "controls" / f"{name.replace('-', '_')}.py"
        assert set(quoted.findall(path.read_text(encoding="utf-8"))) == {name}


def test_nobody_compares_the_name_of_a_control() -> None:
    for path in SOURCES:
        if path.suffix != ".py" or path.parent.name == "testing":
            continue
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Compare):
                words = ast.unparse(node)
                assert not re.search(
                    r"\b(control|post|settings\.control)(\.name\b|\.title\b| [!=]=| in )", words
                ), f"{path.name}: {words}"


def test_only_linuxcnc_has_programs_that_work_out_their_values() -> None:
    assert [name for name, control in BY_NAME.items() if control.dialect.macros] == ["linuxcnc"]
