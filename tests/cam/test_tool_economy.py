"""Tools that a workshop would not change for nothing, and cutters that fit their holes."""

import pytest
from planning_parts import LIBRARY, bore, job, plate, rounded_box

from mechwright_cam.controls.linuxcnc import LinuxCnc
from mechwright_cam.planning import choose_tools, plan
from mechwright_cam.shop.settings import CamSettings

SLOT = rounded_box(40, 8.05, 4.02, clockwise=True)


def names(of, **settings):
    return [tool.name for tool in choose_tools(of, CamSettings.model_validate(settings), LIBRARY)]


def test_a_slot_is_not_cut_by_a_mill_as_wide_as_it():
    program = plan(job(plate(SLOT), "mill-8", "mill-5"))
    tools = {o.name: s.tool.name for s in program.sections for o in s.operations}
    assert tools["opening-1: finish"] == "mill-5"
    assert tools["outside: finish"] == "mill-8"


def test_a_lone_mill_as_wide_as_the_slot_still_cuts_it():
    program = plan(job(plate(SLOT), "mill-8"))
    assert any(o.name.startswith("opening-1") for s in program.sections for o in s.operations)


def test_one_mill_and_one_drill_serve_bores_of_like_size():
    found = names(plate(bore(10, (-15, 0)), bore(8, (15, 0)), material="steel"))
    assert found == ["spot-6", "drill-6", "mill-6", "mill-5"] or found == ["spot-6", "drill-6", "mill-5"]


def test_bores_of_very_different_size_have_their_own_drills():
    found = names(plate(bore(16, (-15, 0)), bore(5, (15, 0))))
    assert [name for name in found if name.startswith("drill")] == ["drill-12", "drill-4"]


def test_the_spindle_stays_off_between_the_stop_for_the_clamp_and_the_next_tool():
    held = job(
        plate(bore(12)),
        *("spot-6", "drill-5", "mill-10", "mill-6"),
        hold={"method": "bore", "clamp_diameter": 16},
    )
    lines = LinuxCnc().write(plan(held)).splitlines()
    after = lines[lines.index("M0") + 1 :]
    change = next(number for number, line in enumerate(after) if "M6" in line)
    assert not any("M3" in line or "M8" in line for line in after[:change])


def test_the_spindle_starts_again_if_the_tool_stays():
    held = job(plate(bore(12)), "mill-6", hold={"method": "bore", "clamp_diameter": 16})
    lines = LinuxCnc().write(plan(held)).splitlines()
    after = lines[lines.index("M0") + 1 :]
    start = next(number for number, line in enumerate(after) if "M3" in line)
    assert start < next(number for number, line in enumerate(after) if line.startswith("G1"))


def test_a_wide_bore_is_not_left_to_the_mill_of_a_narrow_one():
    of = plate(bore(3, (-15, 0)), bore(6.75, (15, 0)), thickness=10)
    program = plan(job(of, *names(of)))
    bored = {o.name: s.tool.name for s in program.sections for o in s.operations}
    assert bored["bore-1: finish"] == "mill-2"
    assert bored["bore-2: finish"] == "mill-4"


@pytest.mark.parametrize(
    ("count", "change", "pays"), [(1, 0, False), (2, 0, True), (2, 90, False), (8, 90, True)]
)
def test_one_more_mill_for_bores_has_to_save_more_than_its_change(count, change, pays):
    """Each of 5 mm takes half a minute longer with the mill that another bore asks for anyway."""
    wide = [bore(5, (7 * i - 22, -11)) for i in range(count)]
    found = names(plate(bore(3, (-15, 0)), *wide), machine={"tool_change": change})
    assert "mill-2" in found
    assert ("mill-3" in found) == pays
