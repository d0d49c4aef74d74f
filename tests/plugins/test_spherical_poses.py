"""Spherical four-bars that carry a body through five orientations, against the independent check and themselves."""

import math
from collections import Counter
from itertools import permutations

import numpy as np
import pytest
from pydantic import ValidationError
from synthesis_reference import fact, facts

from mechwright.mechanics.planar import Turning
from mechwright_spherical.family import Spherical
from mechwright_spherical.kinematics.four_bar import FourBar
from mechwright_spherical.kinematics.linkage import linkage_of
from mechwright_spherical.kinematics.vectors import rotation_about, vector
from mechwright_spherical.requirements import PosesRequirement
from mechwright_spherical.synthesis.dyads import of_five, turns
from mechwright_spherical.synthesis.poses import Carrying, carrying


def quiet(done, what):
    pass


def turned(axes, angles):
    return np.array([rotation_about(vector(a), np.radians(t)) for a, t in zip(axes, angles, strict=True)])


def orientations(bar, theta):
    """The coupler's frames (n, 3, 3) at input angles in degrees."""
    frame = bar.at(Turning.of(np.radians(theta)), 0).coupler
    return np.moveaxis(np.stack([axis[0] for axis in frame], axis=1), 2, 0)


def known():
    """The check's linkage; its sign is that of a.(c x b)."""
    inputs = fact("burmester.spherical5.known_linkage.arcs_deg")["inputs"]
    bar = FourBar(*np.radians(inputs["ground_input_coupler_output_deg"]), -inputs["sigma"])
    return orientations(bar, inputs["theta_deg"])


def test_five_poses_have_the_dyads_of_the_check():
    inputs = fact("burmester.spherical5.real_dyads")["inputs"]
    # Its rotations are those of the frame, not of the body.
    rotations = turned(inputs["rotation_axes"], [-angle for angle in inputs["rotation_angles_deg"]])
    dyads = of_five(rotations)
    assert len(dyads) == fact("burmester.spherical5.real_dyads")["expected"]
    for one in facts("burmester.spherical5.dyad"):
        moving, fixed = (np.array(one["inputs"][key]) for key in ("moving_axis_at_pose1", "fixed_axis"))
        (same,) = [dyad for dyad in dyads if abs(dyad.moving @ moving) > 1 - 1e-9]
        assert abs(same.fixed @ fixed) == pytest.approx(1, abs=1e-9)
        assert math.degrees(same.arc) == pytest.approx(one["expected"], abs=1e-7)


def test_the_known_linkage_has_its_dyads_and_its_defects():
    rotations = known()
    dyads = of_five(rotations)
    expected = fact("burmester.spherical5.known_linkage.arcs_deg")["expected"]
    assert len(dyads) == fact("burmester.spherical5.known_linkage.real_dyads")["expected"]
    assert sorted(math.degrees(one.arc) for one in dyads) == pytest.approx(expected, abs=1e-7)
    ways = [carrying(one, two, turns(rotations)) for one, two in permutations(dyads, 2)]
    sound = [way for way in ways if isinstance(way, Carrying)]
    full = fact("burmester.spherical5.known_linkage.full_crank_defect_free")["expected"]
    assert sum(way.full for way in sound) == full
    assert any(np.degrees(way.arcs) == pytest.approx([80, 30, 70, 60], abs=1e-7) for way in sound)


def test_real_dyads_are_even_in_number_and_keep_their_arcs():
    rng = np.random.default_rng(4)
    counts = Counter()
    for _ in range(60):
        rotations = turned(rng.normal(size=(5, 3)), rng.uniform(-120, 120, 5))
        dyads = of_five(rotations)
        counts[len(dyads)] += 1
        for one in dyads:
            level = [one.fixed @ (turn @ one.moving) for turn in turns(rotations)]
            assert level == pytest.approx([math.cos(one.arc)] * 4, abs=1e-11)
    assert set(counts) <= {0, 2, 4, 6}
    assert len(counts) > 2


def test_designs_carry_the_body_through_its_poses():
    """Driven anew, the coupler turns between the poses as the body does; the path point alone would not say so."""
    wanted = PosesRequirement(point=(0.3, 0.2, 1), designs=30, least_transmission=5)
    result = Spherical().synthesise("poses", wanted, quiet)
    assert len(result.candidates) == 3
    assert "4 real dyads of 6; 3 linkages" in result.findings[0].message
    for one in result.candidates:
        table = one.params.four_bar
        (phase,) = linkage_of(one.params).phases
        assert phase.path_errors.max() < 1e-11
        bar = FourBar(*np.radians([table.ground, table.input, table.coupler, table.output]), table.branch)
        theta = table.start + np.array(table.path_angles)
        frames = orientations(bar, theta)
        z = vector(table.input_axis)
        c = vector(table.output_towards)
        x = vector(c - z * (c @ z))
        world = np.stack((x, np.cross(z, x), z), axis=1)
        seen = [world @ frame @ frames[0].T @ world.T for frame in frames[1:]]
        assert np.array(seen) == pytest.approx(turns(wanted.rotations), abs=1e-9)
        assert one.figures["least_transmission"].value >= math.radians(5)


def test_limits_and_drives_are_kept_and_defects_counted():
    every = Spherical().synthesise("poses", PosesRequirement(designs=30), quiet)
    least = max(one.figures["least_transmission"].value for one in every.candidates)
    high = PosesRequirement(least_transmission=math.degrees(least) + 1)
    none = Spherical().synthesise("poses", high, quiet)
    assert not none.candidates
    assert "3 linkages of them go through" in none.findings[0].message
    reasons = {one.code: one.count for one in none.rejected}
    assert reasons["spherical.transmission"] == 3
    assert sum(reasons.values()) == 12
    assert not Spherical().synthesise("poses", PosesRequirement(drive="lever"), quiet).candidates


def test_a_body_that_turns_about_one_axis_has_infinitely_many_dyads():
    poses = [(0, 0.6, 0.8, angle) for angle in (0, 20, 50, 90, 150)]
    result = Spherical().synthesise("poses", PosesRequirement(poses=poses), quiet)
    assert not result.candidates
    assert "infinitely many" in result.findings[0].message


@pytest.mark.parametrize(
    ("number", "pose", "said"),
    [
        (3, (0.0, 0.0, -2.0, 720.0), "poses 1 and 4 are the same"),
        (2, (0.0, 0.0, 0.0, 10.0), "axis of pose 3"),
        (1, (float("nan"), 0.0, 0.0, 10.0), "finite number"),
    ],
)
def test_poses_that_are_refused(number, pose, said):
    poses = list(PosesRequirement().poses)
    poses[number] = pose
    with pytest.raises(ValidationError) as caught:
        PosesRequirement(poses=tuple(poses))
    assert said in str(caught.value)
