"""Keys and keyed hubs: loose where the torque keeps its sense, tight where it changes it, or by choice."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mechwright import host
from mechwright.contracts.fit_settings import FitSettings
from mechwright.contracts.fits import shaft_fit
from mechwright.contracts.part import Instance, Part
from mechwright.contracts.turned import KeySeat, Step, Turned
from mechwright.designs.design import design_of, load
from mechwright.geometry.keyway import key_of_width
from mechwright.machine import MachineSettings, drive_of
from mechwright.machine.drive import SAMPLES
from mechwright.mechanics.mating.key_seats import with_key_seats
from mechwright.standards.keys import Key
from mechwright_cad.assembly_guide.tools import keyed

ROOT = Path(__file__).parents[2]
STEPS = (Step(10, 8, shaft_fit(10, "j6")), Step(16, 4), Step(12, 10, shaft_fit(12, "h6")), Step(10, 8))
SHAFT = Turned(STEPS, seats=(KeySeat(13.0, 8.0, 4.0, 3.5),))


def shaft(form=SHAFT):
    return Part("shaft", None, 0.0, "steel", (Instance("wheel"),), turned=form)


@pytest.mark.parametrize(
    ("key", "reverses", "seat", "hub"),
    [
        ("auto", False, "N9", "h6"),
        ("auto", True, "P9", "j6"),
        ("N9", True, "N9", "h6"),
        ("P9", False, "P9", "j6"),
    ],
)
def test_a_reversing_torque_or_a_choice_makes_the_seat_tight(key, reverses, seat, hub):
    (found,) = with_key_seats([shaft()], FitSettings(key=key), reverses=reverses)
    assert [one.limits for one in found.turned.seats] == [seat]
    # The step under the hub alone: bearings keep theirs, and so does a step that says nothing.
    assert [one.fit and one.fit.name for one in found.turned.steps] == ["j6", None, hub, None]


def test_a_shaft_without_a_key_keeps_its_fits():
    plain = shaft(replace(SHAFT, seats=()))
    assert with_key_seats([plain], FitSettings(), reverses=True) == [plain]


def design(name, **fits):
    content = load(ROOT / "examples" / f"{name}.toml", host()).content
    return design_of({**content, "fits": fits} if fits else content, Path("d.toml"), "", host())


def test_the_drive_of_a_train_changes_its_sense_and_that_of_a_loaded_pair_does_not():
    pair = design("elliptic-pair-machine")
    assert [part.turned.seats[0].limits for part in pair.parts() if part.name.startswith("shaft-")] == [
        "N9"
    ] * 2
    chosen = design("elliptic-pair-machine", key="P9")
    for part in chosen.parts():
        if part.name.startswith("shaft-"):
            assert [one.limits for one in part.turned.seats] == ["P9"]
            assert [step.fit.name for step in part.turned.steps if step.fit and step.diameter == 12] == ["j6"]
    (around,) = design("figure-eight-machine").surroundings
    assert around.reverses


@pytest.mark.parametrize(("load", "reverses"), [(0.0, True), (0.1, False)])
def test_a_drive_reverses_where_its_torque_has_both_signs(load, reverses):
    found = design("elliptic-pair-machine")
    motion = found.family.solve(found.params, SAMPLES)
    drive = drive_of(motion, found.family.parts(found.params), MachineSettings(load=load, speed=60))
    low, high = (f(run.torque) for f, run in zip((np.min, np.max), drive.runs * 2, strict=False))
    assert drive.reverses is reverses is bool(low < -0.01 * max(high, -low) and high > 0)


@pytest.mark.parametrize(("seat", "tight", "loose"), [("N9", 0.030, 0.030), ("P9", 0.042, 0.018)])
def test_the_guide_says_how_tightly_a_key_sits(seat, tight, loose):
    """4 h9 is 0/-0.030, 4 N9 -0.030/0, 4 P9 -0.042/-0.012 (ISO 286-2)."""
    part = shaft(replace(SHAFT, seats=(replace(SHAFT.seats[0], limits=seat),)))
    bought = Key(key_of_width(4.0), 8).bought(12.0)
    key = Part("key", None, 0.0, "steel", (Instance("wheel"),), bought=bought)
    said = keyed(key, [(7, part)], lambda k: f"shaft ({k})")
    assert said.startswith(
        f"Its seat in shaft (7), 4 {seat} / h9, is from {tight:.3f} mm tight to {loose:.3f} mm"
    )
    assert keyed(part, [(7, part)], str) == ""
    assert keyed(key, [(7, shaft(replace(SHAFT, seats=())))], str) == ""
    elsewhere = replace(key, instances=(Instance("crank"),))
    assert keyed(elsewhere, [(7, part)], str) == ""
