"""Programs of a machine that does not know its zero: words of the work alone, and faults in them."""

import re

import pytest
from by_control import BY_NAME, prove, settled
from planning_parts import bore, plate
from planning_parts import job as planned
from shop import plate_job, plate_program

from mechwright_cam.machining import machine as machined
from mechwright_cam.shop.settings import CamSettings

GRBL = BY_NAME["grbl"]
MACHINE = {"homing": "none", "travel_z": 45}


@pytest.fixture(scope="module")
def job():
    return planned(plate(bore(12.0), material="pom"), "drill-8", "mill-6", control="grbl", machine=MACHINE)


@pytest.fixture(scope="module")
def files(job) -> dict[str, str]:
    made = machined(job, GRBL)
    return dict(made.files)


def test_no_word_is_a_machine_coordinate_and_each_file_begins_and_ends_above_everything(files) -> None:
    for text in files.values():
        lines = [line for line in text.splitlines() if not line.startswith("(")]
        words = {word for line in lines for word in line.split()}
        assert not words & {"G53", "G28", "G30", "G92"}
        moves = [line for line in lines if re.search("[XYZ]", line)]
        assert moves[0] == "G0 Z5"
        assert re.fullmatch("T[0-9]+", lines[lines.index(moves[0]) - 1])
        assert lines[lines.index(moves[0]) - 2] == "G54"
        assert moves[-1] in {"X0 Y0", "G0 Z5"}


def test_it_is_proven(job, files) -> None:
    assert prove(files, job, GRBL).ok


def _without(text: str, line: str) -> str:
    lines = text.splitlines(keepends=True)
    lines.remove(line + "\n")
    return "".join(lines)


FAULTS = {
    "machine Z before all": lambda text: text.replace("G0 Z5", "G53 G0 Z-2\nG0 Z5", 1),
    "machine Z at the end": lambda text: text.replace("X0 Y0", "G53 G0 Z-2\nX0 Y0"),
    "reference point": lambda text: text.replace("G0 Z5", "G91 G28 Z0\nG90\nG0 Z5", 1),
    "second reference point": lambda text: text.replace("X0 Y0", "G91 G30 Z0\nG90\nX0 Y0"),
    "zero shifted": lambda text: text.replace("G0 Z5", "G92 Z0\nG0 Z5", 1),
    "no way up first": lambda text: _without(text, "G0 Z5"),
    "sideways first": lambda text: text.replace("G0 Z5", "G0 X0 Y0 Z5", 1),
    "down first": lambda text: text.replace("G0 Z5", "G0 Z-1", 1),
    "low first": lambda text: text.replace("G0 Z5", "G0 Z0.2", 1),
    "fed first": lambda text: text.replace("G0 Z5", "G1 Z5 F100", 1),
    "by a distance first": lambda text: text.replace("G0 Z5", "G91 G0 Z5\nG90", 1),
    "left low": lambda text: text.replace("G0 Z5\nX0 Y0", "G0 Z0.1\nX0 Y0"),
    "no work offset": lambda text: text.replace("G54\n", "").replace("G54 ", ""),
    "another work offset": lambda text: text.replace("G54", "G55"),
    "Z beyond the travel": lambda text: text.replace("G0 Z5\nX0 Y0", "G0 Z60\nX0 Y0"),
    "no end": lambda text: text.replace("M30\n", ""),
    "no tool": lambda text: "".join(
        line for line in text.splitlines(keepends=True) if not line.startswith("T")
    ),
    "another tool": lambda text: re.sub(r"^T\d+$", "T77", text, flags=re.M),
    "modes left out": lambda text: text.replace("G17 G21 G40 G49 G80 G90 G91.1 G94\n", ""),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_is_found_in_every_file(job, files, fault) -> None:
    seen = 0
    for name, text in files.items():
        wrong = FAULTS[fault](text)
        if wrong == text:
            continue
        seen += 1
        try:
            assert not prove({**files, name: wrong}, job, GRBL).ok, name
        except ValueError:  # not readable is found, too
            continue
    assert seen


@pytest.mark.parametrize("name", [name for name in BY_NAME if name != "grbl"])
def test_a_control_that_changes_tools_at_the_upper_end_wants_a_zero(name) -> None:
    settings = CamSettings.model_validate({"machine": MACHINE})
    (found,) = (one for one in BY_NAME[name].check(settings) if one.code == "cam.homing")
    assert 'homing = "marks"' in found.remedy
    assert not any(
        one.code == "cam.homing"
        for one in BY_NAME[name].check(CamSettings.model_validate({"machine": {"homing": "marks"}}))
    )


def test_marks_set_no_zero_on_grbl() -> None:
    (found,) = (
        one
        for one in GRBL.check(CamSettings.model_validate({"machine": {"homing": "marks"}}))
        if one.code == "cam.homing"
    )
    assert 'homing = "none"' in found.remedy


def test_a_stop_for_the_tool_and_a_length_in_the_program_are_refused() -> None:
    stop = CamSettings.model_validate({"machine": MACHINE, "post": {"tool_change": "pause"}})
    assert "cam.homing" in {one.code for one in GRBL.check(stop)}
    of = plate_job(control="grbl", machine=MACHINE)
    long = [tool.model_copy(update={"length": 10.0}) for tool in of.tools]
    assert "cam.homing" in {one.code for one in GRBL.check_tools(of.settings, long)}


@pytest.mark.parametrize("key", ["low_z", "retract_z", "home_x", "change_y"])
def test_a_place_in_machine_coordinates_has_no_meaning_without_a_zero(key) -> None:
    with pytest.raises(ValueError, match=f"{key} is a machine coordinate"):
        CamSettings.model_validate({"machine": {**MACHINE, key: 0.0}})


def test_a_machine_with_switches_goes_by_its_zero_as_before() -> None:
    of = plate_job(control="grbl")
    assert "G53 G0 Z-2" in GRBL.write(settled(plate_program(), of, GRBL))
