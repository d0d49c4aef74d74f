"""Synthesis of the path of a coupler point."""

import math
import time

import numpy as np
import pytest
from pydantic import ValidationError

from mechwright.contracts.finding import Severity, errors
from mechwright_four_bar.dimensions import FourBar
from mechwright_four_bar.family import FourBars
from mechwright_four_bar.loop import close
from mechwright_four_bar.path_kernels import linear, polish, screen
from mechwright_four_bar.path_search import path, search
from mechwright_four_bar.plates import pivot_of
from mechwright_four_bar.reach import bar_of
from mechwright_four_bar.requirements import PathRequirement

CLOSED = np.array(
    [
        *(0.5 + 1.1j, 0.4 + 1.1j, 0.3 + 1.1j, 0.2 + 1j, 0.1 + 0.9j, 0.005 + 0.75j, 0.02 + 0.6j, 0.5j, 0.4j),
        *(0.03 + 0.3j, 0.1 + 0.25j, 0.15 + 0.2j, 0.2 + 0.3j, 0.3 + 0.4j, 0.4 + 0.5j, 0.5 + 0.7j, 0.6 + 0.9j),
        0.6 + 1j,
    ]
)
LINE = 20 + 1j * np.arange(20.0, 46.0, 5.0)
STARTS = 100_000


def quiet(part, text=""):
    pass


def assert_no_defect(one, targets):
    """The coupler point passes the points in order on one branch, in one turn, with the crank turning fully."""
    steps = np.diff(one.phi)
    assert (steps > 0).all() or (steps < 0).all()
    assert abs(one.phi[-1] - one.phi[0]) < math.tau
    assert one.bar.kind.full_turn
    turn = close(one.bar, np.linspace(0, math.tau, 721))
    assert np.isfinite(turn.joint_b).all()
    side = np.sign((turn.coupler.direction * np.conj(turn.follower.direction)).imag)
    assert (side == side[0]).all()
    again = np.sum(np.abs(path(one.bar, one.pivot, one.point, one.phi) - targets) ** 2)
    assert again == pytest.approx(one.squares, rel=1e-9, abs=1e-25)


def test_eighteen_timed_points():
    turns = np.radians(20 * np.arange(18))
    started = time.process_time()
    found = search(CLOSED, turns, "any", STARTS, 0, 0.0, quiet)
    assert time.process_time() - started < 30
    assert found[0].squares <= 0.00992
    assert found[0].squares == pytest.approx(0.0099119274, rel=1e-6)
    assert_no_defect(found[0], CLOSED)
    np.testing.assert_allclose(np.diff(found[0].phi), np.radians(20), rtol=1e-12)


def test_a_straight_line_of_six_points():
    started = time.process_time()
    found = search(LINE, None, "any", STARTS, 0, math.radians(10), quiet)
    assert time.process_time() - started < 30
    assert found[0].squares <= 1e-20
    assert_no_defect(found[0], LINE)


def test_a_known_mechanism_is_found_again():
    """Thirty-five points of a coupler curve, untimed: zero squares, and the curve itself."""
    bar, pivot, point = FourBar(30, 80, 70, 90, 0.4), 12 - 7j, 55 + 35j
    phi = 0.3 + np.linspace(0, 5.9, 35) + 0.05 * np.sin(np.arange(35))
    targets = path(bar, pivot, point, phi)
    started = time.process_time()
    found = search(targets, None, "ccw", 40_000, 0, math.radians(15), quiet)
    assert time.process_time() - started < 30
    best = found[0]
    assert best.squares < 1e-18
    assert_no_defect(best, targets)
    # A cognate has other links; its coupler point runs on the same curve.
    whole = path(best.bar, best.pivot, best.point, np.linspace(0, math.tau, 20001))
    own = path(bar, pivot, point, np.linspace(0, math.tau, 97))
    assert np.abs(own[:, None] - whole[None, :]).min(axis=1).max() < 0.02


@pytest.mark.parametrize("turns", [None, np.array([0.0, 0.8, 2.0])])
def test_three_points_are_met_in_many_ways(turns):
    targets = np.array([0, 40, 50 + 30j])
    found = search(targets, turns, "any", 2000, 0, math.radians(20), quiet)
    exact = [one for one in found if one.squares < 1e-20]
    assert len(exact) > 20
    for one in exact[:5]:
        assert_no_defect(one, targets)
        if turns is not None:
            np.testing.assert_allclose(one.phi - one.phi[0], turns, atol=1e-12)


def test_senses_are_kept():
    for sense, sign in (("ccw", 1), ("cw", -1)):
        found = search(CLOSED, None, sense, 5000, 0, 0.0, quiet)
        assert {one.sense for one in found} == {sign}


def test_screening_is_the_least_squares_of_numpy():
    rng = np.random.default_rng(3)
    shapes = np.column_stack((rng.normal(0, 1, 40), rng.normal(-1, 1, 40), rng.normal(0, 1, 40)))
    angles = np.sort(rng.uniform(0, 6, (40, 18)), axis=1)
    costs = screen(CLOSED, shapes, angles, 1)
    for shape, phi, cost in zip(shapes, angles, costs, strict=True):
        a = math.exp(shape[0])
        total, difference = (1 + a) * (1 + math.exp(shape[1])), abs(1 - a) * math.tanh(shape[2])
        loop = close(FourBar(a, (total - difference) / 2, (total + difference) / 2, 1.0), phi)
        columns = np.column_stack((np.ones(18), loop.joint_a, loop.coupler.direction))
        solution, *_ = np.linalg.lstsq(columns, CLOSED, rcond=None)
        wanted = np.sum(np.abs(columns @ solution - CLOSED) ** 2)
        assert cost == pytest.approx(wanted, rel=1e-6, abs=1e-9)


@pytest.mark.parametrize("timed", [True, False])
def test_polish_never_gets_worse_and_ends_in_a_minimum(timed):
    rng = np.random.default_rng(5)
    for _ in range(10):
        shape = rng.normal(0, 0.7, 3)
        phi = np.sort(rng.uniform(0, 6, 18))
        start = screen(CLOSED, shape[None], phi[None], 1)[0]
        solution = linear(CLOSED, shape, phi, 1)
        end = polish(CLOSED, solution, phi, 1, timed, 400, 0.0)
        assert end <= start * (1 + 1e-9)
        more = polish(CLOSED, solution, phi, 1, timed, 50, 0.0)
        assert more >= end * (1 - 1e-2)


def test_the_family_gives_designs_whose_point_meets_the_line():
    result = FourBars().synthesise("path", PathRequirement(), quiet)
    assert errors(result.findings) == []
    best = result.candidates[0]
    assert best.figures["sum_of_squares"].value <= 1e-20
    motion = FourBars().solve(best.params, 7201)
    run = motion.channels["xP"].values + 1j * motion.channels["yP"].values
    assert np.abs(LINE[:, None] - run[None, :]).min(axis=1).max() < 0.05
    first = best.figures["first_crank_angle"].value
    assert (
        abs(
            path(bar_of(best.params), pivot_of(best.params), best.params.coupler_point, np.array([first]))[0]
            - LINE[0]
        )
        < 1e-9
    )
    sense = 1 if best.figures["crank_turn"].value > 0 else -1
    assert best.params.direction == ("ccw" if sense > 0 else "cw")


def table(**changes):
    return PathRequirement.model_validate({"starts": 4000, "designs": 3, **changes})


def test_limits_of_the_requirement_are_kept():
    for one in FourBars().synthesise("path", table(), quiet).candidates:
        assert min(bar_of(one.params).lengths) >= 10
        assert one.figures["longest_link"].value <= 1000
        assert one.figures["least_transmission_angle"].value >= math.radians(20)
    tight = table(longest_link=150, shortest_link=15, least_transmission_angle=30)
    for one in FourBars().synthesise("path", tight, quiet).candidates:
        assert min(bar_of(one.params).lengths) >= 15
        assert one.figures["longest_link"].value <= 150
        assert one.figures["least_transmission_angle"].value >= math.radians(30)


def test_what_cannot_be_met_is_said():
    points = [(100 * z.real, 100 * z.imag) for z in CLOSED]
    turns = [20.0 * k for k in range(18)]
    missed = FourBars().synthesise("path", table(points=points, crank_turns=turns, tolerance=0.5), quiet)
    (finding,) = missed.findings
    assert (finding.code, finding.severity) == ("path.missed", Severity.WARNING)
    assert finding.value == pytest.approx(100 * math.sqrt(0.0099119274 / 18), rel=1e-3)
    met = FourBars().synthesise("path", table(points=points, crank_turns=turns, tolerance=3), quiet)
    assert met.findings == ()
    assert met.candidates[0].residual.value <= 3
    none = FourBars().synthesise("path", table(longest_link=30, shortest_link=29), quiet)
    (finding,) = none.findings
    assert (finding.code, finding.severity) == ("path.limits", Severity.ERROR)
    small = [(x / 50, y / 50) for x, y in points]
    tiny = FourBars().synthesise("path", table(points=small, crank_turns=turns, shortest_link=1), quiet)
    assert errors(tiny.findings)


def test_the_seed_decides():
    one, two, three = (
        FourBars().synthesise("path", table(seed=seed, starts=1000), quiet) for seed in (1, 1, 2)
    )
    assert one == two
    assert one != three


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"crank_turns": [0, 10]}, "crank_turns"),
        ({"crank_turns": [0, 10, 5, 20, 30, 40]}, "one way"),
        ({"crank_turns": [0, 10, 20, 30, 40, 400]}, "one turn"),
        ({"points": [(0, 0), (1, 1)]}, "points"),
        ({"points": [(0, 0), (1, 1), (0, 0)]}, "twice"),
        ({"shortest_link": 500, "longest_link": 100}, "shortest_link"),
    ],
)
def test_wrong_requirements_are_refused_by_name(changes, message):
    with pytest.raises(ValidationError, match=message):
        table(**changes)
