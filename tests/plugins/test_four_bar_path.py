"""Synthesis of the path of a coupler point: the search, against the independent check and known linkages."""

import math
from dataclasses import replace

import numpy as np
import pytest
from four_bar_paths import ANY, CLOSED, assert_no_defect, free, known, quiet
from synthesis_reference import fact, facts

from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.kinematics.loop import close
from mechwright_four_bar.synthesis.paths.asked import Limits
from mechwright_four_bar.synthesis.paths.descent import in_order, polish, screen
from mechwright_four_bar.synthesis.paths.kernels import linear
from mechwright_four_bar.synthesis.paths.limits import COUNT, broken
from mechwright_four_bar.synthesis.paths.refit import fitted
from mechwright_four_bar.synthesis.paths.search import PathSolution, path, search, unknowns
from mechwright_four_bar.synthesis.paths.starts import link_lengths, random_shapes

# ---- against the independent check


def case(name):
    given = fact(f"path.{name}.best_sse")["inputs"]
    limits = Limits(
        given["shortest_link"], given["longest_link"], math.radians(given["least_transmission_angle_deg"])
    )
    turns = None if given["timing"] is None else -np.radians(22.5 * np.arange(16))
    points = np.array([complex(*point) for point in given["points"]])
    return free(points, limits, given["closed"] and turns is None, turns=turns)


@pytest.mark.parametrize(
    ("name", "held"),
    [
        ("bean24", {"longest_link", "least_transmission_angle"}),
        ("line11", {"longest_link", "least_transmission_angle"}),
        ("drop16", set()),
    ],
)
def test_the_best_known_designs_within_limits_are_found(name, held):
    problem = case(name)
    best = search(problem, 60_000, 5, 0, quiet).solutions[0]
    known = fact(f"path.{name}.best_sse")["expected"]
    assert best.squares == pytest.approx(known, rel=1e-5)
    assert set(best.held) == held
    assert len(held) == len(
        {limit.split()[0] for limit in fact(f"path.{name}.active_limits")["expected"]} & {"mu"}
    ) + bool({limit for limit in fact(f"path.{name}.active_limits")["expected"] if limit.endswith("hi")})
    assert best.mean == pytest.approx(fact(f"path.{name}.rms")["expected"], rel=1e-5)
    assert_no_defect(best, problem.targets)


def of_reference(given, squares=0.0):
    one = given["design"]
    bar = FourBar(
        one["crank"], one["coupler"], one["follower"], one["ground"], math.radians(one["ground_angle_deg"]),
        int(one["branch"]),
    )  # fmt: skip
    phi = np.radians(given.get("crank_angles_from_ground_line_deg", [0.0])) + bar.ground_angle
    return PathSolution(bar, complex(*one["pivot"]), complex(*one["coupler_point"]), phi, squares)


@pytest.mark.parametrize("name", ["bean24", "line11", "drop16"])
def test_designs_of_the_reference_have_its_squares_and_angles(name):
    given = fact(f"path.{name}.design_sse")
    one, targets = of_reference(given["inputs"]), case(name).targets
    squares = np.sum(np.abs(path(one.bar, one.pivot, one.point, one.phi) - targets) ** 2)
    assert squares == pytest.approx(given["expected"], rel=1e-6)
    angle = fact(f"path.{name}.design_least_transmission_angle_deg")
    assert math.degrees(one.bar.least_transmission_angle()) == pytest.approx(angle["expected"], abs=1e-5)


@pytest.mark.parametrize("given", [one for one in facts("round.") if one["name"].endswith("after_refit")],
                         ids=lambda one: one["name"])  # fmt: skip
def test_rounded_lengths_fitted_again(given):
    """As the reference does, with no limit on the coupler point: fixed lengths, all else free."""
    inputs = given["inputs"]
    problem = case(inputs["case"])
    start = of_reference(fact(f"path.{inputs['case']}.design_sse")["inputs"])
    fixed = tuple(float(inputs[key]) for key in ("crank", "follower", "coupler", "ground"))
    wide = replace(problem, limits=Limits(1.0, 5000.0, math.radians(1)))
    result = fitted(start, wide, start.phi, fixed)
    assert isinstance(result, PathSolution)
    assert result.squares == pytest.approx(given["expected"], rel=1e-3)
    assert result.bar.lengths == pytest.approx(
        [inputs[key] for key in ("crank", "coupler", "follower", "ground")], rel=1e-8
    )


@pytest.mark.parametrize(
    "given",
    [one for one in facts("round.") if one["name"].endswith("without_refit")],
    ids=lambda one: one["name"],
)
def test_rounding_alone_costs_what_the_reference_says(given):
    inputs = given["inputs"]
    one, targets = (
        of_reference(fact(f"path.{inputs['case']}.design_sse")["inputs"]),
        case(inputs["case"]).targets,
    )
    step = inputs["increment"]
    bar = replace(
        one.bar,
        **{
            key: round(getattr(one.bar, key) / step) * step
            for key in ("crank", "coupler", "follower", "ground")
        },
    )
    phi = one.phi
    if inputs["phases"] != "as before":
        phi = np.linspace(0, math.tau, 200_001)
    run = path(bar, one.pivot, one.point, phi)
    if inputs["phases"] == "as before":
        squares = np.sum(np.abs(run - targets) ** 2)
    else:
        squares = sum(float(np.abs(run - target).min()) ** 2 for target in targets)
    # The check sampled the curve coarsely: its sums are too large by up to 0.003 mm², and never too small.
    assert given["expected"] - 0.003 <= squares <= given["expected"] * (1 + 1e-6)


@pytest.mark.parametrize("given", facts("transform."), ids=lambda one: str(one["inputs"]["p1"]))
def test_lengths_of_the_transform(given):
    inputs, expected = given["inputs"], given["expected"]
    double, mu = inputs["kind"] == "double-crank", math.radians(inputs["least_transmission_angle_deg"])
    b, c = inputs["follower"], inputs["coupler"]
    a, f = link_lengths(double, np.array(b), np.array(c), np.array(inputs["p1"]), np.array(inputs["p2"]), mu)
    assert (float(a), float(f)) == pytest.approx((expected["crank"], expected["ground"]), abs=1e-9)
    angle = FourBar(float(a), c, b, float(f)).least_transmission_angle()
    assert math.degrees(angle) == pytest.approx(expected["least_transmission_angle_deg"], abs=1e-9)


def test_a_sum_of_squares_of_the_literature():
    turns = np.radians(20 * np.arange(18))
    found = search(free(CLOSED, ANY, turns=turns), 60_000, 5, 0, quiet).solutions
    assert found[0].squares == pytest.approx(0.0099119274, rel=1e-6)
    assert_no_defect(found[0], CLOSED)
    np.testing.assert_allclose(np.diff(found[0].phi), np.radians(20), rtol=1e-12)


# ---- what the kernels do


def test_limits_and_their_slopes():
    """Each limit is what a linkage in millimetres says of it, and its slopes are the difference quotients."""
    rng = np.random.default_rng(2)
    frame = (-200.0, -150.0, 220.0, 190.0)
    limits = Limits(20.0, 150.0, math.radians(35), frame)
    problem = free(CLOSED * 100, limits)
    for _ in range(10):
        b, c, p = *rng.uniform(50, 100, 2), np.sort(rng.uniform(0, 1, 2))
        a, f = map(float, link_lengths(bool(rng.random() < 0.5), b, c, p[0], p[1], math.radians(5)))
        bar = FourBar(a, float(c), float(b), f, float(rng.uniform(0, 6)))
        one = PathSolution(
            bar, complex(*rng.uniform(-200, 200, 2)), complex(*rng.uniform(-150, 150, 2)), np.zeros(1), 0.0
        )
        z = unknowns(one, problem)
        array = limits.array(problem.centre, problem.size, (30.0, 40.0, 50.0, 60.0, 70.0, 80.0))
        array[:8] = limits.array(problem.centre, problem.size)[:8]
        values, slopes = np.empty(COUNT), np.empty((COUNT, 9))
        broken(z, array, values, slopes, True)
        ordered = (bar.crank, bar.follower, bar.coupler, bar.ground)
        np.testing.assert_allclose(values[:4], np.log(20.0 / np.array(ordered)), atol=1e-8)
        np.testing.assert_allclose(values[4:8], np.log(np.array(ordered) / 150.0), atol=1e-8)
        distances = np.abs([one.point, one.point - bar.coupler])
        np.testing.assert_allclose(values[8:10], distances / 150.0 - 1, atol=1e-8)
        near, far = bar.transmission_cosines()
        limit = math.cos(math.radians(35))
        np.testing.assert_allclose(values[10:12], [near - limit, -far - limit], atol=1e-8)
        pivots = [one.pivot, one.pivot + bar.ground * np.exp(1j * bar.ground_angle)]
        over = [d for z0 in pivots for d in (-200 - z0.real, -150 - z0.imag, z0.real - 220, z0.imag - 190)]
        np.testing.assert_allclose(values[12:20] * problem.size, over, atol=1e-6)
        place = [70 - one.point.real, 80 - one.point.imag, one.point.real - 70, one.point.imag - 80]
        np.testing.assert_allclose(values[20:] * problem.size, place, atol=1e-6)
        for i in range(9):
            step = np.zeros(9)
            step[i] = 1e-6
            above, below, none = np.empty(COUNT), np.empty(COUNT), np.empty((COUNT, 9))
            broken(z + step, array, above, none, False)
            broken(z - step, array, below, none, False)
            np.testing.assert_allclose(slopes[:, i], (above - below) / 2e-6, rtol=1e-5, atol=1e-6)


def test_screening_is_the_least_squares_of_numpy():
    rng = np.random.default_rng(3)
    shapes = np.column_stack((rng.normal(0, 1, 40), rng.normal(-1, 1, 40), rng.normal(0, 1, 40)))
    angles = np.sort(rng.uniform(0, 6, (40, 18)), axis=1)
    costs = screen(CLOSED, shapes, angles, 1, Limits(1e-9, 1e9, 1e-9).array(0j, 1.0))
    for shape, phi, cost in zip(shapes, angles, costs, strict=True):
        a = math.exp(shape[0])
        total, difference = (1 + a) * (1 + math.exp(shape[1])), abs(1 - a) * math.tanh(shape[2])
        loop = close(FourBar(a, (total - difference) / 2, (total + difference) / 2, 1.0), phi)
        columns = np.column_stack((np.ones(18), loop.joint_a, loop.coupler.direction))
        solution, *_ = np.linalg.lstsq(columns, CLOSED, rcond=None)
        wanted = np.sum(np.abs(columns @ solution - CLOSED) ** 2)
        assert cost == pytest.approx(wanted, rel=1e-6, abs=1e-9)


@pytest.mark.parametrize("way", [0, 1])
def test_polish_never_gets_worse_and_ends_in_a_minimum(way):
    rng = np.random.default_rng(5)
    none, limits = np.zeros(COUNT), Limits(1e-9, 1e9, 1e-9).array(0j, 1.0)
    for _ in range(10):
        shape = rng.normal(0, 0.7, 3)
        phi = np.sort(rng.uniform(0, 6, 18))
        solution, start = linear(CLOSED, shape, phi, 1)
        for _ in range(4):  # afresh: angles that are held together may come apart
            end = polish(CLOSED, solution, phi, 1, way, 0.0, limits, 1.0, none, 1000, 0.0, 0.0)
        assert end <= start * (1 + 1e-9)
        assert way == 0 or (np.diff(phi) >= 0).all()
        more = polish(CLOSED, solution, phi, 1, way, 0.0, limits, 1.0, none, 50, 0.0, 0.0)
        assert more >= end * (1 - 2e-2)


def test_angles_in_order_are_the_nearest():
    phi, group = np.array([0.0, 2.0, 1.0, 3.0]), np.empty(4)
    assert in_order(phi, 1, 0.0, group)
    np.testing.assert_allclose(phi, [0, 1.5, 1.5, 3])
    assert group.tolist() == [0, 1, 1, 3]
    phi = np.array([0.0, 2.0, 1.0, 3.0])
    assert not in_order(phi, 1, 1.0, group)
    assert phi.tolist() == [0, 2, 1, 3]
    phi = np.array([0.0, -2.0, -1.0, -9.0])
    in_order(phi, -1, 0.0, group)
    assert phi[3] == pytest.approx(-math.tau)


def test_starts_keep_the_transmission_angle_and_the_ratio():
    rng = np.random.default_rng(1)
    for double in (False, True):
        shapes = random_shapes(2000, double, 8.0, math.radians(40), rng)
        assert len(shapes) > 200
        for z in shapes[:200]:
            a = math.exp(z[0])
            total, difference = (1 + a) * (1 + math.exp(z[1])), abs(1 - a) * math.tanh(z[2])
            bar = FourBar(a, (total - difference) / 2, (total + difference) / 2, 1.0)
            assert bar.kind.full_turn
            assert (bar.kind.value == "double crank") == double
            assert math.degrees(bar.least_transmission_angle()) >= 40 - 1e-9
            assert max(bar.lengths) / min(bar.lengths) <= 8 * (1 + 1e-9)


# ---- known linkages come back


def test_a_known_mechanism_is_found_again():
    """Thirty-five points of a coupler curve, untimed: zero squares, and the curve itself."""
    bar, pivot, point, targets, _ = known()
    best = search(
        free(targets, Limits(10, 400, math.radians(15)), senses=(1,)), 50_000, 1, 0, quiet
    ).solutions[0]
    assert best.squares < 1e-18
    assert_no_defect(best, targets)
    # A cognate has other links; its coupler point runs on the same curve.
    whole = path(best.bar, best.pivot, best.point, np.linspace(0, math.tau, 20001))
    own = path(bar, pivot, point, np.linspace(0, math.tau, 97))
    assert np.abs(own[:, None] - whole[None, :]).min(axis=1).max() < 0.02


@pytest.mark.parametrize("turns", [None, np.array([0.0, 0.8, 2.0])])
def test_three_points_are_met_in_many_ways(turns):
    targets = np.array([0, 40, 50 + 30j])
    found = search(
        free(targets, Limits(10, 200, math.radians(30)), turns=turns), 2000, 50, 0, quiet
    ).solutions
    exact = [one for one in found if one.squares < 1e-20]
    assert len(exact) > 20
    for one in exact[:5]:
        assert_no_defect(one, targets)
        if turns is not None:
            np.testing.assert_allclose(one.phi - one.phi[0], turns, atol=1e-12)


def test_senses_are_kept():
    for sense in (1, -1):
        found = search(free(CLOSED, ANY, senses=(sense,)), 5000, 5, 0, quiet).solutions
        assert {one.sense for one in found} == {sense}
