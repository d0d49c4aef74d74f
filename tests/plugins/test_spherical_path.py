"""Paths of spherical four-bars: found within their limits, counted, and said where there is none."""

import math

import numpy as np
import pytest
from by_night import in_ci
from pydantic import ValidationError

from mechwright.mechanics.planar import Turning
from mechwright_spherical.family import Spherical
from mechwright_spherical.kinematics.four_bar import FourBar
from mechwright_spherical.kinematics.vectors import arc
from mechwright_spherical.requirements import FourBarPathRequirement
from mechwright_spherical.synthesis.four_bar_limits import Bounds, FourBarRoom


def quiet(done, what):
    pass


def ask(kind, **table):
    return Spherical().synthesise(kind, Spherical.requirements[kind].model_validate(table), quiet)


def known_path(count, start=0.0, travel=math.tau, **shape):
    linkage = FourBar(*np.radians((60, 25, 70, 55)), 1.0, math.radians(30), math.radians(10))
    angles = start + travel * np.arange(count) / (count if travel == math.tau else count - 1)
    tilt = np.linalg.qr(np.random.default_rng(8).normal(size=(3, 3)))[0]
    tilt *= np.sign(np.linalg.det(tilt))
    return (tilt @ linkage.loop().position(angles)).T, np.degrees(angles - angles[0])


def residual(found):
    return found.candidates[0].residual.value


def test_a_closed_path_of_a_four_bar_is_found_again():
    path, _ = known_path(9)
    found = ask("four-bar-path", points=path.tolist(), atlas=300, starts=1)
    assert residual(found) < 0.2
    four_bar = found.candidates[0].params.four_bar
    assert abs(four_bar.travel) == 360
    steps = np.diff(four_bar.path_angles)
    assert (np.sign(steps) == np.sign(four_bar.travel)).all()


def test_an_open_path_with_prescribed_timing_is_found_again():
    path, angles = known_path(6, start=0.4, travel=2.0)
    found = ask(
        "four-bar-path", points=path.tolist(), angles=angles.tolist(), closed=False, atlas=300, starts=1
    )
    assert residual(found) < 0.05
    assert found.candidates[0].params.four_bar.path_angles == pytest.approx(
        np.sign(found.candidates[0].params.four_bar.travel) * angles, abs=1e-6
    )


def test_an_open_path_with_free_timing_is_met():
    path, _ = known_path(6, start=0.4, travel=2.0)
    found = ask("four-bar-path", points=path.tolist(), closed=False, atlas=300, starts=1)
    assert residual(found) < 0.02


def test_four_bars_respect_the_transmission_bound():
    for one in ask("four-bar-path", atlas=200, starts=1).candidates:
        assert one.figures["least_transmission"].value > math.radians(29)


@in_ci
def test_random_starts_are_the_seeds():
    one, two = (ask("four-bar-path", atlas=200, starts=1, seed=seed) for seed in (1, 2))
    assert one.candidates[0].params != two.candidates[0].params


def test_the_default_oval_is_no_four_bars_own_but_met_within_a_quarter_of_a_millimetre():
    found = ask("four-bar-path", atlas=600, starts=1)
    assert residual(found) < 0.25
    assert FourBarPathRequirement().radius == 100
    assert float(arc(*(np.array(p) for p in FourBarPathRequirement().points[:2]))) > 0.05


def test_a_path_keeps_its_limits_to_the_last_digit():
    table = {
        "atlas": 200,
        "starts": 1,
        "designs": 3,
        "least_transmission": 45,
        "least_arc": 20,
        "greatest_arc": 85,
    }
    wanted = FourBarPathRequirement.model_validate(table)
    result = Spherical().synthesise("four-bar-path", wanted, quiet)
    assert result.candidates
    for one in result.candidates:
        four_bar = one.params.four_bar
        arcs = [four_bar.ground, four_bar.input, four_bar.coupler, four_bar.output]
        assert 20 - 1e-9 <= min(arcs) <= max(arcs) <= 85 + 1e-9
        theta = Turning.of(np.linspace(0, 2 * np.pi, 1441))
        mu = np.degrees(FourBar(*np.radians(arcs), four_bar.branch).at(theta, 0).transmission)
        assert np.minimum(mu, 180 - mu).min() >= 45
    # The bound holds the best design back: it lies on it.
    assert math.degrees(result.candidates[0].figures["least_transmission"].value) == pytest.approx(
        45, abs=1e-3
    )


@in_ci
def test_a_transmission_angle_that_none_keeps_is_refused_with_the_best():
    table = {"atlas": 60, "starts": 1, "least_transmission": 80, "greatest_arc": 40}
    result = Spherical().synthesise("four-bar-path", FourBarPathRequirement.model_validate(table), quiet)
    assert not result.candidates
    assert result.findings[0].parameter == "least_transmission"
    said = str(result.findings[0])
    assert " starts no four-bar was found that keeps a transmission angle of 80 degrees" in said
    assert "with arcs of 12 to 40: the best of them has 78." in said
    codes = {one.code for one in result.rejected}
    assert codes
    assert codes <= {"spherical.transmission", "spherical.limits"}


@pytest.mark.parametrize(
    ("table", "said"),
    [
        ({"points": [[0, 0, 1]] * 5}, "all 5 are the same"),
        ({"least_arc": 60, "greatest_arc": 50}, "least_arc must be below"),
        ({"points": [[0, 0, 1], [0, 1, float("nan")], [1, 0, 1]]}, "finite number"),
    ],
)
def test_path_requirements_that_contradict_are_refused(table, said):
    with pytest.raises(ValueError, match=said):
        FourBarPathRequirement.model_validate(table)


@in_ci
def test_a_dense_path_is_met_and_its_design_shows_a_part_of_the_points():
    """Of 80 points 40, even along the path, are searched with; what is found meets all of them."""
    path, _ = known_path(80)
    found = ask("four-bar-path", points=[*path.tolist(), path[0].tolist()], closed=False, atlas=300, starts=1)
    assert residual(found) < 1e-6
    four_bar = found.candidates[0].params.four_bar
    assert abs(four_bar.travel) == 360  # the first point came again
    assert 30 < len(four_bar.path) <= 40
    assert found.findings[0].code == "spherical.path"
    assert {one.code for one in found.rejected} <= {
        "synthesis.near-another", "synthesis.beyond-the-number", "spherical.transmission", "spherical.limits"
    }  # fmt: skip


def test_points_that_are_one_are_named():
    found = ask(
        "four-bar-path", points=[[0, 0, 1], [0, 0.1, 1], [0, 0.1, 1], [0.1, 0.1, 1]], atlas=60, starts=1
    )
    (finding,) = found.findings
    assert "points 2 and 3 are both (0, 0.1, 1)" in finding.message


def test_the_room_knows_the_linkage():
    """Unknowns of a known four-bar draw its path, its limits are passed by what they are passed by."""
    linkage = FourBar(*np.radians([80, 30, 70, 60]), 1.0, *np.radians([35, 15]))
    theta = np.linspace(0.3, 2.5, 9)
    state = linkage.at(Turning.of(theta), 0)
    bounds = Bounds(math.radians(40), math.radians(65), math.radians(80))
    room = FourBarRoom(state.p[0].T, None, 1, 1, False, 0.5, bounds)
    x = np.concatenate([np.radians([80, 30, 70, 60, 35, 15]), [2.0, 0, 0, 0]])
    np.testing.assert_allclose(room.missed(room.made(x), theta), 0, atol=1e-14)
    over = room.exceeded(room.made(x), theta)
    wanted = np.radians([-40, 10, -30, -20, 15, -35, 5, -5])
    np.testing.assert_allclose(over[:8], wanted, atol=2e-9)
    fine = linkage.at(Turning.of(np.linspace(0.3, 2.5, 4001)), 0).transmission
    assert over[8:].max() == pytest.approx(np.abs(np.cos(fine)).max() - math.cos(math.radians(80)), abs=1e-6)


def test_arcs_come_in_steps_and_the_rest_is_fitted_again():
    path, _ = known_path(9)
    found = ask("four-bar-path", points=path.tolist(), atlas=300, starts=1, arc_step=4, designs=1)
    (one,) = found.candidates
    table = one.params.four_bar
    for name in ("ground", "input", "coupler", "output", "point_azimuth", "point_elevation"):
        assert getattr(table, name) % 4 == 0, name
    # The design itself, with its digits, misses the points by what is said.
    assert one.figures["path_error_max"].value <= 3 * one.residual.value < 6
    with pytest.raises(ValidationError, match=r"0\.7 does not divide 180 degrees.*give 0\.70038"):
        ask("four-bar-path", arc_step=0.7)
