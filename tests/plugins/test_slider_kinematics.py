"""Motion of the slider-crank: reference numbers, loop closure, exact derivatives, the seed's equations."""

import json
import math
from pathlib import Path

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from planar_circles import bresse_point, curvature, inflection_pole, velocity_pole
from signed_distances import of_slider_crank

from mechwright.errors import KinematicsError
from mechwright.mechanics.linkage import Mass
from mechwright.mechanics.planar import acceleration_pole
from mechwright_slider_crank.kinematics.forces import balance, joint_forces
from mechwright_slider_crank.kinematics.limits import (
    crank_turns,
    least_transmission_angle,
    limits,
    transmission_angle,
)
from mechwright_slider_crank.kinematics.simulated_stroke import simulated
from mechwright_slider_crank.kinematics.slider_crank import SliderCrank
from mechwright_slider_crank.synthesis.stroke import rocking_angle

DATA = json.loads((Path(__file__).parents[1] / "data" / "planar-linkages.json").read_text())
EXPECTED = {fact["name"]: fact["expected"] for fact in DATA["facts"]}

REFERENCE = SliderCrank(50.0, 150.0, 20.0)
OTHER = SliderCrank(50.0, 150.0, 20.0, branch=-1)
PHI = math.radians(60)

COUNT = 250
"""Random mechanisms of one hypothesis example; with 20 examples that makes 5,000."""


def number(name):
    return EXPECTED[f"slider_{name}"]


def place(name):
    return complex(*EXPECTED[f"slider_{name}"])


def random_linkages(seed):
    """COUNT mechanisms that turn, each with a crank angle of its own, in one array."""
    rng = np.random.default_rng(seed)
    a, e = rng.uniform(0.2, 2, COUNT), rng.normal(0, 1, COUNT)
    c = (a + np.abs(e)) * (1.02 + rng.exponential(0.7, COUNT))
    branch = rng.choice([-1, 1], COUNT)
    return SliderCrank(a, c, e, rng.uniform(-4, 4, COUNT), branch), rng.uniform(-7, 7, COUNT)


def random_bodies(seed):
    linkage, phi = random_linkages(seed)
    out = []
    for k in range(COUNT):
        one = SliderCrank(
            *(float(v[k]) for v in (linkage.crank, linkage.rod, linkage.offset, linkage.direction)),
            int(linkage.branch[k]),
        )
        out.append((one, float(phi[k])))
    return out


def test_reference_position_to_jerk():
    bodies = REFERENCE.bodies(PHI, 10.0)
    assert bodies.position[0] == pytest.approx(number("position_s"), rel=1e-12)
    pin = bodies.slider.origin
    assert pin.velocity[0] == pytest.approx(number("velocity"), rel=1e-12)
    assert pin.acceleration[0] == pytest.approx(number("acceleration"), rel=1e-12)
    assert pin.jerk[0] == pytest.approx(number("jerk"), rel=1e-12)
    rod = bodies.rod.turning
    assert math.degrees(rod.theta[0]) == pytest.approx(number("sigma_deg"), rel=1e-12)
    assert rod.omega[0] == pytest.approx(number("omega_coupler"), rel=1e-12)
    assert rod.alpha[0] == pytest.approx(number("alpha_coupler"), rel=1e-12)
    assert rod.jerk[0] == pytest.approx(number("coupler_angular_jerk"), rel=1e-11)


def test_reference_figures():
    found = limits(REFERENCE)
    assert found.stroke == pytest.approx(number("stroke"), rel=1e-12)
    assert found.time_ratio == pytest.approx(number("K"), rel=1e-12)
    assert math.degrees(found.far) == pytest.approx(number("phi_at_s_max_deg"), rel=1e-11)
    assert math.degrees(found.near) == pytest.approx(number("phi_at_s_min_deg"), rel=1e-11)
    assert math.degrees(rocking_angle(found.time_ratio)) == pytest.approx(
        number("theta_extreme_deg"), rel=1e-11
    )
    least = least_transmission_angle(50, 150, 20)
    assert math.degrees(least) == pytest.approx(number("min_transmission_angle_deg"), rel=1e-12)
    assert math.degrees(transmission_angle(REFERENCE, PHI)) == pytest.approx(
        number("transmission_angle_deg"), rel=1e-12
    )


def test_reference_poles_and_circles():
    rod, other = REFERENCE.bodies(PHI).rod, OTHER.bodies(PHI).rod
    assert velocity_pole(rod)[0] == pytest.approx(place("instant_centre_P"), rel=1e-12)
    assert acceleration_pole(rod).fixed[0] == pytest.approx(place("acceleration_pole_fixed"), rel=1e-12)
    assert acceleration_pole(rod).moving[0] == pytest.approx(
        place("acceleration_pole_coupler_frame"), rel=1e-12
    )
    assert acceleration_pole(other).fixed[0] == pytest.approx(
        place("acceleration_pole_fixed_branch-"), rel=1e-12
    )
    assert acceleration_pole(other).moving[0] == pytest.approx(
        place("acceleration_pole_coupler_branch-"), rel=1e-12
    )
    far = inflection_pole(rod)[0]
    assert far == pytest.approx(place("inflection_pole"), rel=1e-10)
    diameter = abs(far - velocity_pole(rod)[0])
    assert diameter == pytest.approx(number("inflection_circle_diameter"), rel=1e-10)
    bresse = abs(bresse_point(rod) - velocity_pole(rod))[0]
    assert bresse == pytest.approx(number("bresse_zero_tangential_circle_diameter"), rel=1e-10)


def test_reference_diagnostics():
    found = of_slider_crank(REFERENCE, PHI)
    assert found.instant_centre[0] == pytest.approx(place("instant_centre_P"), rel=1e-12)
    assert found.relative_centre[0] == pytest.approx(place("relative_centre_Q"), rel=1e-12, abs=1e-12)
    assert found.g[0] == pytest.approx(number("g_signed"), rel=1e-12)
    assert found.h[0] == pytest.approx(number("h_signed"), rel=1e-12)
    assert found.cot_delta[0] == pytest.approx(number("cot_delta"), rel=1e-11)


def test_at_90_degrees_the_pole_is_finite_and_the_parametric_form_is_not():
    rod = REFERENCE.bodies(math.pi / 2).rod
    assert not np.abs(velocity_pole(rod)[0]) < 1e12
    pole = acceleration_pole(rod)
    assert pole.fixed[0] == pytest.approx(place("acceleration_pole_at_phi90"), rel=1e-12)
    assert pole.fixed[0] == pytest.approx(complex(REFERENCE.positions(math.pi / 2), 50), rel=1e-12)
    error = abs(of_slider_crank(REFERENCE, math.pi / 2).fixed[0] - pole.fixed[0])
    assert not error < 1e-9


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_the_seed_equations_equal_the_direct_pole(seed):
    """Equations (1), (3) and (10) to (13) for 5,000 mechanisms, both assemblies, any direction."""
    linkage, phi = random_linkages(seed)
    # Away from where the forms are 0/0: cos φ' = 0, sin δ = 0.
    bodies, found = linkage.bodies(phi), of_slider_crank(linkage, phi)
    pole, rod = acceleration_pole(bodies.rod), bodies.rod.turning
    condition = np.abs(found.cot_delta) + 1 / np.abs(np.cos(phi - linkage.direction))
    usable = condition < 1e3
    assert usable.mean() > 0.9
    size = 1 + np.abs(pole.fixed)
    for error in (
        np.abs(found.fixed - pole.fixed),
        np.abs(found.coupler - pole.moving),
        np.abs(found.omega - rod.omega),
        np.abs(found.alpha - rod.alpha) / (1 + np.abs(rod.alpha)),
    ):
        assert (error <= 1e-9 * size)[usable].all()
    np.testing.assert_allclose((found.g - found.h)[usable], linkage.crank[usable], rtol=1e-9)
    # With the other sign of δ the equations are plainly wrong, so that the comparison means something.
    flipped = np.abs(-found.alpha - rod.alpha) / (1 + np.abs(rod.alpha))
    assert np.median(flipped[usable]) > 1e-3


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_loops_close_and_poles_stand_still(seed):
    linkage, phi = random_linkages(seed)
    bodies = linkage.bodies(phi, 1.7)
    end, pin = bodies.rod.point(linkage.rod), bodies.slider.origin
    reach = linkage.crank + linkage.rod
    assert (np.abs(end.position - pin.position) <= 1e-12 * linkage.rod + 1e-14 * reach).all()
    turning = bodies.rod.turning
    speed = 1 + np.abs(turning.omega) + np.abs(turning.alpha) + np.abs(turning.jerk)
    for name in ("velocity", "acceleration", "jerk"):
        gap = np.abs(getattr(end, name) - getattr(pin, name))
        assert (gap <= 1e-11 * reach * speed * (1 + np.abs(turning.omega)) ** 2).all(), name
    pole = acceleration_pole(bodies.rod)
    rest = np.abs(bodies.rod.point(pole.moving).acceleration)
    assert (rest <= 1e-12 * reach * speed * (1 + np.abs(turning.omega)) * (1 + np.abs(pole.moving))).all()


@settings(max_examples=12, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(0, COUNT - 1))
def test_derivatives_are_those_of_40_digits(seed, which):
    linkage, phi = random_bodies(seed)[which]
    mpmath.mp.dps = 40
    a, c, e, theta = (mpmath.mpf(v) for v in (linkage.crank, linkage.rod, linkage.offset, linkage.direction))

    def s(t):
        y = e - a * mpmath.sin(t - theta)
        return a * mpmath.cos(t - theta) + linkage.branch * mpmath.sqrt(c * c - y * y)

    def sigma(t):
        return mpmath.asin((e - a * mpmath.sin(t - theta)) / c) * linkage.branch

    bodies = linkage.bodies(phi)
    along = np.exp(-1j * linkage.direction)
    pin, rod = bodies.slider.origin, bodies.rod.turning
    rates = [(pin.velocity * along).real, (pin.acceleration * along).real, (pin.jerk * along).real]
    for order, (slide, turn) in enumerate(zip(rates, (rod.omega, rod.alpha, rod.jerk), strict=True), start=1):
        for function, value in ((s, slide), (sigma, turn)):
            exact = float(mpmath.diff(function, mpmath.mpf(phi), order))
            assert value[0] == pytest.approx(exact, rel=1e-10, abs=1e-10 * (1 + abs(rod.jerk[0])))


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(0, COUNT - 1))
def test_closed_form_limits_are_those_of_the_simulation(seed, which):
    linkage, _ = random_bodies(seed)[which]
    found = limits(linkage)
    stroke, ratio = simulated(linkage)
    assert stroke == pytest.approx(found.stroke, rel=1e-9)
    assert ratio == pytest.approx(found.time_ratio, rel=1e-7)
    for angle, position in ((found.far, found.far_position), (found.near, found.near_position)):
        s, v = linkage.positions(angle), linkage.velocities(angle)
        assert s == pytest.approx(position, rel=1e-9, abs=1e-9)
        assert abs(v) < 1e-6 * linkage.crank
    phi = np.linspace(0, math.tau, 3601)
    least = least_transmission_angle(linkage.crank, linkage.rod, linkage.offset)
    # acos is steep near 0: compare cosines.
    assert np.cos(transmission_angle(linkage, phi)).max() == pytest.approx(math.cos(least), rel=1e-5)


def test_the_slow_stroke_is_where_it_is_said_to_be():
    for branch, offset in ((1, 20.0), (1, -20.0), (-1, 20.0), (-1, -20.0)):
        linkage = SliderCrank(50.0, 150.0, offset, 0.4, branch)
        found = limits(linkage)
        distance = np.abs(linkage.positions(np.linspace(0, math.tau, 100_000, endpoint=False)))
        outward = float((np.diff(distance, append=distance[0]) > 0).mean())
        assert found.slow_outward == (outward > 0.5)
        assert max(outward, 1 - outward) / min(outward, 1 - outward) == pytest.approx(
            found.time_ratio, abs=1e-4
        )


def test_the_two_assemblies_are_mirror_images():
    """About the line through A0 across the slide: angles φ' and π - φ'."""
    phi = np.linspace(0.1, 6, 50)
    np.testing.assert_allclose(OTHER.positions(math.pi - phi), -REFERENCE.positions(phi), rtol=1e-13)


def test_wrong_linkages_are_named():
    short = SliderCrank(50.0, 60.0, 20.0)
    assert not crank_turns(50.0, 60.0, 20.0)
    with pytest.raises(KinematicsError, match="longer than 70"):
        short.bodies(np.linspace(0, math.tau, 361))
    with pytest.raises(KinematicsError, match="must be above 70"):
        limits(short)
    with pytest.raises(KinematicsError, match="does not get round"):
        simulated(short)
    assert np.isnan(short.positions(math.radians(-90)))


def test_the_slider_pin_goes_straight():
    """B lies on the inflection circle in every position."""
    bodies = REFERENCE.bodies(np.linspace(0, 6, 40))
    assert np.abs(curvature(bodies.rod.point(150.0))).max() < 1e-9


def test_reference_forces():
    masses = {"crank": Mass(0.0), "rod": Mass(1.2, 50 + 0j, 2500.0), "slider": Mass(2.0)}
    found = joint_forces(REFERENCE.bodies(PHI, 10.0), masses, -300.0)
    assert found.drive[0] == pytest.approx(number("input_torque") / 1e3, rel=1e-7)
    assert found.joints["wrist-pin"][0] == pytest.approx(place("pin_force_coupler_on_slider") / 1e3, rel=1e-7)
    assert found.joints["crank-pin"][0] == pytest.approx(place("pin_force_crank_on_coupler") / 1e3, rel=1e-7)
    assert found.joints["guide"][0] == pytest.approx(
        1j * number("normal_force_of_guide_on_slider") / 1e3, rel=1e-7
    )


def test_reference_balance():
    masses = {"crank": Mass(0.0), "rod": Mass(1.2), "slider": Mass(2.0)}
    assert balance(50.0, 150.0, masses).rod == pytest.approx(number("full_force_balance_coupler_mr_required"))
    # The reference takes the coupler as balanced by moving its own centre, without a weight of its own.
    moved = {"crank": Mass(0.0), "rod": Mass(1.2, complex(-300 / 1.2)), "slider": Mass(2.0)}
    found = balance(50.0, 150.0, moved)
    assert found.rod == pytest.approx(0, abs=1e-12)
    assert found.crank == pytest.approx(number("full_force_balance_crank_mr_required"))


def test_counterweights_stop_the_shaking():
    masses = {
        "crank": Mass(0.4, 12 + 3j, 50.0),
        "rod": Mass(0.7, 70 - 4j, 900.0),
        "slider": Mass(1.1, 0j, 30.0),
    }
    phi = np.linspace(0, math.tau, 73)
    bodies = REFERENCE.bodies(phi, 20.0)
    weights = balance(50.0, 150.0, masses)
    from mechwright.mechanics.linkage import together

    lever = weights.rod / weights.rod_weight
    balanced = {
        "rod": together([masses["rod"], Mass(weights.rod_weight, lever)]),
        "crank": together([masses["crank"], Mass(1.0, weights.crank)]),
        "slider": masses["slider"],
    }
    before = np.abs(joint_forces(bodies, masses).shaking).max()
    after = np.abs(joint_forces(bodies, balanced).shaking).max()
    assert before > 10
    assert after < 1e-9 * before
