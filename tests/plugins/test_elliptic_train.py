"""The train: kinematics against the linkage, differences and closed forms; point Q, its window, its figures."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mechwright_elliptic_gears.family import EllipticGears
from mechwright_elliptic_gears.kinematics.equations import Turning, coupler, driven, phase_offset, train
from mechwright_elliptic_gears.kinematics.peak import peak
from mechwright_elliptic_gears.kinematics.point import place, point_of_coupler, speed_of_q

Params = EllipticGears.Params
eccentricities, phases, angles = st.floats(0, 0.9), st.floats(0, math.tau), st.floats(-40, 40)
points = st.builds(complex, st.floats(0, 1), st.floats(-0.5, 0.5))

# Eight-point central difference.
WEIGHTS = np.array([1 / 280, -4 / 105, 1 / 5, -4 / 5, 0, 4 / 5, -1 / 5, 4 / 105, -1 / 280])
STEPS = np.arange(-4, 5)


def derivative(function, at, h=1e-3):
    return function(at + h * STEPS) @ WEIGHTS / h


def wrapped(angle):
    return (angle + math.pi) % math.tau - math.pi


@given(eccentricities, phases, angles)
def test_the_coupler_of_a_train_keeps_its_length_and_its_direction(e, phase, theta2):
    _, gear4, gear5 = train(Turning.of(theta2, 1.0), e, phase)
    j, k = 2 * e * np.exp(1j * gear4.theta), 2 + 2 * e * np.exp(1j * gear5.theta)
    assert abs(k - j) == pytest.approx(2, rel=1e-12)
    assert np.exp(1j * coupler(gear4, gear5).theta) == pytest.approx((k - j) / 2, abs=1e-9)


@given(eccentricities, phases, angles)
def test_gear_4_stands_ahead_of_gear_3_by_what_the_phase_asks_for(e, phase, theta2):
    gear3, gear4, _ = train(Turning.of(theta2, 2.0), e, phase)
    assert gear4.theta - gear3.theta == pytest.approx(phase_offset(phase, e), abs=1e-9)
    # Gear 4 is at 0 when gear 2 is at the phase angle: that is how the train is put together.
    at_phase = train(Turning.of(phase, 2.0), e, phase)[1]
    assert wrapped(float(at_phase.theta)) == pytest.approx(0, abs=1e-9)
    k = (1 + e) / (1 - e)
    assert math.tan(phase_offset(phase, e) / 2) * math.cos(phase / 2) == pytest.approx(
        k * math.sin(phase / 2), rel=1e-6, abs=1e-6
    )
    assert (gear4.omega, gear4.alpha, gear4.jerk) == (gear3.omega, gear3.alpha, gear3.jerk)


@given(eccentricities, st.floats(0, math.tau - 1e-6))
def test_the_phase_offset_is_continuous_and_one_turn_long(e, phase):
    assert phase_offset(0.0, e) == 0
    assert phase_offset(math.tau, e) == pytest.approx(math.tau)
    assert 0 <= phase_offset(phase + 1e-6, e) - phase_offset(phase, e) <= 1.01e-6 * (1 + e) / (1 - e) + 1e-12


@pytest.mark.parametrize("phase", [0.0, 0.7, math.pi / 2, 3.0, math.pi, 5.5])
def test_no_angle_jumps_in_many_turns(phase):
    e = 0.6
    theta2 = np.linspace(-40, 40, 80001)
    gear3, gear4, gear5 = train(Turning.of(theta2, 1.0), e, phase)
    steepest = ((1 + e) / (1 - e)) ** 2 * 1e-3 * 1.001
    for gear, sign in ((gear3, -1), (gear4, -1), (gear5, 1)):
        steps = sign * np.diff(gear.theta)
        assert steps.min() > 0
        assert steps.max() < steepest
    assert gear5.theta[-1] - gear5.theta[0] == pytest.approx(80, abs=2 * math.tau)


@given(st.floats(0, 0.6), phases, st.floats(-7, 7), points)
def test_q_and_all_gears_move_as_their_rates_say(e, phase, theta, c):
    def gears(t):
        gear2 = Turning.of(
            theta + 2 * t + 0.3 * t**2 + 0.1 * t**3, 2 + 0.6 * t + 0.3 * t**2, 0.6 + 0.6 * t, 0.6
        )
        return train(gear2, e, phase)

    def q(t):
        return point_of_coupler(*gears(t)[1:], 10.0, e, c)

    zero = np.array(0.0)
    scale = 1e-6 / (1 - e) ** 12
    for number in range(3):
        exact = gears(zero)[number]
        for higher, lower in (("omega", "theta"), ("alpha", "omega"), ("jerk", "alpha")):
            slope = derivative(lambda t, n=number, name=lower: getattr(gears(t)[n], name), 0.0)
            assert getattr(exact, higher) == pytest.approx(slope, abs=scale)
    here = q(zero)
    for higher, lower in (("velocity", "position"), ("acceleration", "velocity"), ("jerk", "acceleration")):
        slope = derivative(lambda t, name=lower: getattr(q(t), name), 0.0)
        assert abs(getattr(here, higher) - slope) < 10 * scale


@given(eccentricities, phases, angles, points)
def test_q_stands_where_the_coupler_carries_it(e, phase, theta2, c):
    _, gear4, gear5 = train(Turning.of(theta2, 1.0), e, phase)
    j, k = 20 * e * np.exp(1j * gear4.theta), 20 + 20 * e * np.exp(1j * gear5.theta)
    along, across = c.real, 20 * c.imag
    direction = (k - j) / abs(k - j)
    assert place(along, across, 10.0) == pytest.approx(c)
    q = point_of_coupler(gear4, gear5, 10.0, e, c)
    assert complex(q.position) == pytest.approx(
        complex(j + along * (k - j) + 1j * across * direction), abs=1e-9
    )
    assert float(q.speed) == pytest.approx(
        10 * float(speed_of_q(np.array(theta2), e, phase, c)), abs=1e-9 / (1 - e) ** 4
    )


@given(eccentricities, phases, angles)
def test_the_middle_runs_along_the_hippopede_whatever_the_phase(e, phase, theta2):
    _, gear4, gear5 = train(Turning.of(theta2, 1.0), e, phase)
    q = complex(point_of_coupler(gear4, gear5, 1.0, e).position) - 1
    x, y = q.real, q.imag
    assert (x * x + y * y) ** 2 == pytest.approx(4 * (e**2 * x**2 - (1 - e**2) * y**2), abs=1e-12)


@given(eccentricities, angles)
def test_a_phase_of_half_a_turn_is_a_single_pair(e, theta2):
    gear2 = Turning.of(theta2, 3.0)
    _, gear4, gear5 = train(gear2, e, math.pi)
    one = point_of_coupler(gear2, driven(gear2, e), 10.0, e)
    other = point_of_coupler(gear4, gear5, 10.0, e)
    limit = 1e-8 / (1 - e) ** 6
    assert wrapped(float(gear5.theta) - theta2 - math.pi) == pytest.approx(0, abs=1e-8)
    assert float(other.speed) == pytest.approx(float(one.speed), abs=limit)
    assert abs(other.acceleration) == pytest.approx(abs(one.acceleration), abs=limit)


@pytest.mark.parametrize("e", [0.2, 0.4, 0.6, 0.8])
def test_peaks_at_phase_0_and_180_have_closed_forms(e):
    k = (1 + e) / (1 - e)
    for phase, speed, acceleration in (
        (0, 1000 * e * e * k / (1 - e), 5000 * e * k**2 * (1 + k**2)),
        (180, 1000 * e * e / (1 - e), 5000 * e * (1 + k**2)),
    ):
        params = Params(stages=2, phase=phase, eccentricity=e, speed=600 / math.tau, bore=12)
        motion = EllipticGears().solve(params, 2)
        assert motion.channels["Q.speed"].values[0] == pytest.approx(speed)
        assert motion.scalars["Q.acceleration.max"].value == pytest.approx(acceleration, rel=1e-9)
        assert motion.scalars["Q.acceleration.max.theta2"].value == 0


def test_speeds_of_many_designs_at_once_are_those_of_each():
    theta = np.linspace(0, 6, 7)
    e, phase, c = np.array([0.1, 0.5]), np.array([1.0, 4.0]), np.array([0.5, 0.2 + 0.1j])
    many = speed_of_q(theta, e[:, None], phase[:, None], c[:, None])
    for i in range(2):
        np.testing.assert_allclose(many[i], speed_of_q(theta, e[i], phase[i], c[i]), rtol=1e-14)
    _, gear4, gear5 = train(Turning.of(theta, np.ones((2, 1))), e[:, None], phase[:, None])
    both = point_of_coupler(gear4, gear5, 1.0, e[:, None], c[:, None])
    np.testing.assert_allclose(both.speed, many, rtol=1e-12)


def test_channels_and_figures_of_a_train():
    params = Params(stages=2, speed=600 / math.tau, bore=12, band=10)
    motion = EllipticGears().solve(params, 3601)
    value = {name: channel.values for name, channel in motion.channels.items()}
    assert {f"{what}{n}" for what in ("theta", "omega", "alpha", "jerk") for n in range(2, 7)} <= set(value)
    np.testing.assert_allclose(value["theta6"], value["theta4"] + value["theta5"])
    np.testing.assert_allclose(value["ratio"], value["omega5"] / value["omega2"])
    for rate in ("velocity", "acceleration", "jerk"):
        size = np.hypot(value[f"Q.{rate}.x"], value[f"Q.{rate}.y"])
        np.testing.assert_allclose(size, value["Q.speed" if rate == "velocity" else f"Q.{rate}"])
    figure = {name: scalar.value for name, scalar in motion.scalars.items()}
    for name in ("speed", "acceleration", "jerk"):
        sampled, top = value[f"Q.{name}"], figure[f"Q.{name}.max"]
        # No sample is above the refined peak, and the nearest one hardly below it.
        assert sampled.max() <= top * (1 + 1e-12)
        assert sampled.max() == pytest.approx(top, rel=1e-4)
        assert value["theta2"][sampled.argmax()] == pytest.approx(figure[f"Q.{name}.max.theta2"], abs=2e-3)
    start, end, length = (figure[f"Q.constant_speed_window.{name}"] for name in ("start", "end", "length"))
    assert end == pytest.approx(start + length)
    inside = value["Q.speed"][(value["theta2"] >= start) & (value["theta2"] <= end)]
    assert np.ptp(inside) <= 10 + 1e-9
    assert np.ptp(inside) == pytest.approx(10, abs=0.1)
    assert inside.min() == pytest.approx(figure["Q.constant_speed_window.least_speed"], abs=0.1)
    assert figure["ratio_max"] == pytest.approx(value["ratio"].max(), rel=1e-5)
    assert figure["ratio_min"] == pytest.approx(value["ratio"].min(), rel=1e-5)


def test_figures_of_a_train_do_not_hang_on_the_sampling():
    params = Params(stages=2, eccentricity=0.7, teeth=41, bore=12)
    few, many = (EllipticGears().solve(params, n).scalars for n in (2, 1001))
    assert few == many


def test_the_band_is_a_share_of_the_speed_unless_given():
    named, left_out = (
        Params(stages=2, speed=120, semi_major=40, bore=12, band=band)
        for band in (0.02 * 40 * 2 * math.tau, None)
    )
    one, other = (EllipticGears().solve(params, 2).scalars for params in (named, left_out))
    assert one == other
    wide = EllipticGears().solve(Params(stages=2, bore=12, band=1e5), 2).scalars
    assert wide["Q.constant_speed_window.length"].value == pytest.approx(math.tau)


def test_poses_carry_the_joints_of_a_train():
    params = Params(
        stages=2, eccentricity=0.3, semi_major=60, phase=40, bore=12, point_along=0.3, point_across=5
    )
    motion = EllipticGears().solve(params, 91)
    focus = np.array([[2 * 60 * 0.3, 0.0, 0.0]])
    ends = motion.poses["coupler"].transform(np.array([[0.0, 0, 0], [120.0, 0, 0], [36.0, 5.0, 0]]))
    for joint, gear, end in (("joint-j", "gear-4", 0), ("joint-k", "gear-5", 1)):
        here = motion.poses[gear].transform(focus)[:, 0]
        np.testing.assert_allclose(ends[:, end], here, atol=1e-9)
        np.testing.assert_allclose(motion.poses[joint].position, here, atol=1e-9)
        np.testing.assert_allclose(motion.poses[joint].rotation, motion.poses[gear].rotation, atol=1e-12)
    q = np.column_stack([motion.channels[name].values for name in ("Q.x", "Q.y")])
    np.testing.assert_allclose(ends[:, 2, :2], q, atol=1e-9)
    for body, x in (("gear-2", -120.0), ("gear-3", 0.0), ("gear-4", 0.0), ("gear-5", 120.0)):
        np.testing.assert_allclose(motion.poses[body].position, np.tile((x, 0, 0), (91, 1)), atol=0)


def test_the_first_of_two_mirrored_hills_is_the_peak():
    found = peak(lambda t: np.cos(t - 1) ** 2 + np.cos(t + 1) ** 2 * (1 - 1e-15))
    assert found.angle == pytest.approx(math.pi / 2, abs=1e-6)
    assert peak(lambda t: np.cos(t)).angle == 0
