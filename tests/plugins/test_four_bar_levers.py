"""Four-bars whose crank is a lever, and four-bars that go through their change points."""

import math

import numpy as np
import pytest
from many import Many
from scipy.optimize import brentq

from mechwright import KinematicsError, Severity, Stage
from mechwright.contracts.finding import errors
from mechwright.testing.compare import assert_derivative
from mechwright.testing.joints import joint_faults
from mechwright.testing.rules import motion_faults
from mechwright_four_bar.family import FourBars
from mechwright_four_bar.kinematics.change_point import close_through, turns_to_close
from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.kinematics.loop import close
from mechwright_four_bar.kinematics.reach import reach

LINKS = ("crank", "coupler", "follower", "ground")
RATES = (
    ("phi", "omega_a"),
    ("sigma", "omega_c"),
    ("omega_c", "alpha_c"),
    ("alpha_c", "jerk_c"),
    ("psi", "omega_b"),
    ("omega_b", "alpha_b"),
    ("alpha_b", "jerk_b"),
)


def params(*lengths, **more):
    return FourBars().Params(**dict(zip(LINKS, lengths, strict=True)), **more)


def codes(findings):
    return [finding.code for finding in findings]


def rates_fit(motion):
    time = motion.channels["time"].values
    for value, rate in RATES:
        one, two = motion.channels[value].values, motion.channels[rate].values
        if np.ptp(one) < 1e-9:  # a quotient of rounding says nothing
            assert np.abs(two).max() < 1e-9
            continue
        assert_derivative(two, one, time, what=f"{rate} of {value}")


LEVERS = {
    "triple rocker": ((70, 60, 75, 110), 1),
    "Grashof double rocker": ((70, 30, 75, 90), 2),
    "rocker-crank": ((80, 70, 30, 90), 2),
    "through the opposite of the ground": ((60, 100, 120, 50), 1),
}


@pytest.mark.parametrize("case", LEVERS)
def test_the_reach_ends_where_coupler_and_follower_are_in_line(case):
    lengths, ways = LEVERS[case]
    bar = FourBar(*lengths)
    found = reach(bar)
    assert len(found) == ways
    a, c, b, f = lengths
    for low, high in found:
        for end in (low, high):
            distance = abs(f - a * np.exp(1j * end))
            assert min(abs(distance - (b + c)), abs(distance - abs(b - c))) < 1e-9
        assert np.isfinite(close(bar, np.linspace(low, high, 301)[1:-1]).joint_b).all()
        assert np.isnan(close(bar, np.array([low - 1e-6, high + 1e-6])).joint_b).all()


@pytest.mark.parametrize("case", LEVERS)
@pytest.mark.parametrize("branch", ["open", "crossed"])
def test_a_lever_goes_there_and_back_short_of_its_toggles(case, branch):
    lengths, _ = LEVERS[case]
    design = params(*lengths, branch=branch, ground_angle=25, coupler_point_x=20, coupler_point_y=10)
    found = FourBars().check(design)
    assert errors(found, Stage.MOTION) == []
    rotation = next(finding for finding in found if finding.code == "four-bar.rotation")
    assert rotation.severity is Severity.WARNING
    motion = FourBars().solve(design, 20001)
    assert motion_faults(motion) == []
    assert joint_faults(motion) == []
    rates_fit(motion)
    said = {name: scalar.value for name, scalar in motion.scalars.items()}
    assert motion.scalars["input_range"].unit == "deg"
    assert said["toggle_low"] < said["swing_from"] < said["swing_to"] < said["toggle_high"]
    phi = np.degrees(motion.channels["phi"].values)
    assert [phi.min(), phi.max()] == pytest.approx([said["swing_from"], said["swing_to"]])
    assert phi[[0, -1]] == pytest.approx([said["swing_from"]] * 2)
    least = np.degrees(motion.channels["transmission_angle"].values.min())
    assert least == pytest.approx(1.0, abs=1e-6)
    assert math.degrees(said["least_transmission_angle"]) == pytest.approx(least, abs=1e-6)
    for place in ("position", "rotation"):
        there = getattr(motion.poses["coupler"], place)
        np.testing.assert_allclose(there, there[::-1], atol=1e-9)


def test_a_lever_swings_as_its_design_says_and_is_built():
    design = params(70, 60, 75, 110, swing_from=85, swing_to=30)
    found = FourBars().check(design)
    assert [one for one in found if one.severity is not Severity.NOTE] == []
    assert {part.name for part in FourBars().parts(design)} >= {"crank", "coupler", "follower", "ground"}
    phi = np.degrees(FourBars().solve(design, 181).channels["phi"].values)
    assert phi[[0, 90, 180]] == pytest.approx([85, 30, 85])


def test_a_crank_that_could_turn_may_swing_too():
    motion = FourBars().solve(params(30, 80, 70, 90, swing_from=10, swing_to=100), 721)
    rates_fit(motion)
    assert motion.scalars["input_range"].value == pytest.approx(90)
    assert "toggle_low" not in motion.scalars


def test_a_lever_may_swing_on_either_side_of_the_ground_line():
    for low, high in ((35, 75), (-75, -35), (285, 325)):
        motion = FourBars().solve(params(70, 30, 75, 90, swing_from=low, swing_to=high), 91)
        phi = np.degrees(motion.channels["phi"].values)
        assert math.remainder(phi.min() - low, 360) == pytest.approx(0, abs=1e-9)
        assert math.remainder(phi.max() - high, 360) == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize(("ends", "key"), [((-60, 100), "swing_to"), ((-100, 60), "swing_from")])
def test_a_swing_out_of_reach_names_its_end_and_the_limit(ends, key):
    design = params(70, 60, 75, 110, swing_from=ends[0], swing_to=ends[1])
    (found,) = errors(FourBars().check(design), Stage.MOTION)
    assert (found.code, found.parameter) == ("four-bar.swing", key)
    assert abs(found.limit) == pytest.approx(94.5574, abs=1e-3)
    assert "-94.557 to 94.557" in found.message
    with pytest.raises(KinematicsError, match="cannot swing"):
        FourBars().solve(design, 9)
    mended = design.model_copy(update={key: math.trunc(found.limit * 1e3) / 1e3})
    assert errors(FourBars().check(mended), Stage.MOTION) == []


def test_a_lever_near_its_toggles_is_shown_a_swing_that_is_not():
    for design in (params(70, 60, 75, 110), params(70, 30, 75, 90, swing_from=-80, swing_to=-30)):
        (found,) = (one for one in FourBars().check(design) if one.code == "four-bar.transmission")
        (change,) = found.proposed
        ends = {key.removeprefix("parameters."): end for key, end in change.items()}
        shorter = design.model_copy(update=ends)
        assert "four-bar.transmission" not in {one.code for one in FourBars().check(shorter)}


@pytest.mark.parametrize("branch", ["open", "crossed"])
def test_the_range_of_transmission_is_that_of_the_motion(branch):
    design = params(70, 60, 75, 110, swing_from=-80, swing_to=15, branch=branch)
    motion = FourBars().solve(design, 20001)
    angles = motion.channels["transmission_angle"].values
    assert motion.scalars["least_transmission_angle"].value == pytest.approx(angles.min(), abs=1e-7)
    assert motion.scalars["greatest_transmission_angle"].value == pytest.approx(angles.max(), abs=1e-3)


def test_a_tolerance_analysis_looks_at_the_swing():
    from mechwright import Tolerances

    model = FourBars().tolerances(params(70, 60, 75, 110, swing_from=-30, swing_to=45), Tolerances())
    assert np.degrees(model.positions[[0, -1]]) == pytest.approx([-30, 45])
    assert np.isfinite(model.sensitivities("follower angle", model.positions)[0]).all()


CHANGES = {
    "a + f = b + c": ((40, 80, 70, 110), 2),
    "a + c = b + f": ((40, 100, 60, 80), 2),
    "a + b = c + f": ((40, 60, 100, 80), 2),
    "parallelogram": ((50, 90, 50, 90), 1),
    "kite, crank and coupler alike": ((50, 50, 90, 90), 1),
    "kite, A meets B0": ((50, 90, 90, 50), 2),
    "rhombus": ((50, 50, 50, 50), 1),
}


@pytest.mark.parametrize("case", CHANGES)
@pytest.mark.parametrize("branch", ["open", "crossed"])
@pytest.mark.parametrize("direction", ["ccw", "cw"])
def test_a_linkage_goes_smoothly_through_its_change_points(case, branch, direction):
    lengths, turns = CHANGES[case]
    design = params(*lengths, branch=branch, direction=direction, ground_angle=35)
    assert turns_to_close(FourBar(*lengths)) == turns
    found = FourBars().check(design)
    assert errors(found, Stage.MOTION) == []
    assert [one.code for one in errors(found)] == ["four-bar.change-point"]
    motion = FourBars().solve(design, 1441 * turns)
    assert motion_faults(motion) == []
    assert joint_faults(motion) == []
    rates_fit(motion)
    assert abs(motion.channels["phi"].values[-1]) == pytest.approx(turns * 2 * math.pi)
    for place in ("position", "rotation"):
        ends = getattr(motion.poses["follower"], place)[[0, -1]]
        np.testing.assert_allclose(ends[0], ends[1], atol=1e-9)
    # The branch that the design asks for, at the start or just after it.
    near = close_through(
        FourBar(*lengths, math.radians(35), 1 if branch == "open" else -1),
        np.array([1e-3 if direction == "ccw" else -1e-3]),
        1.0 if direction == "ccw" else -1.0,
    )
    to_ground = lengths[3] * np.exp(1j * math.radians(35)) - near.joint_a
    side = (np.conj(to_ground) * (near.joint_b - near.joint_a)).imag
    assert (side[0] > 0) == (branch == "open")


def test_away_from_a_change_point_it_is_the_motion_of_one_branch():
    bar = FourBar(40, 80, 70, 110)
    phi = np.linspace(-2.5, 2.5, 101)
    one, two = close_through(bar, phi), close(bar, phi)
    np.testing.assert_allclose(one.joint_b, two.joint_b, rtol=0, atol=1e-9)
    np.testing.assert_allclose(one.follower.third, two.follower.third, rtol=1e-6, atol=1e-6)
    after = np.linspace(np.pi + 0.5, 2 * np.pi, 50)
    other = close(FourBar(40, 80, 70, 110, 0.0, -1), after)
    np.testing.assert_allclose(close_through(bar, after).joint_b, other.joint_b, rtol=0, atol=1e-9)


def test_nearly_a_change_point_is_an_error_of_the_parts_alone():
    design = params(40, 80, 70, 110 - 5e-5)
    found = errors(FourBars().check(design))
    assert [(one.code, one.stage) for one in found] == [("four-bar.change-point", Stage.PARTS)]
    motion = FourBars().solve(design, 361)
    assert motion_faults(motion) == []
    assert motion.channels["phi"].values[-1] == pytest.approx(2 * math.pi)


def test_the_toggle_is_where_an_independent_search_finds_it():
    def gap(x):
        return abs(110 - 70 * np.exp(1j * x)) - 135

    angle = brentq(gap, 1, 3)
    motion = FourBars().solve(params(70, 60, 75, 110), 9)
    assert motion.scalars["toggle_high"].value == pytest.approx(math.degrees(angle), abs=1e-9)


@pytest.mark.parametrize(
    "swing", [{}, {"swing_from": 130, "swing_to": 40}, {"swing_from": -500, "swing_to": -430}]
)
def test_many_levers_at_once_swing_as_each_does(swing):
    many = Many(FourBars())
    batch = many.drawn(
        12, {**swing, "ground": 100, "ground_angle": 10}, crank=(20, 120), coupler=(50, 110), follower=(50, 110),
        branch=["open", "crossed"],
    )  # fmt: skip
    columns = [
        "least_transmission_angle", "greatest_transmission_angle", "swing_from", "swing_to", "toggle_low", "toggle_high",
    ]  # fmt: skip
    found = many.same(batch, columns, Stage.MOTION)
    assert not many.alone
    allowed = found.forbidden == 0
    assert allowed.any()
    if swing:
        assert "four-bar.swing" in found.counts
        np.testing.assert_allclose(
            np.ptp([found.values[end][allowed] for end in ("swing_from", "swing_to")], axis=0),
            abs(np.subtract(*swing.values())),
        )
