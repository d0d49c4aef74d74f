"""The slider-crank at its limit, c = a + |e|, and the crank that is a lever."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mechwright import KinematicsError, Severity, Stage
from mechwright.contracts.finding import errors
from mechwright.testing.compare import assert_derivative
from mechwright.testing.joints import joint_faults
from mechwright.testing.rules import motion_faults
from mechwright_slider_crank.family import SliderCrankFamily
from mechwright_slider_crank.kinematics.course import ways
from mechwright_slider_crank.kinematics.figures import peaks
from mechwright_slider_crank.table import SliderCrankTable

RATES = (
    ("phi", "omega_a"),
    ("s", "v"),
    ("v", "a"),
    ("a", "jerk"),
    ("sigma", "omega_c"),
    ("omega_c", "alpha_c"),
    ("alpha_c", "jerk_c"),
    ("axP", "jxP"),
)
FAMILY = SliderCrankFamily()


def params(crank, rod, offset, **more):
    return FAMILY.Params(crank=crank, rod=rod, offset=offset, **more)


def sound(motion):
    assert motion_faults(motion) == []
    assert joint_faults(motion) == []
    time = motion.channels["time"].values
    for value, rate in RATES:
        one, two = motion.channels[value].values, motion.channels[rate].values
        assert_derivative(two, one, time, tolerance=1e-6, what=rate)


@pytest.mark.parametrize("assembly", ["ahead", "behind"])
@pytest.mark.parametrize("clockwise", [False, True])
@pytest.mark.parametrize("offset", [10, -10, 0])
def test_at_its_limit_it_goes_smoothly_through_both_assemblies(assembly, clockwise, offset):
    design = params(30, 30 + abs(offset), offset, assembly=assembly, clockwise=clockwise, slide_direction=37)
    found = errors(FAMILY.check(design))
    assert [(one.code, one.stage) for one in found] == [("slider-crank.crank-turn", Stage.PARTS)]
    turns = 2 if offset else 1
    motion = FAMILY.solve(design, 1440 * turns + 1)
    sound(motion)
    assert abs(motion.channels["phi"].values[-1]) == pytest.approx(turns * 2 * math.pi)
    np.testing.assert_allclose(motion.poses["rod"].rotation[0], motion.poses["rod"].rotation[-1], atol=1e-9)
    along = np.exp(-1j * math.radians(37))
    ends = motion.poses["rod-end"].position - motion.poses["rod"].position
    ahead = ((ends[:, 0] + 1j * ends[:, 1]) * along).real
    assert (ahead[0] > 0) == (assembly == "ahead")
    assert ahead.min() < -10 < 10 < ahead.max()


def test_at_its_limit_one_assembly_has_the_stroke_of_the_formula():
    design = params(19.495181774, 184.661012231, 165.165830457)
    found = FAMILY.solve(design, 1441).scalars
    assert found["assembly_stroke"].value == pytest.approx(120, abs=1e-6)
    assert found["assembly_time_ratio"].value == pytest.approx(1.5, abs=1e-6)
    assert found["stroke"].value == pytest.approx(240, abs=1e-3)


@pytest.mark.parametrize(
    ("crank", "rod", "offset"), [(30, 35, 10), (30, 35, -10), (40, 20, 10), (100, 30, 10), (2, 1, 1 / 3)]
)
@pytest.mark.parametrize("clockwise", [False, True])
def test_a_crank_that_cannot_turn_is_a_lever(crank, rod, offset, clockwise):
    design = params(crank, rod, offset, clockwise=clockwise)
    found = FAMILY.check(design)
    assert errors(found, Stage.MOTION) == []
    turning = next(one for one in found if one.code == "slider-crank.crank-turn")
    assert turning.severity is Severity.WARNING
    motion = FAMILY.solve(design, 8001)
    sound(motion)
    said = {name: scalar.value for name, scalar in motion.scalars.items()}
    assert said["toggle_low"] < said["swing_from"] < said["swing_to"] < said["toggle_high"]
    for end in (said["toggle_low"], said["toggle_high"]):  # the rod stands across the slide
        assert abs(offset - crank * math.sin(math.radians(end))) == pytest.approx(rod)
    assert np.degrees(motion.channels["transmission_angle"].values.min()) == pytest.approx(1.0, abs=1e-6)
    assert said["stroke"] == pytest.approx(np.ptp(motion.channels["s"].values), rel=1e-4)


def test_a_lever_can_be_built():
    design = params(100, 30, 10)
    assert errors(FAMILY.check(design)) == []
    assert "rail" in {part.name for part in FAMILY.parts(design)}


@pytest.mark.parametrize(
    ("sizes", "ends", "direction"),
    [
        ((30, 35, 10), (-20, 80), 40),
        ((30, 100, 10), (100, 10), 0),
        ((100, 30, 10), (-10, 15), -30),
        ((100, 30, 10), (190, 170), 0),
        ((100, 30, 10), (-200, -180), 40),
    ],
)
def test_a_lever_swings_as_its_design_says(sizes, ends, direction):
    one, two = (end + direction for end in ends)
    design = params(*sizes, swing_from=one, swing_to=two, slide_direction=direction)
    motion = FAMILY.solve(design, 1441)
    sound(motion)
    phi = np.degrees(motion.channels["phi"].values)
    assert phi[[0, 720, 1440]] == pytest.approx([one, two, one])
    said = {name: scalar.value for name, scalar in motion.scalars.items()}
    assert said["input_range"] == pytest.approx(abs(one - two))
    assert said["stroke"] == pytest.approx(np.ptp(motion.channels["s"].values), rel=1e-5)
    least = motion.channels["transmission_angle"].values.min()
    assert said["least_transmission_angle"] == pytest.approx(least, abs=1e-6)
    assert ("toggle_low" in said) == (sizes != (30, 100, 10))
    if "toggle_low" in said:
        assert said["toggle_low"] < min(one, two) < max(one, two) < said["toggle_high"]
    assert "slider-crank.crank-turn" not in {one.code for one in FAMILY.check(design)}


@pytest.mark.parametrize(("ends", "key"), [((-50, 240), "swing_to"), ((-60, 200), "swing_from")])
def test_a_swing_out_of_reach_names_its_end_and_the_limit(ends, key):
    design = params(30, 35, 10, swing_from=ends[0], swing_to=ends[1])
    (found,) = errors(FAMILY.check(design), Stage.MOTION)
    assert (found.code, found.parameter) == ("slider-crank.swing", key)
    with pytest.raises(KinematicsError, match="cannot swing"):
        FAMILY.solve(design, 9)
    mended = design.model_copy(update={key: math.trunc(found.limit * 1e3) / 1e3})
    assert errors(FAMILY.check(mended), Stage.MOTION) == []


def test_a_lever_near_its_toggles_is_shown_a_swing_that_is_not():
    design = params(30, 35, 10)
    (found,) = (one for one in FAMILY.check(design) if one.code == "slider-crank.transmission")
    (change,) = found.proposed
    shorter = params(30, 35, 10, **{key.removeprefix("parameters."): end for key, end in change.items()})
    codes = {one.code for one in FAMILY.check(shorter)}
    assert not codes & {"slider-crank.transmission", "slider-crank.crank-turn"}
    assert shorter.swing_to - shorter.swing_from > 200


def test_what_does_not_reach_the_slide_line_does_not_move():
    design = params(20, 30, 60)
    (found,) = errors(FAMILY.check(design), Stage.MOTION)
    assert (found.code, found.limit) == ("slider-crank.closure", 50)
    with pytest.raises(KinematicsError, match="do not reach"):
        FAMILY.solve(design, 9)
    assert errors(FAMILY.check(params(20, 30, 49.5)), Stage.MOTION) == []


def test_the_margin_of_the_rod_is_said():
    design = params(30, 40.008, 10)
    (found,) = errors(FAMILY.check(design))
    assert "is 0.02 % longer than crank and offset together, 40 mm, and the least is 0.05 %" in found.message
    assert "does not span" not in found.message
    assert found.stage is Stage.PARTS
    assert FAMILY.solve(design, 9).channels["phi"].values[-1] == pytest.approx(2 * math.pi)
    assert errors(FAMILY.check(params(30, 40.02, 10))) == [
        one for one in errors(FAMILY.check(params(30, 40.02, 10))) if one.code != "slider-crank.crank-turn"
    ]


@settings(deadline=None)
@given(
    st.floats(5, 100),
    st.floats(5, 100),
    st.floats(-80, 80),
    st.floats(-180, 180),
    st.sampled_from([0.0, 0.02]),
)
def test_the_ways_of_a_crank_are_all_angles_at_which_the_rod_reaches_the_slide(
    crank, rod, offset, slide, least
):
    design = params(crank, rod, offset, slide_direction=slide)
    angles = np.linspace(-math.pi, math.pi, 721)[:-1]
    off = np.abs(offset - crank * np.sin(angles - math.radians(slide))) - rod * math.cos(least)
    inside = np.zeros(angles.shape, bool)
    for low, high in ways(SliderCrankTable.of(design), least):
        inside |= (angles - low) % math.tau <= high - low
    clear = np.abs(off) > 1e-9 * (crank + rod)
    assert (inside == (off <= 0))[clear].all()


@given(st.floats(0, math.tau), st.sampled_from([math.tau, math.inf]))
def test_a_peak_is_found_wherever_it_is_and_nothing_beyond_the_end_is_asked(where, end):
    def functions(t):
        assert end == math.inf or 0 <= t.min() <= t.max() <= end
        return {"one": 3 + np.cos(t - where), "other": -np.abs(t - where)}

    found = peaks(functions, end)
    assert found["one"] == pytest.approx(4, abs=1e-12)
    assert found["other"] == pytest.approx(0, abs=1e-6)
