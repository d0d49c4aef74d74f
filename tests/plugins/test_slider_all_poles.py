"""Every slider-crank through two poles: the count, the certificates, and what is said of them."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
from by_night import by_night

from mechwright.mechanics.continuation import closed, read
from mechwright.mechanics.continuation.loops import new_ones
from mechwright.mechanics.continuation.paths import tracked
from mechwright.mechanics.continuation.trace import EXACT, read_cut, trace
from mechwright.mechanics.planar import acceleration_pole
from mechwright_slider_crank.kinematics.slider_crank import SliderCrank
from mechwright_slider_crank.requirements import PolesRequirement
from mechwright_slider_crank.synthesis.designs import from_poles
from mechwright_slider_crank.synthesis.poles.all_poles import CUT, FILE, SOLUTIONS, all_linkages
from mechwright_slider_crank.synthesis.poles.equations import PoleProblem
from mechwright_slider_crank.synthesis.poles.synthesis import completed, through_poles
from mechwright_slider_crank.synthesis.poles.system import MOVING, TWO_POLES, any_parameters, any_solution

DATA = json.loads((Path(__file__).parents[1] / "data" / "planar-linkages.json").read_text())
TWO = [item for item in DATA["synthesis"] if item["kind"].startswith("slider") and "dphi_deg" in item]


def silent(done, what):
    pass


def of(item):
    return all_linkages(tuple(map(tuple, item["targets"])), float(item["dphi_deg"]), 0.0)


@pytest.mark.parametrize(
    "item", [pytest.param(item, marks=by_night if n else ()) for n, item in enumerate(TWO)]
)
def test_all_solutions_of_the_reference_are_there_and_proven(item):
    """Those whose crank does not turn, too; and none of them is one that misses the poles."""
    every = of(item)
    assert every.solutions.complete
    assert len(every.solutions.proven) == SOLUTIONS
    for wanted in item["solutions"]:
        row = np.array([wanted["a"], wanted["c"], wanted["e"]])
        same = [
            one
            for one in every.linkages
            if np.abs(np.array([one.crank, one.rod, one.offset]) - row).max() < 1e-6 * wanted["c"]
            and one.branch == wanted["branch"]
        ]
        assert len(same) == 1
        assert same[0].turns == bool(wanted["crank"])
    places = np.array([complex(*place) for place in item["targets"]])
    for one in every.linkages:
        if one.branch:
            angles = one.angle + np.radians([0.0, item["dphi_deg"]])
            linkage = SliderCrank(one.crank, one.rod, one.offset, 0.0, one.branch)
            seen = acceleration_pole(linkage.bodies(angles).rod).fixed
            np.testing.assert_allclose(seen, places, atol=1e-5 * np.abs(places).max())


def test_linkages_that_no_start_led_to_are_added():
    item = TWO[0]
    every, places = of(item), np.array([complex(*place) for place in item["targets"]])
    rotations = np.radians([item["dphi_deg"]])
    found, _ = through_poles(places, rotations, 2000, 1, silent)
    assert completed(found, every.turning, places, rotations) == found
    for left_out in found:
        rest = [one for one in found if one is not left_out]
        back = completed(rest, every.turning, places, rotations)
        assert [one.crank for one in back] == pytest.approx([one.crank for one in found], rel=1e-12)
        assert all(one.residual < 1e-10 for one in back)


def test_the_equations_are_those_of_the_search():
    """Unknowns of linkages drawn by lot solve them at the poles that the other equations say."""
    rng = np.random.default_rng(3)
    for branch in (1, -1):
        problem = PoleProblem(np.array([1.0, 1j]), np.array([0.0, 0.8]), branch)
        for row in problem.starts(20, rng):
            poles, a = problem.poles(row), math.exp(row[0])
            _, c, e = map(float, problem.lengths(row))
            pins = a * np.exp(1j * problem.angles(row))
            w = branch * np.sqrt(c * c - (e - pins.imag) ** 2)
            z = np.array([[pins[0], pins[0].conj(), *(-pins.real / w)]])
            p = np.array([*poles, *poles.conj(), np.exp(0.8j)])
            values, slopes, _ = TWO_POLES.at(z, p[None], 0 * p)
            assert np.abs(np.linalg.solve(slopes[0], values[0])).max() < 1e-5 * max(1, a)


def test_a_loop_leads_from_kept_solutions_to_kept_solutions():
    start, rng = read(FILE, TWO_POLES), np.random.default_rng(7)
    assert len(start.solutions) == SOLUTIONS
    one = start.solutions[:4]
    for begin, end in [
        (start.parameters, away := any_parameters(rng)),
        (away, again := any_parameters(rng)),
        (again, start.parameters),
    ]:
        one = tracked(TWO_POLES, one, begin, end).arrived
    assert len(one) > 0
    assert len(new_ones(one, start.solutions)) == 0


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


@by_night
def test_what_is_said_of_the_count():
    (count,) = (
        one
        for one in from_poles(PolesRequirement(starts=200), silent).findings
        if one.code == "slider-crank.count"
    )
    assert count.message.startswith("41 found of 41 solutions, all of them, each certified; ")
    driven = from_poles(PolesRequirement(starts=400, acceleration_ratios=(0.1,)), silent)
    (count,) = (one for one in driven.findings if one.code == "slider-crank.count")
    assert "found in 800 starts; whether there are more is not known" in count.message
