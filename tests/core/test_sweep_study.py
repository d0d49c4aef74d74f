"""Studies: what a file can ask for, which designs that gives, and what is measured of them."""

import math
from pathlib import Path

import numpy as np
import pytest
from bowl_family import BOWL, BowlParams, OneFamily, study
from pydantic import Field

from mechwright import DesignError, Stage
from mechwright.contracts.evaluation import Batch, one_by_one
from mechwright.studies.study import study_of
from mechwright.studies.task import drawn

SHAPES = {"ranges": {"shape": {"values": ["round", "square"]}}}


@pytest.mark.parametrize("method", ["sobol", "latin-hypercube", "random"])
def test_the_same_number_gives_the_same_designs(method):
    asked = study(method=method, count=150)
    one, two = drawn(asked, 1), drawn(asked, 1)
    assert len(one) == 64
    assert len(drawn(asked, 2)) == 150 - 128
    assert (one["x"] == two["x"]).all()
    assert not np.intersect1d(one["x"], drawn(asked, 0)["x"]).size
    assert one["x"].min() >= -4
    assert one["x"].max() <= 6
    assert (drawn(study(method=method, count=150, seed=2), 1)["x"] != one["x"]).any()


def test_sobol_and_hypercube_fill_their_range_evenly():
    for method in ("sobol", "latin-hypercube"):
        x = drawn(study(method=method, count=64), 0)["x"]
        assert sorted(np.floor((x + 4) / 10 * 64).astype(int)) == list(range(64))


def test_a_grid_holds_each_design_once():
    ranges = {
        "x": {"least": 0, "greatest": 0.3, "step": 0.1},
        "teeth": {"least": 8, "greatest": 12, "step": 2},
        "inner": {"width": {"least": "1 cm", "greatest": 30, "count": 3}},
        "shape": {"values": ["round", "square"]},
    }
    asked = study(method="grid", count=1000, ranges=ranges, batch=7)
    assert asked.count == 4 * 3 * 3 * 2
    found = [
        tuple(row)
        for number in range(asked.batches)
        for row in zip(*(drawn(asked, number)[axis.name].tolist() for axis in asked.axes), strict=True)
    ]
    assert len(set(found)) == len(found) == asked.count
    assert found[0] == (0.0, 8, 10.0, "round")
    assert found[-1] == (0.3, 12, 30.0, "square")
    assert {x for x, *_ in found} == {0.0, 0.1, 0.2, 0.3}


def test_equal_ratios_and_whole_numbers():
    asked = study(
        ranges={"x": {"least": 0.01, "greatest": 1, "log": True}, "teeth": {"least": 8, "greatest": 11}}
    )
    batch = drawn(asked, 0)
    assert np.mean(batch["x"] < 0.1) == pytest.approx(0.5, abs=0.05)
    assert set(batch["teeth"].tolist()) == {8, 9, 10, 11}
    assert isinstance(batch.one(0).teeth, int)


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"ranges": {"y": {"least": 0, "greatest": 1}}}, "study.ranges.y: unknown parameter 'y'"),
        (
            {"ranges": {"x": {"least": 0, "greatest": 11}}},
            "study.ranges.x.greatest: 11.0: input should be less",
        ),
        ({"ranges": {"x": {"least": 1, "greatest": 1}}}, "least has to be smaller"),
        (
            {"ranges": {"x": {"least": math.nan, "greatest": 1}}},
            "ranges.x.least: nan should be a finite number",
        ),
        ({"ranges": {"x": {"values": [1, math.inf]}}}, "ranges.x.values.1: inf should be a finite number"),
        ({"ranges": {"x": {"least": 0}}}, "needs least and greatest, or values"),
        ({"ranges": {"x": {"least": 0, "greatest": 1, "step": 0}}}, "has to be more than 0"),
        ({"ranges": {"x": {"least": -1, "greatest": 1, "log": True}}}, "equal ratios need more than 0"),
        ({"ranges": {"shape": {"least": "a", "greatest": "b"}}}, "give its values"),
        ({"ranges": {}}, "varies at least one parameter"),
        ({"method": "grid"}, "a grid needs a count, a step or values"),
        (
            {"method": "grid", "count": 5, "ranges": {"x": {"least": 0, "greatest": 1, "count": 6}}},
            "the grid has 6 designs and the count is 5",
        ),
        ({"count": 1 << 33}, "Sobol has 4,294,967,296 points"),
        ({"objectives": {"lefft": "least"}}, "unknown column 'lefft'; did you mean 'left'?"),
        ({"objectives": {"left": "small"}}, 'none of "least" and "greatest"'),
        ({"constraints": {"left": {"at_least": 2, "at_most": 1}}}, "nothing is at least 2 and at most 1"),
        ({"constraints": {"left": 3}}, "write { at_least = ... }"),
        ({"constraints": {"lean": {"at_most": "3 kg"}}}, "cannot be read in deg"),
        ({"columns": ["speed"]}, "study.columns: unknown column"),
        ({"refine": 1, "objectives": {}}, "needs objectives"),
        ({"ranges": {"x": {"least": 0, "most": 1}}}, "study.ranges.x: unknown key 'most'"),
        ({"ranges": {"x": 3}}, "study.ranges.x: is 3; write a table [study.ranges.x]"),
        (
            {"method": "random", "count": 10**12},
            "1,000,000,000,000 designs in batches of 64 make 15,625,000,000 tables; at most 262,144",
        ),
        ({"method": "random", "count": (1 << 18) * 5 + 1, "batch": 5}, "make 262,145 tables"),
        ({"method": "random", "count": 1 << 41}, "study.count: "),
        (SHAPES | {"objectives": {"shape": "least"}}, "study.objectives.shape: has no numbers"),
        (SHAPES | {"constraints": {"shape": {"at_least": 1}}}, "study.constraints.shape: has no numbers"),
        ({"batch": 1 << 23}, "study.batch: "),
    ],
)
def test_what_a_study_cannot_ask_for_is_one_line(changed, said):
    with pytest.raises(DesignError) as caught:
        study(**changed)
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)
    assert "\n" not in str(caught.value)
    assert str(caught.value).count("bowl.toml") == 1


def test_a_chain_is_refused_by_name():
    with pytest.raises(DesignError, match=r"^chain.toml: stage: a chain is of no one family[^\n]+by itself$"):
        study_of({"stage": [{"family": "bowl"}], "study": {}}, Path("chain.toml"), OneFamily(BOWL))


def test_a_study_may_have_as_many_tables_as_can_be_listed():
    asked = study(method="random", count=(1 << 18) * 5, batch=5)
    assert asked.batches == 1 << 18


def test_columns_are_those_of_solve_with_angles_in_degrees():
    asked = study(
        ranges={"x": {"least": -4, "greatest": 6}, "tilt": {"least": -90, "greatest": 90}},
        columns=["lean", "swing.greatest"],
        constraints={"lean": {"at_most": "0.5 rad"}},
    )
    assert asked.units == {
        "x": "", "tilt": "deg", "lean": "deg", "left": "mm", "right": "mm", "swing.greatest": "deg",
    }  # fmt: skip
    (bound,) = asked.bounds
    assert bound.high == pytest.approx(math.degrees(0.5))
    batch = drawn(asked, 0)
    found = asked.family.evaluate(batch, asked.measured)
    free = found.forbidden == 0
    assert np.allclose(found.values["lean"][free], batch["tilt"][free])
    assert np.allclose(found.values["left"][free], batch["x"][free] ** 2)
    assert np.allclose(found.values["swing.greatest"][free], np.degrees(np.abs(batch["x"][free])))
    assert found.counts == {"bowl.deep": int((batch["x"] > 3).sum())}
    assert np.isnan(found.values["left"][~free]).all()


def test_what_a_table_refuses_is_forbidden_by_its_key():
    class Picky(BowlParams):
        teeth: int = Field(10, ge=8, le=20, description="A whole number.")

    batch = Batch(Picky, {}, {"x": np.array([0.0, 1.0]), "teeth": np.array([5, 9])})
    found = one_by_one(BOWL.judge, BOWL.solve, batch, ("left",), Stage.PARTS)
    assert [found.codes[code] for code in found.forbidden] == ["parameters.teeth", ""]
    assert (
        one_by_one(
            BOWL.judge, BOWL.solve, Batch(BowlParams, {}, {"x": np.array([5.0])}), (), Stage.MOTION
        ).counts
        == {}
    )
