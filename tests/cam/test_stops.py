"""Stops: which of them sets the clamp, and what a program may rely on after one."""

from dataclasses import replace

import pytest
from by_control import BY_NAME, CONTROLS, asked, interpret, prove
from golden_operations import made
from planning_parts import bore, job, plate

from mechwright.plugins.host import host
from mechwright_cam.controls.contract import Control
from mechwright_cam.controls.reading import Kind
from mechwright_cam.machining import machine
from mechwright_cam.shop.posting import Posting

HELD = {"hold": {"method": "bore", "clamp_diameter": 10, "clamp_height": 8}}


def failed(text: str, control: str) -> set[str]:
    (one,) = made("profile-outside", control)
    return {check.name for check in prove(text, one.job, BY_NAME[control]).failures}


@pytest.mark.parametrize("control", CONTROLS)
def test_without_its_stop_the_clamp_stands_in_the_way_from_the_start_and_holds_nothing(control: str) -> None:
    (one,) = made("profile-outside", control)
    lines = one.text.splitlines()
    last = max(number for number, line in enumerate(lines) if line == "M0")
    assert failed("\n".join([*lines[:last], *lines[last + 1 :], ""]), control) == {"clamp", "holding"}


@pytest.mark.parametrize("control", CONTROLS)
def test_an_optional_stop_sets_no_clamp(control: str) -> None:
    settings = {"control": control, "post": Posting(optional_stops=True, tool_change="pause"), **HELD}
    of = job(plate(bore(12.0)), "spot-6", "drill-8", "mill-6", **settings)
    made_of = machine(of, host().get(Control, control))
    assert made_of.text.count("\nM1\n") == 2
    plain = made_of.text.replace("\nM0\n(", "\n(").replace("\nM0\nS", "\nS")
    kinds = interpret(made_of.text, BY_NAME[control]).kind
    assert list(kinds).count(Kind.MAYBE) == 2
    assert "clamp" in {check.name for check in prove(plain, of, BY_NAME[control]).failures}


@pytest.mark.parametrize("control", CONTROLS)
@pytest.mark.parametrize("stop", ["M0", "M1"])
@pytest.mark.parametrize(
    ("before", "said"),
    [
        ("", "at stops spindle and coolant are off and the tool is up"),
        ("M3\n", "stops the program while the spindle turns; write M5 before it"),
        ("M8\n", "stops the program while coolant runs; write M9 before it"),
        ("G1 Z-1. F100.\n", "stops the program with the tool down; before it retract"),
    ],
)
def test_a_stop_that_a_switch_makes_is_judged_as_any(before: str, said: str, stop: str, control: str) -> None:
    (one,) = made("profile-outside", control)
    head, after = one.text.rsplit("\nM5\n", 1)
    found = asked("stops", f"{head}\nM5\n{before}{stop}\n{after}", one.job, BY_NAME[control])
    assert (stop if before else "") + " " * bool(before) + said in found.message


@pytest.mark.parametrize("control", ["fanuc", "haas"])
def test_a_spindle_that_is_turned_to_its_mark_stands_still(control: str) -> None:
    (one,) = made("profile-outside", control)
    head, after = one.text.rsplit("\nM8\n", 1)
    assert failed(f"{head}\nM19\nM8\n{after}", control) == {"spindle"}
    assert not failed(f"{head}\nM19\nM3\nM8\n{after}", control)


@pytest.mark.parametrize("control", CONTROLS)
def test_the_length_offset_is_stated_anew_after_a_stop(control: str) -> None:
    (one,) = made("profile-outside", control)
    head, after = one.text.rsplit("\nM0\n", 1)
    word = "G49\n" if control == "grbl" else "G43 H23 "
    assert after.count(word) == 1
    # Where the way to the top is a G28, G43 may be gone; a G53 leaves it in force.
    expected = {"length-offset"} if control == "fanuc" else set()
    assert failed(f"{head}\nM0\n{after.replace(word, '')}", control) == expected


def test_a_reference_return_ends_the_length_offset_on_fanuc_and_haas_only() -> None:
    text = "G21 G90 G17\nT1 M6\nG54 S1000 M3\nG0 X0. Y0.\nG43 H1 Z5.\nG91 G28 Z0.\nG90\nG0 X3.\nM30\n"
    for control in CONTROLS:
        if control == "grbl":
            continue
        reader = BY_NAME[control]
        run = interpret(text, replace(reader.dialect, text=replace(reader.dialect.text, percent=True)))
        assert run.states[run.state[-1]].length_offset == (None if control in {"fanuc", "haas"} else 1)


@pytest.mark.parametrize("control", ["linuxcnc", "fanuc", "haas", "mach3"])
def test_coolant_is_stated_anew_after_a_change_of_tool_where_that_may_stop_it(control: str) -> None:
    (one,) = made("drill", control)
    first, second = one.text.split("\nM9\n", 1)
    head, after = second.rsplit("\nM8\n", 1)
    found = prove(f"{first}\n{head}\n{after}", one.job, BY_NAME[control])
    assert {check.name for check in found.failures} == (
        {"coolant"} if control in {"fanuc", "haas"} else set()
    )
