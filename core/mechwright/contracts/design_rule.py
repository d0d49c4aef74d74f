"""Rules of a design: what an engineer objects to, each declared once, over one design or a table of many.

A family lists its rules in the order in which they are asked. From the list come the findings of ``check``,
the quick judge that remedies ask, what forbids each design of a study, the limits inside of a synthesis, and
the table of rules in the documentation::

    Rule = DesignRule[YokeTable]

    RULES = in_turn(
        all_of(
            Rule(
                "scotch-yoke.wall",
                "slot_length",
                "the slot leaves a wall of {value:.3f} mm; {limit:g} mm are needed",
                value=lambda t: t.params.yoke_length / 2 - t.params.crank,
                limit=LEAST_WALL,
                unit="mm",
                remedy="make yoke_length at least {m.params.crank:g}",
            ),
        ),
    )

Glossary
--------
value, limit
    Numbers or columns (n, 1) of a table; (n, k) of a rule that is asked of k items of each design, such as
    pins or pairs.
best, worst
    Columns that the value does not pass, found cheaply: rows that they decide need no value.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any, Generic, Literal, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from mechwright.contracts.design_table import DesignTable
from mechwright.contracts.finding import Change, Finding, Severity, Stage
from mechwright.tolerances import exceeds, falls_short

D = TypeVar("D", bound=DesignTable[Any])
E = TypeVar("E", bound=DesignTable[Any], contravariant=True)
Bools = NDArray[np.bool_]


Comparison = Literal["at least", "at most", "above", "below"]
"""What a value must be of its limit; one that reaches it, but for rounding, is at least and at most it, and
neither above nor below it.
"""


@dataclass(frozen=True)
class Failure(Generic[D]):
    """One design that breaks a rule; words are made of it.

    Parameters
    ----------
    m
        The design.
    value, limit
        Those of the rule.
    item
        Which item breaks it, from 0.
    """

    m: D
    value: float
    limit: float
    item: int = 0


Text = str | Callable[[Failure[D]], str]
"""Words; a text is filled in with the fields of the :class:`Failure`, as ``"{value:.3f} of {m.axes}"``."""


class RuleLike(Protocol[E]):
    """What a list of rules consists of."""

    @property
    def codes(self) -> Sequence[str]:
        """Codes of what it finds."""
        ...

    def forbids(self, table: E, stage: Stage) -> Bools | None:
        """Which designs (n,) of a table have an error of a stage or an earlier one; None for none at all."""
        ...

    def findings(self, m: E, *, quick: bool) -> Iterator[Finding]:
        """What there is to say of one design; ``quick`` without remedies that take long to find."""
        ...


@dataclass(frozen=True)
class DesignRule(Generic[D]):
    """What must hold of a design.

    Parameters
    ----------
    code
        Of the finding.
    parameter
        The key of the design file that it is about.
    message
        One sentence that says what was found.
    value, limit
        What is compared: formulas of the table, or a number.
    unit
        Of both.
    remedy
        What to do.
    must_be
        What the value must be of the limit.
    stage, severity
        Of the finding.
    when
        Which designs are asked, a truth value or a column; elsewhere the value may be no number.
    reported
        The value and limit that the finding says, where they are not those that are compared.
    proposed
        Changes that should help.
    best, worst
        What the value is at best and at worst, found cheaply: rows that this decides need no value.
    each
        Whether each item that fails is a finding; else the first.
    slow
        Whether its value, or its remedy, takes long to find: ``"value"``, ``"remedy"``. The quick judge does
        not ask for it.
    """

    code: str
    parameter: Text[D]
    message: Text[D]
    value: Callable[[D], Any]
    limit: "Callable[[D], Any] | float"
    unit: Text[D] = ""
    remedy: Text[D] = ""
    must_be: Comparison = "at least"
    stage: Stage = Stage.PARTS
    severity: Severity = Severity.ERROR
    when: Callable[[D], Any] | None = None
    reported: "Callable[[Failure[D]], tuple[float | None, float | None]] | None" = None
    proposed: Callable[[Failure[D]], Iterable[Change]] | None = None
    best: Callable[[D], Any] | None = None
    worst: Callable[[D], Any] | None = None
    each: bool = True
    slow: str = ""

    def but(self, **changes: Any) -> "DesignRule[D]":
        """The same rule with other fields: a warning for an error, another stage."""
        return replace(self, **changes)

    @property
    def codes(self) -> Sequence[str]:
        """Its code."""
        return (self.code,)

    def forbids(self, table: D, stage: Stage) -> Bools | None:
        """Give the designs (n,) that break it; see :class:`RuleLike`."""
        if self.severity is not Severity.ERROR or self.stage.is_after(stage) or self.slow == "value":
            return None
        asked = truth_of(True if self.when is None else self.when(table), table.size)
        if not asked.any():
            return None
        if asked.all():
            return self._fails(table)
        wrong, places = np.zeros(table.size, bool), np.flatnonzero(asked)
        wrong[places] = self._fails(table.rows(places))
        return wrong

    @property
    def surely(self) -> "DesignRule[D] | None":
        """The same rule of what the value is at best, which a table is asked before; None without that."""
        return None if self.best is None else self.but(value=self.best, best=None, worst=None)

    def _fails(self, table: D) -> Bools:
        """Give the designs (n,) that break it, of those that are asked."""
        if self.worst is None:
            return self._compared(table)
        doubt = truth_of(_breaks(self.must_be, self.worst(table), self._limit(table)), table.size)
        if doubt.all():
            return self._compared(table)
        wrong, unsure = np.zeros(table.size, bool), np.flatnonzero(doubt)
        if unsure.size:
            wrong[unsure] = self._compared(table.rows(unsure))
        return wrong

    def _compared(self, table: D) -> Bools:
        value = np.asarray(self.value(table), dtype=float)
        if np.isnan(value).any():
            raise RuleError(self.code, value, table)
        return truth_of(_breaks(self.must_be, value, self._limit(table)), table.size)

    def _limit(self, table: D) -> Any:
        return self.limit(table) if callable(self.limit) else self.limit

    def findings(self, m: D, *, quick: bool) -> Iterator[Finding]:
        """Give what breaks it of one design; see :class:`RuleLike`."""
        if not (quick and self.slow == "value"):
            yield from (self._finding(failure, quick) for failure in self.failures(m))

    def failures(self, m: D) -> Iterator[Failure[D]]:
        """Give the items of one design that break it, or the first of them."""
        if self.when is not None and not np.any(self.when(m)):
            return
        if self.worst is not None and not self._fails(m).any():
            return
        value, limit = self.value(m), self._limit(m)
        if np.isnan(value).any():
            raise RuleError(self.code, value, m)
        wrong = np.asarray(_breaks(self.must_be, value, limit))
        if not wrong.any():
            return
        values, limits = (np.broadcast_to(one, wrong.shape).ravel() for one in (value, limit))
        for item in np.flatnonzero(wrong.ravel()).tolist():
            yield Failure(m, values[item].item(), float(limits[item]), item)
            if not self.each:
                return

    def allows(self, m: D) -> bool:
        """Give whether one design keeps it; one for which its value is no number does not."""
        try:
            return next(self.failures(m), None) is None
        except RuleError:
            return False

    def _finding(self, failure: Failure[D], quick: bool) -> Finding:
        value, limit = (failure.value, failure.limit) if self.reported is None else self.reported(failure)
        advises = not quick or self.slow != "remedy"
        return Finding(
            self.code,
            self.severity,
            _filled(self.parameter, failure),
            _filled(self.message, failure),
            value,
            limit,
            _filled(self.unit, failure),
            _filled(self.remedy, failure) if advises else "",
            self.stage,
            tuple(self.proposed(failure)) if self.proposed is not None and advises else (),
        )


def no_figures(failure: Failure[Any]) -> tuple[None, None]:  # noqa: ARG001 - the same of every failure
    """Give no value and no limit: ``reported`` of a rule that compares nothing that people measure."""
    return None, None


class RuleError(Exception):
    """A rule whose value is no number.

    Parameters
    ----------
    code
        Of the rule.
    value
        Its values (n, k).
    table
        The designs.
    """

    def __init__(self, code: str, value: Any, table: DesignTable[Any]) -> None:
        bad = np.isnan(np.asarray(value, dtype=float)).reshape(table.size, -1).any(axis=1)
        self.code, self.places = code, np.flatnonzero(bad)
        super().__init__(f"rule {code}: its value is no number")


def _breaks(must_be: Comparison, value: Any, limit: Any) -> Any:
    """Whether values are not what they must be of limits, element by element; what is no number is not."""
    if must_be == "at least":
        return falls_short(value, limit)
    if must_be == "at most":
        return exceeds(value, limit)
    return ~np.asarray(value > limit) if must_be == "above" else ~np.asarray(value < limit)


def truth_of(value: Any, size: int) -> Bools:
    """Give truth values (n,) of what may be one for all, a column, or items (n, k) of which any counts."""
    array: Bools = np.asarray(value, dtype=bool)
    return np.broadcast_to(np.any(array, axis=-1) if array.ndim > 1 else array, (size,))


def _filled(text: Text[D], failure: Failure[D]) -> str:
    if callable(text):
        return text(failure)
    if "{" not in text:
        return text
    return text.format(m=failure.m, value=failure.value, limit=failure.limit, item=failure.item)
