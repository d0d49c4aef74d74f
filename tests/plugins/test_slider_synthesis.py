"""Synthesis from stroke and time ratio, and through acceleration poles."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
from by_night import by_night
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import ValidationError

from mechwright.contracts.finding import Severity, errors
from mechwright.mechanics.planar import acceleration_pole
from mechwright_slider_crank.family import SliderCrankFamily
from mechwright_slider_crank.kinematics.limits import crank_turns, least_transmission_angle, limits
from mechwright_slider_crank.kinematics.simulated_stroke import simulated
from mechwright_slider_crank.kinematics.slider_crank import SliderCrank
from mechwright_slider_crank.requirements import PolesRequirement, StrokeRequirement
from mechwright_slider_crank.synthesis.designs import from_poles, from_stroke
from mechwright_slider_crank.synthesis.poles.equations import PoleProblem
from mechwright_slider_crank.synthesis.poles.synthesis import through_poles
from mechwright_slider_crank.synthesis.stroke import (
    best,
    from_crank,
    from_offset,
    from_rod,
    ranges,
    rocking_angle,
)

DATA = json.loads((Path(__file__).parents[1] / "data" / "planar-linkages.json").read_text())
EXPECTED = {fact["name"]: fact["expected"] for fact in DATA["facts"]}
SLIDERS = [item for item in DATA["synthesis"] if item["kind"].startswith("slider")]


def silent(done, what):
    pass


@pytest.mark.parametrize(
    ("name", "lengths"),
    [
        ("e=50", from_offset(120, 1.5, 50)),
        ("a=35", from_crank(120, 1.5, 35)),
        ("b=130", from_rod(120, 1.5, 130)),
    ],
)
def test_reference_lengths(name, lengths):
    expected = EXPECTED[f"doc001 {name}: a,b,e"]
    assert (lengths.crank, lengths.rod, lengths.offset) == pytest.approx(expected, rel=1e-12)
    least = least_transmission_angle(lengths.crank, lengths.rod, lengths.offset)
    assert math.degrees(least) == pytest.approx(
        EXPECTED[f"doc001 {name}: min transmission angle deg"], rel=1e-10
    )
    linkage = SliderCrank(lengths.crank, lengths.rod, lengths.offset)
    assert simulated(linkage) == pytest.approx((120, 1.5), rel=1e-11)
    ends = limits(linkage)
    angles = sorted(math.degrees(v) for v in (ends.far, ends.near))
    assert angles == pytest.approx(
        sorted(EXPECTED[f"doc001 {name}: crank angles of limit positions deg"]), rel=1e-10
    )


def test_reference_ranges():
    found = ranges(120, 1.5)
    assert found.crank == pytest.approx(EXPECTED["doc001 a range"], rel=1e-12)
    assert found.rod == pytest.approx(EXPECTED["doc001 b range"], rel=1e-12)
    assert found.offset[1] == pytest.approx(EXPECTED["doc001 e max"], rel=1e-12)
    assert math.degrees(rocking_angle(1.5)) == pytest.approx(EXPECTED["doc001 theta deg"], rel=1e-12)


def test_printed_answers_of_the_seed():
    for triple, name in (((50, 115, 50), "50, 115, 50"), ((45, 130, 70.3), "45, 130, 70.3")):
        true = EXPECTED[f"doc001 printed triple ({name}): true H,K"]
        assert simulated(SliderCrank(*map(float, triple))) == pytest.approx(true, rel=1e-9)
    assert not crank_turns(35, 160, 127)


@settings(max_examples=200, deadline=None)
@given(st.floats(1, 500), st.floats(1.01, 2.95), st.floats(0.001, 0.999))
def test_three_ways_to_one_linkage(stroke, ratio, share):
    offset = share * ranges(stroke, ratio).offset[1]
    found = from_offset(stroke, ratio, offset)
    assert crank_turns(found.crank, found.rod, found.offset)
    for other in (from_crank(stroke, ratio, found.crank), from_rod(stroke, ratio, found.rod)):
        assert (other.crank, other.rod) == pytest.approx((found.crank, found.rod), rel=1e-9)
        # The offset is a difference of squares: near 0 it has fewer digits.
        assert other.offset == pytest.approx(offset, rel=1e-7, abs=1e-7 * stroke / (ratio - 1))
    ends = limits(SliderCrank(found.crank, found.rod, found.offset))
    assert (ends.stroke, ends.time_ratio) == pytest.approx((stroke, ratio), rel=1e-8)
    allowed = ranges(stroke, ratio)
    assert allowed.crank[0] <= found.crank <= allowed.crank[1]
    assert allowed.rod[0] <= found.rod <= allowed.rod[1]


@settings(max_examples=60, deadline=None)
@given(st.floats(1, 500), st.floats(1.02, 2.9))
def test_the_best_one_is_better_than_its_neighbours(stroke, ratio):
    found, allowed = best(stroke, ratio), ranges(stroke, ratio)
    angle = least_transmission_angle(found.crank, found.rod, found.offset)
    for share in np.linspace(0.01, 0.99, 25):
        other = from_offset(stroke, ratio, share * allowed.offset[1])
        assert least_transmission_angle(other.crank, other.rod, other.offset) <= angle + 1e-12


def test_reference_best():
    found = best(120, 1.5)
    assert found.offset == pytest.approx(34.593562137, abs=1e-9)
    assert math.degrees(least_transmission_angle(found.crank, found.rod, found.offset)) == pytest.approx(
        27.457639, abs=1e-6
    )


@pytest.mark.parametrize("given_", [{"offset": 50}, {"crank": 35}, {"rod": 130}, {}])
@pytest.mark.parametrize("quick", ["inward", "outward"])
def test_the_design_is_simulated_and_has_the_wanted_quick_stroke(given_, quick):
    result = from_stroke(StrokeRequirement(stroke=120, time_ratio=1.5, quick=quick, **given_))
    assert errors(result.findings) == []
    (candidate,), (note,) = result.candidates, result.findings
    assert note.value == -candidate.params.offset
    assert candidate.residual.value < 1e-9
    assert candidate.figures["stroke_simulated"].value == pytest.approx(120, rel=1e-10)
    assert candidate.figures["time_ratio_simulated"].value == pytest.approx(1.5, rel=1e-10)
    assert limits(candidate.params.linkage).slow_outward == (quick == "inward")
    (told,) = [
        one for one in SliderCrankFamily().check(candidate.params) if one.code == "slider-crank.stroke"
    ]
    assert ("slower away from the crank" in told.message) == (quick == "inward")


@pytest.mark.parametrize(("given_", "rod"), [({}, 100), ({"rod": 80}, 80), ({"crank": 25}, 100)])
def test_both_strokes_take_as_long_without_an_offset(given_, rod):
    result = from_stroke(StrokeRequirement(stroke=50, time_ratio=1, **given_))
    (candidate,) = result.candidates
    assert result.findings == ()
    params = candidate.params
    assert (params.crank, params.rod, params.offset) == (25, rod, 0)
    assert not math.copysign(1, params.offset) < 0
    ends = limits(SliderCrank(params.crank, params.rod, params.offset))
    assert (ends.stroke, ends.time_ratio) == pytest.approx((50, 1), rel=1e-12)


def test_a_ratio_the_wrong_way_round_is_told_the_right_one():
    (finding,) = from_stroke(StrokeRequirement(time_ratio=0.8)).findings
    assert "time_ratio = 1.25" in finding.remedy
    assert from_stroke(StrokeRequirement(time_ratio=1.25)).candidates


@pytest.mark.parametrize(
    ("table", "code", "parameter", "limit"),
    [
        ({"time_ratio": 1.0, "offset": 10}, "slider-crank.offset-range", "offset", 0),
        ({"time_ratio": 1.0, "crank": 50}, "slider-crank.crank-range", "crank", 60),
        ({"time_ratio": 1.0, "rod": 60}, "slider-crank.rod-range", "rod", 60),
        ({"time_ratio": 0.7}, "slider-crank.time-ratio", "time_ratio", 1),
        ({"time_ratio": 3.0}, "slider-crank.time-ratio", "time_ratio", 3),
        ({"crank": 60.5}, "slider-crank.crank-range", "crank", 60),
        ({"crank": 19}, "slider-crank.crank-range", "crank", 19.495181774),
        ({"rod": 59}, "slider-crank.rod-range", "rod", 60),
        ({"rod": 185}, "slider-crank.rod-range", "rod", 184.661012231),
        ({"offset": 166}, "slider-crank.offset-range", "offset", 165.165830457),
    ],
)
def test_bounds_are_findings_with_the_nearest_value(table, code, parameter, limit):
    result = from_stroke(StrokeRequirement(**table))
    assert result.candidates == ()
    (finding,) = result.findings
    assert (finding.code, finding.parameter, finding.severity) == (code, parameter, Severity.ERROR)
    assert finding.limit == pytest.approx(limit, rel=1e-9)
    assert finding.remedy


@pytest.mark.parametrize(
    ("stroke", "ratio"),
    [
        (8, 1.6),
        *(
            pytest.param(*one, marks=by_night)
            for one in (
                (7, 1.1),
                (10, 1.3),
                (20, 2.0),
                (30, 1.3),
                (30, 1.6),
                (45, 2.0),
                (60, 2.0),
                (250, 2.0),
            )
        ),
    ],
)
def test_small_strokes_are_met_by_designs_whose_rails_stand_clear(stroke, ratio):
    for candidate in from_stroke(StrokeRequirement(stroke=stroke, time_ratio=ratio)).candidates:
        assert not errors(SliderCrankFamily().check(candidate.params))
        assert candidate.figures["stroke_simulated"].value == pytest.approx(stroke, rel=1e-6)
        break
    else:
        raise AssertionError("none was found")


def test_usual_rails_stay_where_they_do():
    (one, *_) = from_stroke(StrokeRequirement(stroke=120, time_ratio=1.3)).candidates
    assert (one.params.rail, one.params.pin) == (None, None)


def test_what_just_turns_is_refused_with_words():
    result = from_stroke(StrokeRequirement(offset=165.1658))
    (finding,) = errors(result.findings)
    assert finding.code == "slider-crank.not-buildable"
    assert "the least is 0.05 %" in finding.message


def test_requirements_that_contradict_themselves():
    with pytest.raises(ValidationError, match="at most one of crank, rod and offset"):
        StrokeRequirement(crank=50, rod=100)
    with pytest.raises(ValidationError, match="3 poles with 1 rotations"):
        PolesRequirement(poles=((1, 2), (3, 4), (5, 6)))
    with pytest.raises(ValidationError, match="2 poles with 0 rotations"):
        PolesRequirement(rotations=())
    with pytest.raises(ValidationError, match="two of them are the same"):
        PolesRequirement(poles=((1, 2), (1, 2)))


@pytest.mark.parametrize("item", SLIDERS, ids=lambda item: f"{item['kind']}-{item['targets'][0]}")
def test_reference_solutions_are_found_and_certified(item):
    places = np.array([complex(*target) for target in item["targets"]])
    rotations = np.radians([item["dphi_deg"]]) if "dphi_deg" in item else np.zeros(0)
    found, least = through_poles(places, rotations, PolesRequirement().starts, 1, silent)
    assert least < 1e-9
    assert all(one.residual <= 1e-10 for one in found)
    assert [one.transmission for one in found] == sorted((one.transmission for one in found), reverse=True)

    def same(one, other):
        lengths = (other["a"], other["c"], other["e"])
        near = all(
            abs(x - y) <= 1e-6 * other["c"]
            for x, y in zip((one.crank, one.rod, one.offset), lengths, strict=True)
        )
        return near and one.branch == other["branch"]

    turning = [other for other in item["solutions"] if other["crank"]]
    assert [other for other in turning if not any(same(one, other) for one in found)] == []
    for one in found:
        assert crank_turns(one.crank, one.rod, one.offset)
        if rotations.size:
            assert one.angles[1] - one.angles[0] == pytest.approx(rotations[0])
        linkage = SliderCrank(one.crank, one.rod, one.offset, 0.0, one.branch)
        seen = acceleration_pole(linkage.bodies(np.array(one.angles)).rod).fixed
        assert np.abs(seen - places).max() < 1e-8
    for number, one in enumerate(found):
        for other in found[:number]:
            assert (
                max(
                    abs(one.crank - other.crank),
                    abs(one.rod - other.rod),
                    abs(one.angles[0] - other.angles[0]),
                )
                > 1e-7
            )


def test_another_seed_finds_the_same():
    item = SLIDERS[0]
    places = np.array([complex(*target) for target in item["targets"]])
    one, two = (through_poles(places, np.radians([47.0]), 1500, seed, silent)[0] for seed in (1, 2))
    assert [v.crank for v in one] == pytest.approx([v.crank for v in two], rel=1e-9)


def random_problem(branch, turns):
    """Poles nowhere in particular, and unknowns of every size."""
    rng = np.random.default_rng(5)
    places = rng.normal(size=2 if turns else 3) + 1j * rng.normal(size=2 if turns else 3)
    problem = PoleProblem(places, np.array([0.0, 0.8]) if turns else None, branch)
    return problem, problem.starts(400, rng)


@pytest.mark.parametrize("branch", [1, -1])
@pytest.mark.parametrize("turns", [True, False])
def test_poles_of_the_equations_are_those_of_the_kinematics(branch, turns):
    problem, x = random_problem(branch, turns)
    for row, poles in zip(x, problem.poles(x), strict=True):
        a, c, e = map(float, problem.lengths(row))
        assert crank_turns(a, c, e)
        linkage = SliderCrank(a, c, e, 0.0, branch)
        direct = acceleration_pole(linkage.bodies(problem.angles(row)).rod).fixed
        # The lengths have lost the digits that the logarithms of their differences keep.
        lost = c / min(c - abs(e) - a, a)
        np.testing.assert_allclose(poles, direct, rtol=1e-12 * lost)


@pytest.mark.parametrize("branch", [1, -1])
@pytest.mark.parametrize("turns", [True, False])
def test_slopes_of_the_equations_are_their_differences(branch, turns):
    problem, x = random_problem(branch, turns)
    step = 1e-6 * np.eye(x.shape[1])
    differences = np.stack(
        [(problem.residual(x + h) - problem.residual(x - h)) / 2e-6 for h in step], axis=-1
    )
    slopes = problem.slopes(x)
    size = np.abs(slopes).max(axis=(1, 2), keepdims=True)
    assert np.quantile(np.abs(slopes - differences) / size, 0.99) < 1e-6


def test_half_of_the_starts_meet_a_pole_at_once():
    """Seen on a fine grid of the crank angle, as the starts' own angles are chosen on a coarse one."""
    problem, x = random_problem(1, turns=False)
    phi = np.linspace(0, math.tau, 20_000)
    met = []
    for row in x[:50]:
        fine = PoleProblem(phi, phi, 1).poles(np.append(row[:3], 0.0))
        met.append(np.abs(fine[:, None] - problem.targets).min() / np.abs(np.diff(fine)).max())
    assert max(met) < 1


def test_designs_of_poles_turn_with_the_slide():
    """The same requirement turned by 30 degrees gives the same designs on a slide turned by 30 degrees."""
    turn = complex(math.cos(math.pi / 6), math.sin(math.pi / 6))
    straight = PolesRequirement(starts=400)
    turned = PolesRequirement(
        poles=tuple(((complex(*p) * turn).real, (complex(*p) * turn).imag) for p in straight.poles),
        slide_direction=30,
        starts=400,
    )
    one, two = from_poles(straight, silent), from_poles(turned, silent)
    assert len(one.candidates) == len(two.candidates) == 3
    for a, b in zip(one.candidates, two.candidates, strict=True):
        assert b.params.slide_direction == 30
        assert a.params.crank == pytest.approx(b.params.crank, rel=1e-9)
        assert b.figures["phi_1"].value == pytest.approx((a.figures["phi_1"].value + 30) % 360, abs=1e-7)
    ordered = [candidate.figures["least_transmission_angle"].value for candidate in one.candidates]
    assert ordered == sorted(ordered, reverse=True)


def test_poles_without_a_solution_say_the_best_residual():
    wanted = PolesRequirement(poles=((60, 0), (-60, 0.5)), rotations=(0.01,), starts=100)
    result = from_poles(wanted, silent)
    assert result.candidates == ()
    (finding,) = errors(result.findings)
    assert finding.code == "slider-crank.no-solution"
    assert finding.value > finding.limit
    assert "best residual found" in finding.message


def test_what_cannot_be_built_is_told():
    """Poles within a third of a millimetre: the cranks are smaller than any shaft."""
    wanted = PolesRequirement(poles=((0.3, -0.063), (0.206, 0.208)), starts=400)
    result = from_poles(wanted, silent)
    assert result.candidates == ()
    assert errors(result.findings)[0].code == "slider-crank.not-buildable"
    assert [f.code for f in result.findings[1:]] == ["slider-crank.left-out"] * 3
