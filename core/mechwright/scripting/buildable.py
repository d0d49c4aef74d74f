"""Designs that a synthesis finds and that can be built as the tables of its requirement say."""

import tomllib
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from mechwright.contracts.finding import Change, Finding, Findings
from mechwright.contracts.parameters import Parameters
from mechwright.contracts.synthesis import BEYOND, Candidate, Progress, Reason, Rejected, Synthesis
from mechwright.designs.design import Design, design_of
from mechwright.designs.requirement import Requirement
from mechwright.pipeline import Build
from mechwright.plugins.host import Host
from mechwright.remedies import Bench, Limits, nearest
from mechwright.remedies.words import said
from mechwright.scripting.checking import checked

REMEDIED = 3
"""Designs, the best, for which a change of the requirement's tables is sought where none can be built."""

TABLES = Limits(tries=40, seconds=10.0)
"""For each of them."""

WIDER = 4
"""Times that a family is asked for the designs that it has found and nobody has looked at."""

NUMBER = "designs"
"""The key of a requirement that says how many designs are asked for."""

Machine = tuple[Candidate[Any], ...]
"""One design, or those of all phases of a machine that is set to several paths: none without the others."""


def found_buildable(asked: Requirement, installed: Host, progress: Progress) -> "Buildable":
    """What the family finds, without the designs that cannot be built as the requirement's tables say.

    A family looks at as many designs as are asked for, and knows no shop. Where some of them cannot be built
    and the family has found more, it is asked for these too: once for the number that is asked for, and on
    to the last of them as long as none can be built.
    """
    judge, table = _Judge(asked, installed), asked.table
    result = asked.family.synthesise(asked.kind, table, progress)
    wanted = len(machines(result.candidates))
    kept, rejected = judge.first(wanted, result, progress)
    for _ in range(WIDER):
        wider = _wider(table, len(machines(result.candidates)) + _beyond(result))
        if wider is None or len(kept) == wanted or (kept and table is not asked.table):
            break
        table, result = wider, asked.family.synthesise(asked.kind, wider, progress)
        kept, rejected = judge.first(wanted, result, progress)
    told, looked = result.findings, len(machines(result.candidates))
    if looked and not kept:
        told = (*told, _unbuildable(judge.blamed, *judge.remedy(result.candidates, progress)))
    if len(kept) < wanted and (spare := _beyond(result)):
        told = (*told, _more(looked, len(kept), spare))
    given = tuple(one for machine in kept for one in machine)
    judged = [judge.of(one) for one in given]
    return Buildable(
        Synthesis(given, told, rejected), tuple(one for one, _ in judged), tuple(one for _, one in judged)
    )


@dataclass(frozen=True)
class Buildable:
    """What a synthesis gives: for each candidate its design, and what ``check`` finds of it."""

    result: Synthesis[Any]
    designs: tuple[Design, ...]
    findings: tuple[Findings, ...]


def machines(candidates: Sequence[Candidate[Any]]) -> list[Machine]:
    """The candidates, those of one machine together: the figure ``phase`` of such designs counts from 1.

    >>> machines([])
    []
    """
    found: list[list[Candidate[Any]]] = []
    for one in candidates:
        phase = one.figures.get("phase")
        if phase is None or phase.value <= 1 or not found:
            found.append([])
        found[-1].append(one)
    return [tuple(one) for one in found]


class _Judge:
    """Judges designs as their files will be read, with the tables of a requirement, each once."""

    def __init__(self, asked: Requirement, installed: Host) -> None:
        self.asked, self.installed = asked, installed
        self._judged: dict[str, tuple[Design, Findings]] = {}
        self.blamed = Reason("", 0, "")

    def first(
        self, wanted: int, result: Synthesis[Any], progress: Progress
    ) -> tuple[list[Machine], tuple[Reason, ...]]:
        """So many machines that can be built, or as many as there are, and why the others are not given."""
        kept: list[Machine] = []
        unbuilt, left = Rejected(), 0
        every = machines(result.candidates)
        for number, machine in enumerate(every):
            if len(kept) == wanted:
                left = len(every) - number
                break
            progress(number / len(every), "checking the designs")
            found = [one for each in machine for one in self.of(each)[1]]
            # What is to be done is of a design, and the person has a requirement at hand.
            if not unbuilt.by(replace(one, remedy="") for one in found):
                kept.append(machine)
        self.blamed = next(iter(unbuilt.reasons), self.blamed)
        rejected = Rejected(one for one in result.rejected if one.code != BEYOND)
        for reason in unbuilt.reasons:
            rejected.because(reason.code, reason.message, reason.count)
        rejected.beyond(getattr(self.asked.table, NUMBER, wanted), left + _beyond(result))
        return kept, rejected.reasons

    def remedy(self, candidates: Sequence[Candidate[Any]], progress: Progress) -> tuple[str, Change | None]:
        """A change of the requirement's tables with which one of the best designs can be built, in words.

        It is tried with the design; the requirement says these tables in the same words.
        """
        for one in candidates[:REMEDIED]:
            design, _ = self.of(one)
            bench = Bench(
                design, self._found, limits=TABLES, progress=progress, fixed=tuple(design.own_tables)
            )
            change = nearest(bench)
            if change:
                return f"in {self.asked.path.name}, {said(bench, change)}", change
        return "ask for something else: no change of its tables was found that helps", None

    def _found(self, design: Design) -> Findings:
        with Build(design, self.installed) as build:
            return checked(build, remedies=False)

    def of(self, one: Candidate[Any]) -> tuple[Design, Findings]:
        """The design that the file of a candidate will hold, and what ``check`` finds of it."""
        text = self.asked.text_here(self.asked.name, one.params)
        if text not in self._judged:
            path = self.asked.path.with_name(f"{self.asked.name}.toml")
            design = design_of(tomllib.loads(text), path, "", self.installed)
            self._judged[text] = design, self._found(design)
        return self._judged[text]


def _beyond(result: Synthesis[Any]) -> int:
    """How many designs were found and not looked at."""
    return sum(reason.count for reason in result.rejected if reason.code == BEYOND)


def _wider(table: Parameters, designs: int) -> Parameters | None:
    """The same requirement for so many designs; None if it asks for as many."""
    if NUMBER not in type(table).model_fields or designs <= getattr(table, NUMBER):
        return None
    return table.model_copy(update={NUMBER: designs})


def _more(looked: int, kept: int, spare: int) -> Finding:
    """That there are designs which nobody has looked at, in the place of those that cannot be built."""
    return Finding.note(
        "synthesis.more",
        f"{looked - kept} of {looked} designs cannot be built as their tables say, and {spare} more were "
        "found and not looked at",
        float(spare),
    )


def _unbuildable(reason: Reason, remedy: str, change: Change | None) -> Finding:
    message = f"no design that meets it can be built as its tables say: {reason.message}"
    return replace(Finding.error("synthesis.unbuildable", "", message, remedy=remedy), fix=change)
