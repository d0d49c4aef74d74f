"""What the family contract asks of many designs at once: the answers of one design after the other."""

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np
import pytest
from numpy.typing import NDArray
from pydantic import BaseModel
from pydantic.fields import FieldInfo

from mechwright.arrays import Array
from mechwright.contracts.evaluation import Batch, Columns, one_by_one
from mechwright.contracts.family import Family
from mechwright.contracts.finding import Stage
from mechwright.contracts.masses import OF_BODY, WEIGHED, is_mass
from mechwright.contracts.motion import NOTHING
from mechwright.contracts.parameters import Parameters, first_fields
from mechwright.testing.strategies import rules

SAME = 1e-9
"""Part of a figure by which two ways to it may differ: rounding."""

SHARES = (0.05, 0.3, 1.0)
"""How far from an example its parameters are drawn: some designs stay allowed, others are refused."""


class EvaluationTests:
    """Tests of :meth:`Family.evaluate`, for families that have one of their own."""

    family: ClassVar[type[Family[Any]]]
    examples: ClassVar[Sequence[Mapping[str, Any]]]
    studied: ClassVar[Sequence[str]] = ()
    """Parameters that a batch of designs varies, those of tables with dots; by default the numbers that one
    sets first."""
    designs: ClassVar[int] = 9
    """Designs of that batch: each is checked and solved by itself too."""

    def test_evaluate(self) -> None:
        """Many designs at once have the figures and the refusals that each has by itself, at either stage."""
        family = self.family()
        if type(family).evaluate is Family.evaluate:
            pytest.skip("the family evaluates designs one after the other")
        example = dict(self.examples[0])
        every = tuple(family.measures(family.Params.model_validate(example)))
        batch = drawn(family.Params, example, self.studied, self.designs)
        for stage, columns in ((Stage.MOTION, every[:1]), (Stage.PARTS, every)):
            found = family.evaluate(batch, columns, stage)
            assert_same(found, one_by_one(family.judge, family.solve, batch, columns, stage, family.parts))
            assert found.forbidden[0] == 0, "the example itself is forbidden"
            assert found.forbidden[-1], "a number outside of its bounds is not forbidden"


def drawn(model: type[Parameters], table: Mapping[str, Any], names: Sequence[str], count: int) -> Batch[Any]:
    """Designs around one: itself first, then ever farther from it, and one outside of its bounds last."""
    example = model.model_validate(dict(table))
    chosen = names or [name for name in first_fields(model) if _is_number(getattr(example, name))]
    assert chosen, "no number to vary; name parameters in the attribute studied"
    rng = np.random.default_rng(1)
    share = np.array([SHARES[place * len(SHARES) // count] for place in range(count)])
    varied = {name: _around(model, example, name, share * rng.uniform(-1, 1, count)) for name in chosen}
    return Batch(model, dict(table), varied)


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _around(model: type[BaseModel], example: BaseModel, name: str, share: Array) -> NDArray[Any]:
    """Values (n,) of a parameter around that of the example, its own first and one beyond its bounds last."""
    value: Any = example
    *tables, key = name.split(".")
    for step in tables:
        value = getattr(value, step)
        model = type(value)
    own = getattr(value, key)
    low, high = _bounds(model.model_fields[key])
    values = np.clip(own + share * (abs(own) or (high - low) / 10), low, high)
    values[0], values[-1] = own, high + 1 + abs(high)
    return np.asarray(np.round(values).astype(np.int64) if isinstance(own, int) else values)


def _bounds(field: FieldInfo) -> tuple[float, float]:
    rule = rules(field.metadata)
    for inner in getattr(field.annotation, "__args__", ()):
        rule = rules(getattr(inner, "__metadata__", ())) | rule
    return rule.get("ge", rule.get("gt", -np.inf)), rule.get("le", rule.get("lt", np.inf))


def assert_same(one: Columns, two: Columns) -> None:
    """Assert that two ways to evaluate the same designs say the same, but for rounding.

    Masses may differ by ``WEIGHED``.

    >>> some = Columns({"x": np.array([1.0, np.nan])}, np.array([0, 1]), ("", "gear.undercut"))
    >>> assert_same(some, some)
    """
    said = [[columns.codes[number] for number in columns.forbidden] for columns in (one, two)]
    differ = [(place, *codes) for place, codes in enumerate(zip(*said, strict=True)) if codes[0] != codes[1]]
    assert not differ, "design {} is forbidden by {!r}, by itself by {!r}".format(*differ[0])
    assert set(one.values) == set(two.values)
    for name, values in two.values.items():
        size = np.abs(values[np.isfinite(values)]).max(initial=0.0)
        share = WEIGHED if is_mass(name) or name.startswith(OF_BODY) else SAME
        np.testing.assert_allclose(
            one.values[name], values, rtol=share, atol=NOTHING * max(1.0, size), err_msg=name
        )
