"""Many designs by arrays: what tables refuse, and answers that leave some designs to the slow way."""

import warnings
from typing import Annotated, ClassVar, Literal, Self

import numpy as np
import pytest
from pydantic import AfterValidator, Field, ValidationError, model_validator

from mechwright import (
    Channel,
    DesignRule,
    DesignTable,
    Family,
    Figure,
    KinematicsError,
    Motion,
    Parameters,
    Scalar,
    Stage,
    in_turn,
)
from mechwright.contracts.evaluation import PARAMETERS, Batch, one_by_one
from mechwright.contracts.refusals import refusals
from mechwright.contracts.rule_list import OneByOne
from mechwright.contracts.stand_in import Asked, StandIn
from mechwright.testing import FamilyContract
from mechwright.testing.evaluation import assert_same
from mechwright.units import Millimetres, Ratio, Unit

RANDOM = np.random.default_rng(1)


class Inner(Parameters):
    low: Millimetres = Field(1.0, ge=0, le=50, description="One end.")
    high: Millimetres = Field(20.0, gt=0, lt=50, description="Other end.")

    @model_validator(mode="after")
    def _ordered(self) -> Self:
        if self.low >= self.high:
            raise ValueError("low has to be below high")
        return self


class Table(Parameters):
    first: Millimetres = Field(3.0, ge=1, le=10, description="A length.")
    inner: Inner = Field(Inner(), description="A table.")
    teeth: int = Field(10, ge=5, le=20, description="A whole number.")
    end: Annotated[float, Field(ge=-5, le=5), Unit("deg")] | None = Field(None, description="An angle.")
    ratio: Ratio = Field(1.0, ge=0, le=2, description="A number.")
    shape: Literal["round", "square"] = Field("round", description="A name.")
    sense: Literal[1, -1] = Field(1, description="A way.")
    hollow: bool = Field(False, description="Whether it is hollow.")

    @model_validator(mode="after")
    def _together(self) -> Self:
        if self.shape == "square" and self.end is not None:
            raise ValueError("end is for what is round")
        return self

    @model_validator(mode="after")
    def _hollow(self) -> Self:
        if self.hollow and self.inner.low < 2:
            raise ValueError("inner.low is too small for a hollow one")
        return self


def some(low, high, count=200):
    return RANDOM.uniform(low, high, count)


def by_itself(batch):
    said = []
    for place in range(len(batch)):
        try:
            batch.one(place)
            said.append("")
        except ValidationError as error:
            said.append(".".join([PARAMETERS, *map(str, error.errors()[0]["loc"])]))
    return said


@pytest.mark.parametrize(
    ("content", "varied"),
    [
        ({}, {"ratio": some(-1, 3), "first": some(0, 11), "teeth": RANDOM.integers(3, 23, 200)}),
        ({}, {"teeth": np.round(some(4, 8), 1), "end": some(-6, 6)}),
        ({"shape": "square"}, {"end": np.append(some(-6, 6), np.nan), "first": some(0, 11, 201)}),
        ({}, {"sense": RANDOM.integers(-2, 3, 200), "first": some(0, 11)}),
        ({}, {"shape": RANDOM.choice(["round", "square", "oval"], 200), "first": some(0, 11)}),
        ({}, {"first": RANDOM.choice(["2 mm", "2 cm", "0.1 in", "3 kg"], 200), "ratio": some(-1, 3)}),
        ({}, {"inner.low": some(-1, 51), "inner.high": some(-1, 51), "teeth": RANDOM.integers(3, 23, 200)}),
        ({}, {"inner.low": some(-1, 30), "first": some(0, 11), "ratio": some(-1, 3)}),
        ({"hollow": True}, {"inner.low": some(0, 9), "first": some(0, 11)}),
        ({"inner": {"low": 4}}, {"hollow": some(0, 1) > 0.5, "first": some(0, 11)}),
    ],
)
def test_tables_are_refused_as_one_by_one(content, varied):
    batch = Batch(Table, content, varied)
    told = refusals(batch)
    said = by_itself(batch)
    if any(not code for code in said):
        assert told.known.all()
        assert {""} < set(said)
    assert [c for c, k in zip(said, told.known, strict=True) if k] == [
        told.codes[n] for n, k in zip(told.forbidden, told.known, strict=True) if k
    ]
    for place in np.flatnonzero(told.known & (told.forbidden == 0))[:20]:
        one = batch.one(place)
        for name, values in told.values.items():
            value = one
            for step in name.split("."):
                value = getattr(value, step)
            assert values[place] == value


def test_what_is_not_known_is_left_to_the_table():
    class Strange(Parameters):
        even: Annotated[int, AfterValidator(lambda value: value + value % 2)] = Field(2, ge=0, le=9)
        first: float = Field(2.0, ge=0, le=9)

    class Completed(Parameters):
        first: float = Field(2.0, ge=0, le=9)
        second: float | None = Field(None, ge=0, le=9)

        @model_validator(mode="after")
        def _complete(self) -> Self:
            return self if self.second is not None else self.model_copy(update={"second": 2 * self.first})

    whole = np.arange(4)
    assert not refusals(Batch(Strange, {}, {"even": whole})).known.any()
    assert refusals(Batch(Strange, {}, {"first": whole})).known.all()
    with warnings.catch_warnings(action="ignore"):  # pydantic takes a completed copy in a nested table alone
        assert not refusals(Batch(Completed, {}, {"first": whole})).known.any()
    assert not refusals(Batch(Table, {"first": -1}, {"ratio": some(0, 1)})).known.any()
    assert not refusals(Batch(Table, {"strange": 1}, {"ratio": some(0, 1)})).known.any()


def test_a_stand_in_tells_what_is_alike_and_asks_for_the_rest():
    stand_in = StandIn(Table(), frozenset({"first", "inner.low"}))
    assert isinstance(stand_in, Table)
    assert stand_in.first is not None
    assert (stand_in.teeth, stand_in.inner.high) == (10, 20.0)
    for ask in (
        lambda: stand_in.first > 2,
        lambda: f"{stand_in.first:g}",
        lambda: isinstance(stand_in.first, float),
        lambda: stand_in.inner.low + 1,
        lambda: stand_in.inner == Inner(),
        lambda: stand_in.model_dump(),
        lambda: np.sqrt(stand_in.first),
    ):
        with pytest.raises(Asked):
            ask()


class WedgeParams(Parameters):
    """A wedge."""

    rise: Millimetres = Field(2.0, ge=0, le=10, description="A length.")
    run: Millimetres = Field(5.0, ge=1, le=10, description="A length.")


Wedges = DesignTable[WedgeParams]
STEEP = DesignRule[Wedges](
    "wedge.steep",
    "rise",
    "is too steep",
    value=lambda t: np.asarray(t.params.rise),
    limit=lambda t: 2 * np.asarray(t.params.run),
    must_be="at most",
    stage=Stage.MOTION,
)
FLAT = DesignRule[Wedges](
    "wedge.flat", "rise", "is too flat", value=lambda t: np.asarray(t.params.rise), limit=1
)
ALONE = OneByOne[Wedges](lambda t: (np.asarray(t.params.rise) > 9) | (np.asarray(t.params.rise) == 4))


class Wedge(Family[WedgeParams]):
    name, title, summary = "wedge", "Wedge", "A closed form."
    Params = WedgeParams
    batch = 64
    solved: ClassVar[list[float]] = []

    def rules(self):
        return in_turn(STEEP, FLAT, ALONE)

    def solve(self, params, samples):
        self.solved.append(params.rise)
        if params.rise == 4:
            raise KinematicsError("rise: jams at 4; take another")
        x = np.linspace(0, params.run, samples)
        return Motion(
            "x",
            {"x": Channel(x, "mm"), "y": Channel(params.rise / params.run * x, "mm")},
            scalars={"slope": Scalar(np.arctan2(params.rise, params.run), "rad")},
        )

    def parts(self, params):
        return ()

    def figures(self, table):
        slope = lambda: np.arctan2(table.params.rise, table.params.run)  # noqa: E731 - what a figure takes
        return {"slope": Figure(slope, "rad")}

    def extremes(self, table, names):
        rise = np.asarray(table.params.rise, float).ravel()
        return {"y": (0 * rise, rise, "mm")}


def by_themselves(family, batch, columns, stage=Stage.PARTS):
    return one_by_one(family.judge, family.solve, batch, columns, stage)


@pytest.mark.parametrize("stage", [Stage.MOTION, Stage.PARTS])
def test_what_is_undecided_is_asked_by_itself(stage):
    rise = np.append(some(-1, 11, 300), [4.0, 2.0])
    batch = Batch(WedgeParams, {"run": 5}, {"rise": rise})
    Wedge.solved.clear()
    found = Wedge().evaluate(batch, ["slope", "y.greatest"], stage)
    assert sorted(Wedge.solved) == sorted(rise[((rise > 9) & (rise <= 10)) | (rise == 4)])
    assert_same(found, by_themselves(Wedge(), batch, ["slope", "y.greatest"], stage))
    assert {"parameters.rise", "motion"} <= set(found.counts)


def test_what_has_no_formula_goes_one_by_one():
    for content, varied, columns in (
        ({}, {"run": some(1, 11)}, ["slope", "x.greatest"]),
        ({}, {"rise": np.append(some(0, 11), [4.0, 2.0])}, ["slope", "x.least"]),
        ({"run": -1}, {"rise": some(0, 11)}, ["slope"]),
    ):
        batch = Batch(WedgeParams, content, varied)
        found = Wedge().evaluate(batch, columns)
        assert_same(found, by_themselves(Wedge(), batch, columns))


class KindParams(WedgeParams):
    """A wedge of some kind."""

    kind: Literal["steep", "any"] = Field("any", description="A name.")
    count: int = Field(1, ge=1, le=99, description="A whole number.")


class KindWedge(Wedge):
    name, Params = "kind-wedge", KindParams

    def rules(self):
        return in_turn(STEEP, OneByOne(lambda t: t.params.kind == "steep"), FLAT)

    def figures(self, table):
        return super().figures(table) | {"count": Figure(lambda: 1.0 * table.params.count, "")}

    def solve(self, params, samples):
        found = super().solve(params, samples)
        found.scalars["count"] = Scalar(params.count, "")
        return found


@pytest.mark.parametrize(
    ("kinds", "counts", "fast"), [(["steep", "any"], 4, 0.5), (["any"], 4, 1.0), (["any"], 99, 1.0)]
)
def test_texts_and_whole_numbers_are_answered_kind_by_kind(kinds, counts, fast):
    varied = {
        "rise": some(1.01, 3.99, 300),
        "kind": np.array(kinds)[np.arange(300) % len(kinds)],
        "count": np.arange(300) // 2 % counts + 1,
    }
    batch = Batch(KindParams, {"run": 5}, varied)
    Wedge.solved.clear()
    found = KindWedge().evaluate(batch, ["slope", "count"], Stage.PARTS)
    assert len(Wedge.solved) == 300 * (1 - fast)
    assert_same(found, by_themselves(KindWedge(), batch, ["slope", "count"]))


class WrongWedge(Wedge):
    def figures(self, table):
        slope = lambda: np.arctan2(table.params.rise, table.params.run) * (1 + 1e-8)  # noqa: E731
        return {"slope": Figure(slope, "rad")}


class StrictWedge(Wedge):
    def rules(self):
        return in_turn(STEEP, FLAT.but(best=lambda t: 0 * np.asarray(t.params.rise)), ALONE)


def test_the_contract_finds_other_figures_and_other_refusals():
    def contract(kind):
        tests = FamilyContract()
        type(tests).__test__ = False
        tests.family, tests.designs = kind, 30
        return tests

    contract(Wedge).test_evaluate()
    with pytest.raises(AssertionError, match="slope"):
        contract(WrongWedge).test_evaluate()
    with pytest.raises(AssertionError, match=r"wedge\.flat"):
        contract(StrictWedge).test_evaluate()


class Sized(Parameters):
    """A table whose size replaces another's default."""

    module: float | None = Field(None, ge=1, le=5, description="A number.")
    radius: float | None = Field(50.0, ge=1, le=99, description="Another.")
    kind: str = Field("round", description="A name.")

    @model_validator(mode="before")
    @classmethod
    def _replaces(cls, table):
        return (
            {**table, "radius": None} if table.get("module") is not None and "radius" not in table else table
        )

    @model_validator(mode="after")
    def _one(self):
        if (self.module is None) == (self.radius is None):
            raise ValueError("give one of both")
        if self.kind == "flat":
            raise ValueError("no such kind")
        return self


@pytest.mark.parametrize("content", [{}, {"module": 2.0}, {"module": 2.0, "radius": None}, {"radius": 9.0}])
@pytest.mark.parametrize("name", ["module", "radius"])
def test_rules_that_complete_a_table_are_followed_where_they_see_no_value(content, name):
    kinds = np.array(["round", "flat", "oval", "round"])
    batch = Batch(Sized, content, {name: np.array([2.0, 3.0, 4.0, 200.0]), "kind": kinds})
    told = refusals(batch)
    for place in range(4):
        try:
            table = batch.one(place)
        except ValidationError as error:
            key = ".".join(map(str, error.errors()[0]["loc"]))
            code = f"parameters.{key}" if key else "parameters"
        else:
            code = ""
            assert not told.known[place] or {n: v for n, v in table if n not in batch.varied} == {
                n: v for n, v in told.common if n not in batch.varied
            }
        assert not told.known[place] or told.codes[told.forbidden[place]] == code
    assert told.known.all() or name == "radius" or "radius" in content
