"""Torque, masses and play of the joint by which two pairs of a train are set."""

import dataclasses
import math

import numpy as np
import pytest
from test_elliptic_phase_joint import FAMILY, PINS, VARIABLE, Params, at

from mechwright.contracts.finding import Severity, errors
from mechwright.contracts.made_part import MadePart, MadeRing, MadeSection
from mechwright_elliptic_gears.as_made.pairs import going_in, joint_figures, phase_sensitivity
from mechwright_elliptic_gears.kinematics.equations import Turning, coupler, train
from mechwright_elliptic_gears.kinematics.figures import point_window
from mechwright_elliptic_gears.kinematics.joint_load import greatest_torque, joint_torque, masses_of
from mechwright_elliptic_gears.kinematics.point import point_of_coupler, speed_of_q
from mechwright_elliptic_gears.parts.dividing import START
from mechwright_elliptic_gears.parts.layout import dividing_of, keeper_of, layout_of
from mechwright_elliptic_gears.rules.pins import pin_play, shifted_window


def test_the_torque_of_the_joint_is_the_power_behind_it():
    params, masses = at(45), masses_of(VARIABLE)
    theta = np.linspace(0.3, 6.0, 7)
    gamma = math.radians(45)

    def energy(theta2):
        _, four, five = train(Turning.of(theta2, 10.0), 0.4, gamma)
        link, centre = coupler(four, five), point_of_coupler(four, five, 50.0, 0.4, masses.centre)
        return (
            masses.gear * (four.omega**2 + five.omega**2)
            + masses.turning * link.omega**2
            + masses.coupler * centre.speed**2
        ) / 2e6  # J

    h = 1e-5
    power = (energy(theta + h) - energy(theta - h)) / (2 * h) * 10.0
    omega4 = train(Turning.of(theta, 10.0), 0.4, gamma)[1].omega
    assert joint_torque(theta, params, gamma, masses) * omega4 == pytest.approx(power, rel=1e-6)


def test_masses_are_those_of_the_plates():
    masses = masses_of(VARIABLE)
    parts = {part.name: part for part in FAMILY.parts(VARIABLE)}
    area = parts["coupler"].outline.polygon(1e-4).area
    assert masses.coupler == pytest.approx(area * 6 * 2.7e-6, rel=1e-5)
    assert masses.centre == pytest.approx(0.5, abs=1e-9), "Q's hole stands in the middle"
    # About its middle a rod of that mass has m l²/12; eyes and rounding make it a little more.
    assert masses.turning == pytest.approx(masses.coupler * 112**2 / 12, rel=0.1)


def test_a_pin_that_is_too_weak_is_refused_with_the_speed_that_works():
    table = PINS | {"speed": 1200.0}
    (fault,) = errors(FAMILY.check(Params(**table)))
    assert (fault.code, fault.parameter) == ("train.phase-pin", "speed")
    assert "phase of 0 degrees" in fault.message
    assert errors(FAMILY.check(Params(**table | {"speed": fault.limit}))) == []
    assert errors(FAMILY.check(Params(**table | {"speed": fault.limit * 1.001})))
    torque = greatest_torque(Params(**PINS), 0.0).value
    force = 2 * 1000 * torque / 17.5
    (note,) = [f for f in FAMILY.check(Params(**PINS)) if f.code == "train.phase-pin"]
    assert note.value == pytest.approx(4 * force / (math.pi * 16), rel=1e-9)


def test_speed_changes_by_the_joint_alike_at_every_phase():
    assert phase_sensitivity(VARIABLE) == pytest.approx(1.2477041083, abs=1e-6)
    theta, h = np.linspace(0, math.tau, 20001), 1e-6
    for gamma in (0.0, 1.0, 2.5):
        shift = h * float(1 / ((1 - 0.16) / (1.16 - 0.8 * math.cos(gamma))))
        v = [np.log(speed_of_q(theta, 0.4, gamma + sign * shift)) for sign in (1, -1)]
        assert np.abs(v[0] - v[1]).max() / (2 * h) == pytest.approx(1.2477, abs=2e-4)


@pytest.mark.parametrize(
    ("phase", "ahead", "behind"), [(0, 0, 0), (45, -0.003, 0.003), (90, -0.078, -0.624), (135, 0.001, -0.001)]
)
def test_half_a_degree_of_the_joint_changes_the_window(phase, ahead, behind):
    params = at(phase)
    nominal = point_window(params).length
    found = [shifted_window(params, sign * math.radians(0.5)).length - nominal for sign in (1, -1)]
    assert found == pytest.approx((ahead, behind), abs=1.5e-3)


def test_the_play_of_the_pin_is_told():
    # Holes 6 µm over, the pin 8 µm under 4 mm: 28 µm in both holes, 17.5 mm from the axis.
    assert pin_play(VARIABLE) == pytest.approx(0.028 / 17.5, rel=1e-9)
    (note,) = [f for f in FAMILY.check(VARIABLE) if f.code == "train.phase-window"]
    assert f"±{math.degrees(0.014 / 17.5):.3f} degrees" in note.message
    assert note.value == pytest.approx(-0.49, abs=0.01), "the window of 90 degrees ends at an edge"


def made_gears(diameter):
    """Gears 3 and 4 with round holes of one diameter, mm, where the pin goes in."""
    dividing, turn = dividing_of(VARIABLE), np.linspace(0, -math.tau, 90, endpoint=False)

    def part(name, centre):
        points = np.column_stack((np.cos(turn), np.sin(turn)))
        places = points * diameter / 2 + (centre.real, centre.imag)
        flat = np.zeros(len(turn))
        ring = MadeRing(places, -points, flat, flat.astype(bool))
        return (MadePart(name, name, 0.001, (MadeSection(0.0, 10.0, (ring,)),)),)

    hole = dividing.hole_at(90)
    at_4 = complex(17.5 * math.cos(START), 17.5 * math.sin(START))
    return {"gear-3": part("gear-3", dividing.centre(hole)), "gear-4": part("gear-4", at_4)}


def test_the_play_of_the_pin_is_told_with_holes_as_made():
    play, speed = joint_figures(VARIABLE, made_gears(4.010))
    assert play.design == pytest.approx(1e6 * 0.028 / 17.5)
    assert play.made == pytest.approx(1e6 * 2 * (4.010 - 3.992) / 17.5, rel=1e-6)
    # 2 µm of path on the diameter of each hole, and the pin's own tolerance.
    assert (play.low, play.high) == pytest.approx((2e6 * 0.012 / 17.5, 2e6 * 0.024 / 17.5), rel=1e-6)
    assert play.asked == pytest.approx(1e6 * 2 * (4.012 - 3.988) / 17.5)
    assert speed.made == pytest.approx(50 * 1.2477041 * play.made * 1e-6, rel=1e-6)
    assert going_in([play, speed]) == []
    assert joint_figures(VARIABLE.model_copy(update={"phase_joint": None, "phases": None}), {}) == []


@pytest.mark.parametrize(("diameter", "severity"), [(3.995, Severity.WARNING), (3.990, Severity.ERROR)])
def test_a_pin_that_does_not_go_in_is_told(diameter, severity):
    (finding,) = going_in(joint_figures(VARIABLE, made_gears(diameter)))
    assert (finding.code, finding.severity) == ("train.phase-fit", severity)


def test_the_pin_is_kept_down_below_the_coupler():
    layout, keeper = layout_of(VARIABLE), keeper_of(VARIABLE)
    parts = {part.name: part for part in FAMILY.parts(VARIABLE)}
    pin, washer, bolt = (parts[name] for name in ("phase-pin", "pin-keeper", "keeper-screw"))
    box = pin.build().BoundingBox()
    (instance,) = pin.instances
    head = instance.z + box.zmax
    assert head == pytest.approx(layout.upper + layout.thickness + layout.gap / 2)
    assert (box.xmax, box.zmin) == pytest.approx((3.0, 0.0))
    assert dataclasses.asdict(instance)["body"] == "phase-pin"
    # The washer's upper step reaches over the head, its lower one keeps off it.
    over = washer.instances[0].z + keeper.low
    assert over - head == pytest.approx(0.25)
    apart = abs(keeper.place - 17.5 * np.exp(1j * START))
    assert apart + 1e-9 > keeper.foot / 2 + 3.0
    assert keeper.top / 2 + 3.0 - apart == pytest.approx(1.5)
    assert bolt.bought.designation == "ISO 4762 - M3 x 8 - 8.8"
    assert layout.link - (bolt.instances[0].z + 3.0) == pytest.approx(0.5)
    names = {feature.name for feature in parts["gear-4"].features}
    assert "keeper" in names
    assert [one.name for one in parts["gear-4"].details] == ["thread-keeper"]
    (note,) = [one for one in FAMILY.check(VARIABLE) if one.code == "train.phase-pin-up"]
    assert "M3 x 8 on gear 4 keeps the pin down" in note.message


def test_gears_without_room_for_a_keeper_leave_the_pin_to_its_weight():
    thin = VARIABLE.model_copy(update={"thickness": 4.0})
    assert keeper_of(thin) is None
    (note,) = [one for one in FAMILY.check(thin) if one.code == "train.phase-pin-up"]
    assert "its weight alone" in note.message
