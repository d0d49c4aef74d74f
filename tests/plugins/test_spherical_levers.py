"""Spherical four-bars whose input is a lever."""

import math
from pathlib import Path

import numpy as np
import pytest

from mechwright import Severity, Stage, host
from mechwright.contracts.finding import errors
from mechwright.designs.design import design_of
from mechwright.remedies import tried
from mechwright.testing.compare import assert_derivative
from mechwright.testing.joints import joint_faults
from mechwright.testing.rules import motion_faults
from mechwright_spherical.family import Spherical
from mechwright_spherical.kinematics.linkage import linkage_of
from mechwright_spherical.kinematics.mobility import input_range

ARCS = ("ground", "input", "coupler", "output")
LEVERS = {
    "one way beside the ground": (80, 60, 40, 60),
    "one way through the ground": (65, 94, 140, 63),
    "one way against the ground": (110, 103, 75, 34),
    "two ways": (85, 74, 148, 87),
}


def params(*arcs, **more):
    return Spherical().Params(kind="four-bar", four_bar={**dict(zip(ARCS, arcs, strict=True)), **more})


@pytest.mark.parametrize("case", LEVERS)
@pytest.mark.parametrize("branch", [1, -1])
def test_a_lever_goes_there_and_back_short_of_its_dead_centres(case, branch):
    arcs = LEVERS[case]
    design = params(*arcs, branch=branch)
    found = Spherical().check(design)
    assert errors(found, Stage.MOTION) == []
    assert [one.severity for one in found if one.code == "spherical.lever"] == [Severity.WARNING]
    motion = Spherical().solve(design, 20001)
    assert motion_faults(motion) == []
    assert joint_faults(motion) == []
    time = motion.channels["time"].values
    for value, rate in (("theta", "omega"), ("xP", "vxP"), ("vyP", "ayP"), ("omega3x", "alpha3x")):
        assert_derivative(motion.channels[rate].values, motion.channels[value].values, time, what=rate)
    mu = np.degrees(motion.channels["transmission_angle"].values)
    assert min(mu.min(), 180 - mu.max()) == pytest.approx(1.0, abs=1e-6)
    said = {name: one.value for name, one in motion.scalars.items() if one.unit == "deg"}
    assert said["toggle_low"] < said["swing_from"] < said["swing_to"] < said["toggle_high"]
    theta = np.degrees(motion.channels["theta"].values)
    assert [theta.min(), theta.max(), theta[0]] == pytest.approx(
        [said["swing_from"], said["swing_to"], said["swing_from"]]
    )
    there = motion.poses["coupler"].rotation
    np.testing.assert_allclose(there, there[::-1], atol=1e-9)


@pytest.mark.parametrize("case", LEVERS)
def test_the_range_ends_at_the_transmission_angle_asked_for(case):
    arcs = np.radians(LEVERS[case])
    a1, a2, a3, a4 = arcs
    for least in (0.0, math.radians(1), math.radians(25)):
        for low, high in input_range(*arcs, least):
            for end in (low, high):
                if end in (0.0, math.tau):
                    continue
                diagonal = math.cos(a1) * math.cos(a2) + math.sin(a1) * math.sin(a2) * math.cos(end)
                cosine = (diagonal - math.cos(a3) * math.cos(a4)) / (math.sin(a3) * math.sin(a4))
                assert abs(cosine) == pytest.approx(math.cos(least), abs=1e-9)


def test_a_start_chooses_the_way_and_where_path_angles_count_from():
    arcs = (85, 74, 148, 87)
    ways = [(math.degrees(a), math.degrees(b)) for a, b in input_range(*np.radians(arcs), math.radians(1))]
    for low, high in ways:
        middle = (low + high) / 2
        phase = linkage_of(params(*arcs, start=middle, path=[(0, 0, 1)], path_angles=[3])).shown
        assert phase.rocks
        assert math.degrees(phase.start) == pytest.approx(low)
        assert math.degrees(phase.travel) == pytest.approx(high - low)
        assert math.degrees(phase.target_angles[0]) == pytest.approx(middle + 3)


def test_a_travel_that_is_given_is_kept_or_refused():
    whole = errors(Spherical().check(params(80, 60, 40, 60, travel=360)), Stage.MOTION)
    assert [one.parameter for one in whole] == ["four_bar.travel"]
    assert "leave travel out" in whole[0].remedy
    part = params(80, 60, 40, 60, start=20, travel=60)
    assert errors(Spherical().check(part), Stage.MOTION) == []
    assert np.degrees(Spherical().solve(part, 3).channels["theta"].values) == pytest.approx([20, 50, 80])


def test_a_full_turn_is_left_as_it_was():
    phase = linkage_of(params(80, 30, 70, 60)).shown
    assert (phase.rocks, phase.start, phase.travel) == (False, 0.0, math.tau)


def test_a_path_point_out_of_reach_leaves_the_motion():
    design = params(80, 60, 40, 60, path=[(0, 0.6, 0.8), (0.3, 0.2, 0.9)], path_angles=[30, 170])
    assert errors(Spherical().check(design), Stage.MOTION) == []
    assert errors(Spherical().check(design), Stage.PARTS)
    motion = Spherical().solve(design, 181)
    assert motion_faults(motion) == []
    assert motion.scalars["path_error_max"].value > 0


@pytest.mark.parametrize(("kind", "radius"), [("five-bar", 5), ("five-bar", 10)])
def test_a_small_sphere_forbids_parts_alone(kind, radius):
    design = Spherical().Params(kind=kind, radius=radius)
    found = errors(Spherical().check(design))
    assert found
    assert {one.stage for one in found} == {Stage.PARTS}
    assert motion_faults(Spherical().solve(design, 91)) == []


def told(**table):
    """What is told of a four-bar, by code: the change, and what stands with it."""
    content = {"family": "spherical", "parameters": {"kind": "four-bar", "radius": 80, "four_bar": table}}
    design = design_of(content, Path("lever.toml"), "", host())
    grave = [one for one in tried(design, design.check()) if one.severity is not Severity.NOTE]
    return {
        one.code: (
            one.fix,
            None if one.fix is None else {left.code for left in design.changed(one.fix).check()},
        )
        for one in grave
    }


@pytest.mark.parametrize("case", LEVERS)
def test_of_a_lever_the_swing_is_told_that_is_good(case):
    """Both warnings go with one change of its swing; the limit of what is good stays what it is."""
    found = told(**dict(zip(ARCS, LEVERS[case], strict=True)))
    assert set(found) >= {"spherical.lever", "spherical.transmission"}
    for code in ("spherical.lever", "spherical.transmission"):
        change, left = found[code]
        assert set(change) == {"parameters.four_bar.start", "parameters.four_bar.travel"}
        assert not left & {"spherical.lever", "spherical.transmission"}


def test_a_swing_that_goes_too_far_keeps_its_sense_and_its_start():
    change, left = told(ground=70, input=60, coupler=20, output=55, start=70, travel=-50)[
        "spherical.assembly"
    ]
    assert change == {"parameters.four_bar.travel": -32.7}
    assert "spherical.assembly" not in left


def test_of_a_crank_that_turns_arcs_are_changed_and_no_limit():
    change, left = told(ground=85, input=30, coupler=62, output=60)["spherical.transmission"]
    assert set(change) <= {"parameters.four_bar.coupler", "parameters.four_bar.output"}
    assert "spherical.transmission" not in left
    assert "spherical.lever" not in left
