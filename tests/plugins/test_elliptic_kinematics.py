"""Kinematics against the linkage, against differences, and against brute force."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mechwright.errors import DesignError
from mechwright_elliptic_gears.family import EllipticGears
from mechwright_elliptic_gears.kinematics.equations import (
    Turning,
    coupler,
    driven,
    pitch_radii,
    shaft_pressure_angle,
    steepest_shaft_pressure_angle,
)
from mechwright_elliptic_gears.kinematics.peak import peak
from mechwright_elliptic_gears.kinematics.point import point_of_coupler
from mechwright_elliptic_gears.kinematics.window import near_constant

Params = EllipticGears.Params
eccentricities = st.floats(0, 0.9)
angles = st.floats(-20, 20)

# Eight-point central difference, h = 1e-2: truncation 1e-18 of the ninth derivative's scale.
WEIGHTS = np.array([1 / 280, -4 / 105, 1 / 5, -4 / 5, 0, 4 / 5, -1 / 5, 4 / 105, -1 / 280])
STEPS = np.arange(-4, 5)


def derivative(function, at, h=1e-3):
    return function(at + h * STEPS) @ WEIGHTS / h


@given(eccentricities, angles)
def test_the_coupler_keeps_its_length(e, theta2):
    gear2 = Turning.of(theta2, 1.0)
    gear4 = driven(gear2, e)
    a = 50.0
    j, k = 2 * a * e * np.exp(1j * gear2.theta), 2 * a + 2 * a * e * np.exp(1j * gear4.theta)
    assert abs(k - j) == pytest.approx(2 * a, rel=1e-12)
    if e > 1e-6:
        assert np.exp(1j * coupler(gear2, gear4).theta) == pytest.approx((k - j) / abs(k - j), abs=1e-9)


@given(eccentricities, angles)
def test_the_pitch_radii_meet_on_both_ellipses(e, theta2):
    a = 50.0
    gear2 = Turning.of(theta2, 3.0)
    gear4 = driven(gear2, e)
    s2, s4 = pitch_radii(gear2, a, e)
    assert s2 + s4 == pytest.approx(2 * a)
    assert s4 == pytest.approx(a * (1 - e * e) / (1 + e * np.cos(gear4.theta)), rel=1e-10)
    assert gear4.omega == pytest.approx(-s2 / s4 * 3.0, rel=1e-10)


@given(st.floats(0, 0.8), st.floats(-7, 7), st.floats(-5, 5), st.floats(-5, 5), st.floats(-3, 3))
def test_derivatives_agree_with_differences_for_any_input_motion(e, theta, omega, alpha, jerk):
    def gear2(t):
        return Turning.of(
            theta + omega * t + alpha * t**2 / 2 + jerk * t**3 / 6,
            omega + alpha * t + jerk * t**2 / 2,
            alpha + jerk * t,
            jerk,
        )

    exact = driven(gear2(np.array(0.0)), e)
    scale = 1e-6 * (1 + abs(omega) + abs(alpha) + abs(jerk)) ** 3 / (1 - e) ** 6
    for higher, lower in (("omega", "theta"), ("alpha", "omega"), ("jerk", "alpha")):
        slope = derivative(lambda t, name=lower: getattr(driven(gear2(t), e), name), 0.0)
        assert getattr(exact, higher) == pytest.approx(slope, abs=scale)


@given(st.floats(0, 0.8), st.floats(0, 6.28))
def test_the_midpoint_moves_as_its_velocity_says(e, theta):
    def q(t):
        gear2 = Turning.of(theta + 2.0 * t, 2.0)
        return point_of_coupler(gear2, driven(gear2, e), 10.0, e)

    here = q(np.array(0.0))
    limit = 1e-6 / (1 - e) ** 6
    assert abs(here.velocity - derivative(lambda t: q(t).position, 0.0)) < limit
    assert abs(here.acceleration - derivative(lambda t: q(t).velocity, 0.0)) < limit
    # The hippopede that Q runs along, about (a, 0).
    x, y = here.position.real - 10.0, here.position.imag
    assert (x * x + y * y) ** 2 == pytest.approx(400 * (e**2 * x**2 - (1 - e**2) * y**2), abs=1e-9)


@given(eccentricities, angles)
def test_each_turn_of_gear_2_turns_gear_4_back_once(e, theta2):
    one, next_ = driven(Turning.of(theta2, 1.0), e), driven(Turning.of(theta2 + math.tau, 1.0), e)
    assert next_.theta - one.theta == pytest.approx(-math.tau, abs=1e-9 / (1 - e))


def test_gear_4_never_jumps():
    theta4 = driven(Turning.of(np.linspace(-15, 15, 20001), 1.0), 0.7).theta
    steps = -np.diff(theta4)
    assert steps.min() > 0
    assert steps.max() < 1.7 / 0.3 * 30 / 20000 * 1.001


@given(eccentricities)
def test_the_steepest_pressure_angle_is_that_of_the_turn(e):
    turn = Turning.of(np.linspace(0, math.tau, 20001), 1.0)
    found = shaft_pressure_angle(turn, e, 0.3).max()
    assert found <= steepest_shaft_pressure_angle(e, 0.3) + 1e-12
    assert found == pytest.approx(steepest_shaft_pressure_angle(e, 0.3), abs=1e-5)


@given(st.integers(0, 100), st.floats(0.01, 3))
def test_the_window_is_the_longest_one(seed, band):
    rng = np.random.default_rng(seed)
    weights, phases = rng.normal(size=4), rng.uniform(0, math.tau, 4)

    def speed(t):
        return sum(w * np.cos(k * t + p) for k, (w, p) in enumerate(zip(weights, phases, strict=True), 1))

    n = 400
    values = speed(math.tau * np.arange(2 * n) / n)
    longest = 0
    for i in range(n):
        low, high = np.minimum.accumulate(values[i : i + n]), np.maximum.accumulate(values[i : i + n])
        longest = max(longest, int((high - low <= band).sum()))
    window = near_constant(speed, band)
    # Another stretch may be longer by up to a step of the search grid.
    assert (longest - 1) * math.tau / n - math.tau / 8192 <= window.length <= (longest + 1) * math.tau / n
    inside = speed(window.start + np.linspace(0, window.length, 5001))
    # An extreme inside the window is known to half a grid step: some 1e-6 of the curvature.
    assert inside.max() - inside.min() <= band + 1e-5
    assert inside.min() == pytest.approx(window.low, abs=1e-4 * np.abs(weights).sum())


def test_a_steady_speed_is_one_window():
    window = near_constant(lambda t: np.full_like(t, 4.0), 0.1)
    assert (window.start, window.length, window.low) == (0.0, math.tau, 4.0)


def test_motion_channels_are_the_equations():
    params = Params(eccentricity=0.6, semi_major=50.0, teeth=41, speed=600 / math.tau)
    motion = EllipticGears().solve(params, 721)
    value = {name: channel.values for name, channel in motion.channels.items()}
    assert motion.samples == 721
    assert value["omega2"] == pytest.approx(np.full(721, 10.0))
    assert value["time"][-1] == pytest.approx(math.tau / 10)
    assert value["theta3"] == pytest.approx(value["theta2"] + value["theta4"])
    assert value["omega3"] == pytest.approx(value["omega2"] + value["omega4"])
    assert value["ratio"] == pytest.approx(-value["s2"] / value["s4"])
    assert np.hypot(value["Q.velocity.x"], value["Q.velocity.y"]) == pytest.approx(value["Q.speed"])
    # vQ of a pair equals that of a train with phase π, whose extremes are known in closed form.
    assert motion.scalars["Q.speed.max"].value == pytest.approx(907.114735222146)
    assert motion.scalars["Q.acceleration.max"].value == pytest.approx(51000.0)
    assert motion.scalars["omega4_max"].value == pytest.approx(40.0)


def test_poses_carry_the_free_foci():
    params = Params(eccentricity=0.5, semi_major=30.0, teeth=41)
    motion = EllipticGears().solve(params, 61)
    focus = np.array([[2 * 30.0 * 0.5, 0.0, 0.0]])
    j = motion.poses["gear-2"].transform(focus)[:, 0]
    k = motion.poses["gear-4"].transform(focus)[:, 0]
    assert np.linalg.norm(k - j, axis=1) == pytest.approx(np.full(61, 60.0))
    ends = motion.poses["coupler"].transform(np.array([[0.0, 0, 0], [60.0, 0, 0]]))
    np.testing.assert_allclose(ends[:, 0], j, atol=1e-10)
    np.testing.assert_allclose(ends[:, 1], k, atol=1e-10)


def test_scalars_do_not_hang_on_the_sampling():
    params = Params(eccentricity=0.8, teeth=61)
    few, many = (EllipticGears().solve(params, n).scalars for n in (2, 1001))
    assert few == many


def test_too_few_samples_are_refused():
    with pytest.raises(DesignError, match="at least 2"):
        EllipticGears().solve(Params(), 1)


def test_peak_of_a_narrow_hill():
    assert peak(lambda t: 1 / (1.001 - np.cos(t - 2.34567))).value == pytest.approx(1000.0, rel=1e-9)
