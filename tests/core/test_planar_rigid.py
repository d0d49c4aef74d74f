"""Rigid bodies in the plane against derivatives, poles and circles against what they have to be."""

import json
from pathlib import Path

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from planar_circles import (
    bresse_point,
    centre_of_curvature,
    curvature,
    in_body,
    inflection_pole,
    jerk_pole,
    pole_velocity,
    velocity_pole,
)

from mechwright.mechanics.planar import BodyMotion, PointMotion, Turning, acceleration_pole

FACTS = json.loads((Path(__file__).parents[1] / "data" / "planar-linkages.json").read_text())["facts"]
EXPECTED = {fact["name"]: fact["expected"] for fact in FACTS}


def plane(name):
    return complex(*EXPECTED[name])


def random_bodies(seed, count):
    rng = np.random.default_rng(seed)
    origin = PointMotion(*(rng.normal(size=(4, count)) + 1j * rng.normal(size=(4, count))))
    return BodyMotion(origin, Turning(*rng.normal(size=(4, count))))


@pytest.fixture(scope="module")
def coupler():
    """The four-bar of the reference: a = 40, c = 120, b = 80, f = 100 at 120 degrees and 10 rad/s."""
    lever, omega = 40 * np.exp(2j * np.pi / 3), 10.0
    pin = PointMotion.of([lever], 1j * omega * lever, -(omega**2) * lever, -1j * omega**3 * lever)
    names = ("angle_sigma_deg",)
    sigma = np.radians(EXPECTED[f"fourbar_coupler_{names[0]}"])
    return BodyMotion(
        pin,
        Turning.of(
            [sigma],
            EXPECTED["fourbar_omega_coupler"],
            EXPECTED["fourbar_alpha_coupler"],
            EXPECTED["fourbar_jerk_coupler"],
        ),
    )


def test_reference_coupler_point(coupler):
    point = coupler.point(60 + 30j)
    for name, values in {
        "pos": point.position,
        "vel": point.velocity,
        "acc": point.acceleration,
        "jerk": point.jerk,
    }.items():
        expected = plane(f"fourbar_coupler_point_{name}")
        assert abs(values[0] - expected) <= 1e-9 * abs(expected), name


def test_reference_poles_and_circles(coupler):
    centre = velocity_pole(coupler)
    assert centre[0] == pytest.approx(plane("fourbar_instant_centre_P"), rel=1e-10)
    moving = plane("fourbar_moving_centrode_point_coupler_frame")
    assert in_body(coupler, centre)[0] == pytest.approx(moving, rel=1e-10)
    pole = acceleration_pole(coupler)
    assert pole.fixed[0] == pytest.approx(plane("fourbar_acceleration_pole_fixed"), rel=1e-10)
    assert pole.moving[0] == pytest.approx(plane("fourbar_acceleration_pole_coupler_frame"), rel=1e-10)
    per_radian = pole_velocity(coupler)[0] / 10
    assert per_radian == pytest.approx(plane("fourbar_pole_changing_velocity_per_rad"), rel=1e-9)
    far, other = inflection_pole(coupler), bresse_point(coupler)
    assert far[0] == pytest.approx(plane("fourbar_inflection_pole"), rel=1e-9)
    diameter = EXPECTED["fourbar_inflection_circle_diameter"]
    assert np.abs(far - centre)[0] == pytest.approx(diameter, rel=1e-9)
    assert other[0] == pytest.approx(plane("fourbar_bresse_far_point"), rel=1e-9)
    diameter = EXPECTED["fourbar_bresse_zero_tangential_circle_diameter"]
    assert np.abs(other - centre)[0] == pytest.approx(diameter, rel=1e-9)
    point = coupler.point(60 + 30j)
    radius = EXPECTED["fourbar_coupler_point_signed_radius_of_curvature"]
    assert 1 / curvature(point)[0] == pytest.approx(radius, rel=1e-9)
    bend = plane("fourbar_coupler_point_centre_of_curvature")
    assert centre_of_curvature(point)[0] == pytest.approx(bend, rel=1e-9)


def test_a_body_point_is_differentiated_exactly():
    mpmath.mp.dps = 40

    def origin(t):
        return mpmath.mpc(mpmath.sin(2 * t) + t**3, mpmath.exp(t) - t)

    def angle(t):
        return mpmath.cos(t) + t**2

    place, at = mpmath.mpc(2, -3), mpmath.mpf("0.7")
    exact = [
        mpmath.diff(lambda t: origin(t) + place * mpmath.exp(1j * angle(t)), at, order) for order in range(4)
    ]
    body = BodyMotion(
        PointMotion.of(*([complex(mpmath.diff(origin, at, order))] for order in range(4))),
        Turning.of(*([float(mpmath.diff(angle, at, order))] for order in range(4))),
    )
    point = body.point(complex(place))
    found = (point.position, point.velocity, point.acceleration, point.jerk)
    for order, values in enumerate(found):
        assert abs(values[0] - complex(exact[order])) <= 1e-13 * abs(complex(exact[order])), order


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_nothing_moves_in_a_pole(seed):
    body = random_bodies(seed, 200)
    found = acceleration_pole(body)
    assert np.isfinite(found.fixed).all()
    for moving, rate in (
        (in_body(body, velocity_pole(body)), "velocity"),
        (found.moving, "acceleration"),
        (in_body(body, jerk_pole(body)), "jerk"),
    ):
        scale = 1 + np.abs(moving) * (1 + np.abs(body.turning.omega) ** 3 + np.abs(body.turning.jerk))
        assert (np.abs(getattr(body.point(moving), rate)) <= 1e-12 * scale * 10).all(), rate
    np.testing.assert_allclose(
        in_body(body, found.fixed), found.moving, atol=1e-11 * np.abs(found.moving).max()
    )


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 2**32 - 1), st.floats(0, 2 * np.pi))
def test_points_of_the_circles_have_one_part_of_an_acceleration(seed, angle):
    body = random_bodies(seed, 200)
    near = velocity_pole(body)
    for far, part in ((inflection_pole(body), np.imag), (bresse_point(body), np.real)):
        diameter = np.abs(far - near)
        point = body.point(in_body(body, (near + far + diameter * np.exp(1j * angle)) / 2))
        # Normal part of an acceleration: along i v; tangential part: along v.
        along = part(np.conj(point.velocity) * point.acceleration)
        size = np.abs(point.velocity) * (
            np.abs(point.acceleration) + np.abs(body.origin.acceleration) + diameter
        )
        assert (np.abs(along) <= 1e-9 * size * (1 + np.abs(body.turning.omega) ** 2)).all()


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_acceleration_pole_is_the_foot_on_the_line_of_the_far_ends(seed):
    body = random_bodies(seed, 200)
    pole, p = acceleration_pole(body).fixed, velocity_pole(body)
    far, other = inflection_pole(body), bresse_point(body)
    line = (other - far) / np.abs(other - far)
    foot = far + line * np.real(np.conj(line) * (p - far))
    scale = np.abs(p - far) + np.abs(p - other) + np.abs(p)
    assert (np.abs(foot - pole) <= 1e-10 * scale).all()


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_euler_savary_gives_the_centre_of_curvature(seed):
    body = random_bodies(seed, 200)
    place = np.random.default_rng(seed).normal(size=200) + 1j
    point = body.point(place)
    pole = velocity_pole(body)
    z, diameter = point.position - pole, inflection_pole(body) - pole
    below = np.abs(z) ** 2 - np.real(np.conj(z) * diameter)
    centre = point.position - np.abs(z) ** 2 * z / below
    share = np.abs(z) ** 2 / np.abs(below)
    off = np.abs(centre - centre_of_curvature(point))
    assert (off <= 1e-9 * (1 + np.abs(z) + np.abs(pole)) * (1 + share) ** 2).all()


@pytest.mark.parametrize(
    "body",
    [
        BodyMotion.sliding(PointMotion.of([1j], 2.0, 3j), 0.4),
        BodyMotion.about(2j, Turning.of([0.3])),
        BodyMotion(PointMotion.of([0j], 50.0, 1.0), Turning.of([0.0], 0.0, 1e-13)),
    ],
    ids=["shifting", "at rest", "nearly shifting"],
)
def test_without_turning_there_is_no_acceleration_pole(body):
    pole = acceleration_pole(body)
    assert np.isnan(pole.fixed).all()
    assert np.isnan(pole.moving).all()


def test_a_body_that_does_not_turn_just_now_has_an_acceleration_pole():
    """A crank angle of 90 degrees leaves a cosine of 6e-17."""
    body = BodyMotion(PointMotion.of([0j], 50.0), Turning.of([0.0], 6e-17, 1.0))
    assert np.isfinite(acceleration_pole(body).fixed).all()


def test_sampling_does_not_matter():
    body = random_bodies(3, 50)
    one = BodyMotion(
        PointMotion(
            *(getattr(body.origin, name)[7:8] for name in ("position", "velocity", "acceleration", "jerk"))
        ),
        Turning(*(getattr(body.turning, name)[7:8] for name in ("theta", "omega", "alpha", "jerk"))),
    )
    assert acceleration_pole(one).fixed[0] == acceleration_pole(body).fixed[7]


def test_poses_put_body_points_where_the_motion_says():
    body = random_bodies(4, 9)
    moved = body.poses(5.0).transform(np.array([[2.0, -1.0, 0.5]]))[:, 0]
    point = body.point(2 - 1j).position
    np.testing.assert_allclose(moved, np.column_stack((point.real, point.imag, np.full(9, 5.5))), atol=1e-12)
