"""The findings of a design, from the rules of its family."""

from functools import lru_cache
from typing import Any, Protocol

import numpy as np

from mechwright.contracts.design_rule import RuleError
from mechwright.contracts.design_table import DesignTable
from mechwright.contracts.finding import Finding
from mechwright.contracts.guard import UnsoundError
from mechwright.contracts.parameters import KEPT, Parameters
from mechwright.contracts.rule_list import Rules


class Checked(Protocol):
    """A family whose findings come from rules."""

    def __hash__(self) -> int: ...

    def rules(self) -> Rules[Any]:
        """The rules."""
        ...

    def table(self, params: Any, size: int | None = None) -> DesignTable[Any]:
        """What they are asked of."""
        ...

    def remedy(self, params: Any, finding: Finding) -> Finding:
        """A finding with the remedy that takes long to find."""
        ...


def findings_of(family: Checked, params: Parameters, *, quick: bool) -> tuple[Finding, ...]:
    """Give what the rules of a family find of a design, ``quick`` without what takes long to find.

    Raises
    ------
    UnsoundError
        A rule whose value is no number.
    """
    return (_kept if _has_hash(params) else _found)(family, params, quick)


def _found(family: Checked, params: Parameters, quick: bool) -> tuple[Finding, ...]:
    try:
        with np.errstate(all="ignore"):
            rules = family.rules()
            if not isinstance(rules, Rules):
                raise UnsoundError(
                    f"rules() gives {type(rules).__name__}; rules are wanted, as in_turn and all_of give"
                )
            found = rules.findings(family.table(params), quick=quick)
    except RuleError as error:
        raise UnsoundError(str(error)) from error
    return tuple(found if quick else (family.remedy(params, one) for one in found))


_kept = lru_cache(KEPT)(_found)


def _has_hash(params: Parameters) -> bool:
    """Whether a table can be kept: one with a list in it has no hash."""
    try:
        hash(params)
    except TypeError:
        return False
    return True
