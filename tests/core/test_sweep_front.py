"""Studies: what is best of what was tried, and what is tried near it."""

import math
from pathlib import Path

import numpy as np
import pytest
from bowl_family import BowlParams, study
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from mechwright.contracts.evaluation import Batch
from mechwright.plugins.host import host
from mechwright.scripting.pareto import front_of, spread
from mechwright.studies import page
from mechwright.studies.front import Front, around
from mechwright.studies.page import page_of
from mechwright.studies.shard import Counts, read, shard_of
from mechwright.studies.study import study_of
from mechwright.studies.task import drawn


@given(arrays(float, st.tuples(st.integers(0, 60), st.integers(1, 4)), elements=st.integers(0, 6).map(float)))
@settings(max_examples=100, deadline=None)
def test_the_front_is_what_nothing_dominates(costs):
    def dominated(k):
        return any((one <= costs[k]).all() and (one < costs[k]).any() for one in costs)

    assert front_of(costs).tolist() == [k for k in range(len(costs)) if not dominated(k)]


def test_designs_without_a_number_are_in_no_front():
    costs = np.array([[1.0, np.nan], [2.0, 2.0], [np.inf, 0.0]])
    assert front_of(costs).tolist() == [1]
    assert front_of(np.empty((0, 2))).tolist() == []


def test_a_front_of_all_designs_takes_no_longer_than_another():
    """Compared in pairs, thirty thousand would take a quarter of a minute."""
    x = np.random.default_rng(1).random(30_000)
    costs = np.column_stack([x, 1 - x, np.random.default_rng(2).random(x.size)])
    assert front_of(costs).size == x.size
    assert len(spread(costs, 200)) == 200


def test_large_fronts_are_found_in_blocks():
    x = np.random.default_rng(1).permutation(3000) / 3000
    assert front_of(np.column_stack([x, 1 - x])).size == 3000
    assert front_of(np.column_stack([x, x])).tolist() == [int(np.argmin(x))]
    assert front_of(np.column_stack([x, 1 - x, x, x])).size == 3000


def test_what_is_shown_of_a_front_are_its_ends_and_what_is_far_from_them():
    x = np.linspace(0, 1, 11)
    chosen = spread(np.column_stack([x, 1 - x]), 3)
    assert sorted(chosen) == [0, 5, 10]
    assert spread(np.empty((0, 2)), 3) == []


def test_of_a_front_of_very_many_designs_some_are_on_the_page(monkeypatch):
    asked = study(count=64, ranges={"x": {"least": -4, "greatest": 6}, "teeth": {"least": 5, "greatest": 20}})
    front = Front(asked)
    front.columns = {"design": np.arange(30)} | {name: np.linspace(0, 1, 30) for name in asked.units}
    counts = Counts(30, 30, {})
    whole = page_of(asked, counts, front, (), (), {})
    monkeypatch.setattr(page, "SHOWN", 10)
    some = page_of(asked, counts, front, (), (), {})
    assert '"count": 30' in whole
    assert "of the front;" not in whole
    assert '"count": 10' in some
    assert "one design of 3, and one of 3 of the front; the tables have all" in some


def test_refinement_stays_in_its_ranges_and_finds_what_is_known_to_be_best():
    asked = study(count=64, ranges={"x": {"least": -4, "greatest": 6}, "teeth": {"least": 5, "greatest": 20}})
    front = Front(asked)

    def take(first, batch):
        found = asked.family.evaluate(batch, asked.measured)
        free = found.forbidden == 0
        values = {name: batch[name] for name in batch.varied} | dict(found.values)
        front.take(
            {"design": np.arange(first, first + len(batch))[free]} | {k: v[free] for k, v in values.items()}
        )

    take(0, drawn(asked, 0))
    before = len(front)
    for number in range(3):
        values = around(front, number, spread(front.costs, 12))
        assert values["x"].min() >= -4
        assert values["x"].max() <= 6
        assert set(values["teeth"].tolist()) <= set(range(5, 21))
        known = {(x, n) for x, n in zip(front.columns["x"], front.columns["teeth"], strict=True)}
        assert not known & set(zip(values["x"], values["teeth"], strict=True))
        take(1000 * (number + 1), Batch(BowlParams, {}, values))
    x = front.columns["x"]
    assert len(front) > 5 * before
    assert x.min() > -0.01  # the front in closed form, but for gaps of what was drawn
    assert x.max() < 2.01
    assert x.min() < 0.02
    assert x.max() > 1.98
    assert np.allclose(np.sqrt(front.costs).sum(axis=1), 2.0, atol=0.03)


def test_texts_that_are_varied_come_to_the_front():
    pytest.importorskip("pyarrow", reason="pip install 'mechwright[scale]'")
    asked = study(ranges={"x": {"least": -4, "greatest": 6}, "shape": {"values": ["round", "flat"]}})
    table = read(shard_of(asked, drawn(asked, 0), 0))
    front = Front(asked)
    front.take(table)
    assert {front.design(place)["shape"] for place in range(len(front))} <= {"round", "flat"}
    assert set(table["shape"].tolist()) == {"round", "flat"}
    values = around(front, 0, list(range(len(front))))
    assert Batch(BowlParams, {}, values).one(0).shape in {"round", "flat"}


def test_the_front_of_a_study_contains_the_known_optimum():
    """A pair's acceleration grows with its eccentricity, its size with the semi-major axis: one corner is best."""
    pytest.importorskip("pyarrow", reason="pip install 'mechwright[scale]'")
    content = {
        "family": "elliptic-gears",
        "study": {
            "method": "grid",
            "count": 20000,
            "ranges": {
                "eccentricity": {"least": 0.2, "greatest": 0.5, "count": 16},
                "semi_major": {"least": 40, "greatest": 60, "count": 11},
                "teeth": {"values": [25, 27, 29]},
            },
            "constraints": {"ratio_max": {"at_least": 2.0}},
            "objectives": {"alpha4_max": "least", "centre_distance": "least"},
        },
    }
    asked = study_of(content, Path("pairs.toml"), host())
    front = Front(asked)
    for number in range(asked.batches):
        front.take(read(shard_of(asked, drawn(asked, number), number * asked.batch)))
    # (1 + e)/(1 - e) is at least 2 from e = 1/3 on; 0.34 is the next of the grid
    assert {round(front.design(place)["eccentricity"], 9) for place in range(len(front))} == {0.34}
    assert {front.design(place)["semi_major"] for place in range(len(front))} == {40.0}
    e = 0.34
    cos = (-(1 + e * e) + math.sqrt((1 + e * e) ** 2 + 32 * e * e)) / (4 * e)
    ratio = 2 * e * (1 - e * e) * math.sqrt(1 - cos * cos) / (1 + e * e - 2 * e * cos) ** 2
    assert np.allclose(front.columns["alpha4_max"], ratio * (60 * math.tau / 60) ** 2, rtol=1e-12)
