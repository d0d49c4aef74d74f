"""Roberts' cognates against the independent check, and that all three draw one curve."""

import math

import numpy as np
import pytest
from synthesis_reference import facts

from mechwright_four_bar.kinematics.cognates import cognates, third_pivot
from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.synthesis.paths.search import path


def of(given):
    bar = FourBar(
        given["a"], given["c"], given["b"], given["f"], math.radians(given["theta_deg"]), given["branch"]
    )
    start = math.radians(given["start_phi_deg"]) + bar.ground_angle
    return bar, complex(*given["pivot"]), complex(*given["q"]), start + np.linspace(0, 0.3, 5)


@pytest.mark.parametrize("given", facts("cognate."), ids=lambda one: one["name"])
def test_numbers_of_the_check(given):
    bar, pivot, point, phi = of(given["inputs"])
    what, expected = given["name"].split(".")[2:], given["expected"]
    if what == ["third_pivot"]:
        assert third_pivot(bar, pivot, point) == pytest.approx(complex(*expected), abs=1e-9)
        return
    if what == ["lambda"]:
        assert point / bar.coupler == pytest.approx(complex(*expected), abs=1e-12)
        return
    ones = [one for one in cognates(bar, pivot, point, phi) if one.number == int(what[0])]
    if len(what) == 2:
        assert math.degrees(ones[0].bar.least_transmission_angle()) == pytest.approx(expected, abs=1e-7)
        return
    # The check starts linkage 3 at C0, linkage 2 at A0; the other of each pair is driven from its other end.
    one = ones[0]
    assert one.bar.lengths == pytest.approx(
        [expected[key] for key in ("first_link", "coupler", "last_link", "ground")], abs=1e-8
    )
    turned = math.radians(expected["ground_angle_deg"])
    assert math.remainder(one.bar.ground_angle - turned, math.tau) == pytest.approx(0, abs=1e-9)
    assert one.pivot == pytest.approx(complex(*expected["pivot"]), abs=1e-8)
    assert one.point == pytest.approx(complex(*expected["coupler_point"]), abs=1e-8)
    assert one.bar.branch == expected["branch_at_start"]


def test_all_draw_the_same_points_at_the_same_time():
    rng = np.random.default_rng(8)
    for _ in range(20):
        a, c, b, f = 40 * rng.uniform(0.5, 1), 120, 100 * rng.uniform(0.9, 1.1), 100
        bar = FourBar(float(a), c, float(b), f, float(rng.uniform(0, 6)), int(rng.choice((-1, 1))))
        pivot, point = complex(*rng.uniform(-50, 50, 2)), complex(*rng.uniform(-80, 80, 2))
        phi = rng.uniform(0, 6) + np.linspace(0, 6, 40)
        own = path(bar, pivot, point, phi)
        ones = cognates(bar, pivot, point, phi)
        assert [one.number for one in ones] == [1, 1, 2, 2, 3, 3]
        turning = [one for one in ones if one.bar.kind.full_turn]
        assert len(turning) >= 2, "a crank-rocker has one cognate that is one too"
        for one in turning:
            np.testing.assert_allclose(path(one.bar, one.pivot, one.point, one.phi), own, atol=1e-9)
        same = turning[1]
        assert same.bar.least_transmission_angle() == pytest.approx(bar.least_transmission_angle())
        np.testing.assert_allclose(same.phi - same.phi[0], phi - phi[0], atol=1e-9)


def test_a_coupler_point_in_a_joint_has_no_cognate():
    bar = FourBar(40, 120, 80, 100)
    assert [one.number for one in cognates(bar, 0j, 0j, np.array([0.0, 0.5]))] == [1, 1]


def test_hoecken_s_linkage_is_the_cognate_of_chebyshev_s():
    chebyshev = FourBar(5, 2, 5, 4, branch=-1)
    every = cognates(chebyshev, 0j, 1 + 0j, np.radians([40, 60, 80]))
    turning = [one.bar for one in every if one.bar.kind.full_turn]
    assert turning
    for bar in turning:
        assert bar.lengths == pytest.approx((1, 2.5, 2.5, 2), abs=1e-12)
