"""Many pairs of elliptic gears at once are what each of them is by itself."""

import numpy as np
import pytest

from mechwright import Stage
from mechwright.contracts.by_arrays import Designs
from mechwright.contracts.evaluation import Batch, one_by_one
from mechwright.testing.evaluation import assert_same
from mechwright_elliptic_gears.evaluation import Sizes, answer
from mechwright_elliptic_gears.family import EllipticGears
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.areas import areas_of, by_mean, by_teeth

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


def test_what_moves_is_not_judged_for_its_parts():
    few = Batch(EllipticGearParams, {}, {"eccentricity": np.linspace(0, 0.9, 7)})
    found = FAMILY.evaluate(few, COLUMNS, Stage.MOTION)
    assert_same(found, one_by_one(FAMILY.judge, FAMILY.solve, few, COLUMNS, Stage.MOTION))
    assert found.counts == {}


def test_formulas_decide_pairs_of_the_usual_rack():
    study = STUDIES["usual"]
    said = answer(Designs(study.common, study.varied), (), Stage.PARTS)
    assert said is not None
    assert not said.undecided.any()
    assert 0.2 < (said.forbidden == 0).mean() < 0.9


@pytest.mark.parametrize("eccentricity", [0.0, 0.2, 0.5, 0.7])
def test_areas_by_their_mean_are_those_tooth_by_tooth(eccentricity):
    """Of odd and even numbers of teeth; and where teeth are few, each is followed."""
    varied = {"eccentricity": np.full(4, eccentricity), "teeth": np.array([8, 24, 41, 61])}
    gears = Sizes(Designs(EllipticGearParams(), varied)).gears()
    each = by_teeth(gears)
    np.testing.assert_allclose(areas_of(gears), each, rtol=1e-7)
    np.testing.assert_allclose(by_mean(gears, 32)[2:], each[2:], rtol=1e-7)
    if eccentricity == 0.7:
        assert abs(by_mean(gears, 32)[0] / each[0] - 1) > 1e-7
