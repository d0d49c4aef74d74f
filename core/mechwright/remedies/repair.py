"""Making a design build: the changes of ``mechwright fix``, from cheap judgements to dear ones."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from mechwright.contracts.finding import Change, Finding, Stage, errors
from mechwright.contracts.synthesis import Progress, unheard
from mechwright.designs.design import Design
from mechwright.errors import MechwrightError
from mechwright.pipeline import Build, Inspection, Wanted, work_to
from mechwright.pipeline.run import refused
from mechwright.plugins.host import Host
from mechwright.remedies.bench import Bench, Judge, Limits, of_family
from mechwright.remedies.nearest import MOST_CHANGES, candidates, nearest
from mechwright.remedies.search import proposed_step

FAMILY = Limits(tries=1500, seconds=60.0)
"""For what the family itself judges: milliseconds each."""
INSPECTED = Limits(tries=60, seconds=120.0)
"""For what inspections judge: a second or so each, of cutters and of bodies that meet."""

_PROPOSED = 3
"""Proposals that are followed from a change that pleases the family, before the next such change is tried."""

Ask = Callable[[Build], Sequence[Finding]]


@dataclass(frozen=True)
class Repair:
    """What came of a repair.

    Parameters
    ----------
    found
        Errors that stand in the design as it is.
    change
        What was changed, empty for a design that builds; None where nothing was found.
    left
        Errors that stand after what was changed last; none if the design builds.
    bench
        Where it was tried, for what is said of keys.
    nearest
        Where nothing was found: the nearest change with which the design builds, of more keys than a remedy
        has; None where there is none either.
    """

    found: list[Finding]
    change: Change | None
    left: list[Finding]
    bench: Bench
    nearest: Change | None = None

    @property
    def builds(self) -> bool:
        """Whether the design builds with the change."""
        return self.change is not None


def repaired(design: Design, host: Host, stage: Stage, progress: Progress = unheard) -> Repair:
    """The smallest change found with which a design passes all that ``build`` asks up to a stage."""
    asked = Asked(host, stage)
    first = of_family(design, FAMILY, stage, progress)
    found = first.errors({}) or []
    whole = asked.judge(asked.looks)
    smallest: Change | None = None
    beyond: list[Change] = []
    for change in candidates(first) if found else [{}]:
        bench = Bench(design.changed(change), whole, stage, INSPECTED, progress=progress)
        if len(change) > MOST_CHANGES:
            beyond += [] if beyond or not bench.builds({}) else [change]
            continue
        smallest = change if smallest is None else smallest
        stood, more = bench.errors({}) or [], _as_proposed(bench)
        if more is not None and len(merged := {**change, **more}) <= MOST_CHANGES:
            return Repair(found or stood, merged, [], first)
    if smallest is None:
        return Repair(found, None, found, first, next(iter(beyond), None))
    return _further(Repair(found, smallest, [], first), design, asked)


def _as_proposed(bench: Bench) -> Change | None:
    """What the findings of a design propose, one after the other, where it builds then; None where not.

    A length that the family has chosen may be none that a cutter makes, and the finding knows the next.
    """
    change: Change = {}
    for _ in range(_PROPOSED + 1):
        left = bench.errors(change)
        if not left:
            return None if left is None else change
        step = proposed_step(bench, left[0], change, left)
        if step is None:
            return None
        change = step.change
    return None


def _further(repair: Repair, design: Design, asked: "Asked") -> Repair:
    """Go on from a change that pleases the family, with one dearer judgement after the other.

    The one that is new is asked first: most changes fail by it, and what it is content with is put to the
    others then.
    """
    found, change, whole = repair.found, repair.change or {}, asked.judge(asked.looks)
    for number in range(len(asked.looks) + 1):
        limits = INSPECTED if number else FAMILY
        judge = asked.judge(asked.looks[:number][::-1])
        bench = Bench(design.changed(change), judge, asked.stage, limits, progress=repair.bench.progress)
        left = bench.errors({}) or []
        if left:
            found = found or left
            more = nearest(bench)
            if more is None:
                return Repair(found, None, left, repair.bench)
            change = {**change, **more}
            if len(change) > MOST_CHANGES:
                last = Bench(design.changed(change), whole, asked.stage, INSPECTED)
                return Repair(found, None, left, repair.bench, change if last.builds({}) else None)
    return Repair(found, change, [], repair.bench)


class Asked:
    """What ``build`` asks of a design up to a stage; an answer is kept.

    Parameters
    ----------
    looks
        What ``check`` asks, then the inspections of what is made.
    """

    def __init__(self, host: Host, stage: Stage) -> None:
        self.host, self.stage = host, stage
        asked = [
            one
            for one in sorted(host.all(Inspection), key=lambda one: one.order)
            if not one.stage.is_after(stage)
        ]
        later = [one for one in asked if one.needs]
        self.looks: list[Ask] = [one.outlook if one.needs else one.findings for one in asked]
        self.looks += [one.findings for one in later if one.needs <= work_to(stage)[1].makes]
        self._answers: dict[tuple[str, Ask], list[Finding]] = {}

    def judge(self, looks: Sequence[Ask]) -> Judge:
        """Ask the family, its parts, and then some looks, up to the first that finds an error."""
        return judge_of(self.host, [_family, _parts, *looks], self.stage, self._answers)


def judge_of(
    host: Host, asks: Sequence[Ask], stage: Stage, answers: dict[tuple[str, Ask], list[Finding]] | None = None
) -> Judge:
    """Ask one after the other, up to the first that finds an error; ``answers`` are those that are known."""
    known = {} if answers is None else answers

    def judge(design: Design) -> list[Finding]:
        found: list[Finding] = []
        name = repr(design.content)
        with Build(design, host, Wanted("build")) as build:
            for ask in asks:
                if (name, ask) not in known:
                    known[name, ask] = _answer(ask, build, stage)
                found += known[name, ask]
                if errors(found, stage):
                    break
        return found

    return judge


def _answer(ask: Ask, build: Build, stage: Stage) -> list[Finding]:
    try:
        return list(ask(build))
    except MechwrightError as error:
        return [refused(error, build.path, stage)]


def _family(build: Build) -> Sequence[Finding]:
    return build.findings


def _parts(build: Build) -> Sequence[Finding]:
    """Nothing, or the error of parts that cannot be made."""
    _ = build.parts
    return ()
