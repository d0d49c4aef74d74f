"""A family whose findings come from a method, for tests that say what is found."""

from collections.abc import Iterable
from typing import Any, TypeVar

from mechwright import DesignTable, Family, Finding, Parameters, Procedure, all_of
from mechwright.contracts.rule_list import Rules

P = TypeVar("P", bound=Parameters)


class Procedural(Family[P]):
    """Its rules are one procedure: ``found`` of all, ``found_fast`` for the quick judge."""

    def found(self, params: P) -> Iterable[Finding]:
        """Findings of a design."""
        raise NotImplementedError

    def found_fast(self, params: P) -> Iterable[Finding]:
        """Those that are found fast."""
        return self.found(params)

    def rules(self) -> Rules[Any]:
        """Both."""
        kind = Procedure[DesignTable[P]]
        return all_of(
            kind((), lambda t: self.found_fast(t.params), quickly=True),
            kind((), lambda t: self.found(t.params), slow=True),
        )
