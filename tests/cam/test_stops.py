"""Stops: which of them sets the clamp, and what a program may rely on after one."""

from dataclasses import replace

import pytest
from golden_operations import CONTROLS, made
from mechwright_cam.pipeline import machine
from planning_parts import bore, job, plate

from mechwright.plugins.host import host
from mechwright_cam.controls.reading import DIALECTS, Kind, interpret
from mechwright_cam.proof import prove
from mechwright_cam.shop.posting import Posting

HELD = {"hold": {"method": "bore", "clamp_diameter": 10, "clamp_height": 8}}


def failed(text: str, control: str) -> set[str]:
    (one,) = made("profile-outside", control)
    return {check.name for check in prove(text, one.job, DIALECTS[control]).failures}


@pytest.mark.parametrize("control", CONTROLS)
def test_without_its_stop_the_clamp_was_there_from_the_start(control: str) -> None:
    (one,) = made("profile-outside", control)
    lines = one.text.splitlines()
    last = max(number for number, line in enumerate(lines) if line == "M0")
    assert failed("\n".join([*lines[:last], *lines[last + 1 :], ""]), control) == {"clamp"}


@pytest.mark.parametrize("control", CONTROLS)
def test_an_optional_stop_sets_no_clamp(control: str) -> None:
    settings = {"control": control, "post": Posting(optional_stops=True, tool_change="pause"), **HELD}
    of = job(plate(bore(12.0)), "spot-6", "drill-8", "mill-6", **settings)
    made_of = machine(of, host().post(control))
    assert made_of.text.count("\nM1\n") == 2
    plain = made_of.text.replace("\nM0\n(", "\n(").replace("\nM0\nS", "\nS")
    kinds = interpret(made_of.text, DIALECTS[control]).kind
    assert list(kinds).count(Kind.MAYBE) == 2
    assert "clamp" in {check.name for check in prove(plain, of, DIALECTS[control]).failures}


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
    for control, dialect in DIALECTS.items():
        if control == "grbl":
            continue
        run = interpret(text, replace(dialect, percent=True))
        assert run.states[run.state[-1]].length_offset == (None if control in {"fanuc", "haas"} else 1)


def test_a_clamp_is_set_within_the_file_of_a_tool() -> None:
    settings = {"control": "grbl", "machine": {"retract_z": -2.0}, **HELD}
    of = job(plate(bore(12.0)), "spot-6", "drill-8", "mill-6", **settings)
    one = machine(of, host().post("grbl"))
    assert [name.rpartition("-t")[2] for name in one.files] == ["1", "9", "24"]
    # No stop for a tool, which is in the spindle already, and one for the clamp.
    assert [text.splitlines().count("M0") for text in one.files.values()] == [0, 0, 1]
    before, after = list(one.files.values())[-1].split("\nM0\n")
    assert before.splitlines()[-4:-1] == ["M9", "M5", "G53 G0 Z-2"]
    assert {"M3", "M8", "G49"} <= set(" ".join(after.splitlines()[:5]).split())
    assert one.proof.ok
    assert isinstance(one.proven, dict)
    last = list(one.proven)[-1]
    for gone in ({last: f"{before}\n{after}"}, {last: one.proven[last].replace("M5\nG53", "G53", 1)}):
        faults = prove({**one.proven, **gone}, one.job, DIALECTS["grbl"]).failures
        assert {check.name for check in faults} & {"clamp", "stops"}, faults


def test_a_clamp_may_be_set_at_the_end_of_a_file() -> None:
    settings = {"control": "grbl", "machine": {"retract_z": -2.0}, **HELD}
    of = job(plate(bore(12.0)), "spot-6", "drill-8", "mill-6", "mill-3", **settings)
    one = machine(of, host().post("grbl"))
    with_stop = [text for text in one.files.values() if "M0" in text.splitlines()]
    assert len(with_stop) == 1
    assert one.proof.ok
