"""The test kit for plugins: contracts to subclass, strategies, and comparisons that know tolerances.

A family's own tests begin like this, and pytest does the rest::

    from mechwright.testing import FamilyContract

    class TestScotchYoke(FamilyContract):
        family = ScotchYoke

This package needs pytest and hypothesis, which the ``test`` extra brings; nothing else of Mechwright
imports it.
"""
# ruff: noqa: E402 - the rewriting of assertions has to be asked for before the imports

import pytest

# A failed assertion of a contract shows its values in a plugin's tests as well.
pytest.register_assert_rewrite("mechwright.testing.family")

from mechwright.testing.compare import (
    assert_derivative,
    assert_monotone,
    assert_points_close,
    assert_rotations,
    assert_same_outline,
)
from mechwright.testing.family import FamilyContract
from mechwright.testing.strategies import parameters, tables

__all__ = [
    "FamilyContract",
    "assert_derivative",
    "assert_monotone",
    "assert_points_close",
    "assert_rotations",
    "assert_same_outline",
    "parameters",
    "tables",
]
