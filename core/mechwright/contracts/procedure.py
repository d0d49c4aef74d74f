"""What is found of a design where no value and limit say it: by a procedure, or as a figure worth knowing."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

import numpy as np

from mechwright.contracts.design_rule import Bools, truth_of
from mechwright.contracts.design_table import DesignTable
from mechwright.contracts.finding import Finding, Severity, Stage
from mechwright.contracts.guard import UnsoundError

D = TypeVar("D", bound=DesignTable[Any])


@dataclass(frozen=True)
class Procedure(Generic[D]):
    """What is found of one design by a procedure, where no value and limit say it.

    Parameters
    ----------
    codes
        Of what it finds.
    inspect
        What it finds of one design.
    common
        Whether it looks at nothing but what the designs of a table have in common.
    when
        Which designs are asked.
    slow
        Whether it takes long: the quick judge does not ask it.
    stage
        The earliest stage of what it finds: studies up to an earlier one do not ask it.
    certain
        Whether it finds an error of that stage in every design that is asked: tables are not inspected.
    warns
        Whether it finds no errors, and so forbids nothing.
    quickly
        Whether only tables and the quick judge ask it: a slow one finds the same, and more.
    """

    codes: Sequence[str]
    inspect: Callable[[D], Iterable[Finding]]
    common: bool = False
    when: Callable[[D], Any] | None = None
    slow: bool = False
    stage: Stage = Stage.MOTION
    certain: bool = False
    warns: bool = False
    quickly: bool = False

    def forbids(self, table: D, stage: Stage) -> Bools | None:
        """Give the designs (n,) in which it finds an error: the first tells of all, or each of itself."""
        if self.slow or self.warns or not table.size or self.stage.is_after(stage):
            return None
        asked = truth_of(True if self.when is None else self.when(table), table.size)
        if self.certain:
            return asked
        if self.common:
            return asked & self._stops(table.row(0), stage) if asked.any() else None
        wrong = np.zeros(table.size, bool)
        for place in np.flatnonzero(asked).tolist():
            wrong[place] = self._stops(table.row(place), stage)
        return wrong

    def forbidding(self, table: D, wrong: Bools, stage: Stage) -> Iterator[tuple[str, Bools]]:
        """Give each code with which it forbids designs (n,), and which of them."""
        if len(self.codes) == 1 or self.certain:
            yield self.codes[0], wrong
            return
        places = np.flatnonzero(wrong)
        rows = places[:1] if self.common else places
        found = [self._first(table.row(place), stage) for place in rows.tolist()]
        for code in dict.fromkeys(found):
            which = wrong.copy()
            if not self.common:
                which[places] = [one == code for one in found]
            yield code, which

    def _first(self, m: D, stage: Stage) -> str:
        return next(one.code for one in self.inspect(m) if _forbids(one, stage))

    def _stops(self, m: D, stage: Stage) -> bool:
        return any(_forbids(one, stage) for one in self.inspect(m))

    def findings(self, m: D, *, quick: bool) -> Iterator[Finding]:
        """Give what it finds of one design; see :class:`RuleLike`."""
        if self.slow if quick else self.quickly:
            return
        if self.when is None or np.any(self.when(m)):
            found = self.inspect(m)
            if not isinstance(found, Iterable):
                raise UnsoundError(f"a procedure of its rules gives {found!r}; findings are wanted")
            yield from found


@dataclass(frozen=True)
class Note(Generic[D]):
    """A figure worth knowing.

    Parameters
    ----------
    code, message, unit
        Of the finding.
    value
        A formula of the design.
    when
        Whether there is something to say of a design.
    stage
        Of the finding.
    """

    code: str
    message: "str | Callable[[D], str]"
    value: Callable[[D], float] | None = None
    unit: str = ""
    when: Callable[[D], Any] | None = None
    stage: Stage = Stage.PARTS

    @property
    def codes(self) -> Sequence[str]:
        """Its code."""
        return (self.code,)

    def forbids(self, table: D, stage: Stage) -> None:
        """Give None; see :class:`RuleLike`."""

    def findings(self, m: D, *, quick: bool) -> Iterator[Finding]:
        """Give the note of one design; see :class:`RuleLike`."""
        if quick or (self.when is not None and not np.any(self.when(m))):
            return
        value = None if self.value is None else float(self.value(m))
        said = self.message(m) if callable(self.message) else self.message.format(m=m, value=value)
        yield Finding(self.code, Severity.NOTE, "", said, value, unit=self.unit, stage=self.stage)


def _forbids(finding: Finding, stage: Stage) -> bool:
    return finding.severity is Severity.ERROR and not finding.stage.is_after(stage)
