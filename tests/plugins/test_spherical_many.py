"""Many spherical four-bars at once are what each is by itself."""

import numpy as np
import pytest
from by_night import in_ci

from mechwright import Stage
from mechwright.contracts import by_arrays
from mechwright.contracts.evaluation import Batch, one_by_one
from mechwright.testing.evaluation import assert_same
from mechwright_spherical.family import Spherical
from mechwright_spherical.params import SphericalParams

pytestmark = in_ci

FAMILY = Spherical()
ENDS = ("least", "greatest")
FIGURES = [
    "transmission_min", "transmission_max", "T1", "T2", "T3", "T4", "time.least", "time.greatest",
    *(
        f"{name}.{end}"
        for name in ("omega", "alpha", "jerk", "psi", "omega_psi", "alpha_psi", "jerk_psi", "transmission_angle")
        for end in ENDS
    ),
]  # fmt: skip


def drawn(count, content, **ranges):
    rng = np.random.default_rng(1)
    varied = {
        name.replace("__", "."): rng.choice(some, count)
        if isinstance(some, list)
        else rng.uniform(*some, count)
        for name, some in ranges.items()
    }
    return Batch(SphericalParams, {"kind": "four-bar", **content}, varied)


CRANKS = {
    "four_bar__input": (15, 35),
    "four_bar__coupler": (50, 90),
    "four_bar__output": (45, 85),
    "four_bar__ground": (70, 110),
}
ANY = dict.fromkeys(CRANKS, (0, 180))
ONE = {"hardware": {"frame": "one"}}


@pytest.fixture
def alone(monkeypatch):
    """How many designs were asked one by one."""
    count = []

    def counted(judge, solve, batch, columns, stage):
        count.extend(range(len(batch)))
        return one_by_one(judge, solve, batch, columns, stage)

    monkeypatch.setattr(by_arrays, "one_by_one", counted)
    return count


def same(batch, columns, stage):
    found = FAMILY.evaluate(batch, columns, stage)
    assert_same(found, one_by_one(FAMILY.judge, FAMILY.solve, batch, columns, stage))
    return found


def test_cranks_and_levers_of_both_branches(alone):
    found = same(drawn(40, ONE, **ANY, four_bar__branch=[1, -1]), FIGURES, Stage.PARTS)
    assert {"spherical.assembly", "spherical.clearance"} <= set(found.counts)
    assert 0 in found.forbidden
    assert not alone


def test_sizes_of_links_and_stand(alone):
    batch = drawn(
        40, ONE, **CRANKS, hardware__boss_diameter=(7, 30), hardware__gap=(0.1, 1.5), stand__arc=(10, 60),
        radius=(30, 100), flat__bend_radius=(1, 50), four_bar__point_azimuth=(-20, 80),
    )  # fmt: skip
    found = same(batch, ["alpha_psi.greatest"], Stage.PARTS)
    assert {"spherical.boss", "spherical.gap", "spherical.stand", "spherical.strip"} <= set(found.counts)
    assert not alone


def test_a_ground_on_both_sides_is_asked_by_itself(alone):
    batch = drawn(6, {}, four_bar__input=(70, 90), four_bar__ground=(20, 40), four_bar__coupler=(70, 90))
    same(batch, ["transmission_min", "xP.greatest"], Stage.PARTS)
    assert alone


@pytest.mark.parametrize("content", [{"four_bar": {"travel": 90}}, {"stand": {"motor_flange": 60}}])
def test_what_has_no_way_goes_one_by_one(content, alone):
    same(drawn(2, content, radius=(90, 110)), ["transmission_min"], Stage.MOTION)
    assert len(alone) == 2
