"""Plates on a vacuum table, on tape, under toe clamps: planned, proven, and told on the setup sheet."""

import pytest
from by_control import BY_NAME, prove
from planning_parts import bore, job, part, plate, rounded_box
from pydantic import ValidationError

from mechwright.errors import ProofError
from mechwright_cam.controls.linuxcnc import LinuxCnc
from mechwright_cam.machining import machine
from mechwright_cam.pages.setup_sheet.procedure import steps
from mechwright_cam.proof import Scene
from mechwright_cam.proof.holding import holding
from mechwright_cam.shop.holding import Hold

TOOLS = ("spot-6", "drill-8", "mill-6")


def held(**hold: object) -> object:
    return job(plate(bore(12.0)), *TOOLS, hold={"method": "none", **hold})


@pytest.mark.parametrize("bed", ["vacuum", "tape"])
def test_a_plate_held_from_below_needs_no_tabs(bed: str) -> None:
    of = held(bed=bed)
    made = machine(of, LinuxCnc())  # type: ignore[arg-type]
    assert made.proof.ok
    assert not made.job.tabs
    (_, stock, *_) = steps(made.job, LinuxCnc(), [1], file_names=["a.ngc"], deepest=-4.3)
    assert ("vacuum table" if bed == "vacuum" else "double-sided tape") in " ".join(stock.lines)
    tabs = job(plate(bore(12.0)), *TOOLS)
    assert "tabs" in {check.name for check in prove(made.text, tabs).failures}


def test_toe_clamps_hold_what_is_under_them_and_stand_in_the_way() -> None:
    of = held(bed="tape")
    text = machine(of, LinuxCnc()).text  # type: ignore[arg-type]
    x0, y0, _, _ = of.stock  # type: ignore[attr-defined]
    on_frame = held(toe_clamps=[[x0 - 20, y0 + 5, x0 + 2, y0 + 25, 3.0]])
    found = holding(Scene(text, on_frame, BY_NAME["linuxcnc"]))  # type: ignore[arg-type]
    assert not found.passed
    assert "the part comes loose" in found.message
    assert "hold it by tape (cam.hold.bed), or with one more of cam.hold.toe_clamps" in found.message
    with pytest.raises(ProofError, match="the part comes loose"):
        machine(on_frame, LinuxCnc())  # type: ignore[arg-type]
    in_the_way = held(bed="tape", toe_clamps=[[-5, y0 - 20, 5, y0 + 12, 3.0]])
    checks = prove(text, in_the_way).checks  # type: ignore[arg-type]
    assert "into toe clamp 1 (up to Z3)" in checks["clamp"].message
    beside = held(bed="tape", toe_clamps=[[x0 - 30, y0 - 20, x0 - 20, y0 - 10, 3.0]])
    made = machine(beside, LinuxCnc())  # type: ignore[arg-type]
    assert made.program.clearance == 8.0  # over the clamp
    said = " ".join(steps(beside, LinuxCnc(), [1], file_names=["a"], deepest=-4.3)[1].lines)  # type: ignore[arg-type]
    assert "Toe clamp 1: from X" in said
    assert "no higher than Z +3.0" in said


def test_a_small_part_slips_on_a_vacuum() -> None:
    of = held(bed="vacuum")
    made = machine(of, LinuxCnc())  # type: ignore[arg-type]
    small = job(part(rounded_box(26, 22, 4), bore(8.0)), *TOOLS, hold={"method": "none", "bed": "vacuum"})
    assert made.proof.ok
    with pytest.raises(ProofError, match="leave pieces of 500 mm² at least, or tabs"):
        machine(small, LinuxCnc())
    tape = job(part(rounded_box(26, 22, 4), bore(8.0)), *TOOLS, hold={"method": "none", "bed": "tape"})
    assert machine(tape, LinuxCnc()).proof.ok


@pytest.mark.parametrize(
    ("hold", "said"),
    [
        ({"method": "none"}, "needs what holds instead; write bed or toe_clamps"),
        ({"bed": "tape"}, 'bed and toe_clamps are for method = "none", and not for "tabs"'),
        ({"method": "vice", "toe_clamps": [[0, 0, 1, 1, 1]]}, 'and not for "vice"'),
        ({"method": "none", "toe_clamps": [[0, 0, 0, 1, 1]]}, "is no clamp on the plate"),
        (
            {"method": "none", "toe_clamps": [[0, 0, 1, 1, 0]]},
            "with x0 below x1, y0 below y1 and top above 0",
        ),
    ],
)
def test_what_does_not_hold_is_refused(hold: dict[str, object], said: str) -> None:
    with pytest.raises(ValidationError, match=said):
        Hold.model_validate(hold)
