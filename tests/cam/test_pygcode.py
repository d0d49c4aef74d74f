"""A parser of other hands reads every control's program as we do."""

from dataclasses import replace

import pytest
from by_control import CONTROLS
from by_night import by_night
from golden_cases import CASES
from golden_operations import made
from golden_programs import every_operation, with_options
from planning_parts import bore, job, plate
from pygcode_reader import agree, needs_pygcode

from mechwright.plugins.host import host
from mechwright_cam.controls.contract import Control
from mechwright_cam.machining import machine
from mechwright_cam.program.moves import Program
from mechwright_cam.shop.posting import Posting

pytestmark = needs_pygcode


def without_cycles(program: Program) -> Program:
    """It takes a cycle for one move to the bottom; written out, every move can be compared."""
    return replace(program, posting=program.posting.model_copy(update={"cycles": False}))


@pytest.mark.parametrize("control", CONTROLS)
def test_kept_programs(control: str) -> None:
    for program in (every_operation(), with_options()):
        text = host().get(Control, control).write(without_cycles(program))
        assert agree([text], control, program.machine.retract_z) > 50


@pytest.mark.parametrize(
    "control", [pytest.param(one, marks=() if one in {"fanuc", "grbl"} else by_night) for one in CONTROLS]
)
def test_every_operation(control: str) -> None:
    cases = [name for name in CASES if not name.startswith("tap")]  # no move writes them out
    if control != "grbl":
        cases.remove("offsets")  # it knows no subprograms
    programs = [one.program for operation in cases for one in made(operation, control)]
    texts = [host().get(Control, control).write(without_cycles(program)) for program in programs]
    assert agree(texts, control, 0.0) > 20 * len(texts)


@pytest.mark.parametrize("control", CONTROLS)
def test_planned_programs(control: str) -> None:
    settings = {"control": control, "post": Posting(cycles=False)}
    made_of = machine(
        job(plate(bore(12.0)), "spot-6", "drill-8", "mill-6", **settings), host().get(Control, control)
    )
    assert agree([*made_of.files.values()], control, 0.0) > 150
