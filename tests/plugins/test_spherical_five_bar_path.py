"""Paths of spherical five-bars: found within their limits, counted, and said where there is none."""

import math

import numpy as np
import pytest
from by_night import in_ci
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import ValidationError

from mechwright.contracts.finding import errors
from mechwright.mechanics.planar import Turning
from mechwright_spherical.family import Spherical
from mechwright_spherical.kinematics.linkage import linkage_of
from mechwright_spherical.kinematics.loop import Loop
from mechwright_spherical.rules.rule_table import findings_of
from mechwright_spherical.synthesis.five_bar_limits import FiveBarRoom
from mechwright_spherical.synthesis.four_bar_limits import Bounds

FAMILY = Spherical()
ARCS = np.radians([50, 25, 60, 55, 30])
"""Ground, crank, coupler, rocker, arm of a five-bar that turns fully with an arm as fast as the crank."""

ANYWHERE = Bounds(0.0, math.pi, 0.0)


def room(theta, ratio, targets=None, turns=None, bounds=ANYWHERE, closed=False):
    targets = np.zeros((len(theta), 3)) if targets is None else targets
    sense = 1 if theta[-1] > theta[0] else -1
    return FiveBarRoom(targets, turns, ratio, 1, sense, closed, 0.5, bounds)


def unknowns(phase=0.4, kappa=0.5, eta=0.3, turn=(0.5, -0.5, 0.7, 0.2)):
    return np.array([*ARCS, phase, kappa, eta, *turn])


def known(theta, ratio):
    """Points (n, 3) of the known five-bar at crank angles (n,)."""
    one = room(theta, ratio)
    return 0.5 * one.missed(one.made(unknowns()), theta)


def ask(points, **table):
    asked = {"atlas": 1000, "starts": 2, "designs": 1, "least_transmission": 25} | table
    wanted = FAMILY.requirements["five-bar-path"].model_validate(
        {"points": np.array(points).tolist(), **asked}
    )
    return FAMILY.synthesise("five-bar-path", wanted, lambda done, what: None), wanted


def met(result, wanted, ratio):
    """Every candidate runs through the points that it claims to, passes the check and keeps every limit."""
    assert result.candidates
    for one in result.candidates:
        assert errors(FAMILY.check(one.params)) == []
        table = one.params.five_bar
        assert table.ratio == ratio
        phase = linkage_of(one.params).phases[0]
        steps = np.diff(phase.target_angles) * math.copysign(1, phase.travel)
        assert (steps >= 0).all()
        assert abs(phase.target_angles[-1]) <= abs(phase.travel) + 1e-9
        mean = wanted.radius * math.sqrt(np.mean(phase.path_errors**2))
        assert mean == pytest.approx(one.residual.value, rel=1e-3, abs=1e-8)
        mu = phase.loop.at(Turning.of(phase.sweep(5001)), 0).transmission
        assert math.degrees(np.minimum(mu, math.pi - mu).min()) >= wanted.least_transmission - 1e-9
        arcs = np.degrees([one.figures[name].value for name in ("least_arc", "greatest_arc")])
        assert wanted.least_arc - 1e-7 <= arcs[0] <= arcs[1] <= wanted.greatest_arc + 1e-7


@given(ratio=st.sampled_from([-2.0, -0.7, 0.5, 1.0, 3.0]), phase=st.floats(-3, 3), first=st.floats(-3, 3))
@settings(deadline=None)
def test_the_room_has_the_kinematics_of_the_family(ratio, phase, first):
    theta = first + np.linspace(0, 1.2, 7)
    own, x = room(theta, ratio), unknowns(phase)
    points = 0.5 * own.missed(own.made(x), theta)
    pins = own.pins(x, first)
    if not np.isfinite([*pins.values()]).all():
        assert not np.isfinite(points[0]).all()
        return
    loop = Loop.of_pins(pins["a0"], pins["a"], pins["b0"], pins["b"], pins["c"], pins["p"], ratio)
    np.testing.assert_allclose(points.T, loop.position(theta - first), atol=1e-11)


@pytest.mark.parametrize("ratio", [-2.0, 0.5, 1.0, 2.0])
@pytest.mark.parametrize("closed", [True, False])
def test_the_least_transmission_angle_is_that_of_a_fine_passage(ratio, closed):
    theta = np.array([0.3, 2.9])
    own = room(theta, ratio, closed=closed)
    made = own.made(unknowns())
    fine = 0.3 + np.linspace(0, math.tau if closed else 2.6, 40_001)
    a, b = own.driven(made, fine)
    mean, factor = math.cos(ARCS[2]) * math.cos(ARCS[3]), math.sin(ARCS[2]) * math.sin(ARCS[3])
    cosine = ((a * b).sum(axis=0) - mean) / factor
    found = own.cosines(made, theta)
    assert found.max() == pytest.approx(np.abs(cosine).max(), abs=1e-5)
    # And not only where the passage is at its worst.
    assert found[: len(found) // 2].max() == pytest.approx(cosine.max(), abs=1e-5)
    assert found[len(found) // 2 :].max() == pytest.approx(-cosine.min(), abs=1e-5)


def test_arcs_beyond_their_bounds_are_told_by_how_much():
    theta = np.array([0.3, 1.0])
    own = room(theta, 1.0, bounds=Bounds(math.radians(28), math.radians(58), 0.0))
    over = np.degrees(own.exceeded(own.made(unknowns()), theta)[:10])
    np.testing.assert_allclose(over, [-22, 3, -32, -27, -2, -8, -33, 2, -3, -28], atol=1e-6)


def test_an_open_path_comes_back_from_its_points():
    points = known(np.linspace(0.3, 2.8, 6), 0.5)
    result, wanted = ask(points, ratio=0.5, closed=False, starts=1, atlas=500)
    met(result, wanted, 0.5)
    assert result.candidates[0].residual.value < 1e-6
    assert result.findings[0].code == "spherical.path"


@in_ci
def test_a_closed_path_turns_the_crank_once():
    theta = 0.2 + math.tau * np.arange(14) / 14
    result, wanted = ask(known(theta, 1.0), ratio=1.0, least_transmission=15)
    met(result, wanted, 1.0)
    assert result.candidates[0].residual.value < 1e-6
    assert abs(result.candidates[0].params.five_bar.travel) == 360


@in_ci
def test_prescribed_angles_are_those_of_the_design():
    theta = np.linspace(0.3, 2.8, 9) + 0.1 * np.sin(np.arange(9))
    turns = np.degrees(theta - theta[0])
    result, wanted = ask(known(theta, 1.0), ratio=1.0, closed=False, angles=turns.tolist())
    met(result, wanted, 1.0)
    told = np.array(result.candidates[0].params.five_bar.path_angles)
    np.testing.assert_allclose(np.abs(told), turns, atol=1e-7)


@in_ci
def test_limits_hold_the_best_design_back():
    """With the bound at work the design lies on it, and none is below it."""
    result, wanted = ask(FAMILY.requirements["five-bar-path"]().points, least_transmission=50, designs=3)
    met(result, wanted, 1.0)
    least = min(math.degrees(one.figures["least_transmission"].value) for one in result.candidates)
    assert 50 <= least < 51


def test_a_design_of_one_path_has_nothing_to_be_set():
    result, _ = ask(known(np.linspace(0.3, 2.8, 6), 0.5), ratio=0.5, closed=False, starts=1, atlas=500)
    params = result.candidates[0].params
    assert params.five_bar.a1 == params.five_bar.a1n
    assert "spherical.setting" not in {one.code for one in findings_of(params)}
    assert "rocker-n" not in {part.name for part in FAMILY.parts(params)}


@pytest.mark.parametrize(
    ("table", "said"),
    [
        ({"ratio": 0}, "ratio is 0"),
        ({"ratio": 0.5}, "closed and ratio = 0.5 contradict"),
        ({"points": [[0, 0, 1]] * 5}, "all 5 are the same"),
        ({"least_arc": 60, "greatest_arc": 50}, "least_arc must be below"),
        ({"points": [[0, 0, 1], [0, 1, float("nan")], [1, 0, 1]]}, "finite number"),
        ({"points": [[0, 0, 1]]}, "at least 3"),
        ({"closed": False, "points": [[1, 0, 1], [0, 1, 1], [0, 0, 1]], "angles": [0, 20, 10]}, "one way"),
    ],
)
def test_what_contradicts_is_refused(table, said):
    with pytest.raises(ValidationError, match=said):
        FAMILY.requirements["five-bar-path"].model_validate(table)


def test_points_that_follow_each_other_in_one_place_are_named():
    result, _ = ask([[0, 0, 1], [0, 0.1, 1], [0, 0.1, 1], [0.1, 0.1, 1]])
    (finding,) = result.findings
    assert "points 2 and 3 are both (0, 0.1, 1)" in finding.message
    result, _ = ask([[0, 0, 1], [0, 0, 2], [0, 0, 3]])  # lengths of directions say nothing
    (finding,) = result.findings
    assert "all 3 points are (0, 0, 1)" in finding.message


@in_ci
def test_a_transmission_angle_that_none_keeps_is_refused_with_the_nearest():
    result, _ = ask(
        FAMILY.requirements["five-bar-path"]().points,
        least_transmission=80,
        least_arc=40,
        greatest_arc=41,
        starts=1,
        atlas=60,
    )
    assert not result.candidates
    said = str(result.findings[0])
    assert "starts no five-bar was found that keeps a transmission angle of 80 degrees" in said
    assert "the nearest misses the points by" in said or "near the points" in said


def test_arcs_come_in_steps_and_the_rest_is_fitted_again():
    points = known(np.linspace(0.2, 2.4, 7), 1.0)
    (one,) = ask(points, closed=False, atlas=300, starts=1, arc_step=5)[0].candidates
    pins = {name: np.array(getattr(one.params.five_bar, name)) for name in ("a0", "b0", "a1", "b1", "c1")}
    for two in (("a0", "b0"), ("a0", "a1"), ("a1", "c1"), ("b1", "c1"), ("b0", "b1")):
        arc = math.degrees(math.acos(float(pins[two[0]] @ pins[two[1]])))
        assert abs(arc / 5 - round(arc / 5)) < 1e-9, two
    assert one.figures["path_error_max"].value <= 3 * one.residual.value + 1e-6
