"""Many cams at once are what each of them is by itself."""

import numpy as np
import pytest

from mechwright import Stage
from mechwright.contracts.evaluation import Batch, one_by_one
from mechwright.testing.evaluation import assert_same
from mechwright_cam_follower.family import CamFollower
from mechwright_cam_follower.parameters import CamParams

FAMILY = CamFollower()


def batch(content, size, **ranges):
    rng = np.random.default_rng(3)
    return Batch(CamParams, content, {name: rng.uniform(*ends, size) for name, ends in ranges.items()})


TWO_STEPS = {
    "angles": [70, 30, 70, 40, 110, 40],
    "laws": ["cycloidal", "simple-harmonic", "modified-trapezoid"],
}

STUDIES = {
    "slides": batch(
        {"laws": ["modified-sine", "3-4-5"], "screw_diameter": 4, "pin_diameter": 8},
        14,
        base_radius=(12, 60),
        roller_radius=(4, 20),
        offset=(-30, 30),
        bore=(0, 30),
        mass=(0.1, 3),
        speed=(50, 900),
        screw_circle=(18, 60),
    ),
    "levers": batch(
        {"follower": "oscillating", "swings": [10, 10, 20, 20, 0, 0], "turning": "cw", **TWO_STEPS},
        14,
        base_radius=(15, 60),
        centre_distance=(50, 150),
        arm_length=(40, 120),
        pivot_bore=(4, 18),
    ),
    "short levers": batch(
        {"follower": "oscillating", "swings": [6, 6, 0, 0], "pin_diameter": 6},
        14,
        base_radius=(15, 40),
        centre_distance=(40, 60),
        arm_length=(6, 45),
        pivot_bore=(4, 18),
    ),
    "small slides, whose bores and studs follow": batch(
        {"lifts": [2, 2, 0, 0]}, 10, base_radius=(2.5, 14), roller_radius=(1.2, 8)
    ),
    "levers that follow their cams": batch(
        {"follower": "oscillating", "swings": [8, 8, 0, 0]}, 8, base_radius=(4, 80), roller_radius=(1.5, 12)
    ),
    "keyed slides": batch(
        {"bore": 14, "keyway_width": 5, "keyway_relief": 1, "screw_diameter": 3, "pin_diameter": 8},
        8,
        base_radius=(14, 40),
        roller_radius=(4, 10),
        screw_circle=(18, 40),
    ),
    "pairs of slides": batch(
        {"conjugate": True, "laws": ["modified-sine", "3-4-5"]},
        10,
        base_radius=(6, 45),
        roller_radius=(4, 20),
        offset=(-20, 20),
        bore=(0, 30),
        mass=(0.1, 3),
    ),
    "pairs of levers": batch(
        {"conjugate": True, "follower": "oscillating", "swings": [16, 16, 0, 0], "inertia": 0.002},
        10,
        base_radius=(14, 60),
        centre_distance=(60, 110),
        arm_length=(50, 90),
        pivot_bore=(4, 18),
    ),
    "flat faces": batch(
        {"contact": "flat", "laws": ["4-5-6-7"]},
        8,
        base_radius=(8, 60),
        thickness=(0.9, 20),
        guide_length=(10, 40),
    ),
    "flat levers": batch(
        {"contact": "flat", "follower": "oscillating", "swings": [8, 8, 0, 0]},
        8,
        base_radius=(30, 110),
        centre_distance=(60, 170),
        face_offset=(5, 25),
    ),
}


def columns(study):
    """All columns."""
    return tuple(FAMILY.measures(CamParams.model_validate(study.content)))


@pytest.mark.parametrize("study", STUDIES)
def test_they_are_what_each_is_by_itself(study):
    one = STUDIES[study]
    found = FAMILY.evaluate(one, columns(one))
    assert_same(found, one_by_one(FAMILY.judge, FAMILY.solve, one, columns(one), Stage.PARTS, FAMILY.parts))
    assert (found.forbidden == 0).sum() >= 2
    assert len(found.counts) >= 2 if "follow" not in study else not found.counts


@pytest.mark.parametrize("study", STUDIES)
def test_no_design_is_evaluated_by_itself(study, monkeypatch):
    one = STUDIES[study]
    asked = columns(one)
    monkeypatch.setattr(CamFollower, "judge", None)
    monkeypatch.setattr(CamFollower, "solve", None)
    monkeypatch.setattr(CamFollower, "parts", None)
    found = FAMILY.evaluate(one, asked)
    assert all(np.isfinite(found.values[name][found.forbidden == 0]).all() for name in asked)


def test_what_moves_is_not_judged_for_its_parts():
    few = Batch(CamParams, {"bore": 78.0}, {"base_radius": np.linspace(6, 40, 5), "offset": np.full(5, 20.0)})
    asked = ("cam_radius_max", "lift.greatest")
    found = FAMILY.evaluate(few, asked, Stage.MOTION)
    assert_same(found, one_by_one(FAMILY.judge, FAMILY.solve, few, asked, Stage.MOTION))


@pytest.mark.parametrize("keyway", [{"keyway_width": 4.5}, {"keyway_width": 5, "keyway_relief": 9}])
def test_keyways_that_are_none_forbid_all(keyway):
    few = Batch(CamParams, {"bore": 14, **keyway}, {"base_radius": np.array([40.0, 50.0])})
    found = FAMILY.evaluate(few, ())
    assert_same(found, one_by_one(FAMILY.judge, FAMILY.solve, few, (), Stage.PARTS))
    assert found.forbidden.all()


def test_shafts_with_keys_may_be_varied():
    """Bores, depths and reliefs of one keyway are columns; each width has a table of its own."""
    varied = {
        "bore": np.array([13.0, 15.0, 17.0, 76.0, 15.0, 15.0, 15.0, 4.0]),
        "keyway_width": np.array([5.0, 5.0, 5.0, 5.0, 4.0, 6.0, 4.5, 5.0]),
        "keyway_depth": np.array([2.3, 2.3, 3.0, 2.3, 1.8, 1.0, 2.0, 2.3]),
        "keyway_relief": np.array([0.0, 1.0, 0.5, 1.0, 0.0, 0.0, 9.0, 0.0]),
    }
    one, asked = Batch(CamParams, {}, varied), ("mass.cam", "cam_radius_max")
    found = FAMILY.evaluate(one, asked)
    assert_same(found, one_by_one(FAMILY.judge, FAMILY.solve, one, asked, Stage.PARTS, FAMILY.parts))
    assert found.counts == {
        "bore.keyway-depth": 1,
        "bore.keyway-relief": 1,
        "bore.keyway-width": 1,
        "follower.wall": 1,
    }


def test_kinds_that_are_varied_are_evaluated_kind_by_kind(monkeypatch):
    """Slides and levers, single and in pairs: nothing is asked by itself."""
    size = 32
    varied = {
        "base_radius": np.linspace(38, 60, size),
        "follower": np.array(["translating", "oscillating"])[np.arange(size) % 2],
        "conjugate": np.arange(size) // 2 % 2 == 1,
    }
    one, asked = Batch(CamParams, {"bore": 10}, varied), ("cam_radius_max", "torque.greatest")
    single = one_by_one(FAMILY.judge, FAMILY.solve, one, asked, Stage.PARTS)
    monkeypatch.setattr(CamFollower, "judge", None)
    assert_same(FAMILY.evaluate(one, asked), single)


def test_a_top_beyond_the_first_parabolas_is_followed():
    """The force is greatest shortly before the rise ends, and bends more and more on the way there."""
    lift = 27.641466417404814
    content = {"lifts": [lift, lift, 0, 0], "laws": ["3-4-5", "4-5-6-7"], "speed": 36.4, "offset": -11.765}
    one = Batch(CamParams, content, {"base_radius": np.array([49.05]), "roller_radius": np.array([19.62])})
    asked = ("contact_force_max", "contact_pressure_max")
    found = FAMILY.evaluate(one, asked)
    assert_same(found, one_by_one(FAMILY.judge, FAMILY.solve, one, asked, Stage.PARTS))
    assert (found.forbidden == 0).all()


LEVER = {"follower": "oscillating", "swings": [10, 10, 0, 0]}


@pytest.mark.parametrize(
    ("table", "hole"),
    [
        ({"pin_diameter": 8}, 8),
        ({**LEVER, "pin_diameter": 4, "pivot_bore": 9}, 9),
        ({**LEVER, "pin_diameter": 9, "pivot_bore": 5}, 9),
    ],
)
def test_a_bar_is_refused_that_leaves_less_than_a_wall_beside_its_hole(table, hole):
    wall = 1.5
    widths = hole + 2 * wall + np.array([-1.0, -0.01, 0.01, 4.0])
    few = Batch(CamParams, {**table, "least_wall": wall}, {"follower_width": widths})
    found = FAMILY.evaluate(few, ())
    assert_same(found, one_by_one(FAMILY.judge, FAMILY.solve, few, (), Stage.PARTS))
    assert found.counts == {"follower.wall": 2}
    assert (found.forbidden > 0).tolist() == [True, True, False, False]


def test_a_law_that_is_none_forbids_all_by_its_first_fault():
    table = {"laws": ["polynomial"], "polynomial": [0, 0, 3, -1]}
    few = Batch(CamParams, table, {"base_radius": np.array([40.0, 50.0])})
    found = FAMILY.evaluate(few, ())
    assert_same(found, one_by_one(FAMILY.judge, FAMILY.solve, few, (), Stage.PARTS))
    assert found.forbidden.all()
