"""Torque of a drive against closed forms: shafts, weights, loads, both senses, and work over a period."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mechwright import GROUND, Channel, Instance, Joint, Load, Loop, Motion, Outline, Part, Poses, circle
from mechwright.errors import DesignError, KinematicsError
from mechwright.machine import MachineSettings, drive_of
from mechwright.machine.course import course_of, differences, over_time
from mechwright.machine.drive import GRAVITY
from mechwright.mechanics.planar import BodyMotion, Turning

SAMPLES = 721
NOISE = 1e-8
"""Share of the greatest kinetic energy by which differences of samples may be off, at the ends of a period."""
OMEGA = 10.0
NOTHING = MachineSettings()


def disc(name, radius, centre=(0.0, 0.0), thickness=10.0, z=0.0):
    return Part(name, Outline(Loop((circle(centre, radius),))), thickness, "steel", (Instance(name, z),))


def mass_of(radius, thickness=10.0):
    return math.pi * radius**2 * thickness * 7.85e-6


def turning(angle, time, poses, *, loads=None, joints=None):
    held = {"shaft": Joint("revolute", GROUND, "crank", drives=True)} if joints is None else joints
    channels = {"phi": Channel(angle, "rad"), "time": Channel(time, "s")}
    return Motion("phi", channels, poses, joints=held, loads=loads or {})


def energy_of(drive):
    return float((drive.reflected * drive.course.speed**2 / 2).max())


def crank_motion(**more):
    angle = np.linspace(0, math.tau, SAMPLES)
    return turning(angle, angle / OMEGA, {"crank": Poses.planar(0.0, 0.0, angle)}, **more)


def geared(ripple=0.5, **more):
    """A crank at constant speed, and an output at θ + ripple sin θ."""
    angle = np.linspace(0, math.tau, SAMPLES)
    poses = {
        "crank": Poses.planar(0.0, 0.0, angle),
        "output": Poses.planar(50.0, 0.0, angle + ripple * np.sin(angle)),
    }
    joints = {
        "shaft": Joint("revolute", GROUND, "crank", drives=True),
        "out": Joint("revolute", GROUND, "output", (50.0, 0.0, 0.0)),
    }
    return turning(angle, angle / OMEGA, poses, joints=joints, **more)


def test_a_shaft_asks_for_j_i_di_omega_squared():
    drive = drive_of(geared(), [disc("output", 30.0)], NOTHING)
    angle, inertia = drive.course.angle, mass_of(30.0) * 30.0**2 / 2 * 1e-6
    ratio, slope = 1 + 0.5 * np.cos(angle), -0.5 * np.sin(angle)
    wanted = inertia * ratio * slope * OMEGA**2
    np.testing.assert_allclose(drive.inertia, wanted, rtol=0, atol=1e-8 * np.abs(wanted).max())
    np.testing.assert_allclose(drive.reflected, inertia * ratio**2, rtol=1e-8)
    assert drive.swing == pytest.approx(inertia * OMEGA**2 * (1.5**2 - 0.5**2) / 2, rel=1e-5)
    assert drive.flywheel(0.025) == pytest.approx(drive.swing / (0.05 * OMEGA**2))
    peak, at, _ = drive.peak()
    fine = np.linspace(0, math.tau, 1_000_001)
    exact = inertia * (1 + 0.5 * np.cos(fine)) * -0.5 * np.sin(fine) * OMEGA**2
    assert abs(peak) == pytest.approx(np.abs(exact).max(), rel=1e-7)
    assert abs(math.sin(at)) == pytest.approx(abs(math.sin(fine[np.argmax(exact)])), abs=1e-4)
    assert drive.rms == pytest.approx(math.sqrt(np.mean(exact[:-1] ** 2)), rel=1e-6)


def test_an_eccentric_disc_lifts_its_weight():
    crank = [disc("crank", 20.0, (15.0, 0.0))]
    drive = drive_of(crank_motion(), crank, MachineSettings(up="y"))
    wanted = mass_of(20.0) * GRAVITY * 0.015 * np.cos(drive.course.angle)
    np.testing.assert_allclose(drive.weight, wanted, rtol=0, atol=1e-10)
    assert np.abs(drive.inertia).max() < NOISE * energy_of(drive)
    assert drive.power[1] == pytest.approx(0, abs=1e-8)
    assert np.abs(drive_of(crank_motion(), crank, MachineSettings(up="z")).weight).max() < 1e-12
    assert not drive_of(crank_motion(), crank, NOTHING).weight.any()
    other = drive_of(crank_motion(), crank, MachineSettings(up="-y"))
    np.testing.assert_allclose(other.weight, -drive.weight, rtol=0, atol=1e-12)


def test_a_lying_body_that_climbs_is_lifted():
    """Its height 2 sin θ above the plane: T = m g 2 cos θ, and its own inertia m 4 cos θ sin θ ω²."""
    angle = np.linspace(0, math.tau, SAMPLES)
    body = Poses.planar(0.0, 0.0, 0 * angle)
    body.position[:, 2] = 2 * np.sin(angle)
    drive = drive_of(
        turning(angle, angle / OMEGA, {"crank": body}, joints={}),
        [disc("crank", 20.0)],
        MachineSettings(up="z"),
    )
    mass = mass_of(20.0)
    np.testing.assert_allclose(drive.weight, mass * GRAVITY * 2e-3 * np.cos(angle), rtol=0, atol=1e-10)
    wanted = -mass * 4e-6 * np.cos(angle) * np.sin(angle) * OMEGA**2
    np.testing.assert_allclose(drive.inertia, wanted, rtol=0, atol=1e-12)


def test_backwards_inertia_and_weight_change_their_sign_and_resistance_does_not():
    drive = drive_of(geared(), [disc("output", 30.0)], MachineSettings(load=0.3))
    ahead, back = drive.runs
    resisting = 0.3 * (1 + 0.5 * np.cos(drive.course.angle))
    np.testing.assert_allclose(drive.resisting, resisting, rtol=1e-8)
    np.testing.assert_allclose(ahead.torque, resisting + drive.inertia, rtol=1e-8)
    np.testing.assert_allclose(back.torque, resisting - drive.inertia, rtol=1e-8)
    assert drive.power[1] == pytest.approx(0.3 * OMEGA, rel=1e-9)
    one = drive_of(geared(), [disc("output", 30.0)], MachineSettings(load=0.3, direction="backwards"))
    assert [run.name for run in one.runs] == ["backwards"]


def test_forces_and_torques_of_loads_count_by_their_way():
    push = Load("crank", force=(0.0, -5.0, 0.0), point=(20.0, 0.0, 0.0))
    twist = Load("crank", torque=(0.0, 0.0, 0.7))
    drive = drive_of(crank_motion(loads={"push": push, "twist": twist}), [disc("crank", 5.0)], NOTHING)
    wanted = 5.0 * 0.02 * np.cos(drive.course.angle) - 0.7
    np.testing.assert_allclose(drive.given, wanted, rtol=0, atol=1e-10)


def test_a_load_that_brings_its_inertia_stands_for_the_parts():
    heavy = drive_of(geared(loads={"load": Load("output", inertia=2e-4)}), [disc("output", 30.0)], NOTHING)
    light = drive_of(geared(loads={"load": Load("output", inertia=2e-4)}), [disc("output", 3.0)], NOTHING)
    np.testing.assert_allclose(heavy.inertia, light.inertia)
    ratio = 1 + 0.5 * np.cos(heavy.course.angle)
    np.testing.assert_allclose(heavy.reflected, 2e-4 * ratio**2, rtol=1e-9)


def test_a_speed_of_its_own_scales_inertia_with_its_square_exact_rates_too():
    angle = np.linspace(0, math.tau, SAMPLES)
    exact = {
        "crank": BodyMotion.about(0j, Turning.of(angle, OMEGA)).poses(rates=True),
        "output": BodyMotion.about(
            50 + 0j,
            Turning.of(
                angle + 0.5 * np.sin(angle),
                OMEGA * (1 + 0.5 * np.cos(angle)),
                -0.5 * OMEGA**2 * np.sin(angle),
            ),
        ).poses(rates=True),
    }
    joints = geared().joints
    for motion in (geared(), turning(angle, angle / OMEGA, exact, joints=joints)):
        slow = drive_of(motion, [disc("output", 30.0)], NOTHING)
        fast = drive_of(motion, [disc("output", 30.0)], MachineSettings(speed=3 * OMEGA * 60 / math.tau))
        np.testing.assert_allclose(fast.inertia, 9 * slow.inertia, rtol=0, atol=NOISE * energy_of(fast))
        assert fast.speed == pytest.approx(3 * OMEGA)
        assert fast.mean_speed == pytest.approx(3 * OMEGA)


def test_speed_and_acceleration_are_those_that_the_body_of_the_driven_shaft_has():
    """Exactly, however few samples there are, and wherever its joint stands among others."""
    phase = np.linspace(0, math.tau, 25)
    angle, speed = 0.5 * (1 - np.cos(phase)), 0.5 * OMEGA * np.sin(phase)
    acceleration = 0.5 * OMEGA**2 * np.cos(phase)
    exact = {
        "crank": BodyMotion.about(0j, Turning.of(angle, speed, acceleration)).poses(rates=True),
        "output": BodyMotion.about(50 + 0j, Turning.of(-2 * angle, -2 * speed, -2 * acceleration)).poses(
            rates=True
        ),
    }
    joints = dict(reversed(geared().joints.items()))
    course = course_of(turning(angle, phase / OMEGA, exact, joints=joints), None)
    np.testing.assert_allclose(course.speed, speed, rtol=0, atol=1e-12)
    np.testing.assert_allclose(course.acceleration, acceleration, rtol=0, atol=1e-11)


def test_a_crank_that_accelerates_asks_for_j_alpha():
    """θ = 3 t²: α = 6; at rest in the first sample, where exact rates give 0/0 and the limit is taken."""
    time = np.linspace(0, 1, SAMPLES)
    exact = BodyMotion.about(0j, Turning.of(3 * time**2, 6 * time, 6.0)).poses(rates=True)
    drive = drive_of(turning(3 * time**2, time, {"crank": exact}), [disc("crank", 30.0)], NOTHING)
    inertia = mass_of(30.0) * 30.0**2 / 2 * 1e-6
    np.testing.assert_allclose(drive.inertia, 6 * inertia, rtol=1e-9)
    assert drive.swing is None
    assert drive.flywheel(0.05) is None
    assert drive.power[0] == pytest.approx(36 * inertia)


def test_a_lever_is_braked_as_it_is_driven():
    phase = np.linspace(0, math.tau, SAMPLES)
    angle = 0.5 * (1 - np.cos(phase))
    motion = turning(angle, phase / OMEGA, {"crank": Poses.planar(0.0, 0.0, angle)})
    drive = drive_of(motion, [disc("crank", 30.0)], NOTHING)
    inertia = mass_of(30.0) * 30.0**2 / 2 * 1e-6
    np.testing.assert_allclose(drive.inertia, inertia * 0.5 * OMEGA**2 * np.cos(phase), atol=1e-9, rtol=0)
    assert drive.power[1] == pytest.approx(0, abs=1e-9)
    assert drive.flywheel(0.05) is None


def test_friction_turns_over_where_a_lever_does_and_its_peak_is_no_parabola_through_the_jump():
    phase = np.linspace(0, math.tau, SAMPLES)
    angle = 0.5 * (1 - np.cos(phase))
    poses = {"crank": Poses.planar(0.0, 0.0, angle), "output": Poses.planar(50.0, 0.0, 2 * angle)}
    drive = drive_of(
        turning(angle, phase / OMEGA, poses, joints=geared().joints), [], MachineSettings(load=0.3)
    )
    ahead, back = drive.runs
    np.testing.assert_allclose(ahead.torque, 0.6 * np.sign(np.round(np.sin(phase), 9)), atol=1e-8)
    np.testing.assert_allclose(back.torque, -ahead.torque)
    assert abs(drive.peak()[0]) == pytest.approx(0.6)
    assert drive.power[1] == pytest.approx(0.6 * 2 / (math.tau / OMEGA), rel=1e-3)
    assert min(run.power.min() for run in drive.runs) >= -1e-9


def test_the_clock_is_made_where_a_motion_has_none():
    motion = geared()
    bare = Motion("phi", {"phi": motion.channels["phi"]}, motion.poses, joints=motion.joints)
    with pytest.raises(DesignError, match=r"machine\.speed: the motion does not say how fast"):
        drive_of(bare, [disc("output", 30.0)], NOTHING)
    timed = drive_of(bare, [disc("output", 30.0)], MachineSettings(speed=OMEGA * 60 / math.tau))
    wanted = drive_of(motion, [disc("output", 30.0)], NOTHING)
    np.testing.assert_allclose(timed.inertia, wanted.inertia, rtol=0, atol=NOISE * energy_of(wanted))


def test_what_is_asked_of_what_is_not_there_is_refused():
    with pytest.raises(DesignError, match=r"machine\.load: no body turns in the frame besides"):
        drive_of(crank_motion(), [], MachineSettings(load=1))
    with pytest.raises(DesignError, match=r"machine\.output: no body 'wheel' .*those that do: output"):
        drive_of(geared(), [], MachineSettings(output="wheel"))
    two = dict(geared().joints) | {"third": Joint("revolute", GROUND, "more")}
    poses = dict(geared().poses) | {"more": geared().poses["output"]}
    motion = turning(geared().channels["phi"].values, geared().channels["time"].values, poses, joints=two)
    with pytest.raises(DesignError, match=r"machine\.output: output, more turn in the frame; name"):
        drive_of(motion, [], MachineSettings(load=1))
    assert drive_of(motion, [], MachineSettings(load=1, output="more")).resisting.max() > 1
    way = Motion("s", {"s": Channel(np.linspace(0, 9, 30), "mm")})
    with pytest.raises(DesignError, match="no angle, and nothing that turns drives it"):
        drive_of(way, [], NOTHING)
    with pytest.raises(KinematicsError, match="is on body 'ghost'"):
        crank_motion(loads={"load": Load("ghost")})
    with pytest.raises(KinematicsError, match="not finite"):
        Load("crank", resisting=math.nan)
    with pytest.raises(KinematicsError, match="limit of each is 0"):
        Load("crank", resisting=-1.0)


number = st.floats(-1, 1)


@given(st.lists(st.tuples(number, number, number), min_size=1, max_size=3), number)
def test_inertia_and_weight_do_no_work_over_a_period(waves, tilt):
    """A body that turns and shifts in space by any few harmonics comes back with what it had."""
    angle = np.linspace(0, math.tau, 361)
    turn = angle + sum(0.3 * a * np.sin(k * angle) for k, (a, _, _) in enumerate(waves, 1))
    body = Poses.planar(
        sum(20 * b * np.cos(k * angle) for k, (_, b, _) in enumerate(waves, 1)),
        sum(20 * c * np.sin(k * angle) for k, (_, _, c) in enumerate(waves, 1)),
        turn,
    )
    c, s = math.cos(tilt), math.sin(tilt)
    lean = np.array([[1, 0, 0], [0, c, -s], [0, s, c]])
    leaning = Poses(body.position @ lean.T, lean @ body.rotation)
    motion = turning(angle, angle / OMEGA, {"crank": leaning}, joints={})
    drive = drive_of(motion, [disc("crank", 20.0, (7.0, 3.0))], MachineSettings(up="y"))
    for torque in (drive.inertia, drive.weight):
        assert abs(np.trapezoid(torque, angle)) <= 1e-7 * (energy_of(drive) + np.abs(torque).max())
    rate, _ = differences(drive.reflected * OMEGA**2 / 2)
    np.testing.assert_allclose(rate / angle[1], drive.inertia, rtol=0, atol=1e-6 * energy_of(drive))


@pytest.mark.parametrize("uneven", [0.0, 0.4, -0.4])
def test_rates_over_time_are_exact_for_polynomials_whatever_the_steps(uneven):
    share = np.linspace(0, 1, 40)
    time = 2 * share + uneven * share**2
    values = np.stack([time, time**2, 3 - time**2 / 2], axis=1)
    first, second = over_time(values, time)
    one = np.ones(40)
    np.testing.assert_allclose(first, np.stack([one, 2 * time, -time], axis=1), atol=1e-9)
    np.testing.assert_allclose(second, np.stack([0 * one, 2 * one, -one], axis=1), atol=1e-6)
