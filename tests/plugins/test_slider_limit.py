"""The slider-crank at its limit, c = a + |e|, and the crank that is a lever."""

import math

import numpy as np
import pytest

from mechwright import KinematicsError, Severity, Stage
from mechwright.contracts.finding import errors
from mechwright.testing.compare import assert_derivative
from mechwright.testing.joints import joint_faults
from mechwright.testing.rules import motion_faults
from mechwright_slider_crank.family import SliderCrankFamily

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
