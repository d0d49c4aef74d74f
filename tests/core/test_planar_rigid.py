"""Rigid bodies in the plane against derivatives, poles and circles against what they have to be."""

import json
from pathlib import Path

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mechwright.mechanics.planar import (
    BodyMotion,
    PointMotion,
    PoleKind,
    Turning,
    acceleration_pole,
    bresse_circle,
    curvature_of_path,
    inflection_circle,
    jerk_pole,
    pole_velocity,
    velocity_pole,
)

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
    assert velocity_pole(coupler).fixed[0] == pytest.approx(plane("fourbar_instant_centre_P"), rel=1e-10)
    assert velocity_pole(coupler).moving[0] == pytest.approx(
        plane("fourbar_moving_centrode_point_coupler_frame"), rel=1e-10
    )
    pole = acceleration_pole(coupler)
    assert pole.fixed[0] == pytest.approx(plane("fourbar_acceleration_pole_fixed"), rel=1e-10)
    assert pole.moving[0] == pytest.approx(plane("fourbar_acceleration_pole_coupler_frame"), rel=1e-10)
    per_radian = pole_velocity(coupler)[0] / 10
    assert per_radian == pytest.approx(plane("fourbar_pole_changing_velocity_per_rad"), rel=1e-9)
    inflection, bresse = inflection_circle(coupler), bresse_circle(coupler)
    assert inflection.far[0] == pytest.approx(plane("fourbar_inflection_pole"), rel=1e-9)
    assert inflection.diameter[0] == pytest.approx(EXPECTED["fourbar_inflection_circle_diameter"], rel=1e-9)
    assert bresse.far[0] == pytest.approx(plane("fourbar_bresse_far_point"), rel=1e-9)
    diameter = EXPECTED["fourbar_bresse_zero_tangential_circle_diameter"]
    assert bresse.diameter[0] == pytest.approx(diameter, rel=1e-9)
    bend = curvature_of_path(coupler.point(60 + 30j))
    assert 1 / bend.signed[0] == pytest.approx(
        EXPECTED["fourbar_coupler_point_signed_radius_of_curvature"], rel=1e-9
    )
    assert bend.centre[0] == pytest.approx(plane("fourbar_coupler_point_centre_of_curvature"), rel=1e-9)


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
    for pole, rate in (
        (velocity_pole(body), "velocity"),
        (acceleration_pole(body), "acceleration"),
        (jerk_pole(body), "jerk"),
    ):
        assert pole.finite.all()
        scale = 1 + np.abs(pole.moving) * (1 + np.abs(body.turning.omega) ** 3 + np.abs(body.turning.jerk))
        assert (np.abs(getattr(body.point(pole.moving), rate)) <= 1e-12 * scale * 10).all(), rate
        towards = (pole.fixed - body.origin.position) / np.abs(pole.fixed - body.origin.position)
        np.testing.assert_allclose(pole.direction, towards, atol=1e-12)
        np.testing.assert_allclose(
            body.to_body(pole.fixed), pole.moving, atol=1e-11 * np.abs(pole.moving).max()
        )


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 2**32 - 1), st.floats(0, 2 * np.pi))
def test_circles_are_what_they_are_called(seed, angle):
    body = random_bodies(seed, 200)
    for circle, part in ((inflection_circle(body), np.imag), (bresse_circle(body), np.real)):
        assert circle.exists.all()
        point = body.point(body.to_body(circle.centre + circle.diameter / 2 * np.exp(1j * angle)))
        # Normal part of an acceleration: along i v; tangential part: along v.
        along = part(np.conj(point.velocity) * point.acceleration)
        size = np.abs(point.velocity) * (
            np.abs(point.acceleration) + np.abs(body.origin.acceleration) + np.abs(circle.diameter)
        )
        assert (np.abs(along) <= 1e-9 * size * (1 + np.abs(body.turning.omega) ** 2)).all()


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_acceleration_pole_is_the_foot_on_the_line_of_the_far_ends(seed):
    body = random_bodies(seed, 200)
    pole, p = acceleration_pole(body).fixed, velocity_pole(body).fixed
    far, other = inflection_circle(body).far, bresse_circle(body).far
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
    pole, circle = velocity_pole(body).fixed, inflection_circle(body)
    z, diameter = point.position - pole, circle.far - circle.near
    below = np.abs(z) ** 2 - np.real(np.conj(z) * diameter)
    centre = point.position - np.abs(z) ** 2 * z / below
    bend = curvature_of_path(point)
    assert not bend.cusp.any()
    share = np.abs(z) ** 2 / np.abs(below)
    assert (np.abs(centre - bend.centre) <= 1e-9 * (1 + np.abs(z) + np.abs(pole)) * (1 + share) ** 2).all()


def test_a_shifting_body_has_its_velocity_pole_at_infinity():
    body = BodyMotion.sliding(PointMotion.of([1j], 2.0, 3j), 0.4)
    pole = velocity_pole(body)
    assert pole.kind.tolist() == [PoleKind.AT_INFINITY]
    assert np.isnan(pole.fixed).all()
    assert np.isnan(pole.moving).all()
    assert abs(np.real(np.conj(pole.direction[0]) * 2.0)) < 1e-15  # it lies across the velocity
    assert not inflection_circle(body).exists.any()
    assert not bresse_circle(body).exists.any()
    assert np.isnan(pole_velocity(body)).all()
    assert acceleration_pole(body).kind.tolist() == [PoleKind.AT_INFINITY]


def test_a_body_at_rest_has_its_poles_everywhere():
    body = BodyMotion.about(2j, Turning.of([0.3]))
    for pole in (velocity_pole(body), acceleration_pole(body), jerk_pole(body)):
        assert pole.kind.tolist() == [PoleKind.EVERYWHERE]
        assert np.isnan(pole.direction).all()


def test_nearly_no_turning_counts_as_none():
    """A crank angle of 90 degrees leaves a cosine of 6e-17, and a pole beyond all belief."""
    body = BodyMotion(PointMotion.of([0j], 50.0), Turning.of([0.0], 6e-17, 1.0))
    assert velocity_pole(body).kind.tolist() == [PoleKind.AT_INFINITY]
    assert acceleration_pole(body).finite.all()


def test_without_angular_acceleration_the_bresse_circle_is_a_line():
    body = BodyMotion(PointMotion.of([0j], 3j, -1.0), Turning.of([0.0], 2.0))
    assert inflection_circle(body).exists.all()
    circle = bresse_circle(body)
    assert not circle.exists.any()
    assert np.isnan(circle.far).all()


def test_cusp_and_straight_path():
    rolling = BodyMotion(PointMotion.of([1j], 1.0), Turning.of([0.0], -1.0))
    cusp = curvature_of_path(rolling.point(-1j))
    assert cusp.cusp.all()
    assert np.isnan(cusp.signed).all()
    straight = curvature_of_path(rolling.point(0j))
    assert straight.straight.all()
    assert straight.signed.tolist() == [0.0]
    assert np.isnan(straight.centre).all()


def test_sampling_does_not_matter():
    body = random_bodies(3, 50)
    one = BodyMotion(
        PointMotion(
            *(getattr(body.origin, name)[7:8] for name in ("position", "velocity", "acceleration", "jerk"))
        ),
        Turning(*(getattr(body.turning, name)[7:8] for name in ("theta", "omega", "alpha", "jerk"))),
    )
    assert velocity_pole(one).fixed[0] == velocity_pole(body).fixed[7]
    assert bresse_circle(one).far[0] == bresse_circle(body).far[7]


def test_poses_put_body_points_where_the_motion_says():
    body = random_bodies(4, 9)
    moved = body.poses(5.0).transform(np.array([[2.0, -1.0, 0.5]]))[:, 0]
    point = body.point(2 - 1j).position
    np.testing.assert_allclose(moved, np.column_stack((point.real, point.imag, np.full(9, 5.5))), atol=1e-12)
