"""Every four-bar through two poles with a given ground: the count, the certificates, what is said of them."""

import math

import numpy as np
import pytest
from by_night import by_night, in_ci
from four_bar_reference import SYNTHESIS, poles_of

from mechwright.mechanics.continuation import closed, read
from mechwright.mechanics.continuation.loops import new_ones
from mechwright.mechanics.continuation.paths import tracked
from mechwright.mechanics.continuation.trace import EXACT, read_cut, trace
from mechwright_four_bar.family import FourBars
from mechwright_four_bar.kinematics.loop import close
from mechwright_four_bar.requirements import PolesRequirement
from mechwright_four_bar.synthesis.poles.all_poles import CUT, FILE, SOLUTIONS, all_linkages
from mechwright_four_bar.synthesis.poles.equations import PoleProblem
from mechwright_four_bar.synthesis.poles.search import completed, search
from mechwright_four_bar.synthesis.poles.system import MOVING, TWO_POLES, any_parameters, any_solution

TWO = [case for case in SYNTHESIS if "two_poles" in case["kind"]]
SIZE = 30.0
"""mm to one unit of the reference."""


def asked(case):
    poles = tuple((SIZE * x, SIZE * y) for x, y in case["targets"])
    return poles, float(case["dphi_deg"]), float(case["theta_deg"]), SIZE * case["f"]


def problem(case):
    poles, turn, theta, ground = asked(case)
    places = np.array([complex(*pole) for pole in poles])
    return PoleProblem(places, np.radians([0.0, turn]), math.radians(theta), ground, 1, True)


@pytest.mark.parametrize(
    "case", [pytest.param(case, marks=by_night if n else ()) for n, case in enumerate(TWO)]
)
def test_all_solutions_of_the_reference_are_there_and_proven(case):
    """Those whose crank does not turn, too; and each of one branch has its poles there by the kinematics."""
    every = all_linkages(*asked(case))
    assert every.solutions.complete
    assert len(every.solutions.proven) == SOLUTIONS
    kept = [one for one in every.linkages if one.one_branch]
    for wanted in case["solutions"]:
        row = SIZE * np.array([wanted["a"], wanted["c"], wanted["b"]])
        same = [
            one
            for one in kept
            if np.abs(np.array(one.bar.lengths[:3]) / row - 1).max() < 1e-6
            and one.bar.branch == wanted["branch"]
        ]
        assert len(same) == 1, wanted
    for one in every.linkages:
        miss = np.abs(poles_of(one.bar, one.phi) - problem(case).targets)
        # Near a toggle rounded lengths lose digits.
        loop = close(one.bar, one.phi)
        room = np.abs(np.sin(np.angle(loop.coupler.direction / loop.follower.direction))).min()
        assert miss[0] < 1e-9 / room**3
        assert (miss[1] < 1e-9 / room**3) == one.one_branch


def test_linkages_that_no_start_led_to_are_added():
    case = TWO[0]
    every = all_linkages(*asked(case))
    found = search(problem(case), 2000, 0, lambda part: None).solutions
    assert completed(problem(case), found, every.turning) == found
    lengths = sorted(one.bar.crank for one in found if one.bar.kind.full_turn)
    assert len(lengths) == len(every.turning) > 0
    alone = completed(problem(case), (), every.turning)
    assert sorted(one.bar.crank for one in alone) == pytest.approx(lengths, rel=1e-12)
    assert all(one.residual < 1e-10 for one in alone)


def test_a_loop_leads_from_kept_solutions_to_kept_solutions():
    start, rng = read(FILE, TWO_POLES), np.random.default_rng(7)
    assert len(start.solutions) == SOLUTIONS
    known = start.solutions[:4]
    away = any_parameters(rng)
    for begin, end in (
        (start.parameters, away),
        (away, again := any_parameters(rng)),
        (again, start.parameters),
    ):
        known = tracked(TWO_POLES, known, begin, end).arrived
    assert len(known) > 0
    assert len(new_ones(known, start.solutions)) == 0


@in_ci
def test_the_sums_of_a_cut_prove_that_these_are_all():
    """The kept cut goes through the kept solutions, no two of which have one crank pin, and its sums are linear."""
    start, cut = read(FILE, TWO_POLES), read_cut(CUT)
    np.testing.assert_array_equal(cut.base, start.parameters)
    assert (cut.way[:MOVING] != 0).all()
    pins = start.solutions[:, cut.unknown]
    assert np.abs(pins[:, None] - pins + np.eye(SOLUTIONS)).min() > 1e-6
    found = trace(TWO_POLES, cut)
    assert found is not None
    assert found.proves(SOLUTIONS, EXACT)


@by_night
def test_loops_from_another_linkage_close_at_the_same_number():
    rng = np.random.default_rng(5)
    known, parameters = any_solution(rng)
    every = closed(TWO_POLES, known, parameters, lambda: any_parameters(rng), 4, lambda count: None)
    assert len(every) == SOLUTIONS


def said(**table):
    result = FourBars().synthesise("poles", PolesRequirement(**table), lambda part, text: None)
    return next(one for one in result.findings if one.code.startswith("poles.")).message


def test_what_is_said_of_the_count():
    two = {"poles": [(47.1, -39.3), (132.3, 51.9)], "crank_turns": [0, 54], "ground_angle": 10, "starts": 100}
    message = said(**two, ground=102.9)
    assert message.startswith(
        "141 found of 141 solutions, all of them, each certified; 11 of them are real, "
    )
    assert "4 of these with a full turn; 4 of them are given" in message
    driven = said(**two, ground=102.9, acceleration_ratios=[0.2])
    assert "in 200 starts" in driven
    assert "141" not in driven
