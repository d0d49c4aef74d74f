"""Masses as objectives of the studies in examples: at full speed, and the same as those of each design."""

import tomllib
from pathlib import Path

import numpy as np
import pytest
from by_night import examples

from mechwright.contracts.evaluation import Batch, one_by_one
from mechwright.plugins.host import host
from mechwright.studies.study import study_of
from mechwright.studies.task import drawn
from mechwright.testing.evaluation import assert_same

EXAMPLES = Path(__file__).parents[2] / "examples"

MASSES = {
    "cam-follower": "mass",
    "elliptic-gears": "mass",
    "five-bar": "mass",
    "four-bar": "mass.coupler",
    "geneva": "mass",
    "slider-crank": "mass",
}
"""Family to a mass that it has by arrays."""


def study(family, seed):
    """The study of a family's example, drawn anew, for the lightest designs that it bounds as well."""
    path = EXAMPLES / f"{family}-study.toml"
    content = tomllib.loads(path.read_text(encoding="utf-8"))
    content["study"] |= {"count": 400, "seed": seed, "objectives": {MASSES[family]: "least"}}
    content["study"].setdefault("constraints", {})[MASSES[family]] = {"at_most": "100 kg"}
    return study_of(content, path, host())


@pytest.mark.parametrize("family", MASSES)
def test_a_study_for_the_lightest_weighs_no_design_by_itself(family, monkeypatch):
    one = study(family, 7)
    batch = drawn(one, 0)
    assert one.units[MASSES[family]] == "kg"
    monkeypatch.setattr(type(one.family), "parts", None)
    found = one.family.evaluate(batch, one.measured, one.stage)
    allowed = found.forbidden == 0
    assert allowed.sum() > 10
    assert np.isfinite(found.values[MASSES[family]][allowed]).all()
    assert np.ptp(found.values[MASSES[family]][allowed]) > 0


@pytest.mark.parametrize("seed", range(examples(1, 6)))
@pytest.mark.parametrize("family", MASSES)
def test_masses_are_those_of_each_design(family, seed):
    one = study(family, seed)
    batch, column = drawn(one, 0), [MASSES[family]]
    allowed = np.flatnonzero(one.family.evaluate(batch, (), one.stage).forbidden == 0)[: examples(2, 12)]
    few = Batch(batch.model, batch.content, {name: values[allowed] for name, values in batch.varied.items()})
    found = one.family.evaluate(few, column, one.stage)
    single = one_by_one(one.family.judge, one.family.solve, few, column, one.stage, one.family.parts)
    assert_same(found, single)
    assert np.isfinite(single.values[column[0]]).all()
