"""Findings with remedies that were tried: what ``check`` prints."""

from collections.abc import Iterable, Sequence
from dataclasses import replace

from mechwright.contracts.finding import Change, Finding, Findings, Severity, Stage, errors
from mechwright.designs.design import Design
from mechwright.pipeline import Build, Inspection, Run, Work
from mechwright.pipeline.run import REFUSED
from mechwright.remedies.advice import advised
from mechwright.remedies.bench import Bench, Limits, identity, of_family, same
from mechwright.remedies.nearest import MOST_CHANGES, nearest
from mechwright.remedies.repair import INSPECTED, judge_of
from mechwright.remedies.search import (
    Worth,
    best_step,
    path_of,
    proposals,
    proposed_step,
    refined,
    related,
    unnamed,
    worth,
    written,
)
from mechwright.remedies.words import said

NOT_ENOUGH = "what is proposed was tried, and is not enough by itself"

FOLLOWED = 3
"""Proposals of an inspection that are followed one after the other, each of what the one before brings to
light."""

CHECKED = Limits()
"""For what is refused."""

WARNED = Limits(tries=200, seconds=2.0)
"""For a design that has warnings alone: they stop nothing, and are told by every command."""

REMARKED = Limits(tries=6, seconds=4.0)
"""For the warnings of an inspection, and for all that the change against a warning may bring."""

CONFIRMED = Limits(tries=30, seconds=60.0)
"""For all that the change against an error may bring."""


def remedied(bench: Bench, findings: Iterable[Finding]) -> list[Finding]:
    """The findings that a bench's judge has of its design, each with the change that removes it.

    An error that no change of one key removes without a new error gets the nearest design that builds.
    ``remedy`` then says the change, or what was tried where nothing helped.
    """
    findings = list(findings)
    if all(one.severity is Severity.NOTE for one in findings):
        return findings
    judged = {identity(one) for one in bench.found({}) or ()}
    if any(identity(one) not in judged for one in findings if one.severity is not Severity.NOTE):
        return _remedied(bench.sure, findings)
    told = _remedied(bench, findings)
    lost = any(one.fix is not None and not holds(bench.sure, one, one.fix) for one in told)
    return _remedied(bench.sure, findings) if lost else told


def holds(bench: Bench, finding: Finding, change: Change) -> bool:
    """Whether a change removes a finding of the design and spoils nothing."""
    return worth(bench, finding, bench.errors({}) or [], change) <= Worth.HELPS


def _remedied(bench: Bench, findings: list[Finding]) -> list[Finding]:
    grave = [finding for finding in findings if _grave(finding)]
    before = bench.errors({}) or []
    # What is proposed is tried for each before the tries are spent on values that nobody proposed.
    for finding in findings:
        if finding.severity is not Severity.NOTE:
            proposed_step(bench, same(finding, bench.found({})) or finding, {}, before)
    # What removes several errors at once is sought first, before the tries are spent on each by itself.
    whole = nearest(bench) if len(grave) > 1 else None
    alone = [_alone(bench, finding) for finding in findings]
    if whole is None and any(
        _grave(one) and change is None for one, change in zip(findings, alone, strict=True)
    ):
        whole = nearest(bench)
    if whole is not None and len(whole) > MOST_CHANGES:
        whole = None
    return [
        _with(bench, finding, alone[number] or (whole if _grave(finding) else None))
        for number, finding in enumerate(findings)
    ]


def tried(design: Design, findings: Iterable[Finding], limits: Limits | None = None) -> list[Finding]:
    """What the family finds of a design, with remedies that the family was asked about.

    Inspections are not asked: a try of theirs takes a second or so, which is for ``mechwright fix``.
    """
    findings = list(findings)
    return remedied(of_family(design, limits or (CHECKED if errors(findings) else WARNED)), findings)


def with_remedies(run: Run) -> Findings:
    """What a run has found, with remedies that were tried.

    Against errors of later stages than the run's, which stop nothing, nothing is sought.
    """
    own, last = run.build.findings, run.work.stage
    sought = [one for one in own if one.severity is not Severity.ERROR or not one.stage.is_after(last)]
    known = dict(zip(map(id, sought), tried(run.build.design, sought), strict=True))
    told = [*((one, known.get(id(one), one)) for one in own), *((one, one) for one in run.part_errors)]
    for each, found in run.found:
        told += zip(found, proposed_tried(run, each, found), strict=True)
    whole = _Whole(run)
    confirmed = [(before, whole.confirmed(before, after)) for before, after in told]
    return Findings(whole.agreeing(confirmed))


class _Whole:
    """All that a run looks at before it makes anything: a remedy must bring nothing new to light there."""

    def __init__(self, run: Run) -> None:
        design, last = run.build.design, run.work.stage
        work = Work(last, process=run.work.process)
        judge = judge_of(run.build.host, work, every=True, wanted=run.build.wanted)
        self._benches = {
            Severity.ERROR: Bench(design, judge, last, CONFIRMED),
            Severity.WARNING: Bench(design, judge, last, REMARKED),
        }
        self._before = {
            severity: {identity(one) for one in run.findings if one.severity in grave}
            for severity, grave in _AS_GRAVE.items()
        }

    def confirmed(self, before: Finding, after: Finding) -> Finding:
        """A finding with its change, with one that goes further, or with what stands in the way of it."""
        if after.fix is None or after.severity is Severity.NOTE:
            return after
        bench, change = self._benches[after.severity], after.fix
        first = new = self._new(bench, before, change)
        for _ in range(FOLLOWED):
            if not new or new == [before]:
                break
            step = proposed_step(bench, new[0], change, bench.errors(change) or [])
            if step is None or len(step.change) > MOST_CHANGES:
                break
            change = step.change
            new = self._new(bench, before, change)
        if not new:
            return after if change is after.fix else replace(after, fix=change, remedy=said(bench, change))
        way = f"{said(bench, after.fix)} would lead to {_in_the_way(first[0])}"
        return replace(after, fix=None, remedy="; ".join(filter(None, (before.remedy, way))))

    def agreeing(self, told: Sequence[tuple[Finding, Finding]]) -> list[Finding]:
        """The findings without changes that undo another's: of two values of one key the graver's stays."""
        found = [after for _, after in told]
        order = list(Severity)
        ranked = sorted(range(len(found)), key=lambda place: order.index(found[place].severity))
        kept: list[Finding] = []
        for place in ranked:
            one = found[place]
            if one.fix is None:
                continue
            other = next((each for each in kept if self._undoes(one, each)), None)
            if other is None:
                kept.append(one)
                continue
            way = f"{one.remedy} would undo what is done about {_in_the_way(other)}"
            words = told[place][0].remedy
            found[place] = replace(one, fix=None, remedy="; ".join(filter(None, (words, way))))
        return found

    def _undoes(self, one: Finding, other: Finding) -> bool:
        """Whether two changes are of one key, and the first leaves the other's finding."""
        mine, its = one.fix or {}, other.fix or {}
        if all(mine[key] == its[key] for key in mine.keys() & its.keys()):
            return False
        left = self._benches[one.severity].found(mine) or ()
        return identity(other) in {identity(each) for each in left}

    def _new(self, bench: Bench, finding: Finding, change: Change) -> list[Finding]:
        """What stands with a change against a finding, is as grave, and did not stand before; or itself."""
        found = bench.found(change)
        if found is None:
            return [Finding.error(REFUSED, "", "a design that cannot be judged")]
        if identity(finding) in {identity(one) for one in found}:
            return [finding]
        grave, before = _AS_GRAVE[finding.severity], self._before[finding.severity]
        return [one for one in found if one.severity in grave and identity(one) not in before]


_AS_GRAVE = {Severity.ERROR: {Severity.ERROR}, Severity.WARNING: {Severity.ERROR, Severity.WARNING}}
"""What the change against a finding must not bring: against an error no error, against a warning neither."""


def _in_the_way(finding: Finding) -> str:
    where = f"{finding.parameter}: " if finding.parameter else ""
    return f"{finding.code}: {where}{finding.message}"


def proposed_tried(run: Run, inspection: Inspection, findings: Iterable[Finding]) -> list[Finding]:
    """What an inspection finds in a run, with the first of what each finding proposes that removes it.

    Values that its words advise count as proposals. Nothing else is tried: a design takes an inspection a
    second or so. A finding whose proposals all fail keeps its words, and says so.
    """
    findings = list(findings)
    if all(finding.severity is Severity.NOTE for finding in findings):
        return findings

    def judge(design: Design) -> Sequence[Finding]:
        with Build(design, run.build.host, run.build.wanted) as build:
            found = build.findings
            return found if errors(found, inspection.stage) else [*found, *run.ask(inspection, build)]

    limits = INSPECTED if errors(findings) else REMARKED
    bench = Bench(run.build.design, judge, inspection.stage, limits)
    told = [with_proposed(bench, finding) for finding in findings]
    fixes = [one.fix for one in told if one.fix is not None]
    return [_as_others(bench, finding, one, fixes) for finding, one in zip(findings, told, strict=True)]


def _as_others(bench: Bench, finding: Finding, told: Finding, fixes: Iterable[Change]) -> Finding:
    """A finding without a change with another one's that removes it too: of two parts, the larger's.

    What is about no key of the file, such as the shop, keeps its own words.
    """
    of_file = path_of(bench, finding.parameter) in bench.given or not _about_no_key(bench, finding)
    if told.fix is not None or finding.severity is Severity.NOTE or not of_file:
        return told
    before = errors([finding])
    change = next((one for one in fixes if worth(bench, finding, before, one) <= Worth.HELPS), None)
    return told if change is None else replace(told, fix=change, remedy=said(bench, change))


def with_proposed(bench: Bench, finding: Finding) -> Finding:
    """A finding with the first change that it proposes and that removes it; else its own words."""
    if finding.severity is Severity.NOTE:
        return finding
    # An error that was raised has its advice behind its last semicolon.
    message, _, words = ("", "", finding.remedy) if finding.remedy else finding.message.rpartition("; ")
    own = bench.keys.get(path_of(bench, finding.parameter))
    said_so = list(advised(words, own, bench.keys))
    measured, before = unnamed(bench, finding, {}), errors([finding])
    proposed = [written(bench, one, {}) for one in (*proposals(bench, finding), *measured, *said_so)]
    change = next((one for one in proposed if worth(bench, finding, before, one) <= Worth.HELPS), None)
    if change is None and before:
        change = next(filter(None, (_followed(bench, finding, one) for one in proposed)), None)
    if change is not None:
        fixed = replace(finding, fix=change, remedy=said(bench, change))
        return replace(fixed, message=message) if message else fixed
    if (measured or said_so) and not bench.spent:
        return replace(finding, remedy="; ".join(filter(None, (finding.remedy, NOT_ENOUGH))))
    return finding


def _about_no_key(bench: Bench, finding: Finding) -> bool:
    return bool(finding.parameter) and path_of(bench, finding.parameter) not in bench.keys


def _followed(bench: Bench, finding: Finding, change: Change) -> Change | None:
    """A proposal with what the errors propose that it brings to light, with which none of these is left.

    A part too small for tabs is held in another way, and only then is it seen that no mill reaches its
    corners.
    """
    before = bench.errors({}) or []
    for _ in range(FOLLOWED):
        worthy = worth(bench, finding, before, change)
        if worthy <= Worth.HELPS:
            return change
        if worthy is Worth.USELESS:
            return None
        stood = {identity(one) for one in before}
        left = bench.errors(change) or []
        target = next(one for one in left if identity(one) not in stood)
        step = proposed_step(bench, target, change, left)
        if step is None:
            return None
        change = step.change
    return None


def _grave(finding: Finding) -> bool:
    return finding.severity is Severity.ERROR


def _alone(bench: Bench, finding: Finding) -> Change | None:
    """The smallest change of one key, or the first proposed, that removes a finding and spoils nothing."""
    if finding.severity is Severity.NOTE:
        return None
    before, judged = bench.errors({}) or [], same(finding, bench.found({})) or finding
    best = best_step(bench, judged, {}, before)
    if best is None or best.worth > Worth.HELPS:
        return None
    if best.change in [written(bench, one, {}) for one in proposals(bench, finding)]:
        return best.change
    return refined(bench, judged, before, best.change)


def _first_step(bench: Bench, finding: Finding) -> str | None:
    """The change that leads past a finding of the motion, and to what: it had hidden other checks.

    None of other findings: nothing is hidden by those.
    """
    if finding.stage is not Stage.MOTION:
        return None
    before = bench.errors({}) or []
    step = best_step(bench, same(finding, bench.found({})) or finding, {}, before)
    left = bench.errors(step.change) if step is not None and step.worth is Worth.REVEALS else None
    if step is None or not left:
        return None
    return f"{said(bench, step.change)}, which leads to {left[0].code}: {left[0].message}"


def _with(bench: Bench, finding: Finding, change: Change | None) -> Finding:
    if finding.severity is Severity.NOTE:
        return finding
    if change is not None and holds(bench, same(finding, bench.found({})) or finding, change):
        return replace(finding, fix=change, remedy=said(bench, change))
    keys = related(bench, finding)
    if finding.remedy and (_about_no_key(bench, finding) or not any(key.kind != "other" for key in keys)):
        return finding  # about what no change sets, such as the family of a stage, or a drawing
    if (first := _first_step(bench, finding)) is not None:
        return replace(finding, remedy=first)
    tried = ", ".join(key.name for key in keys) or finding.parameter
    ended = f" in {bench.tries} tries" if bench.spent else ""
    return replace(finding, remedy=f"no remedy found by changing {tried}{ended}")
