"""Synthesis of adjustable four-bars: a path per phase, one set of links."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
from by_night import by_night
from pydantic import ValidationError

from mechwright.contracts.finding import errors
from mechwright_four_bar.family import FourBars
from mechwright_four_bar.kinematics.reach import bar_of
from mechwright_four_bar.parts.phases import in_phase
from mechwright_four_bar.requirements import AdjustablePathRequirement

FACTS = {
    fact["name"]: fact
    for fact in json.loads(
        (Path(__file__).parents[1] / "data" / "adjustable.json").read_text(encoding="utf-8")
    )["facts"]
}


def found(**wanted):
    requirement = AdjustablePathRequirement.model_validate(wanted)
    return requirement, FourBars().synthesise("adjustable-path", requirement, lambda done, what: None)


def assert_passes(requirement, result, most: float) -> None:
    """Every design goes through its phase's points in order, as its own motion says, and is built."""
    family = FourBars()
    assert result.candidates
    for candidate in result.candidates:
        params = candidate.params
        number = round(candidate.figures["phase"].value)
        motion = family.solve(params, 14401)
        path = motion.channels["xP"].values + 1j * motion.channels["yP"].values
        points = [complex(*point) for point in requirement.phases[number - 1]]
        places = [int(np.abs(path - point).argmin()) for point in points]
        misses = [float(np.abs(path - point).min()) for point in points]
        step = float(np.abs(np.diff(path)).max())
        assert max(misses) < most + step
        for k, miss in enumerate(misses, start=1):
            assert miss <= candidate.figures[f"error_{k}"].value + step
        if requirement.full_turn:
            turns = np.mod(np.array(places) - places[0], len(path) - 1)
            assert (np.diff(turns) > 0).all()
        assert errors(family.check(params)) == []
        assert {part.name for part in family.parts(params)} >= {"crank", "coupler", "follower", "ground"}
        bar = bar_of(in_phase(params))
        if requirement.full_turn:
            assert math.degrees(bar.least_transmission_angle()) >= requirement.least_transmission_angle


def test_two_phases_of_four_points_are_met_exactly_and_built():
    requirement, result = found(starts=1000, designs=2)
    assert_passes(requirement, result, 1e-9)
    assert all(candidate.residual.value < 1e-9 for candidate in result.candidates)
    # One machine per pair: the same links and the same coupler plate.
    for one, two in zip(result.candidates[::2], result.candidates[1::2], strict=True):
        assert one.params.model_copy(update={"phase": 2}) == two.params
    assert "4 free parameters" in result.findings[0].message


@by_night
def test_the_exact_number_of_points_brings_the_reference_machine_back():
    points = FACTS["adjust.planar4.two.points"]["expected"]
    requirement, result = found(phases=points, least_chord=6, designs=2)
    assert_passes(requirement, result, 1e-9)
    assert all(one.residual.value < 1e-9 for one in result.candidates)
    # Two machines are known that go through these points exactly.
    by_crank = sorted((one.params for one in result.candidates[::2]), key=lambda params: params.crank)
    assert [[one.crank, one.coupler, one.follower] for one in by_crank] == [
        pytest.approx([25.58484, 92.00635, 71.72946], abs=1e-5),
        pytest.approx([30.0, 95.0, 80.0], abs=1e-8),
    ]
    reference = by_crank[1]
    assert reference.setting_angle == pytest.approx(70)
    assert reference.phases[0].crank_turn == pytest.approx(25)
    assert reference.phases[0].follower_turn == pytest.approx(14)


@pytest.mark.parametrize("moves", ["fixed", pytest.param("both", marks=by_night)])
def test_fixed_pivots_are_set_and_the_links_stay(moves):
    requirement, result = found(moves=moves, starts=1000, designs=1)
    assert_passes(requirement, result, 1e-9)
    one, two = (candidate.params for candidate in result.candidates)
    assert one.crank == pytest.approx(two.crank, rel=1e-12)
    assert one.follower == pytest.approx(two.follower, rel=1e-12)
    if moves == "fixed":
        assert one.coupler == pytest.approx(two.coupler, rel=1e-9)
        assert one.coupler_point_x == pytest.approx(two.coupler_point_x)
    assert abs(complex(one.pivot_x - two.pivot_x, one.pivot_y - two.pivot_y)) > 12


@by_night
def test_three_phases_at_the_exact_number():
    points = FACTS["adjust.planar4.three.points"]["expected"]
    requirement, result = found(phases=points, least_chord=0, designs=1)
    assert result.findings[0].message.startswith("15 points in 3 phases, and 15")
    if result.candidates:  # its own holes run into each other, so another machine may be all there is
        assert_passes(requirement, result, 5.0)


def test_more_points_than_can_be_met_are_met_as_nearly_as_can_be():
    points = [
        [(20.0, 88.0), (-10.0, 78.0), (-20, 66), (-27.0, 52.0), (-29, 40), (-25.0, 30.0), (-18, 27)]
    ] * 2
    bent = [points[0], [(20.0, 88.0), (0, 88), (-10, 80), (-21, 66), (-27, 54), (-29.0, 42.0), (-22, 28)]]
    requirement, result = found(phases=bent, least_chord=0, starts=1000, designs=1, tolerance=1e-3)
    codes = [one.code for one in result.findings]
    assert codes[0] == "path.count"
    assert "2 too many" in result.findings[0].message
    assert set(codes) <= {"path.count", "path.missed", "path.limits"}
    if result.candidates:
        assert_passes(requirement, result, 3.0)


def test_levers_serve_where_the_crank_need_not_turn_fully():
    requirement, result = found(full_turn=False, starts=1000, designs=1)
    assert_passes(requirement, result, 1e-9)


def test_limits_that_leave_nothing_are_refused_with_the_count():
    _, result = found(least_transmission_angle=80, longest_link=40, starts=300)
    assert not result.candidates
    assert [one.code for one in errors(result.findings)] == ["path.limits"]


@pytest.mark.parametrize(
    ("wanted", "word"),
    [
        ({"phases": [[(0, 0), (1, 1), (2, 3)], [(0, 1), (1, 1), (2, 3)]]}, "begin at different points"),
        ({"phases": [[(0, 0), (1, 1), (1, 1)]]}, "phase 1 holds a point twice"),
        ({"shortest_link": 600}, "below longest_link"),
    ],
)
def test_requirements_that_cannot_be_are_refused(wanted, word):
    with pytest.raises(ValidationError, match=word):
        AdjustablePathRequirement.model_validate(wanted)
