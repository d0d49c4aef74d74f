"""The torque of a screwed joint, and the screw for a blind thread of a bought part."""

import json
import math
from pathlib import Path

import pytest

from mechwright import DesignError
from mechwright.contracts.threads import COARSE
from mechwright.machine.frame.base import base_stock, foot
from mechwright.machine.frame.coupled import motor_fixing
from mechwright.machine.frame.fixing import WASHERS, fixing
from mechwright.machine.frame.pillars import SPARE
from mechwright.mechanics.strength.allowed import ALLOWED
from mechwright.mechanics.strength.bolts import (
    PROOF,
    friction_of,
    preload,
    stress_area,
    tightening_torque,
    yield_preload,
)
from mechwright.mechanics.strength.tightening import (
    LEAST_ENGAGED,
    SCREW_SHEAR,
    Clamped,
    bond_torque,
    strip_force,
    tightening,
)
from mechwright.standards.motors import motor_faces
from mechwright.standards.screws import screw_size
from mechwright.standards.stock import plate_stock

PRELOADS = json.loads(
    (Path(__file__).parents[1] / "data" / "screw-preloads.json").read_text(encoding="utf-8")
)
DATA = json.loads((Path(__file__).parents[1] / "data" / "thread-strip.json").read_text(encoding="utf-8"))
M5 = (5.0, 0.8, 8.5, 5.5)


@pytest.mark.parametrize("case", DATA["cases"], ids=lambda one: f"{one['thread']} in {one['into']}")
def test_threads_strip_where_the_reference_has_it(case):
    """The reference counts the nut's turns alone; in a hard part the screw's own strip first."""
    size, shear = float(case["thread"][1:]), DATA["shear"][case["into"]]
    pitch = COARSE[size]
    grade = case["class"] if case["class"] in SCREW_SHEAR else "8.8"
    found = strip_force(size, pitch, case["engaged"], shear, grade)
    if shear < 300:
        assert found == pytest.approx(case["strips_at"], rel=1e-4)
    else:
        assert found <= case["strips_at"] * (1 + 1e-4)


@pytest.mark.parametrize("case", PRELOADS["cases"], ids=lambda one: f"{one['thread']} {one['class']}")
def test_preloads_and_torques_are_the_references(case):
    of, proof, friction = screw_size(float(case["thread"][1:])), PROOF[case["class"]], case["friction"]
    area = stress_area(of.size, of.pitch)
    assert area == pytest.approx(case["stress_area"], rel=1e-6)
    for name, force in (
        ("0.9", yield_preload(of.size, of.pitch, proof, friction)),
        ("0.7_area", preload(area, proof)),
    ):
        assert force == pytest.approx(case[f"preload_{name}"], rel=1e-6)
        torque = tightening_torque(force, of.size, of.pitch, of.head, of.clearance(), friction)
        assert torque == pytest.approx(case[f"torque_{name}"], rel=1e-6)


def test_a_stainless_screw_is_tightened_to_what_friction_leaves_of_it():
    """At a friction of 0.2 the torsion leaves less than 0.7 of the yield strength for the preload."""
    loose = yield_preload(4, 0.7, PROOF["A2-70"], friction_of("A2-70"))
    found = tightening((4.0, 0.7, 7.0, 4.5), "A2-70", 1e6)
    assert found.force == pytest.approx(loose)
    assert loose < preload(stress_area(4, 0.7), PROOF["A2-70"])
    assert found.torque == pytest.approx(3.028, abs=0.001)


def test_what_bears_least_sets_the_torque():
    strong = strip_force(5, 0.8, 10, ALLOWED["steel"].shear)
    assert tightening(M5, "8.8", strong).torque == pytest.approx(5.45, abs=0.01)
    short = tightening(M5, "8.8", strip_force(5, 0.8, 2, ALLOWED["aluminium"].shear))
    assert short.limit == "thread"
    pom = tightening(M5, "8.8", strong, [Clamped(10, 5.5, ALLOWED["pom"].head)])
    assert pom.limit == "head"
    assert pom.torque == pytest.approx(1.88, abs=0.01), "under a washer on POM"
    rubber = tightening(M5, "8.8", strong, most=bond_torque(20))
    assert rubber.limit == "holder"
    assert rubber.torque == pytest.approx(0.785, abs=0.001)
    assert rubber.force < 1000


@pytest.mark.parametrize("thickness", [*plate_stock("aluminium").thicknesses[7:-1], 9.525, 12.7, 19.05])
def test_the_screw_of_a_foot_neither_bottoms_out_nor_hangs_on_a_turn(thickness):
    """A plate of 10 mm took a screw of 16 into a thread of 6: its point stood on the bottom."""
    (thread,) = foot().threads
    if thickness > 45:
        with pytest.raises(DesignError):
            fixing(thread.diameter, thickness, thread.depth)
        return
    found = fixing(thread.diameter, thickness, thread.depth)
    deep = found.screw.length - thickness - found.washers * 1.0
    assert LEAST_ENGAGED * 5 - 1e-9 <= deep <= thread.depth - SPARE + 1e-9
    assert found.washers <= WASHERS


@pytest.mark.parametrize("face", [one for one in motor_faces() if one.thread], ids=lambda one: one.name)
def test_the_screws_of_a_motor_fit_its_thread(face):
    """A gear motor whose thread is 3 mm deep took the screws of one with 4.5."""
    found = motor_fixing(face)
    deep = found.screw.length - 6.0 + found.sunk
    assert LEAST_ENGAGED * face.thread <= deep <= face.depth - SPARE + 1e-9


def test_a_plate_for_which_no_screw_is_sold_is_refused():
    with pytest.raises(
        DesignError, match=r"no screw M5 that is sold goes 4 to 5\.5 mm into a thread 6 mm deep"
    ):
        fixing(5, 16.6, 6)
    assert math.isclose(fixing(3, 6, 3, 2).sunk, 0.5)


def test_a_plate_in_hand_without_a_screw_for_its_feet_is_no_base_plate():
    """The design was refused, though a plate of 19 mm lay beside that of 16.6."""
    assert base_stock(12, "aluminium", (16.6, 19)) == 19
    assert base_stock(12, "aluminium", (16.6,)) == 12, "as they are sold"
