"""The motion of many non-circular pairs at once is what each of them has by itself."""

import numpy as np
import pytest

from mechwright import Stage
from mechwright.contracts import by_arrays
from mechwright.contracts.evaluation import Batch, one_by_one
from mechwright.testing.evaluation import assert_same
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


@pytest.fixture
def alone(monkeypatch):
    """The places that tables leave to one design after the other."""
    places = []
    inner = by_arrays.singly

    def counted(family, batch, columns, stage, some, **more):
        places.extend(some.tolist())
        return inner(family, batch, columns, stage, some, **more)

    monkeypatch.setattr(by_arrays, "singly", counted)
    return places


@pytest.mark.parametrize("study", STUDIES)
def test_tables_leave_none_to_itself(study, alone):
    found = FAMILY.evaluate(STUDIES[study], COLUMNS, Stage.MOTION)
    assert not alone
    assert np.isfinite([found.values[name][found.forbidden == 0] for name in COLUMNS]).all()


EVERY = (*COLUMNS, "ratio_max.theta1", "ratio_min.theta1", "omega2.least", "jerk2.greatest", "s1.least")


@pytest.mark.parametrize(
    ("content", "ranges"),
    [
        ({"law": "window", "teeth": 41, "bore": 12.0}, {"window_ratio": (0.8, 0.9), "thickness": (5, 20)}),
        ({"law": "window", "centre_distance": None, "module": 2.0}, {"blend": (60, 150)}),
        ({"law": "fourier", "sines": [12.0]}, {"speed": (10, 300), "pressure_angle": (14, 28)}),
        ({"law": "slider", "teeth": 48}, {"rod_ratio": (2.5, 5), "speed": (10, 300)}),
        ({"law": "ellipse", "internal": True, "mate_lobes": 2}, {"eccentricity": (0, 0.9)}),
        ({"law": "spiral", "sector": 100, "teeth": 20}, {"first_ratio": (0.6, 0.8), "load_torque": (0, 1)}),
        ({"law": "angle", "angle": "0.9*phi + 0.1*sin(phi)"}, {"speed": (10, 300), "bore": (5, 12)}),
        ({"law": "geneva", "slots": 6}, {"ramp": (0.1, 0.4), "window": (120, 200)}),
    ],
)
@pytest.mark.parametrize("stage", [Stage.MOTION, Stage.PARTS])
def test_rows_are_what_each_is_by_itself(content, ranges, stage, alone):
    few = batch(content, 4, **ranges)
    found = FAMILY.evaluate(few, EVERY, stage)
    assert not alone
    assert_same(found, one_by_one(FAMILY.judge, FAMILY.solve, few, EVERY, stage))
