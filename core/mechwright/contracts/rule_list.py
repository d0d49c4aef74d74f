"""The rules of a family in their order: what they say of one design, and which designs of a table they allow.

Glossary
--------
all of
    Rules that are all asked.
in turn
    Rules of which each is asked if none before it found an error.
by design
    Rules that are asked of one design of a table after the other: all of them of each.
one by one
    Designs for which the later rules, and the figures, have no formula over a table.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from mechwright.contracts.design_rule import DesignRule, RuleLike
from mechwright.contracts.design_table import DesignTable
from mechwright.contracts.finding import Finding, Severity, Stage, errors
from mechwright.contracts.procedure import Procedure

D = TypeVar("D", bound=DesignTable[Any])


@dataclass(frozen=True)
class OneByOne(Generic[D]):
    """Takes designs out of a table for which no later formula holds: each is checked and solved by itself.

    Parameters
    ----------
    when
        Which designs, a truth value or a column.
    stage
        The earliest stage of the later rules that lack a formula.
    """

    when: Callable[[D], Any]
    stage: Stage = Stage.MOTION
    codes: tuple[str, ...] = ()

    def forbids(self, table: D, stage: Stage) -> None:
        """Give None: it forbids nothing."""

    def findings(self, m: D, *, quick: bool) -> Iterator[Finding]:  # noqa: ARG002 - it says nothing
        """Give nothing."""
        return iter(())

    def asked(self, table: D, stage: Stage) -> NDArray[np.bool_]:
        """Give which designs (n,) these are."""
        which = not self.stage.is_after(stage) and self.when(table)
        return np.broadcast_to(np.ravel(np.asarray(which, bool)), (table.size,))


@dataclass(frozen=True)
class Rules(Generic[D]):
    """Rules in the order in which they are asked.

    Parameters
    ----------
    every
        Rules, and lists of rules.
    turns
        Whether each is asked only if none before it found an error; else all are.
    when
        Whether they are asked at all, by what the designs of a table have in common.
    singly
        The earliest stage of what they find, if they are asked of one design of a table after the other: what
        takes long to compute is then in memory for one design at once.
    """

    every: Sequence["RuleLike[D] | Rules[D]"]
    turns: bool
    when: Callable[[D], bool] | None = None
    singly: Stage | None = None

    def of(self, table: D) -> "Iterator[RuleLike[D]]":
        """Give the rules that are asked of a table, in order."""
        if self.when is not None and not self.when(table):
            return
        if self.singly is not None:
            yield from (_Verdict(self, code, self.singly) for code in self.codes)
            return
        for one in self.every:
            if isinstance(one, Rules):
                yield from one.of(table)
                continue
            if isinstance(one, DesignRule) and (surely := one.surely) is not None:
                yield surely
            yield one

    @property
    def codes(self) -> tuple[str, ...]:
        """Codes of what they find, each once."""
        return tuple(dict.fromkeys(code for one in self.every for code in one.codes))

    def findings(self, m: D, *, quick: bool = False) -> list[Finding]:
        """Give what there is to say of one design, in order."""
        found: list[Finding] = []
        if self.when is not None and not self.when(m):
            return found
        for one in self.every:
            found += one.findings(m, quick=quick)
            if self.turns and any(finding.severity is Severity.ERROR for finding in found):
                break
        return found

    def allowed(
        self,
        table: D,
        stage: Stage,
        forbid: Callable[[str, NDArray[np.intp]], None],
        fail: Callable[[str, int, Exception], None] | None = None,
        leave: Callable[[NDArray[np.intp]], None] | None = None,
    ) -> tuple[D, NDArray[np.intp]]:
        """Sort out the designs of a table that have an error of a stage or an earlier one.

        Parameters
        ----------
        table
            The designs.
        stage
            Up to which errors count.
        forbid
            Takes the code of an error, and the places (k,) of the designs that it forbids first.
        fail
            Takes the code of a rule, the place of a design for which its formulas fail, and what they raise;
            without it they raise.
        leave
            Takes the places (k,) of designs that are asked one by one; without it they stay in the table.

        Returns
        -------
        table, places
            The designs that nothing forbids, with what has been computed of them, and their places.
        """
        places = np.arange(table.size)
        for rule in self.of(table):
            if not places.size:
                break
            if isinstance(rule, OneByOne):
                if leave is not None and (alone := rule.asked(table, stage)).any():
                    leave(places[alone])
                    places, table = places[~alone], table.rows(np.flatnonzero(~alone))
                continue
            try:
                wrong = rule.forbids(table, stage)
            except Exception as error:
                if fail is None or isinstance(error, MemoryError):
                    raise
                wrong, failed = _one_by_one(rule, table, stage, error)
                for place, reason in failed.items():
                    fail(next(iter(rule.codes), "procedure"), int(places[place]), reason)
                sound = np.array([place for place in range(table.size) if place not in failed], np.intp)
                places, table, wrong = places[sound], table.rows(sound), wrong[sound]
            if wrong is None or not wrong.any():
                continue
            if isinstance(rule, Procedure):
                for code, which in rule.forbidding(table, wrong, stage):
                    forbid(code, places[which])
            else:
                forbid(rule.codes[0], places[wrong])
            left = np.flatnonzero(~wrong)
            places, table = places[left], table.rows(left)
        return table, places


@dataclass(frozen=True)
class _Verdict(Generic[D]):
    """The designs in which one code is the first error of rules that are asked by design."""

    rules: Rules[D]
    code: str
    earliest: Stage

    @property
    def codes(self) -> Sequence[str]:
        return (self.code,)

    def forbids(self, table: D, stage: Stage) -> NDArray[np.bool_] | None:
        """Give the designs (n,); all rules are asked once of each."""
        if self.earliest.is_after(stage):
            return None
        name = "first error", id(self.rules), stage
        return np.asarray(table.once(name, lambda: self._first(table, stage))[:, 0] == self.code)

    def _first(self, table: D, stage: Stage) -> NDArray[np.object_]:
        found = (self.rules.findings(table.row(place), quick=True) for place in range(table.size))
        stopping = ([one.code for one in errors(some, stage)] for some in found)
        return np.array([next(iter(some), "") for some in stopping], object)[:, None]

    def findings(self, m: D, *, quick: bool) -> Iterator[Finding]:
        """Give those of its code."""
        yield from (one for one in self.rules.findings(m, quick=quick) if one.code == self.code)


def _one_by_one(
    rule: RuleLike[D], table: D, stage: Stage, error: Exception
) -> tuple[NDArray[np.bool_], dict[int, Exception]]:
    """Which designs (n,) a rule forbids, and the places at which it raises, found by halving the table."""
    if table.size == 1:
        return np.zeros(1, bool), {0: error}
    wrong = np.zeros(table.size, bool)
    failed: dict[int, Exception] = {}
    for half in np.array_split(np.arange(table.size), 2):
        some = table.rows(half)
        try:
            found = rule.forbids(some, stage)
            reasons: dict[int, Exception] = {}
        except Exception as reason:  # whatever a formula raises
            found, reasons = _one_by_one(rule, some, stage, reason)
        if found is not None:
            wrong[half] = found
        failed |= {int(half[place]): one for place, one in reasons.items()}
    return wrong, failed


def all_of(*rules: "RuleLike[D] | Rules[D]", when: Callable[[D], bool] | None = None) -> Rules[D]:
    """Rules that are all asked."""
    return Rules(rules, turns=False, when=when)


def in_turn(*rules: "RuleLike[D] | Rules[D]", when: Callable[[D], bool] | None = None) -> Rules[D]:
    """Rules of which each is asked only if none before it found an error."""
    return Rules(rules, turns=True, when=when)


def by_design(*rules: "RuleLike[D] | Rules[D]", stage: Stage = Stage.MOTION) -> Rules[D]:
    """Rules in turn, all asked of one design after the other; ``stage`` is the earliest of what they find."""
    return Rules(rules, turns=True, singly=stage)
