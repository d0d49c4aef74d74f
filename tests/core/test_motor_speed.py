"""The speed of a gear motor over the turn, against a reference and against the equation of motion in time."""

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from test_machine_motor import drive
from test_machine_motor import settings as machine

from mechwright.machine import motor_of
from mechwright.machine.motors import EFFICIENCY, even_on, judged, more_even, with_speed
from mechwright.mechanics.strength.motor import Demand, gear_motor_margin
from mechwright.mechanics.strength.motor_speed import Line, steady_run
from mechwright.standards.motors import NOMINAL_VOLTAGE, gear_motors, motor

RPM = math.tau / 60
SAMPLES = 1440
ANGLE = np.arange(SAMPLES) * math.tau / SAMPLES
REFERENCE = json.loads((Path(__file__).parents[1] / "data" / "motor-speed.json").read_text())
CASES = REFERENCE["cases"]


def harmonics(given):
    """A load over the angle of its mean and harmonics."""

    def at(angle):
        found = np.full_like(np.asarray(angle, dtype=float), given["mean"])
        for name, wave in (("cos", np.cos), ("sin", np.sin)):
            for k, size in enumerate(given.get(name, []), start=1):
                found = found + size * wave(k * np.asarray(angle))
        return found

    return at


def inertia_of(given):
    if not isinstance(given, dict):
        return np.full(SAMPLES, given)
    e = given["e"]
    ratio = (1 - e * e) / (1 + e * e - 2 * e * np.cos(ANGLE))
    return given["driver"] + given["driven"] * ratio**2


@pytest.mark.parametrize("case", CASES, ids=lambda case: case["name"])
def test_the_reference(case):
    """Solutions by spectral collocation and by Radau; the voltage is sought for the mean over time."""
    line = Line(case["no_load"] * RPM, case["stall"])
    load = harmonics(case["load"])(ANGLE)
    mean = case["speed_mean_over_time"] * RPM
    found = steady_run(inertia_of(case["inertia"]), load, ANGLE[1], mean, line)
    assert found.speed.min() / RPM == pytest.approx(case["speed_min"], abs=0.01)
    assert found.speed.max() / RPM == pytest.approx(case["speed_max"], abs=0.01)
    assert found.share == pytest.approx(case["voltage_share"], rel=1e-5)
    assert SAMPLES / (1 / found.speed).sum() == pytest.approx(mean, rel=1e-9)


small = st.floats(-1, 1)


@given(
    one=st.sampled_from(gear_motors()),
    waves=st.lists(small, min_size=4, max_size=4),
    inertia=st.floats(-5, -2),
    swing=st.floats(0, 0.9),
    rpm=st.floats(0.3, 0.9),
)
@settings(deadline=None, max_examples=25)
def test_the_equation_of_motion_runs_into_the_same_speeds(one, waves, inertia, swing, rpm):
    """J ω ω' + J' ω²/2 = M(ω) - L over the angle, from another speed on, until it repeats itself."""
    line = Line(one.no_load * RPM, one.stall_torque)
    size = 0.05 * one.stall_torque
    load = harmonics(
        {"mean": 2 * size, "cos": [size * waves[0] / 2, size * waves[1] / 3], "sin": [size * waves[2] / 2]}
    )
    mean, base = rpm * line.no_load, 10**inertia

    def felt(angle):
        return base * (1 + swing * np.sin(angle + waves[3]))

    found = steady_run(felt(ANGLE), load(ANGLE), ANGLE[1], mean, line)
    assert found is not None

    def rate(angle, omega):
        torque = line.stall * (found.share - omega / line.no_load) - load(angle)
        gain = base * swing * np.cos(angle + waves[3]) * omega**2 / 2
        return (torque - gain) / (felt(angle) * omega)

    settling = base * line.no_load / line.stall
    turns = 1 + math.ceil(6 * settling * mean / math.tau)
    last = math.tau * (turns - 1)
    found_too = solve_ivp(
        rate, (0, last + math.tau), [1.02 * found.speed[0]], t_eval=last + ANGLE, method="LSODA", rtol=1e-8
    )
    np.testing.assert_allclose(found_too.y[0], found.speed, rtol=1e-3)


def test_without_inertia_the_speed_lies_on_the_line_and_with_much_it_is_the_flywheels():
    line, load = Line(200 * RPM, 2.0), 0.3 + 0.25 * np.sin(ANGLE)
    bare = steady_run(np.zeros(SAMPLES), load, ANGLE[1], 120 * RPM, line)
    np.testing.assert_allclose(line.torque(bare.speed, bare.share)[0], load, rtol=1e-9)
    heavy = steady_run(np.full(SAMPLES, 0.5), load, ANGLE[1], 120 * RPM, line)
    swing = 2 * 0.25 / (0.5 * (120 * RPM) ** 2)  # ΔE/(J ω²)
    assert np.ptp(heavy.speed) / (120 * RPM) == pytest.approx(swing, rel=1e-2)


def test_the_losses_of_a_gear_make_the_line_steeper_where_it_brakes():
    line = Line(10.0, 4.0, 0.8)
    torque, _ = line.torque(np.array([5.0, 15.0]), 1.0)
    assert torque.tolist() == [0.8 * 2.0, -2.0 / 0.8]


@pytest.mark.parametrize("direction", ["forwards", "backwards"])
@pytest.mark.parametrize("gear", [1.0, 2.5])
def test_the_speed_of_a_drive_obeys_its_own_torque(direction, gear):
    """d(J ω²/2)/dθ by another difference is what the motor gives beyond loads, in the sense of the running."""
    asked = machine(load=0.1, direction=direction, gear=gear, motor="37D 30:1", speed=60.0)
    found = drive(asked)
    choice = motor_of(found, asked)
    seen, one = choice.speed, choice.motor
    assert seen.run == direction
    energy = np.interp(seen.angle, found.course.angle, found.reflected) * seen.speed**2 / 2
    way = np.abs(seen.angle - seen.angle[0])
    assert np.ptp(way) == pytest.approx(math.tau)
    assert seen.speed[0] == seen.speed[-1]
    gained = np.gradient(energy, way)
    load = np.interp(seen.angle, found.course.angle, found.resisting)
    share = seen.voltage / NOMINAL_VOLTAGE
    own = one.stall_torque * gear * (share - seen.speed * gear / (one.no_load * RPM))
    efficiency = 1.0 if gear == 1 else EFFICIENCY
    given = np.where(own >= 0, own * efficiency, own / efficiency)
    inner = slice(2, -2)
    np.testing.assert_allclose(
        (given - load)[inner], gained[inner], rtol=0, atol=2e-3 * np.abs(gained).max() + 1e-3 * load.max()
    )


def test_a_stepper_keeps_its_speed_and_what_follows_a_law_has_none():
    asked = machine(load=0.02, motor="NEMA 23 - 56")
    found = drive(asked)
    seen = motor_of(found, asked).speed
    assert (seen.least, seen.greatest, seen.deviation) == (found.mean_speed, found.mean_speed, 0.0)
    assert seen.voltage == 24.0
    weak = machine(load=5.0, motor="NEMA 17 - 34")
    assert motor_of(drive(weak), weak).speed is None


def test_what_is_proposed_turns_evenly():
    asked = machine(load=0.05, motor="37D 18.75:1", direction="forwards")
    found = drive(asked, rpm=60.0, ripple=0.9)
    choice = motor_of(found, asked)
    assert choice.enough
    assert choice.speed.deviation > asked.variation
    better = more_even(found, asked)
    assert with_speed(found, asked, judged(found, asked, better.motor)).speed.deviation <= asked.variation
    slow = found.slowed(0.5)
    again = drive(asked, rpm=30.0, ripple=0.9)
    np.testing.assert_allclose(slow.runs[0].torque, again.runs[0].torque, rtol=1e-6, atol=1e-9)
    assert even_on(slow, asked) == even_on(again, asked)
    assert motor_of(slow, asked).speed.deviation == pytest.approx(
        motor_of(again, asked).speed.deviation, rel=1e-5
    )


def test_the_least_ratio_that_keeps_the_speed_is_chosen():
    """The load 0.2 + 0.06 cos θ on a disc that is next to nothing; shares of stall, voltage and speed."""
    asked = machine(load=0.2, margin=1.0, direction="forwards", speed_variation=3.0)
    found = drive(asked, rpm=50.0, ripple=0.3, radius=0.5)
    for row in REFERENCE["least_ratio"]["ratios"]:
        one = motor(f"37D {row['ratio']:g}:1")
        seen = with_speed(found, asked, judged(found, asked, one))
        half = (seen.speed.greatest - seen.speed.least) / 2 / seen.speed.requested
        assert half == pytest.approx(row["half_fluctuation"], rel=1e-3)
        if half < 0.1:  # the reference has the mean over the angle, which is above that over time
            assert seen.speed.voltage / NOMINAL_VOLTAGE == pytest.approx(row["voltage_share"], rel=3e-3)
        assert seen.demand.peak / one.stall_torque == pytest.approx(row["peak_over_stall"], rel=1e-4)
        assert seen.demand.rms / one.stall_torque == pytest.approx(row["rms_over_stall"], rel=1e-4)
        assert (seen.enough and seen.even) is row["ok"]
    assert motor_of(found, asked).motor.ratio == REFERENCE["least_ratio"]["chosen"]


def test_what_the_gearbox_bears_counts_where_the_ratio_is_high():
    """131:1 stalls at 4.41 N m, a quarter of which is more than the 0.98 N m of its gearbox."""
    one = motor("37D 131:1")
    assert gear_motor_margin(one, Demand(1.0, 1.0, 1.0)) == pytest.approx(0.980665)
    assert gear_motor_margin(motor("37D 18.75:1"), Demand(1.0, 0.1, 1.0)) == pytest.approx(0.25 * 0.83356525)
    high = replace(one, stall=1000.0)
    assert gear_motor_margin(high, Demand(1.0, 5.0, 0.1)) == pytest.approx(2.4516625 / 5)
    assert one.current_limit == pytest.approx(0.2 + 5.3 * 250 / 450)
    assert motor("37D 50:1").current_limit is None


def test_a_motor_that_stalls_within_the_turn_is_found():
    """So much flywheel that the speed would pass through 0: no voltage has that mean."""
    load = 0.2 + 3.0 * np.sin(ANGLE)
    line = Line(motor("37D 18.75:1").no_load * RPM, motor("37D 18.75:1").stall_torque)
    assert steady_run(np.full(SAMPLES, 0.5), load, ANGLE[1], 2 * RPM, line) is None
