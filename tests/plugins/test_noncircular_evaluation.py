"""The motion of many non-circular pairs at once is what each of them has by itself."""

import numpy as np
import pytest

from mechwright import Stage
from mechwright.contracts.by_arrays import Designs
from mechwright.contracts.evaluation import Batch, one_by_one
from mechwright.testing.evaluation import assert_same
from mechwright_noncircular_gears.evaluation import answer, covered
from mechwright_noncircular_gears.family import NoncircularGears
from mechwright_noncircular_gears.sized import SizedParams

FAMILY = NoncircularGears()

COLUMNS = (
    "centre_distance", "ratio_max", "ratio_min", "omega2_max", "alpha2_max", "jerk2_max", "pressure_angle_max",
)  # fmt: skip


def batch(content, size, **ranges):
    rng = np.random.default_rng(2)
    varied = {name: rng.uniform(*ends, size) for name, ends in ranges.items()}
    return Batch(SizedParams, {"centre_distance": 90.0, **content}, varied)


STUDIES = {
    "windows": batch(
        {"law": "window"}, 10, window_ratio=(0.3, 2.5), window=(10, 250), blend=(10, 120), speed=(10, 300)
    ),
    "windows of lobes": batch(
        {"law": "window", "lobes": 2, "mate_lobes": 3}, 4, window=(10, 90), blend=(10, 60)
    ),
    "ellipses": batch(
        {"law": "ellipse", "mate_lobes": 2, "teeth": 30}, 4, eccentricity=(0, 0.89), centre_distance=(40, 200)
    ),
    "limacons": batch(
        {"law": "limacon", "lobes": 3, "teeth": 39}, 4, eccentricity=(0, 0.89), pressure_angle=(12, 28)
    ),
}


@pytest.mark.parametrize("study", STUDIES)
def test_they_move_as_each_by_itself(study):
    one = STUDIES[study]
    found = FAMILY.evaluate(one, COLUMNS, Stage.MOTION)
    assert_same(found, one_by_one(FAMILY.judge, FAMILY.solve, one, COLUMNS, Stage.MOTION))
    assert (found.forbidden == 0).any()
    assert set(found.counts) >= ({"law.window", "law.turns-back"} if study == "windows" else set())


@pytest.mark.parametrize("study", STUDIES)
def test_none_but_the_steepest_are_left(study):
    one = STUDIES[study]
    with np.errstate(all="ignore"):
        found = answer(Designs(one.common, one.varied), COLUMNS, Stage.MOTION)
    assert found.undecided.sum() <= 1
    assert set(found.values) == set(COLUMNS)


def test_teeth_are_looked_at_one_by_one():
    few = batch({"law": "window", "teeth": 41, "bore": 12.0}, 3, window_ratio=(0.8, 0.9), thickness=(5, 20))
    found = FAMILY.evaluate(few, COLUMNS[:2])
    assert_same(found, one_by_one(FAMILY.judge, FAMILY.solve, few, COLUMNS[:2], Stage.PARTS))
    with np.errstate(all="ignore"):
        assert answer(Designs(few.common, few.varied), COLUMNS[:2], Stage.PARTS).undecided.all()


@pytest.mark.parametrize(
    "content",
    [
        {"law": "fourier"},
        {"law": "slider"},
        {"law": "ellipse", "internal": True, "mate_lobes": 2},
        {"law": "ratio", "ratio": "1", "sector": 120},
    ],
)
def test_other_laws_are_left_to_each(content):
    assert not covered(Designs(SizedParams.model_validate(content), {"speed": np.array([60.0])}))
