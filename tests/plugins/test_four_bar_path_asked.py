"""Synthesis of the path of a coupler point, as the family is asked: what it gives, its limits, what is said."""

import math
import re

import numpy as np
import pytest
from by_night import by_night
from four_bar_paths import CLOSED, ELLIPSE, known, quiet
from pydantic import ValidationError

from mechwright.contracts.finding import Severity, errors
from mechwright_four_bar.family import FourBars
from mechwright_four_bar.kinematics.reach import bar_of
from mechwright_four_bar.requirements import PathRequirement
from mechwright_four_bar.synthesis.paths.asked import Limits
from mechwright_four_bar.synthesis.paths.search import path
from mechwright_four_bar.synthesis.paths.starts import link_lengths
from mechwright_four_bar.table import FourBarTable

LINE = 20 + 1j * np.arange(20.0, 46.0, 5.0)


def table(**changes):
    return PathRequirement.model_validate({"starts": 6000, "designs": 3, **changes})


def asked(**changes):
    return FourBars().synthesise("path", table(**changes), quiet)


def test_the_family_gives_designs_whose_point_meets_the_line():
    result = asked()
    assert errors(result.findings) == []
    best = result.candidates[0]
    assert best.figures["sum_of_squares"].value <= 1e-18
    motion = FourBars().solve(best.params, 7201)
    run = motion.channels["xP"].values + 1j * motion.channels["yP"].values
    assert np.abs(LINE[:, None] - run[None, :]).min(axis=1).max() < 0.05
    bar, point = bar_of(best.params), best.params.coupler_point
    first = best.figures["first_crank_angle"].value
    assert abs(path(bar, FourBarTable.of(best.params).pivot, point, np.array([first]))[0] - LINE[0]) < 1e-8
    turn = best.figures["crank_turn"].value
    assert (
        abs(path(bar, FourBarTable.of(best.params).pivot, point, np.array([first + turn]))[0] - LINE[-1])
        < 1e-8
    )
    sense = 1 if turn > 0 else -1
    assert best.params.direction == ("ccw" if sense > 0 else "cw")


@pytest.mark.parametrize(
    "limits",
    [
        {"longest_link": 200, "least_transmission_angle": 45},
        {"longest_link": 120, "shortest_link": 15, "least_transmission_angle": 30},
        {"longest_link": 200, "frame": [-60, -130, 60, -20]},
        {"longest_link": 150, "length_step": 0.5},
    ],
)
def test_every_design_keeps_every_limit_and_can_be_built(limits):
    result = asked(points=ELLIPSE, closed=True, **limits)
    wanted = table(points=ELLIPSE, closed=True, **limits)
    assert result.candidates
    for one in result.candidates:
        bar, pivot, point = bar_of(one.params), FourBarTable.of(one.params).pivot, one.params.coupler_point
        assert min(bar.lengths) >= wanted.shortest_link
        assert max(*bar.lengths, abs(point), abs(point - bar.coupler)) <= wanted.longest_link
        assert math.degrees(bar.least_transmission_angle()) >= wanted.least_transmission_angle
        if wanted.frame:
            for z in (pivot, pivot + bar.ground * np.exp(1j * bar.ground_angle)):
                assert wanted.frame[0] <= z.real <= wanted.frame[2]
                assert wanted.frame[1] <= z.imag <= wanted.frame[3]
        if wanted.length_step:
            for value in (*bar.lengths, point.real, point.imag):
                assert value / 0.5 == pytest.approx(round(value / 0.5), abs=1e-9)
        assert errors(FourBars().check(one.params)) == []


def test_a_limit_holds_the_nearest_design_back():
    result = asked(points=ELLIPSE, closed=True, longest_link=200)
    assert result.candidates[0].residual.value == pytest.approx(0.11382, abs=1e-4)
    assert result.findings[0].code == "path.found"
    assert result.findings[0].value >= len(result.candidates)
    _, note = result.findings
    assert (note.code, note.severity) == ("path.held", Severity.NOTE)
    assert "longest_link holds" in note.message
    wider = asked(points=ELLIPSE, closed=True, longest_link=300)
    assert wider.candidates[0].residual.value == pytest.approx(0.05105, abs=1e-4)


def test_a_path_that_ends_where_it_begins_is_closed():
    one = asked(points=[*ELLIPSE, ELLIPSE[0]], longest_link=200)
    assert one.candidates == asked(points=ELLIPSE, closed=True, longest_link=200).candidates


def test_dense_points_that_step_back():
    *_, targets, _ = known(300, math.tau * 299 / 300, 0.01)
    rng = np.random.default_rng(4)
    noisy = targets + 0.6 * (rng.normal(size=300) + 1j * rng.normal(size=300)) / math.sqrt(2)
    result = asked(points=[(z.real, z.imag) for z in noisy], closed=True, longest_link=200)
    assert result.candidates[0].residual.value < 0.6
    (note,) = [one for one in result.findings if one.code == "path.order"]
    assert note.value > 10
    exact = asked(points=[(z.real, z.imag) for z in targets], closed=True, longest_link=200)
    assert exact.candidates[0].residual.value < 1e-8


def test_designs_are_distinct():
    """The ellipse is its own image under two reflections and half a turn."""
    result = asked(points=ELLIPSE, closed=True, longest_link=200, designs=6)
    triples = []
    for one in result.candidates:
        bar, point = bar_of(one.params), one.params.coupler_point
        triples.append(sorted((*bar.lengths, abs(point), abs(point - bar.coupler))))
    for i, one in enumerate(triples):
        for other in triples[:i]:
            assert np.abs(np.array(one) - other).max() > 0.1


def test_what_cannot_be_met_is_said():
    points = [(100 * z.real, 100 * z.imag) for z in CLOSED]
    turns = [20.0 * k for k in range(18)]
    timed = {"points": points, "crank_turns": turns, "longest_link": 2000, "shortest_link": 1,
             "least_transmission_angle": 1}  # fmt: skip
    missed = asked(**timed, tolerance=0.5)
    _, finding = missed.findings
    assert (finding.code, finding.severity) == ("path.missed", Severity.WARNING)
    assert finding.value >= 100 * math.sqrt(0.0099119274 / 18) * (1 - 1e-6)
    met = asked(**timed, tolerance=4)
    assert not any(one.code == "path.missed" for one in met.findings)
    assert met.candidates[0].residual.value <= 4


@pytest.mark.parametrize(
    ("changes", "code", "said"),
    [
        ({"longest_link": 30, "shortest_link": 25}, "path.contradiction", "1.4281"),
        ({"frame": [0, 0, 5, 5]}, "path.contradiction", "frame and shortest_link"),
        ({"points": [(1, 2)] * 4}, "path.points", r"all 4 points are \(1, 2\)"),
        ({"points": [(1, 2), (3, 4), (3, 4), (5, 5)]}, "path.points", r"points 2 and 3 are both \(3, 4\)"),
        ({"longest_link": 100, "frame": [500, 500, 600, 600]}, "path", "frame"),
    ],
)
def test_a_requirement_that_nothing_meets_says_why(changes, code, said):
    result = asked(**changes)
    if result.candidates:
        (finding,) = [one for one in result.findings if one.code == "path.held"]
    else:
        (finding,) = errors(result.findings)
    assert finding.code.startswith(code)
    assert re.search(said, finding.message)


def test_a_dwell_in_which_the_point_stands_still_may_be_asked_for():
    points = [(0, 0), (20, 10), (40, 0), (40, 0), (40, 0), (20, -10)]
    result = asked(points=points, crank_turns=[0, 60, 120, 140, 160, 260])
    assert result.candidates


def test_the_ratio_of_a_contradiction_is_the_least_there_is():
    rng = np.random.default_rng(7)
    for mu in (20, 40, 60):
        limits = Limits(1.0, 100.0, math.radians(mu))
        ratios = []
        for double in (False, True):
            b, c = np.exp(rng.uniform(-0.3, 0.3, (2, 20_000)))
            p1, p2 = np.sort(rng.uniform(0, 1, (2, 20_000)), axis=0)
            links = np.stack((b, c, *link_lengths(double, b, c, p1, p2, math.radians(mu))))
            ratios.append((links.max(axis=0) / links.min(axis=0)).min())
        assert limits.least_ratio <= min(ratios) <= limits.least_ratio * 1.05


def test_the_seed_decides():
    loose = {"points": [(0, 0), (30, 5), (50, 30), (20, 45)], "starts": 1000}
    one, two, three = (asked(seed=seed, **loose) for seed in (1, 1, 2))
    assert one == two
    assert one != three


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"crank_turns": [0, 10]}, "crank_turns"),
        ({"crank_turns": [0, 10, 5, 20, 30, 40]}, "turns back from 10 to 5 degrees, its 2nd and 3rd"),
        ({"crank_turns": [0, 10, 10, 20, 30, 40]}, "stands at 10 degrees, its 2nd and 3rd"),
        ({"crank_turns": [5, 10, 15, 20, 30, 40]}, "starts with 5"),
        ({"crank_turns": [0, 10, 20, 30, 40, 400]}, "one turn"),
        ({"crank_turns": [0, 10, 20, 30, 40, 50], "closed": True}, "closed and crank_turns contradict"),
        ({"points": [(0, 0), (1, 1)]}, "points"),
        ({"points": [(0, 0), (1, 1), (math.nan, 0)]}, "points"),
        ({"shortest_link": 500, "longest_link": 100}, "shortest_link"),
        ({"frame": [0, 0, -5, 5]}, "frame"),
    ],
)
def test_wrong_requirements_are_refused_by_name(changes, message):
    with pytest.raises(ValidationError, match=message):
        table(**changes)


FAR = [(0, 0), (1000, 0), (2000, 500)]


def test_points_farther_apart_than_any_path_contradict_the_longest_link():
    """Where a tolerance cannot be met that is an error before any search; else the nearest are given, warned of."""
    refused = asked(points=FAR, longest_link=100, tolerance=1)
    assert not refused.candidates
    (told,) = refused.findings
    assert (told.code, told.severity) == ("path.contradiction", Severity.ERROR)
    assert "points 1 and 3 are 2062 mm apart" in told.message
    assert "no path is wider than 400 mm" in told.message
    near = asked(points=FAR, longest_link=100, starts=200)
    warned = near.findings[0]
    assert (warned.code, warned.severity) == ("path.contradiction", Severity.WARNING)
    least = (math.dist(FAR[0], FAR[2]) - 400) / math.sqrt(2 * len(FAR))
    assert f"{least:.4g} mm in the mean" in warned.message
    assert all(one.residual.value >= least for one in near.candidates)
    assert asked(points=FAR, longest_link=700, starts=100).findings[0].code != "path.contradiction"


@by_night
@pytest.mark.parametrize("longest", [200, 300, 500])
def test_an_ellipse_is_built(longest):
    import mechwright as mw

    found = mw.synthesize("four-bar", "path", points=ELLIPSE, closed=True, longest_link=longest)
    assert len(found) >= 3
