"""Cutter compensation as each control writes and reads it."""

import tempfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from by_control import BY_NAME, LINUXCNC, interpret, prove, read, setup_html, summary_html
from golden_compensation import CONTROLS, FOLDER, WAYS, made, texts
from planning_parts import LIBRARY
from rs274 import needs_rs274, run_rs274
from test_cutter_compensation import TABS, reader, sample, text_of
from test_rs274 import distinct

from mechwright.errors import MechwrightError, ProgramError
from mechwright.plugins.host import host
from mechwright_cam.controls.contract import Control
from mechwright_cam.controls.reading import Kind
from mechwright_cam.pages.trace import trace
from mechwright_cam.planning import plan
from mechwright_cam.proof.scene import planned_offsets
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.library import Library
from mechwright_cam.shop.posting import Posting
from mechwright_cam.shop.settings import CamSettings

# -- controls -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", [f"{way}-{control}.nc" for way in WAYS for control in CONTROLS])
def test_the_text_is_as_it_was_reviewed(name: str) -> None:
    assert texts()[name] == (FOLDER / name).read_text(encoding="ascii")


def test_no_text_is_kept_that_nothing_writes() -> None:
    assert {path.name for path in FOLDER.glob("*")} == set(texts())


@needs_rs274
@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("more", [-0.1, 0.0, 0.1])
def test_linuxcnc_goes_the_same_way(way: str, more: float) -> None:
    one = sample(way)
    text = text_of(one)
    rows = "".join(f"T{d} P{d} Z0 D{2 * (r + more) / 25.4:.12f}\n" for d, r in planned_offsets(one).items())
    with tempfile.TemporaryDirectory() as folder:
        canon = run_rs274(text, Path(folder), rows)
    assert canon.ok, canon.error
    run = read(text, one, reader(), more)
    moves = np.isin(run.kind, (Kind.RAPID, Kind.FEED, Kind.ARC, Kind.HOME)) & ~run.piece
    ends = np.nan_to_num(run.end[moves], posinf=0.0)
    # The first moves and retracts are where offsets are unknown to us; LinuxCNC takes them for 0.
    ours, theirs = (distinct(np.concatenate((np.zeros((1, 3)), rows)))[2:] for rows in (ends, canon.ends))
    assert ours.shape == theirs.shape
    np.testing.assert_allclose(ours, theirs, atol=3e-4, rtol=0)


def test_grbl_refuses_and_names_the_key() -> None:
    found = host().get(Control, "grbl").check(CamSettings(control="grbl", compensation="wear"))
    assert any(f.code == "cam.compensation" and f.parameter == "cam.compensation" for f in found)
    with pytest.raises(ProgramError, match="no cutter compensation"):
        host().get(Control, "grbl").write(plan(sample("wear")))


@pytest.mark.parametrize(
    ("control", "value", "way", "line"),
    [
        ("linuxcnc", "radius", "control", "T24 P24 Z0 D6 ;mill-6 end-mill flute_length=24 flutes=3\n"),
        (
            "linuxcnc",
            "radius",
            "wear",
            "T24 P24 Z0 D0 ;mill-6 end-mill flute_length=24 diameter=6 flutes=3\n",
        ),
        ("fanuc", "radius", "control", "G10 L12 P24 R3.\nG10 L13 P24 R0.\n"),
        ("haas", "diameter", "control", "G10 L12 P24 R6.\nG10 L13 P24 R0.\n"),
        ("haas", "diameter", "wear", "G10 L12 P24 R0.\nG10 L13 P24 R0.\n"),
        ("mach3", "radius", "wear", '24,"mill-6 end-mill, D of T24",0,\n'),
    ],
)
def test_the_table_holds_what_d_is(control: str, value: str, way: str, line: str) -> None:
    cam = CamSettings(control=control, compensation=way, post=Posting(d_value=value))
    name, text = (
        host().get(Control, control).offset_table([LIBRARY.get("mill-6"), LIBRARY.get("drill-8")], cam)
    )
    assert name
    assert line in text


def test_a_d_number_of_its_own() -> None:
    mine = LIBRARY.get("mill-6").model_copy(update={"diameter_offset": 74})
    one = sample("control")
    one = Job(one.part, one.settings, (mine,), one.origin, one.stock, one.tabs)
    text = text_of(one)
    assert "G41 D74" in text
    assert "G41 D24" not in text
    assert "D74 holds the diameter of T24: 6 as planned, at most 0.2 more or less" in text
    prove(text, one, reader()).require()
    _, table = LINUXCNC.offset_table([mine], one.settings)
    assert "T24 P24 Z0 D6 ;mill-6 end-mill flute_length=24 flutes=3 diameter_offset=74\n" in table
    assert "T74 P74 Z0 D6 ;" in table
    with pytest.raises(MechwrightError, match="both have D number 24"):
        Library((LIBRARY.get("mill-6"), LIBRARY.get("mill-3").model_copy(update={"diameter_offset": 24})))


@pytest.mark.parametrize("way", WAYS)
def test_the_sheet_says_what_to_type(way: str) -> None:
    one = sample(way)
    page = setup_html(one, plan(one), None)
    first = "6.000, the diameter" if way == "control" else "0.000, the wear on the diameter"
    assert f"<b>D24</b> = {first}" in page
    assert "Set D, and bring the part to size" in page
    low, high = ("5.800", "6.200") if way == "control" else ("−0.200", "0.200")
    assert f"From {low} to {high} is proven" in page
    offset = BY_NAME["haas"].offsets.d_offset(LIBRARY.get("mill-6"), Posting(), way, 0.1)
    assert (offset.quantity, offset.limit) == ("radius", 0.1)


def test_sheets_name_the_d_that_a_tool_has_and_only_those_in_use() -> None:
    mine = LIBRARY.get("mill-6").model_copy(update={"diameter_offset": 74})
    for way, shown in (("control", True), ("computer", False)):
        one = replace(sample(way), tools=(mine, LIBRARY.get("drill-8")))
        rows = [(one, plan(one), None)]
        whole = summary_html(rows, name="job")
        assert ("D74" in whole) == shown
        assert "D24" not in whole
        assert ("H24<br>D74" in setup_html(*rows[0])) == shown
        assert "H9<" in setup_html(*rows[0])
    by_hand = replace(one, settings=one.settings.model_copy(update={"control": "grbl"}))
    assert "H24" not in summary_html([(by_hand, plan(by_hand), None)], name="job")


@pytest.mark.parametrize(("control", "setting"), [("fanuc", "parameter 5004, bit 2"), ("haas", "setting 40")])
def test_the_sheet_says_how_the_control_adds_d_up_and_that_its_table_is_a_program(control, setting) -> None:
    one = sample("wear")
    one = replace(one, settings=one.settings.model_copy(update={"control": control}))
    page = setup_html(one, plan(one), None, tool_table="tool-offsets.nc")
    assert setting in page
    assert "enter the planned value as geometry, with wear 0" in page
    assert "tool-offsets.nc is a program: run it once for new cutters" in page
    assert "geometry" not in setup_html(sample("wear"), plan(sample("wear")), None)


def test_pictures_and_reach_follow_the_centre_of_the_cutter() -> None:
    """Stroke for stroke the program as planned goes where the text is read to go."""
    one = sample("control")
    program = plan(one)
    strokes = [s for item in trace(program) for s in item.strokes if s.feed > 0]
    run = read(LINUXCNC.write(program), one, reader())
    theirs = run.end[run.cutting]
    assert len(strokes) == len(theirs)
    np.testing.assert_allclose([s.end for s in strokes], theirs, atol=2e-4, rtol=0)


def test_restart_points_and_line_numbers_are_outside_of_compensation() -> None:
    program = plan(sample("control", hold=TABS))
    from dataclasses import replace

    text = LINUXCNC.write(replace(program, posting=Posting(restart=True, line_numbers=10)))
    on = False
    for line in text.splitlines():
        if "restart point" in line:
            assert not on
        on = ("G41" in line or on) and "G40" not in line
    prove(text, sample("control"), reader()).require()


def test_a_larger_wear_limit_leaves_more_in_corners() -> None:
    assert sample("control", wear_limit=0.3).reach(LIBRARY.get("mill-6")) == pytest.approx(3.35)
    assert sample("computer").reach(LIBRARY.get("mill-6")) == 3.0
    texts_ = {wear: text_of(sample("control", wear_limit=wear)) for wear in (0.05, 0.3)}
    assert texts_[0.05] != texts_[0.3]


def test_the_golden_programs_are_of_the_ways_they_are_named_after() -> None:
    for way in WAYS:
        assert made(way, "linuxcnc").program.compensation == way


IDLE = ("G4 P500", "M8", "S2000", "F90.", "G91", "Z-2.5")
BESIDE = (
    "G21 G90 G17 G40 G80 G94\nG54 S1000 M3\nG0 X0. Y0. Z-2.\nG1 F100. G41 D3 X10. Y0.\nX20.\n{}\nG90 Y20.\n"
)


@pytest.mark.parametrize("one", IDLE)
def test_fanuc_sees_one_block_past_the_next_one(one: str) -> None:
    """A corner behind two blocks without X and Y is cut as if the first of its sides went on."""
    end = "X0.\nG40 X-10.\nM30\n"
    for words in (one, f"{one}\n(a comment)", f"(a comment)\n\n{one}"):
        interpret(BESIDE.format(words) + end, BY_NAME["fanuc"], diameters={3: 6.0})
    twice = BESIDE.format(f"{one}\n(a comment)\nM9") + end
    with pytest.raises(ProgramError, match=r"^line 9: 2 blocks without X and Y before this one while comp"):
        interpret(twice, BY_NAME["fanuc"], diameters={3: 6.0})
    interpret(twice, BY_NAME["haas"], diameters={3: 6.0})
    beside = BESIDE.format("") + f"X0.\nG40 X-10.\n{one}\nM9\nG90 X-20.\nM30\n"
    interpret(beside, BY_NAME["fanuc"], diameters={3: 6.0})
