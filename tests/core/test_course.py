"""One period of an input: a crank that turns, a lever that goes there and back."""

import numpy as np
import pytest

from mechwright.contracts.motion import Channel, Curve, Motion, Poses
from mechwright.errors import DesignError, KinematicsError
from mechwright.mechanics.planar import Course
from mechwright.testing.compare import assert_derivative
from mechwright.testing.rules import motion_faults
from mechwright.tolerances import exceeds, falls_short


@pytest.mark.parametrize("travel", [1.3, -0.4])
def test_a_lever_is_moved_as_by_a_far_crank(travel):
    time, turning = Course(0.2, travel, rocks=True).period(401, 7.0)
    assert time[-1] == pytest.approx(2 * np.pi / 7)
    assert turning.theta[[0, 200, 400]] == pytest.approx([0.2, 0.2 + travel, 0.2], abs=1e-15)
    assert turning.omega[[0, 200, 400]] == pytest.approx([0, 0, 0], abs=1e-14)
    for rate, value in (("omega", "theta"), ("alpha", "omega"), ("jerk", "alpha")):
        assert_derivative(getattr(turning, rate), getattr(turning, value), time, what=rate)


@pytest.mark.parametrize("travel", [2 * np.pi, -4 * np.pi])
def test_a_crank_turns_at_constant_speed(travel):
    time, turning = Course(0.5, travel).period(9, 3.0)
    assert time[-1] == pytest.approx(abs(travel) / 3)
    assert turning.omega == pytest.approx([np.copysign(3.0, travel)] * 9)
    assert turning.theta[[0, -1]] == pytest.approx([0.5, 0.5 + travel])
    assert not turning.alpha.any()


def test_too_few_samples_are_refused():
    for rocks in (False, True):
        with pytest.raises(DesignError, match="take at least 2"):
            Course(0.0, 1.0, rocks).period(1, 1.0)


def lever(**channels):
    angle = 1 - np.cos(np.linspace(0, 2 * np.pi, 31))
    return Motion("phi", {"phi": Channel(angle, "rad"), **channels})


def test_what_goes_there_and_back_is_drawn_over_its_time():
    time = {"time": Channel(np.linspace(0, 2, 31), "s")}
    assert (lever(**time).rocks, lever(**time).over) == (True, "time")
    assert motion_faults(lever(**time)) == []
    assert "needs a channel time" in motion_faults(lever())[0]
    assert "needs a channel time" in motion_faults(lever(time=Channel(np.linspace(2, 0, 31), "s")))[0]
    turning = Motion("phi", {"phi": Channel(np.linspace(0, 1, 9), "rad")})
    assert (turning.rocks, turning.over) == (False, "phi")


def test_a_curve_belongs_to_a_body_and_is_in_space():
    channels = {"x": Channel(np.arange(2.0), "")}
    poses = {"wheel": Poses.planar(0.0, 0.0, np.zeros(2))}
    Motion("x", channels, poses, curves={"rim": Curve.planar("wheel", np.array([1j, 2 + 0j]))})
    for curve in (Curve("wheel", np.zeros((4, 2))), Curve("rim", np.zeros((4, 3)))):
        with pytest.raises(KinematicsError, match="the curve 'rim'"):
            Motion("x", channels, poses, curves={"rim": curve})


def test_a_limit_that_is_reached_is_not_passed():
    assert not exceeds(50.00000000000001, 50)
    assert not falls_short(0.1 + 0.2, 0.30000000000000004)
    assert exceeds(50.001, 50)
    assert falls_short(49.999, 50)
    assert exceeds(1e-12, 0.0)
    assert falls_short(-1e-12, 0.0)
