"""Programs of a machine that does not know its zero: words of the work alone, and faults in them."""

import re

import pytest
from by_control import BY_NAME, prove, read, settled
from by_night import NIGHT, examples
from mutant_traces import differences, trace
from planning_parts import bore, plate
from planning_parts import job as planned
from programs_without_homing import FAULTS, MORE_PARTS, PARTS, faulty
from shop import plate_job, plate_program
from test_mutations import SURE

from mechwright.errors import ProgramError
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
    assert seen or fault in {"machine Z in the middle", "a length"}


def test_planted_faults_are_refused_or_the_machine_does_the_same() -> None:
    """Those kinds of fault that change what is cut wherever they stand; benchmarks/mutations.py takes all."""
    refused, other = 0, []
    parts = (*PARTS, *MORE_PARTS) if NIGHT else PARTS[:3]
    for one, made in faulty(examples(40, 300), 52, parts, (*FAULTS, *SURE)):
        try:
            if not prove(made.text, one.job, GRBL).ok:
                refused += 1
                continue
        except ProgramError:
            refused += 1
            continue
        before, after = (trace(read(text, one.job, GRBL)) for text in (one.text, made.text))
        if changed := differences(before, after):
            other.append((one.name, made.kind, made.change, changed))
    assert not other
    assert refused > (240 if NIGHT else 30)


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
