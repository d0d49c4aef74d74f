"""What is said before the first move, how fast an edge runs, how far cuts go out: limits on both sides."""

import math
from dataclasses import replace

import pytest
from by_control import BY_NAME, LINUXCNC, asked, scene_of
from shop import MILL, plate_job

from mechwright_cam.controls.contract import Control
from mechwright_cam.proof.cutting_rules import BEYOND
from mechwright_cam.proof.tool_collisions import bodies
from mechwright_cam.shop.tool import CuttingData, Tool, ToolKind

WORDS = ("G17", "G21", "G40", "G90")


def program(words: tuple[str, ...], speed: int = 8000) -> str:
    head = f"{' '.join(words)} G94\nG53 G0 Z0\nT3 M6\nG54 S{speed} M3\nG0 X-50 Y0\nG43 H3 Z5\n"
    return f"{head}G1 Z-1 F100\nX0 F300\nG0 Z5\nG53 G0 Z0\nM30\n"


@pytest.mark.parametrize("missing", WORDS)
def test_a_mode_that_is_not_said_is_named(missing: str) -> None:
    assert asked("modes", program(WORDS), plate_job()).passed
    found = asked("modes", program(tuple(word for word in WORDS if word != missing)), plate_job())
    assert not found.passed
    said = "G21" if missing == "G21" else missing
    assert f"moves before {said}" in found.message or f"before {said}" in found.message


def test_a_control_that_does_not_compensate_needs_no_word_for_it() -> None:
    grbl: Control = BY_NAME["grbl"]
    text = "G17 G21 G90 G94\nG54 S8000 M3\nG0 X-50 Y0\nZ5\nG1 Z-1 F100\nX0 F300\nG0 Z5\nM30\n"
    assert "G40" not in asked("modes", text, plate_job(control="grbl"), grbl).message


@pytest.mark.parametrize("cutting_speed", [100.0, 210.0])
def test_the_edge_may_run_so_much_faster_and_a_turn_a_minute(cutting_speed: float) -> None:
    data = {"aluminium": CuttingData(cutting_speed=cutting_speed, chip_load=0.04)}
    job = replace(plate_job(), tools=(MILL.model_copy(update={"cutting": data}),))
    highest = 1000 * BEYOND * cutting_speed / (math.pi * 6)
    assert asked("cutting-speed", program(WORDS, math.floor(highest + 1)), job).passed
    found = asked("cutting-speed", program(WORDS, math.floor(highest + 2)), job)
    assert not found.passed
    assert found.limit == pytest.approx(BEYOND * cutting_speed)
    assert found.value == pytest.approx(math.pi * 6 * math.floor(highest + 2) / 1000)


def test_shanks_are_bodies_where_they_are_wider_than_the_cutter() -> None:
    def told(**known: float) -> list[tuple[str, float, float]]:
        job = replace(plate_job(), tools=(MILL.model_copy(update=known),))
        found = bodies(scene_of(program(WORDS), job, LINUXCNC))
        return [(body.name, body.lift, body.radius) for body in found]

    assert told() == []
    assert told(shank_diameter=6.0) == []
    assert told(shank_diameter=5.0) == []
    assert told(shank_diameter=8.0) == [("shank", 12.0, 4.0)]
    assert told(stick_out=20.0, holder_diameter=30.0) == [("holder", 20.0, 15.0)]
    assert len(told(shank_diameter=8.0, stick_out=20.0)) == 2


def test_a_cut_beside_the_stock_goes_out_by_three_diameters_and_three_millimetres() -> None:
    """The stock ends at X39 and Y29, and the mill of 6 mm may go on by 21 mm."""
    job = plate_job()
    assert job.stock == (-39.0, -29.0, 39.0, 29.0)
    for axis, end in (("X", 60.0), ("X", -60.0), ("Y", 50.0), ("Y", -50.0)):
        far = math.copysign(0.01, end)
        texts = [program(WORDS).replace("X0 F300", f"X0 F300\n{axis}{at:.2f}") for at in (end, end + far)]
        assert asked("beside", texts[0], job).passed
        found = asked("beside", texts[1], job)
        assert not found.passed
        assert (found.value, found.limit) == (pytest.approx(21.01), pytest.approx(21.0))


@pytest.mark.parametrize("neck", [None, 3.0])
def test_a_neck_in_material_is_told_with_its_width(neck: float | None) -> None:
    mill = Tool(
        name="thread-6", number=3, kind=ToolKind.THREAD_MILL, diameter=6, flute_length=12, neck_diameter=neck
    )
    wide = 4.2 if neck is None else neck
    found = asked("edges", program(WORDS), replace(plate_job(), tools=(mill,)))
    assert not found.passed
    assert f"with its neck of {wide:g} mm" in found.message
    assert found.value == pytest.approx(wide)
