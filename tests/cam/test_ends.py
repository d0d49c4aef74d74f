"""Both ends of every axis in machine coordinates, in every control's own words; what is not known of them is told."""

from dataclasses import replace
from typing import Any

import pytest
from by_control import EVERY, steps
from klartext_blocks import anew
from machine_programs import job_of, judged, text_of

from mechwright_cam.proof.motion_rules import travel
from mechwright_cam.setup.job import Job

WORDS = {
    "siemens-840d": "G0 SUPA {} D0",
    "heidenhain-tnc": "L {} R0 FMAX M91",
    "fanuc": "G53 G0 {}",
    "haas": "G53 G0 {}",
}
"""A rapid in machine coordinates."""
PLACES = (
    ("Z", 300.0, False),
    ("Z", 5.0, False),
    ("Z", -399.0, True),
    ("Z", -401.0, False),
    ("X", 501.0, False),
)
"""Axis, place, and whether it lies within the travel of 500 x 400 x 400 mm."""


def with_settings(job: Job, machine: dict[str, Any], measured: dict[str, float], length: float | None) -> Job:
    cam = job.settings
    changes = {
        "machine": cam.machine.model_copy(update=machine),
        "measured": cam.measured.model_copy(update=measured),
    }
    tools = tuple(tool.model_copy(update={"length": length}) for tool in job.tools)
    return replace(job, settings=cam.model_copy(update=changes), tools=tools)


def at_the_end(control: str, words: str) -> str:
    lines = text_of(control).splitlines()
    at = max(k for k, line in enumerate(lines) if line.split()[-1:] == ["M30"])
    return anew("\n".join([*lines[:at], words, *lines[at:]]) + "\n")


@pytest.mark.parametrize(("axis", "place", "good"), PLACES)
@pytest.mark.parametrize("control", EVERY)
def test_each_control_s_words_lie_within_both_ends(control: str, axis: str, place: float, good: bool) -> None:
    sign = "+" if control == "heidenhain-tnc" and place > 0 else ""
    words = WORDS.get(control, "G53 G0 {}").format(f"{axis}{sign}{place:.1f}")
    found = judged(travel, control, at_the_end(control, words))
    assert found.passed == good, found.message
    assert good or f"goes to machine {axis} {place:g}, and {axis} travels from " in found.message


@pytest.mark.parametrize(("z", "over"), [(-82.0, 0.0), (-80.0, 2.0), (-300.0, 0.0), (-396.0, 2.0)])
@pytest.mark.parametrize("control", ["grbl", "siemens-840d", "fanuc"])
def test_with_the_length_of_the_tool_no_move_leaves_the_upper_or_lower_end(
    control: str, z: float, over: float
) -> None:
    """Its clearance plane is Z5, its lowest cut about Z-9; the tools are 77 mm long, the switch is at machine Z0."""
    job = with_settings(job_of(control), {}, {"x": -250.0, "y": -200.0, "z": z}, 77.0 if z > -200 else 0.0)
    found = judged(travel, control, text_of(control), job)
    assert found.passed == (over == 0.0), found.message
    if over:
        assert "leaves the travel of Z by" in found.message


def test_what_is_not_known_of_the_ends_is_named() -> None:
    job = job_of("linuxcnc")
    said = judged(travel, "linuxcnc", text_of("linuxcnc"), job).message
    for name in ("low_x", "low_y", "measured.x", "measured.y", "measured.z", "the length of T1"):
        assert name in said
    assert "low_z" not in said
    ends = {"low_x": -500.0, "low_y": -400.0, "low_z": -400.0}
    known = with_settings(job, ends, {"x": -250.0, "y": -200.0, "z": -200.0}, 50.0)
    said = judged(travel, "linuxcnc", text_of("linuxcnc"), known).message
    assert said == "all moves are within the machine's travel"


def first_lines(job: Job) -> str:
    reach = (-40.0, -30.0, 40.0, 30.0)
    (first, *_) = steps(job, [1, 2, 3], file_names=["a.nc"], deepest=-6.0, reach=reach)
    return " ".join(first.lines)


def test_the_sheet_tells_it_too() -> None:
    job = job_of("grbl")
    said = first_lines(job)
    assert "The ends of X and Y in machine coordinates are not known ([cam.machine], low_x, low_y)." in said
    assert "Machine Z is taken to travel from −400.0 to 0.0 ([cam.machine], low_z is not given)." in said
    assert "Where the work stands in the machine is not known ([cam.measured], x, y, z)" in said
    assert "jog from X −40.0 to" in said
    ends, place = {"low_x": -500.0, "low_y": -400.0, "low_z": -400.0}, {"x": -250.0, "y": -200.0, "z": -200.0}
    assert "The lengths of T1, T2, T3 are not known" in first_lines(with_settings(job, ends, place, None))
    known = first_lines(with_settings(job, ends, place, 50.0))
    assert "not known" not in known
    assert "jog from" not in known
