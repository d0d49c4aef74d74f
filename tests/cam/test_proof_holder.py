"""Shank and holder against stock, walls and clamp."""

from dataclasses import replace

import pytest
from by_control import asked
from pydantic import ValidationError
from shop import MILL, TOOLS, plate_job, plate_program

from mechwright.contracts.part import Pocket
from mechwright_cam.controls.linuxcnc import LinuxCnc
from mechwright_cam.program.moves import Feed, Operation, Program, Rapid, ToolSection
from mechwright_cam.proof.report import Check
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.holding import Hold
from mechwright_cam.shop.tool import Tool


def held(**changes: float) -> Tool:
    """The mill with a longer reach than flutes, so that shank and holder can be low."""
    return Tool.model_validate({**MILL.model_dump(), **changes})


def check(mill: Tool, name: str = "holder", **settings: object) -> Check:
    job = plate_job(tools=(*TOOLS[:2], mill), **settings)
    return asked(name, LinuxCnc().write(plate_program(mill=mill)), job)


def test_what_the_library_does_not_know_is_not_judged() -> None:
    assert check(MILL).passed


@pytest.mark.parametrize(
    ("stick_out", "width", "passed"), [(6.3, 40, True), (6.25, 40, False), (6.25, 6, True)]
)
def test_a_holder_that_reaches_the_plate_is_found(stick_out: float, width: float, passed: bool) -> None:
    # The cuts go down to -6.3: a holder 6.25 above the tip is 0.05 mm deep, in the channel if it is narrow.
    found = check(held(flute_length=6.25, stick_out=stick_out, holder_diameter=width))
    assert found.passed == passed
    if not passed:
        assert (
            "the holder of T3 (mill-6), 40 mm wide from 6.25 mm above the tip, goes 0.05 mm deep"
            in found.message
        )
        assert found.value == pytest.approx(0.05)


def test_a_thick_shank_rubs_where_the_flutes_end() -> None:
    found = check(held(flute_length=5.0, shank_diameter=8.0))
    assert not found.passed
    assert "the shank of T3 (mill-6), 8 mm wide from 5 mm above the tip, goes 1.30 mm deep" in found.message
    assert check(held(flute_length=5.0, shank_diameter=6.0)).passed


def test_a_holder_may_go_down_where_nothing_is_left() -> None:
    """In a wide recess that has been cleared the holder has room; beside its wall it has none."""
    mill = held(flute_length=2.0, stick_out=2.0, holder_diameter=10.0)
    job = plate_job(tools=(*TOOLS[:2], mill))
    part = replace(
        job.part, machined=(Pocket("p", job.part.features[1].loop, (), 0.0, 3.0), *job.part.features)
    )
    job = replace(job, part=part)

    def row(y: float, z: float, x: float = 20) -> list[object]:
        return [Rapid(-x, y), Rapid(z=1), Feed(None, None, z, 99), Feed(x, y, None, 99), Rapid(z=5)]

    clear = [move for y in range(-10, 11, 2) for move in row(y, -2.0)]

    def found(last: list[object]) -> Check:
        section = ToolSection(mill, 8000, "flood", (Operation("o", (*clear, *last)),))
        return asked("holder", LinuxCnc().write(Program("plate", "G54", 5.0, (section,))), job)

    assert found(row(0, -2.5, 17)).passed
    assert not found(row(9, -2.5, 17)).passed
    # In the other order the stock is still there.
    section = ToolSection(mill, 8000, "flood", (Operation("o", (*row(0, -2.5, 17), *clear)),))
    assert not asked("holder", LinuxCnc().write(Program("plate", "G54", 5.0, (section,))), job).passed


def test_the_holder_misses_the_clamp() -> None:
    def clamped(**changes: float) -> Check:
        hold = Hold(method="bore", clamp_diameter=20, clamp_height=15)
        mill = held(**changes)
        job: Job = plate_job(hold=hold, clearance=20.0, tools=(*TOOLS[:2], mill))
        return asked("clamp", LinuxCnc().write(plate_program(mill=mill)), job)

    found = clamped(stick_out=20.0, holder_diameter=100.0)
    assert not found.passed
    # The tip at -6.3 has the holder's end at 13.7, below the clamp's top at 15.
    assert "into the clamp" in found.message


def test_flutes_do_not_cut_inside_the_holder() -> None:
    with pytest.raises(ValidationError, match="stick_out must be at least flute_length"):
        held(stick_out=5.0)
