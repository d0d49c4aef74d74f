"""Linkages that guide a body or answer a crank, against the independent check and against their own motion."""

import cmath
import math
from dataclasses import replace
from itertools import permutations

import numpy as np
import pytest
from by_night import by_night
from pydantic import ValidationError
from synthesis_reference import fact, facts

from mechwright import Scalar
from mechwright.contracts.finding import errors
from mechwright.contracts.synthesis import ALIKE
from mechwright_four_bar.family import FourBars
from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.kinematics.loop import close
from mechwright_four_bar.kinematics.reach import bar_of
from mechwright_four_bar.synthesis.burmester import dyads, freudenstein, kept
from mechwright_four_bar.synthesis.burmester.dyads import Poses
from mechwright_four_bar.synthesis.burmester.kept import Option, driven
from mechwright_four_bar.synthesis.burmester.rectify import Way, way_through
from mechwright_four_bar.synthesis.burmester.requirements import FunctionRequirement, PosesRequirement
from mechwright_four_bar.table import FourBarTable

FIVE = ((7, -6, -27), (14, -17, -40), (23, -24, -61), (28, -25, -72), (37, -19, -91))


def quiet(part, text=""):
    pass


def poses_of(table):
    table = np.array(table, dtype=float)
    return Poses(table[:, 0] + 1j * table[:, 1], np.radians(table[:, 2]))


# ---- dyads


def test_five_poses_have_the_dyads_of_the_check():
    result = dyads.of_five(poses_of(fact("burmester.planar5.real_dyads")["inputs"]["poses_x_y_deg"]))
    assert (len(result.dyads), result.sliders) == (4, 0)
    for number, one in enumerate(result.dyads):
        expected = fact(f"burmester.planar5.dyad{number}")["expected"]
        assert one.pivot == pytest.approx(complex(*expected["G"]), abs=1e-7)
        assert one.joint == pytest.approx(complex(*expected["w"]), abs=1e-7)
        assert one.length == pytest.approx(expected["length"], abs=1e-7)


def pairs(poses):
    found = dyads.of_five(poses).dyads
    for i, j in permutations(range(len(found)), 2):
        one, two = found[i], found[j]
        joints = poses.joints(one.joint), poses.joints(two.joint)
        yield (i, j), one, two, way_through(one.pivot, two.pivot, *joints)


def test_defects_of_the_check():
    ways = {pair: way for pair, _, _, way in pairs(poses_of(FIVE)) if isinstance(way, Way)}
    free = fact("burmester.planar5.defect_free_drive_follow")["expected"]
    assert sorted(ways) == sorted((i, j) for i, j, _ in free)
    for i, j, kind in free:
        assert kind in (ways[i, j].bar.kind.value, "non-Grashof")
        expected = fact(f"burmester.planar5.linkage_{i}_{j}")["expected"]
        lengths = [expected[key] for key in ("crank", "coupler", "follower", "ground")]
        assert ways[i, j].bar.lengths == pytest.approx(lengths, abs=1e-6)
        bar, phi = ways[i, j].bar, ways[i, j].phi - ways[i, j].bar.ground_angle
        angles = [bar.transmission_range(x, x)[0] for x in phi]
        assert math.degrees(min(angles)) == pytest.approx(expected["least_angle_at_poses_deg"], abs=1e-6)
    full = [list(pair) for pair, way in ways.items() if way.full]
    assert sorted(full) == sorted(fact("burmester.planar5.full_crank_defect_free")["expected"])


def test_the_number_of_real_dyads_is_even():
    rng = np.random.default_rng(3)
    counts = []
    for _ in range(100):
        poses = Poses(rng.normal(size=5) + 1j * rng.normal(size=5), rng.uniform(-1.5, 1.5, 5))
        result = dyads.of_five(poses)
        counts.append(len(result.dyads) + result.sliders)
        for one in result.dyads:
            assert np.ptp(np.abs(poses.joints(one.joint) - one.pivot)) < 1e-8 * max(1, one.length)
    assert set(counts) == {0, 2, 4}


def test_a_linkage_is_found_from_five_of_its_own_poses():
    bar, phi = FourBar(30, 80, 70, 90), np.array([0.2, 1.1, 2.0, 3.0, 4.4])
    loop = close(bar, phi)
    poses = Poses(loop.joint_a, np.angle(loop.coupler.direction))
    lengths = sorted(one.length for one in dyads.of_five(poses).dyads)
    assert any(abs(one - 30) < 1e-6 for one in lengths)
    assert any(abs(one - 70) < 1e-6 for one in lengths)


def test_three_and_four_poses():
    given = fact("burmester.planar3.centre")
    one = dyads.of_three(poses_of(FIVE[:3]), complex(*given["inputs"]["w"]))
    assert one.pivot == pytest.approx(complex(*given["expected"]["G"]), abs=1e-8)
    assert one.length == pytest.approx(given["expected"]["length"], abs=1e-8)
    found = dyads.of_four(poses_of(FIVE[:4]), 10.0)
    expected = sorted((one["expected"] for one in facts("burmester.planar4")), key=lambda one: one["w"][1])
    assert len(found) == len(expected) == 3
    for one, other in zip(found, expected, strict=True):
        assert one.joint == pytest.approx(complex(*other["w"]), abs=1e-6)
        assert one.pivot == pytest.approx(complex(*other["G"]), abs=2e-6)
        assert one.length == pytest.approx(other["length"], abs=2e-6)


def test_places_on_a_line_have_no_centre():
    poses = Poses(np.array([0, 1, 2 + 0j]), np.zeros(3))
    assert dyads.of_three(poses, 5 + 5j) is None


# ---- functions


def test_three_pairs():
    given = fact("function.three_points")
    phi, psi = (np.radians(given["inputs"][key]) for key in ("phi_deg", "psi_deg"))
    np.testing.assert_allclose(freudenstein.coefficients(phi, psi), given["expected"]["K"], atol=1e-9)
    (one,) = freudenstein.of_three(phi, psi)
    for key in ("crank", "coupler", "follower"):
        assert getattr(one, key) == pytest.approx(given["expected"][key], abs=1e-9)


@pytest.mark.parametrize(
    "given", facts("function.four_points"), ids=lambda one: str(one["expected"]["psi0_deg"])
)
def test_four_pairs(given):
    inputs, expected = given["inputs"], given["expected"]
    phi = np.radians(np.array(inputs["dphi_deg"]) + inputs["phi0_deg"])
    psi = np.radians(inputs["dpsi_deg"])
    found = freudenstein.of_four(phi, psi)
    assert len(found) == 2
    wanted = math.radians(expected["psi0_deg"]) + psi[0]
    (one,) = [one for one in found if abs(math.remainder(one.psi - wanted, math.tau)) < 1e-9]
    for key in ("crank", "coupler", "follower"):
        assert getattr(one, key) == pytest.approx(expected[key], abs=1e-7)


def test_five_pairs_and_the_error_between_them():
    given = fact("function.five_points")
    phi, psi = (np.radians(given["inputs"][key]) for key in ("dphi_deg", "dpsi_deg"))
    (one,) = freudenstein.of_five(phi, psi)
    expected = given["expected"]
    for key in ("crank", "coupler", "follower"):
        assert getattr(one, key) == pytest.approx(expected[key], abs=1e-7)
    assert math.degrees(one.phi - phi[0]) == pytest.approx(expected["phi0_deg"], abs=1e-7)
    assert math.degrees(one.psi - psi[0]) == pytest.approx(expected["psi0_deg"], abs=1e-7)
    x = np.linspace(1, 2, 1001)
    turned, wanted = np.radians(60) * (x - 1), np.radians(90) * np.log10(x) / math.log10(2)
    bar = FourBar(one.crank, one.coupler, one.follower, 1.0)
    worst = []
    for branch in (1, -1):
        loop = close(FourBar(*bar.lengths, 0.0, branch), one.phi - phi[0] + turned)
        errors = np.angle(loop.follower.direction * np.exp(-1j * (one.psi - psi[0] + wanted)))
        worst.append(math.degrees(np.abs(errors).max()))
    assert min(worst) == pytest.approx(fact("function.five_points.greatest_error_deg")["expected"], abs=1e-5)


# ---- the family


def asked(kind, **table):
    model = {"poses": PosesRequirement, "function": FunctionRequirement}[kind]
    return FourBars().synthesise(kind, model.model_validate(table), quiet)


def carried(one, angles):
    """Places and directions of the body at crank angles, rad, as a design says."""
    bar = bar_of(one.params)
    loop = close(bar, angles)
    place = (
        FourBarTable.of(one.params).pivot + loop.joint_a + one.params.coupler_point * loop.coupler.direction
    )
    return place, np.angle(loop.coupler.direction * np.exp(1j * one.figures["frame_angle"].value))


@pytest.mark.parametrize("count", [3, 4, 5])
def test_designs_carry_the_body_through_its_poses(count):
    table = FIVE[:count]
    result = asked("poses", poses=table, starts=100)
    poses = poses_of(table)
    assert result.candidates
    for one in result.candidates:
        assert one.residual.value < 1e-7
        course = FourBarTable.of(one.params).closed_ways.course
        angles = course.start + np.linspace(0, course.travel, 40_001)
        place, turned = carried(one, angles)
        ways = []
        for d, theta in zip(poses.places, poses.angles, strict=True):
            far = np.abs(place - d) + 20 * np.abs(np.angle(np.exp(1j * (turned - theta))))
            assert far.min() < 0.05
            ways.append(int(far.argmin()))
        steps = np.diff(ways)
        # A turn begins anywhere among the poses, a swing at the first of them.
        assert (steps < 0).sum() <= (0 if one.params.swing_from is not None else 1)
        assert errors(FourBars().check(one.params)) == []


def test_many_poses_of_a_known_linkage():
    bar, phi, point = FourBar(30, 80, 70, 90), np.linspace(0.2, 4, 12), 20 + 30j
    loop = close(bar, phi)
    place = loop.joint_a + point * loop.coupler.direction
    turned = np.degrees(np.unwrap(np.angle(loop.coupler.direction))) + 10
    table = [(z.real, z.imag, a) for z, a in zip(place, turned, strict=True)]
    best = asked("poses", poses=table, designs=1).candidates[0]
    assert best.residual.value < 1e-5
    assert best.figures["angle_error"].value < 1e-7
    assert bar_of(best.params).lengths == pytest.approx(bar.lengths, abs=1e-3)


def test_more_pairs_than_unknowns():
    x = np.linspace(1, 2, 15)
    table = {"crank_angles": list(60 * (x - 1)), "follower_angles": list(90 * np.log10(x) / math.log10(2))}
    result = asked("function", **table, least_transmission_angle=10, longest_link=1000)
    assert math.degrees(result.candidates[0].residual.value) < 0.05


@by_night
def test_more_pairs_than_unknowns_within_limits_and_a_tolerance():
    x = np.linspace(1, 2, 15)
    table = {"crank_angles": list(60 * (x - 1)), "follower_angles": list(90 * np.log10(x) / math.log10(2))}
    tight = asked("function", **table, least_transmission_angle=30, longest_link=200)
    for one in tight.candidates:
        assert math.degrees(one.figures["least_transmission_angle"].value) >= 30
        assert one.figures["longest_link"].value <= 200
    missed = asked("function", **table, least_transmission_angle=10, longest_link=1000, tolerance=0.001)
    assert [one.code for one in missed.findings] == ["function.found", "function.missed"]


def test_a_follower_answers_as_the_design_moves():
    result = asked("function")
    wanted = FunctionRequirement()
    for one in result.candidates:
        phi = (
            one.figures["first_crank_angle"].value
            + np.radians(wanted.crank_angles)
            - math.radians(wanted.crank_angles[0])
        )
        answer = np.angle(close(bar_of(one.params), phi).follower.direction)
        turned = np.degrees(np.unwrap(answer - answer[0]))
        assert turned == pytest.approx(np.array(wanted.follower_angles) - wanted.follower_angles[0], abs=1e-6)


def test_where_no_linkage_of_five_poses_keeps_the_limits_the_nearest_that_does_is_given():
    result = asked("poses", longest_link=40, designs=1)
    near, found = result.findings
    assert (near.code, found.code) == ("poses.nearest", "poses.found")
    assert "4 real dyads of 4" in near.message
    assert "breaks a limit: a link is 74.9513 mm long" in near.message
    (one,) = result.candidates
    assert one.residual.value < 0.15
    assert one.figures["longest_link"].value <= 40
    course = FourBarTable.of(one.params).closed_ways.course
    place, turned = carried(one, course.start + np.linspace(0, course.travel, 40_001))
    poses = poses_of(FIVE)
    off = np.abs(place[:, None] - poses.places)
    assert np.sqrt(np.mean(off.min(axis=0) ** 2)) <= one.residual.value + 0.01
    angle = np.angle(np.exp(1j * (turned[off.argmin(axis=0)] - poses.angles)))
    assert np.abs(angle).max() < math.radians(1), "the nearest place is not quite that of the nearest pose"


@by_night
def test_where_none_comes_near_either_the_limit_is_said_that_stands_in_the_way():
    (finding,) = errors(asked("poses", drive="crank", longest_link=15, least_transmission_angle=70).findings)
    assert finding.code == "poses.none"
    assert finding.message.count("breaks a limit") == 2
    assert "misses them by" in finding.message


def test_cranks_alone_are_given_where_they_are_asked_for():
    only = asked("poses", drive="crank")
    assert all(one.params.swing_from is None for one in only.candidates)
    assert only.candidates


@pytest.mark.parametrize(
    ("kind", "table", "message"),
    [
        ("poses", {"poses": [(0, 0, 0), (0, 0, 360), (1, 1, 5)]}, "poses 1 and 2 are the same"),
        ("poses", {"poses": [(0, 0, 9), (1, 1, 5), (0, 0, -351)]}, "poses 1 and 3 are the same"),
        ("poses", {"poses": [(0, 0, 0), (1, 0, 0), (1, 1, 0)]}, "does not turn"),
        ("poses", {"poses": [(0, 0, 0), (1, 0, math.nan), (1, 1, 0)]}, "poses"),
        ("function", {"crank_angles": [0, 10, 5, 20, 30]}, "one way"),
        ("function", {"crank_angles": [0, 10, 20]}, "follower_angles has 5 angles for the 3"),
        (
            "function",
            {"crank_angles": [0, 10, 20], "follower_angles": [0, 5, 9]},
            "leave offsets = 'both' open",
        ),
        ("function", {"follower_angles": [1, 1, 1, 1, 1]}, "stand still"),
        ("function", {"shortest_link": 500, "longest_link": 400}, "shortest_link"),
    ],
)
def test_wrong_requirements_are_refused_by_name(kind, table, message):
    model = {"poses": PosesRequirement, "function": FunctionRequirement}[kind]
    with pytest.raises(ValidationError, match=message):
        model.model_validate(table)


def test_a_body_that_turns_about_one_point_has_infinitely_many_dyads():
    angles = np.radians([0, 10, 30, 50, 90])
    places = 20 + 10j + (7 - 3j) * np.exp(1j * angles)
    table = [(one.real, one.imag, math.degrees(angle)) for one, angle in zip(places, angles, strict=True)]
    result = FourBars().synthesise("poses", PosesRequirement(poses=tuple(table)), quiet)
    assert not result.candidates
    assert [one.code for one in result.findings] == ["poses.infinite"]
    assert not dyads.of_five(poses_of(FIVE)).infinite


@pytest.mark.parametrize(
    ("answer", "within"),
    [
        pytest.param(lambda x: 90 * (x / 90) ** 2, 0.1, id="square", marks=by_night),
        pytest.param(lambda x: 60 * np.sqrt(x / 90), 1.8, id="root"),
    ],
)
def test_a_function_is_fitted_within_the_limits(answer, within):
    """Where the nearest linkages break the limits, those that keep them are found, not refused."""
    x = np.linspace(0, 90, 10)
    result = asked("function", crank_angles=list(x), follower_angles=list(answer(x)))
    assert math.degrees(result.candidates[0].residual.value) < within
    for one in result.candidates:
        assert one.figures["least_transmission_angle"].value >= math.radians(20)
        assert one.figures["longest_link"].value <= 400


@pytest.mark.parametrize(
    ("bar", "pivot", "same"),
    [
        ({"coupler": 80 + 0.2 * ALIKE * 30, "ground_angle": 1.0 + 0.1 * ALIKE}, 5 + 0.2j * ALIKE * 30, True),
        ({"branch": -1}, 5 + 0j, False),
        ({"coupler": 80 + 2 * ALIKE * 30}, 5 + 0j, False),
        ({}, 5 + 2j * ALIKE * 30, False),
        ({"ground_angle": 1.0 + ALIKE}, 5 + 0j, False),
        (
            {"ground_angle": 1.0 + 0.7 * ALIKE / 3},
            5 + 0.7j * ALIKE * 30 * cmath.exp(1j),
            False,
        ),  # both one way
    ],
)
def test_two_linkages_are_one_if_branch_links_and_pivots_are(bar, pivot, same):
    way = Way(FourBar(30, 80, 70, 90, 1.0), np.radians([60.0, 70.0, 80.0]), True)
    one = Option(way, Scalar(0.0, "mm"), {}, 5 + 0j)
    other = replace(one, way=replace(way, bar=replace(way.bar, **bar)), pivot=pivot)
    assert kept._same(one, other) == kept._same(other, one) == same


def test_a_crank_that_could_turn_swings_where_its_turn_would_be_too_weak():
    """30-80-70-90 falls to 43.5 degrees over a turn, and stays above 60 over this swing."""
    bar = FourBar(30, 80, 70, 90)
    way = Way(bar, np.radians([60.0, 70.0, 80.0]), True)
    over_turn, over_swing = (math.degrees(each.least_angle) for each in (way, replace(way, full=False)))
    assert over_turn < 50 < over_swing
    asked_for = PosesRequirement(least_transmission_angle=50)
    assert not driven(way, asked_for).full
    assert driven(way, PosesRequirement(least_transmission_angle=30)).full
    assert driven(way, PosesRequirement(least_transmission_angle=50, drive="crank")).full
    assert not driven(way, PosesRequirement(least_transmission_angle=30, drive="lever")).full
    assert driven(way, PosesRequirement(least_transmission_angle=80)).full


def test_pairs_that_no_linkage_meets_within_the_limits_are_answered_nearly():
    """Five pairs, whose one exact linkage falls below the transmission angle."""
    pairs = {"crank_angles": [0, 15, 35, 55, 70], "follower_angles": [0, 28, 54, 75, 90]}
    weak = asked("function", **pairs, least_transmission_angle=1, longest_link=2000)
    most = max(math.degrees(one.figures["least_transmission_angle"].value) for one in weak.candidates)
    assert all(one.residual.value < 1e-9 for one in weak.candidates)
    result = asked("function", **pairs, least_transmission_angle=most + 5)
    assert [one.code for one in result.findings] == ["function.nearest", "function.found"]
    assert "exactly" in result.findings[0].message
    assert 1e-6 < result.candidates[0].residual.value < math.radians(5)
    for one in result.candidates:
        assert math.degrees(one.figures["least_transmission_angle"].value) >= most + 5
