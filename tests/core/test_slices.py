"""A batch that is evaluated in slices gives what it gives at once, bit for bit, and nothing is evaluated twice."""

from collections import Counter
from typing import Any

import numpy as np
import pytest
from bowl_family import BOWL, BowlParams
from test_by_arrays import KindParams, KindWedge, Wedge, WedgeParams

from mechwright.contracts.evaluation import Batch
from mechwright.contracts.family import Family
from mechwright.contracts.finding import Stage
from mechwright.contracts.singly import singles_of
from mechwright.contracts.slices import Answered, Slices, Work

NOW = 1e-9
"""A time that is over: what is begun at all is one piece."""

RISE = np.append(np.random.default_rng(1).uniform(-1, 11, 300), [4.0, 2.0])
COUNTS = np.arange(300) // 2 % 4 + 1
KINDS = np.array(["steep", "any"])[np.arange(300) % 2]
CASES = {
    "by default": (BOWL, BowlParams, {}, {"x": np.linspace(-12, 6, 90)}, ["left", "swing.least"]),
    "by arrays": (Wedge(), WedgeParams, {"run": 5}, {"rise": RISE}, ["slope", "y.greatest"]),
    "columns left out": (Wedge(), WedgeParams, {"run": 5}, {"rise": RISE}, ["slope", "x.least"]),
    "kinds": (
        KindWedge(),
        KindParams,
        {"run": 5},
        {"rise": np.linspace(1.01, 3.99, 300), "kind": KINDS, "count": COUNTS},
        ["slope", "count"],
    ),
}


def evaluated(family: Family[Any], batch: Batch[Any], columns: list[str], seed: int) -> tuple[Any, Work]:
    """What comes of slices whose order and size are random, and the work that was done."""
    rng, known, slices = np.random.default_rng(seed), Work(), batch.slices
    assert slices is not None
    seen: Counter[object] = Counter()
    while True:
        slices.begin(known, 0.0)
        found = family.evaluate(batch, columns, Stage.PARTS)
        assert not slices.fresh, "nothing is evaluated where nothing may be"
        if slices.complete:
            assert max(seen.values()) == 1
            return found, known
        chunks, left = list(slices.chunks), dict(slices.left)
        if rng.random() < 0.3:  # from the beginning, until it is late
            slices.begin(known, NOW)
            family.evaluate(batch, columns, Stage.PARTS)
            seen.update(list(slices.fresh.answers))
            for question, one in slices.fresh.singles.items():
                seen.update((question, place) for place in one.places.tolist())
            known.update(slices.fresh)
            said = {question: sorted(some.tolist()) for question, some in slices.left.items()}
            slices.begin(known, 0.0)
            family.evaluate(batch, columns, Stage.PARTS)
            assert said == {question: sorted(some.tolist()) for question, some in slices.left.items()}
        elif chunks and (not left or rng.random() < 0.5):
            slices.begin(
                Work(),
                np.inf,
                frozenset(
                    chunks[n] for n in rng.permutation(len(chunks))[: rng.integers(1, len(chunks) + 1)]
                ),
            )
            family.evaluate(batch, columns, Stage.PARTS)
            seen.update(list(slices.fresh.answers))
            known.update(slices.fresh)
        else:
            question, places = list(left.items())[rng.integers(len(left))]
            some = np.sort(rng.permutation(places)[: rng.integers(1, places.size + 1)])
            until = np.inf if rng.random() < 0.5 else NOW
            single = singles_of(family, question, batch, Stage.PARTS, some, until)
            assert single.places.tolist() == some[: 1 if until == NOW else None].tolist()
            seen.update((question, place) for place in single.places.tolist())
            known.add(question, single)


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("case", CASES.values(), ids=CASES)
def test_slices_give_the_bits_of_the_whole(case: Any, seed: int) -> None:
    family, model, content, varied, columns = case
    whole = family.evaluate(Batch(model, content, varied), columns, Stage.PARTS)
    found, _ = evaluated(family, Batch(model, content, varied, Slices()), columns, seed)
    codes = [np.array(one.codes, dtype=object)[one.forbidden].tolist() for one in (whole, found)]
    assert codes[0] == codes[1]
    for name in columns:
        assert whole.values[name].tobytes() == found.values[name].tobytes()


def test_a_survey_evaluates_one_piece_at_least_and_says_the_rest() -> None:
    family, model, content, varied, columns = CASES["by arrays"]
    batch = Batch(model, content, varied, slices := Slices())
    slices.begin(Work(), NOW)
    family.evaluate(batch, columns, Stage.PARTS)
    assert len(slices.fresh.answers) == 1
    assert not slices.fresh.singles
    allowed = int(((RISE >= 0) & (RISE <= 10)).sum())
    assert slices.chunks == list(range(64, allowed, 64))


def test_answers_of_other_designs_are_not_taken() -> None:
    family, model, content, varied, columns = CASES["by arrays"]
    whole = family.evaluate(Batch(model, content, varied), columns, Stage.PARTS)
    batch = Batch(model, content, varied, Slices())
    _, known = evaluated(family, batch, columns, 0)
    wrong = {key: Answered(one.places[::-1], one.answer) for key, one in known.answers.items()}
    assert batch.slices is not None
    batch.slices.begin(Work(wrong, known.singles), np.inf)
    found = family.evaluate(batch, columns, Stage.PARTS)
    assert whole.values["slope"].tobytes() == found.values["slope"].tobytes()
