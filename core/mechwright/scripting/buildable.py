"""Designs that a synthesis finds and that can be built as the tables of its requirement say."""

from collections.abc import Sequence
from typing import Any

from annotated_types import Le

from mechwright.build import Build, Wanted
from mechwright.contracts.finding import Finding
from mechwright.contracts.parameters import Parameters
from mechwright.contracts.synthesis import BEYOND, Candidate, Progress, Reason, Rejected, Synthesis
from mechwright.designs.requirement import Requirement
from mechwright.plugins.host import Host
from mechwright.scripting.mechanism import inspections

NUMBER = "designs"
"""The key of a requirement that says how many designs are asked for."""

Machine = tuple[Candidate[Any], ...]
"""One design, or those of all phases of a machine that is set to several paths: none without the others."""


def found_buildable(asked: Requirement, installed: Host, progress: Progress) -> Synthesis[Any]:
    """What the family finds, without the designs that cannot be built as the requirement's tables say.

    A family looks at as many designs as are asked for, and knows no shop. Where the shop refuses some of them
    and the family has found more, it is asked for these too, and the first that can be built are given.
    """
    result = asked.family.synthesise(asked.kind, asked.table, progress)
    wanted = len(machines(result.candidates))
    shop = _Shop(asked, installed)
    kept, rejected = shop.first(wanted, result, progress)
    wider = _wider(asked.table, wanted + _beyond(result)) if len(kept) < wanted else None
    if wider is not None:
        result = asked.family.synthesise(asked.kind, wider, progress)
        kept, rejected = shop.first(wanted, result, progress)
    said, looked = result.findings, len(machines(result.candidates))
    if looked and not kept:
        said = (*said, _unbuildable(shop.blamed))
    if len(kept) < wanted and (spare := _beyond(result)):
        said = (*said, _more(looked, len(kept), spare))
    return Synthesis(tuple(one for machine in kept for one in machine), said, rejected)


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


class _Shop:
    """Judges designs by the tables of a requirement, each once."""

    def __init__(self, asked: Requirement, installed: Host) -> None:
        self.asked, self.installed = asked, installed
        self._judged: dict[str, tuple[Finding, ...]] = {}
        self.blamed = Reason("", 0, "")

    def first(
        self, wanted: int, result: Synthesis[Any], progress: Progress
    ) -> tuple[list[Machine], tuple[Reason, ...]]:
        """So many machines that can be built, or as many as there are, and why the others are not given."""
        kept: list[Machine] = []
        unbuilt, left = Rejected(), 0
        found = machines(result.candidates)
        for number, machine in enumerate(found):
            if len(kept) == wanted:
                left = len(found) - number
                break
            progress(number / len(found), "checking the designs")
            if not unbuilt.by(finding for one in machine for finding in self.against(one)):
                kept.append(machine)
        self.blamed = next(iter(unbuilt.reasons), self.blamed)
        rejected = Rejected(one for one in result.rejected if one.code != BEYOND)
        for reason in unbuilt.reasons:
            rejected.because(reason.code, reason.message, reason.count)
        rejected.beyond(getattr(self.asked.table, NUMBER, wanted), left + _beyond(result))
        return kept, rejected.reasons

    def against(self, one: Candidate[Any]) -> tuple[Finding, ...]:
        """What there is to say of a design up to its machining."""
        key = repr(one.params)
        if key not in self._judged:
            design = self.asked.design(self.asked.name, one.params)
            with Build(design, self.installed, Wanted("check")) as build:
                self._judged[key] = (*build.findings, *inspections(build))
        return self._judged[key]


def _beyond(result: Synthesis[Any]) -> int:
    """How many designs were found and not looked at."""
    return sum(reason.count for reason in result.rejected if reason.code == BEYOND)


def _wider(table: Parameters, designs: int) -> Parameters | None:
    """The same requirement for so many designs, or as many as it can ask for; None if it asks for them."""
    field = type(table).model_fields.get(NUMBER)
    if field is None:
        return None
    most = [int(one.le) for one in field.metadata if isinstance(one, Le)]  # type: ignore[call-overload]
    number = min([designs, *most])
    return table.model_copy(update={NUMBER: number}) if number > getattr(table, NUMBER) else None


def _more(looked: int, kept: int, spare: int) -> Finding:
    """That there are designs which nobody has looked at, in the place of those that cannot be built."""
    return Finding.note(
        "synthesis.more",
        f"{looked - kept} of {looked} designs cannot be built as their tables say, and {spare} more were "
        "found and not looked at",
        float(spare),
    )


def _unbuildable(reason: Reason) -> Finding:
    said = f"no design that meets it can be built as its tables say: {reason.message}"
    return Finding.error("synthesis.unbuildable", "", said, remedy="change the tables, or what is asked for")
