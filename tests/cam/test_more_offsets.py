"""One job at several work offsets: what each control writes and reads, what the proof asks, what the sheet says."""

import re
from dataclasses import replace

import numpy as np
import pytest
from by_control import BY_NAME, EVERY, asked, interpret, prove
from planning_parts import bore, job, plate

import mechwright
from mechwright.contracts.finding import errors
from mechwright.errors import ProgramError
from mechwright_cam.controls.reading import Kind
from mechwright_cam.machining import Machined, Machining, machine
from mechwright_cam.pages.setup_sheet import setup_html
from mechwright_cam.proof.several import at_offset
from mechwright_cam.shop.settings import CamSettings

TOOLS = ("spot-6", "drill-8", "mill-6")
TWO = {"more_offsets": ["G55"]}
WRITTEN_OUT = ("grbl",)


def made(control: str, **settings: object) -> Machined:
    return machine(job(plate(bore(12.0)), *TOOLS, control=control, **(TWO | settings)), BY_NAME[control])


def ways(one: Machined) -> list[np.ndarray]:
    """Kind, start, end and feed of every move at each work offset."""
    run = BY_NAME[one.job.settings.control].read(one.files if len(one.files) > 1 else one.text)
    offset = run.of_states(lambda state: state.work_offset)
    cuts = [run.moving & (offset == name) for name in ("G54", "G55")]
    return [np.column_stack((run.kind, run.end, run.feed, run.tool))[own] for own in cuts]


@pytest.mark.parametrize("control", EVERY)
def test_each_tool_does_the_same_at_each_offset_and_is_changed_to_once(control: str) -> None:
    one = made(control)
    first, second = ways(one)
    assert len(first) > 20
    np.testing.assert_array_equal(first, second)
    run = BY_NAME[control].read(one.files if len(one.files) > 1 else one.text)
    assert run.tool[run.kind == Kind.TOOL].tolist() == [
        section.tool.number for section in one.program.sections
    ]
    alone = made(control, more_offsets=[])
    longer = len(one.text.splitlines()) / len(alone.text.splitlines())
    assert longer > 1.8 if control in WRITTEN_OUT else longer < 1.3
    # Twice the cuts, the changes of tools once.
    assert 1.5 < one.proof.time_estimate_s / alone.proof.time_estimate_s < 2
    assert one.proof.cutting_length_mm == pytest.approx(2 * alone.proof.cutting_length_mm)
    assert [o.name for o in one.proof.operations] == [o.name for o in alone.proof.operations]


def test_what_is_wrong_at_one_of_them_is_found_there() -> None:
    one = made("grbl")
    name = next(iter(one.files))
    text = one.files[name]
    at = text.index("\nG55")
    deeper = text[:at] + re.sub(r"Z-(\d)", r"Z-9\1", text[at:], count=1)
    found = prove(one.files | {name: deeper}, one.job, BY_NAME["grbl"])
    assert not found.ok
    assert all(check.message.startswith("at G55, ") for check in found.failures)


@pytest.mark.parametrize(
    ("change", "check", "message"),
    [
        (("G55\no103 call\n", ""), "depth", None),
        (("G55\no103 call\n", "G55\n"), "", "at G55"),
        (("G55\no101 call", "G56\no101 call"), "work-offset", "moves in G56; the job is set up in G54"),
    ],
)
def test_a_plate_that_is_left_out_is_found(change: tuple[str, str], check: str, message: str | None) -> None:
    one = made("linuxcnc")
    proof = prove(one.text.replace(*change), one.job)
    assert not proof.ok
    if check == "work-offset":
        assert message is not None
        assert message in proof.checks[check].message
    else:
        assert proof.failures[0].message.startswith("at G55, ")


def test_a_tool_that_stays_down_between_two_plates_is_refused() -> None:
    one = made("linuxcnc")
    low = one.text.replace("M9\nG53 G0 Z0\no101 endsub", "M9\nG0 Z5\no101 endsub")
    assert low != one.text
    assert {check.name for check in prove(low, one.job).failures} >= {"positions"}


def placed(x: float, y: float, **settings: object) -> dict[str, object]:
    there = {"x": x, "y": y, "z": -300.0}
    return {"measured": {"x": 0.0, "y": 0.0, "z": -300.0, "more": {"G55": there}}, **settings}


def test_plates_have_to_be_clear_of_each_other_where_it_is_known() -> None:
    assert "not known" in made("linuxcnc").proof.checks["neighbours"].message
    one = made("linuxcnc", **placed(200.0, 0.0))
    assert "stay clear" in one.proof.checks["neighbours"].message
    near = replace(one.job, settings=CamSettings.model_validate({**TWO, **placed(50.0, 0.0)}))
    found = asked("neighbours", one.text, near)
    assert not found.passed
    least = float(re.findall(r"clamp them ([\d.]+) mm", found.message)[0])
    for x, passes in ((least + 0.1, True), (least - 0.1, False), (-least - 0.1, True)):
        moved = replace(one.job, settings=CamSettings.model_validate({**TWO, **placed(x, 0.0)}))
        assert asked("neighbours", one.text, moved).passed is passes


def test_the_program_sets_all_measured_offsets() -> None:
    lengths = {"spot-6": 80.0, "drill-8": 90.0, "mill-6": 70.0}
    settings = placed(200.0, 10.0, post={"offsets": True})
    settings["measured"]["lengths"] = lengths  # type: ignore[index]
    one = made("linuxcnc", **settings)
    assert "G10 L2 P1 X0 Y0 Z-300\nG10 L2 P2 X200 Y10 Z-300\n" in one.text
    assert one.proof.ok
    del settings["measured"]["more"]  # type: ignore[attr-defined]
    with pytest.raises(ProgramError, match=r"cam\.measured\.more\.G55\.x is not given"):
        made("linuxcnc", **settings)


def test_travel_is_asked_for_at_every_offset() -> None:
    room = {"machine": {"low_x": -100.0, "travel_x": 400.0, "low_y": -200.0, "travel_y": 400.0}}
    one = made("linuxcnc", **placed(200.0, 0.0), **room)
    far = replace(one.job, settings=CamSettings.model_validate({**TWO, **placed(290.0, 0.0), **room}))
    proof = prove(one.text, far)
    assert [check.name for check in proof.failures] == ["travel"]
    assert proof.failures[0].message.startswith("at G55, ")


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"more_offsets": ["G54"]}, "G54 is named twice"),
        ({"more_offsets": ["G55", "G55"]}, "G55 is named twice"),
        ({"measured": {"more": {"G56": {}}}}, "G56 is none of more_offsets"),
    ],
)
def test_each_offset_is_one_plate(settings: dict[str, object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        CamSettings.model_validate({**TWO, **settings})


def test_a_control_that_does_not_write_them_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(type(BY_NAME["linuxcnc"]), "several", False)
    build = mechwright.load("examples/nema-17-pair.toml")
    codes = [finding.code for finding in errors(build.made(Machining).findings)]
    assert codes == ["cam.more-offsets"]


def test_what_does_not_go_with_it_is_refused() -> None:
    restart = CamSettings.model_validate({**TWO, "post": {"restart": True}})
    assert [f.code for f in BY_NAME["fanuc"].check(restart)] == ["cam.restart"]
    with pytest.raises(ProgramError, match=r"leave post\.restart out"):
        made("linuxcnc", post={"restart": True})
    numbered = CamSettings.model_validate({**TWO, "post": {"line_numbers": 10}})
    assert [f.code for f in BY_NAME["haas"].check(numbered)] == ["cam.line-numbers"]
    assert [f.code for f in BY_NAME["siemens-840d"].check(CamSettings(more_offsets=("G58",)))] == [
        "cam.work-offset"
    ]
    with pytest.raises(ProgramError, match="use at most 78"):
        made("fanuc", post={"program_number": 80})


@pytest.mark.parametrize("control", ["linuxcnc", "fanuc", "mach3", "siemens-840d"])
def test_blocks_may_be_numbered(control: str) -> None:
    assert made(control, post={"line_numbers": 10}).proof.ok


def test_the_sheet_lists_every_offset() -> None:
    one = made("fanuc")
    page = setup_html(one.job, one.program, one.proof.as_dict(), BY_NAME["fanuc"])
    assert "G54, G55" in page
    assert "One more plate of the same size for each of G55" in page
    assert "goes to G54 and G55 by itself" in page
    grbl = made("grbl")
    page = setup_html(grbl.job, grbl.program, grbl.proof.as_dict(), BY_NAME["grbl"])
    assert "set G54 and G55 Z so that Z reads h, for each on its own plate" in page


CALLED = (
    "%\nO1\nG21 G17 G40 G90 G94\nG54 S900 M3\nG0 X0. Y0.\nM98 P7{}\nM30\nO7\nG91 G1 X1. F90.\nG90\nM99\n%"
)


@pytest.mark.parametrize(("rounds", "moves"), [("", 1), (" L1", 1), (" L3", 3)])
def test_a_subprogram_is_run_as_often_as_it_is_called(rounds: str, moves: int) -> None:
    run = interpret(CALLED.format(rounds), BY_NAME["fanuc"])
    assert run.end[run.kind == Kind.FEED, 0].tolist() == list(range(1, moves + 1))
    assert run.line[run.kind == Kind.FEED].tolist() == [9] * moves
    assert run.ended
    assert run.beyond == 0


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (("M98 P7", "M98 P8"), "line 6: there is no O8 in this file"),
        (("M98 P7", "M98 P30007"), "line 6: P30007 may be a number"),
        (("M98 P7", "M98 P7 L0"), "line 6: L0"),
        (("M98 P7", "M97 P7"), "line 6: M97 is not read here"),
        (("M99", "G4 P1"), "line 8: O7 has no end"),
        (("M99\n", "M99\nO7\nM99\n"), "line 12: O7 stands twice"),
        (("M30", "M99"), "line 7: M99 in the main program"),
        (("G90\nM99", "M98 P7\nM99"), "line 10: calls are nested"),
    ],
)
def test_what_is_no_subprogram_is_refused_in_its_line(change: tuple[str, str], message: str) -> None:
    with pytest.raises(ProgramError, match=re.escape(message)):
        interpret(CALLED.format("").replace(*change), BY_NAME["fanuc"])


def test_lines_behind_the_end_that_nothing_calls_are_told() -> None:
    text = CALLED.format("").replace("%", "", 1).replace("M99\n%", "M99\nO8\nG0 Z5.\nM99\n%")
    assert interpret("%" + text, BY_NAME["fanuc"]).beyond == 12


def test_what_is_done_elsewhere_is_left_out_of_the_run_at_an_offset() -> None:
    run = interpret(made("linuxcnc").text)
    own = at_offset(run, ["G55"], [(2, 2)])
    offsets = own.of_states(lambda state: state.work_offset)
    assert "G55" not in offsets[own.moving | (own.kind == Kind.HOME)]
    assert (own.kind == Kind.TOOL).sum() == (run.kind == Kind.TOOL).sum()
    assert own.moving.sum() * 2 == run.moving.sum()


def test_second_sides_have_offsets_of_their_own() -> None:
    from golden_case import MORE
    from golden_cases import CASES

    from mechwright_cam.planning.setups import lay_out_setups

    case = CASES["second-side"]
    wrong = {"tools": case.tools, "floor_to_leave": 0, **case.settings, **TWO}
    _, found = lay_out_setups(case.part("plate"), CamSettings.model_validate(wrong), MORE)
    assert "G55 is the first side's" in found[-1].message
