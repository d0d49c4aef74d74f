"""Motors of drives: what is asked at their shaft, which is chosen, and when one would do."""

import math

import numpy as np
import pytest

from mechwright import GROUND, Channel, Instance, Joint, Loop, Motion, Outline, Part, Poses, circle
from mechwright.machine import MachineSettings, drive_of, motor_of
from mechwright.machine.motors import (
    EFFICIENCY,
    able_at,
    carried,
    curve_of,
    demand_of,
    geared_down,
    judged,
    with_speed,
)
from mechwright.mechanics.strength.motor import INERTIA_RATIO, gear_motor_margin, stepper_margin
from mechwright.standards.motors import motor, motors

SAMPLES = 361


def drive(settings, rpm=120.0, ripple=0.4, radius=60.0):
    """A shaft at constant speed, and an output disc at θ + ripple sin θ."""
    angle = np.linspace(0, math.tau, SAMPLES)
    time = angle / (rpm * math.tau / 60)
    poses = {
        "crank": Poses.planar(0.0, 0.0, angle),
        "output": Poses.planar(90.0, 0.0, angle + ripple * np.sin(angle)),
    }
    joints = {
        "shaft": Joint("revolute", GROUND, "crank", drives=True),
        "out": Joint("revolute", GROUND, "output", (90.0, 0.0, 0.0)),
    }
    channels = {"phi": Channel(angle, "rad"), "time": Channel(time, "s")}
    disc = Outline(Loop((circle((0.0, 0.0), radius),)))
    parts = [Part("disc", disc, 10.0, "steel", (Instance("output"),))]
    return drive_of(Motion("phi", channels, poses, joints=joints), parts, settings)


def settings(**keys):
    return MachineSettings(**{"motor": "auto", **keys})


def test_demand_is_the_peak_and_rms_with_the_margin():
    asked = settings(load=0.2, margin=2.0)
    found = drive(asked)
    demand = demand_of(found, asked)
    assert demand.peak == pytest.approx(2 * abs(found.peak()[0]), rel=1e-4)
    assert demand.rms == pytest.approx(2 * found.rms)
    assert demand.speed == pytest.approx(120.0)


def test_a_gear_takes_torque_and_adds_speed_and_its_losses_help_to_brake():
    plain, geared = settings(load=0.2, margin=1.0), settings(load=0.2, margin=1.0, gear=4.0)
    found = drive(plain)
    one, four = demand_of(found, plain), demand_of(found, geared)
    assert four.speed == pytest.approx(4 * one.speed)
    assert four.peak == pytest.approx(one.peak / 4 / EFFICIENCY, rel=1e-6)
    braking = settings(margin=1.0, gear=4.0)
    free = drive(braking)
    torque, power = free.runs[0].torque, free.runs[0].power
    wanted = np.where(power >= 0, torque / EFFICIENCY, torque * EFFICIENCY) / 4
    assert demand_of(free, braking).rms == pytest.approx(math.sqrt(free.mean_of(wanted**2)), rel=1e-6)


def test_auto_takes_the_lightest_that_is_enough_and_turns_evenly():
    for load in (0.02, 0.1, 0.3):
        asked = settings(load=load)
        found = drive(asked)
        choice = motor_of(found, asked)
        assert choice.enough
        seen = [with_speed(found, asked, judged(found, asked, one)) for one in motors()]
        enough = [one for one in seen if one.enough and (one.ratio is None or one.ratio <= INERTIA_RATIO)]
        wanted = next((one for one in enough if one.even), None)
        wanted = wanted or min(enough, key=lambda one: one.speed.deviation)
        assert choice.motor == wanted.motor


def test_how_a_motor_covers_its_demand_is_the_formulas_of_strength():
    asked = settings(load=0.1, voltage=12.0)
    found = drive(asked)
    stepper, gear = (judged(found, asked, motor(name)) for name in ("NEMA 23 - 56", "37D 30:1"))
    assert stepper.cover == stepper_margin(stepper.motor, stepper.demand, 12.0)
    assert gear.cover == gear_motor_margin(gear.motor, gear.demand)
    assert stepper.cover < judged(found, settings(load=0.1, voltage=48.0), stepper.motor).cover * 1.0000001
    assert stepper.ratio == pytest.approx(found.reflected.max() / 3.0e-5)
    speeds, torques = curve_of(stepper)
    assert np.interp(stepper.demand.speed, speeds, torques) == pytest.approx(stepper.given, rel=1e-2)
    assert not stepper.resonant
    assert judged(drive(asked, rpm=25.0), asked, stepper.motor).resonant


def test_the_rotor_is_accelerated_too():
    """A crank at θ = 3 t² on a stepper: J_M i α beyond the torque."""
    time = np.linspace(0.1, 1, SAMPLES)
    angle = 3 * time**2
    channels = {"phi": Channel(angle, "rad"), "time": Channel(time, "s")}
    asked = settings(margin=1.0, gear=5.0, direction="forwards")
    motion = Motion("phi", channels, {"crank": Poses.planar(0.0, 0.0, angle)})
    still = drive_of(motion, [], asked)
    assert demand_of(still, asked, 5.8e-6).peak == pytest.approx(5.8e-6 * 5 * 6.0, rel=1e-6)


def test_slower_and_lighter_is_found_to_be_just_enough():
    asked = settings(load=0.3, motor="NEMA 17 - 48")
    found = drive(asked, rpm=600.0)
    weak = motor_of(found, asked)
    assert not weak.enough
    share = able_at(found, settings(load=0.01, motor="NEMA 17 - 48"), weak.motor)
    light = settings(load=0.01, motor="NEMA 17 - 48")
    quick = drive(light, rpm=600.0)
    share = able_at(quick, light, weak.motor)
    assert 0 < share < 1
    assert judged(quick, light, weak.motor, share * 0.999).enough
    assert not judged(quick, light, weak.motor, share * 1.001).enough
    slowed = drive(light.model_copy(update={"speed": 600 * share * 0.999}), rpm=600.0)
    assert judged(slowed, light, weak.motor).enough
    heavy = settings(load=0.3, motor="NEMA 17 - 48")
    slow = drive(heavy, rpm=20.0)
    assert not judged(slow, heavy, weak.motor).enough
    part = carried(slow, heavy, weak.motor)
    lighter = settings(load=0.3 * part * 0.999, motor="NEMA 17 - 48")
    assert judged(drive(lighter, rpm=20.0), lighter, weak.motor).enough
    gear = geared_down(slow, heavy)
    assert judged(slow, heavy.model_copy(update={"gear": gear}), weak.motor).enough


def test_a_load_that_no_speed_helps_has_none():
    asked = settings(load=50.0, motor="NEMA 17 - 34")
    assert able_at(drive(asked), asked, motor("NEMA 17 - 34")) is None
    assert geared_down(drive(asked, rpm=3000.0), asked) is None


def test_a_motor_that_is_asked_for_nothing_covers_it_a_finite_number_of_times():
    asked = settings()
    free = drive(asked, ripple=0.0)
    assert judged(free, asked, motor("NEMA 17 - 34")).cover <= 1e6
    fast = drive(asked, ripple=0.0, rpm=600.0)
    assert not judged(fast, asked, motor("37D 18.75:1")).enough
