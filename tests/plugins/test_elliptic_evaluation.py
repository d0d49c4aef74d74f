"""Many pairs of elliptic gears at once are what each of them is by itself."""

import numpy as np
import pytest

from mechwright import Stage
from mechwright.contracts.design_table import with_columns
from mechwright.contracts.evaluation import Batch, one_by_one
from mechwright.mechanics.gearing.checks import least_tip
from mechwright.testing.evaluation import assert_same
from mechwright_elliptic_gears.family import EllipticGears
from mechwright_elliptic_gears.kinematics.equations import Turning, train
from mechwright_elliptic_gears.kinematics.joint_load import greatest_torque
from mechwright_elliptic_gears.kinematics.mesh_load import meshes_of
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.areas import areas_of, by_mean, by_teeth
from mechwright_elliptic_gears.parts.teeth import least_regularity
from mechwright_elliptic_gears.rules.load_bounds import BETWEEN, SAMPLED_TO, TURN_SAMPLES, torques
from mechwright_elliptic_gears.table import table_of

FAMILY = EllipticGears()

COLUMNS = (
    "centre_distance", "ratio_max", "ratio_min", "omega4_max", "alpha4_max", "jerk4_max", "pressure_angle_max",
    "s2.greatest", "alpha4.least", "Q.speed.greatest", "Q.jerk.x.least", "theta4.least", "pressure_angle.greatest",
    "mass", "mass.gear",
)  # fmt: skip


def batch(content, size, **ranges):
    rng = np.random.default_rng(5)
    return Batch(
        EllipticGearParams,
        content,
        {
            name: rng.integers(*ends, size) if name == "teeth" else rng.uniform(*ends, size)
            for name, ends in ranges.items()
        },
    )


STUDIES = {
    "usual": batch({}, 14, teeth=(15, 60), eccentricity=(0.0, 0.62), semi_major=(10, 80), bore=(4, 30)),
    "racks": batch(
        {"module": 2.0, "bore": 0},
        30,
        teeth=(8, 40),
        eccentricity=(0.3, 0.7),
        addendum=(0.9, 1.5),
        dedendum=(1.0, 1.9),
        tip_radius=(0.0, 0.6),
        pressure_angle=(14, 30),
        point_across=(-60, 60),
    ),
    "coarse": batch({"backlash": 0.05}, 14, teeth=(6, 18), eccentricity=(0.0, 0.3), semi_major=(4, 40)),
}


@pytest.mark.parametrize("study", STUDIES)
def test_they_are_what_each_is_by_itself(study):
    found = FAMILY.evaluate(STUDIES[study], COLUMNS)
    assert_same(
        found, one_by_one(FAMILY.judge, FAMILY.solve, STUDIES[study], COLUMNS, Stage.PARTS, FAMILY.parts)
    )


def test_pairs_and_trains_in_one_table_have_their_masses():
    mixed = Batch(
        EllipticGearParams,
        {"eccentricity": 0.3},
        {"stages": np.array([2, 1, 2]), "bore": np.array([8.0, 9, 10])},
    )
    found = FAMILY.evaluate(mixed, ("mass",))
    assert np.isfinite(found.values["mass"]).all()
    assert_same(found, one_by_one(FAMILY.judge, FAMILY.solve, mixed, ("mass",), Stage.PARTS, FAMILY.parts))


def test_what_moves_is_not_judged_for_its_parts():
    few = Batch(EllipticGearParams, {}, {"eccentricity": np.linspace(0, 0.9, 7)})
    found = FAMILY.evaluate(few, COLUMNS, Stage.MOTION)
    assert_same(found, one_by_one(FAMILY.judge, FAMILY.solve, few, COLUMNS, Stage.MOTION))
    assert found.counts == {}


TRAINS = {
    "dowels": batch({"stages": 2}, 6, phase=(0, 360), eccentricity=(0.3, 0.6), teeth=(25, 40), bore=(6, 14)),
    "pins": batch({"stages": 2, "phase_joint": "pins"}, 5, eccentricity=(0.3, 0.6), semi_major=(40, 70)),
    "clamp": batch({"stages": 2, "phase_joint": "clamp"}, 5, eccentricity=(0.3, 0.6), semi_major=(40, 70)),
    "keyed": batch({"keyway_width": 3.0}, 6, bore=(5, 14), keyway_relief=(0, 1), eccentricity=(0.1, 0.6)),
    "offset": batch({"tooth_offset": 0.5}, 8, teeth=(22, 40), semi_major=(20, 60), eccentricity=(0.1, 0.6)),
}


@pytest.mark.parametrize("study", TRAINS)
def test_trains_and_keyed_pairs_are_what_each_is_by_itself(study):
    columns = (
        "centre_distance",
        "ratio_max",
        "Q.speed.max",
        "pressure_angle.greatest",
        "Q.jerk.least",
        "mass",
    )
    found = FAMILY.evaluate(TRAINS[study], columns)
    alone = one_by_one(FAMILY.judge, FAMILY.solve, TRAINS[study], columns, Stage.PARTS, FAMILY.parts)
    assert_same(found, alone)


def test_flanks_of_a_table_are_those_of_the_teeth():
    """Regularity and tips in columns, against the curves that outlines are made of."""
    rng = np.random.default_rng(3)
    many = {"teeth": rng.integers(9, 50, 40), "eccentricity": rng.uniform(0, 0.8, 40)}
    table = table_of(with_columns(EllipticGearParams(), {k: v[:, None] + 0.0 for k, v in many.items()}), 40)
    regularity = least_regularity(table.gears)
    for place in range(40):
        (teeth,) = table.row(place).teeth_with(table.row(place).backlash)
        assert regularity[place].item() == pytest.approx(teeth.least_regularity.min(), abs=1e-9)
        assert table.tips.width[place].item() == pytest.approx(least_tip([teeth]), abs=1e-9)
        assert table.tips.depth[place].item() == pytest.approx(teeth.tip_height / teeth.rack.module, abs=1e-9)


@pytest.mark.parametrize("eccentricity", [0.0, 0.2, 0.5, 0.7])
def test_areas_by_their_mean_are_those_tooth_by_tooth(eccentricity):
    """Of odd and even numbers of teeth; and where teeth are few, each is followed."""
    teeth = np.array([[8.0], [24.0], [41.0], [61.0]])
    varied = with_columns(EllipticGearParams(), {"eccentricity": eccentricity, "teeth": teeth})
    gears = table_of(varied, 4).gears
    each = by_teeth(gears)
    np.testing.assert_allclose(areas_of(gears), each, rtol=1e-7)
    np.testing.assert_allclose(by_mean(gears, 32)[2:], each[2:], rtol=1e-7)
    if eccentricity == 0.7:
        assert abs(by_mean(gears, 32)[0] / each[0] - 1) > 1e-7


LOADED = {
    "pairs": {"load_torque": (0.0, 8.0), "speed": (10.0, 4000.0), "eccentricity": (0.0, 0.65)},
    "keyed": {"load_torque": (0.0, 8.0), "speed": (10.0, 2000.0), "eccentricity": (0.0, 0.6)},
    "trains": {
        "load_torque": (0.0, 3.0),
        "speed": (10.0, 900.0),
        "eccentricity": (0.3, 0.62),
        "phase": (0, 360),
    },
}


@pytest.mark.parametrize("kind", LOADED)
def test_loads_are_within_their_bounds(kind):
    """Torques are within their bounds, and those by which most designs are judged not far below."""
    content = {"pairs": {}, "keyed": {"keyway_width": 3.0}, "trains": {"stages": 2}}[kind]
    many = batch(content | {"teeth": 35}, 8, semi_major=(40, 70), **LOADED[kind])
    for row in range(len(many)):
        table = table_of(many.one(row))
        bound, meshes = torques(table), meshes_of(table.given)
        true = [meshes[0].input_torque, meshes[0].greatest_torque]
        bounds = [bound.driver, bound.first]
        if kind == "trains":
            true += [greatest_torque(table.given, table.given.phase_degrees).value, meshes[1].greatest_torque]
            bounds += [bound.joint, bound.second]
        ratios = np.ravel(bounds) / true
        assert (ratios >= 1).all()
        assert (ratios[:3] <= (5 if kind == "trains" else 40)).all()


@pytest.mark.parametrize(
    ("rule", "content", "load"),
    [
        ("gear.root", {"thickness": 3.0}, (1.0, 60.0)),
        ("gear.key", {"keyway_width": 3.0, "bore": 9.0, "thickness": 4.0}, (1.0, 60.0)),
        ("train.shaft", {"stages": 2, "bore": 5.0, "thickness": 14.0}, (0.1, 9.0)),
        (
            "train.dowel-load",
            {"stages": 2, "dowel_diameter": 1.0, "thickness": 14.0, "bore": 14.0},
            (0.1, 40.0),
        ),
    ],
)
def test_what_breaks_is_forbidden_in_tables(rule, content, load):
    some = Batch(
        EllipticGearParams, content | {"eccentricity": 0.35}, {"load_torque": np.linspace(*load, 12)}
    )
    found = FAMILY.evaluate(some, ())
    assert_same(found, one_by_one(FAMILY.judge, FAMILY.solve, some, (), Stage.PARTS))
    assert 0 < found.counts.get(rule, 0) < 12


@pytest.mark.parametrize("phase", [0.0, 77.0, 200.0, 301.0])
def test_peaks_between_samples_are_within_the_bound_as_far_as_it_is_used(phase):
    """By samples thirty times as dense, up to the eccentricity beyond which nothing is said."""
    params = EllipticGearParams(stages=2, eccentricity=SAMPLED_TO, phase=phase, teeth=40)
    theta = np.linspace(0.0, 2 * np.pi, 30 * (TURN_SAMPLES - 1) + 1)
    _, four, five = train(Turning.of(theta, 1.0), SAMPLED_TO, np.radians(phase))
    for load in (five.alpha, five.omega, five.alpha * five.omega / four.omega, four.alpha):
        assert np.abs(load).max() <= BETWEEN * np.abs(load[::30]).max()
    beyond = table_of(params.model_copy(update={"eccentricity": SAMPLED_TO + 0.01}))
    assert np.isfinite(torques(table_of(params))).all()
    assert np.isinf(torques(beyond)).all()
