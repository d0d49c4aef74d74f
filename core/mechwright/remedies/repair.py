"""Wording a design build: the changes of ``mechwright fix``, from cheap judgements to dear ones."""

from collections.abc import Sequence
from dataclasses import dataclass

from mechwright.contracts.finding import Change, Finding, Stage
from mechwright.contracts.refused import RefusedError
from mechwright.contracts.synthesis import Progress, unheard
from mechwright.designs.design import Design
from mechwright.errors import MechwrightError
from mechwright.pipeline import Build, Run, Wanted, Work, work_to
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
    first = of_family(design, FAMILY, stage, progress)
    found = first.errors({}) or []
    works = (Work(min(stage, Stage.PARTS, key=list(Stage).index)), Work(stage), work_to(stage)[1])
    judges = [judge_of(host, work) for work in works]
    smallest: Change | None = None
    beyond: list[Change] = []
    for change in candidates(first) if found else [{}]:
        bench = Bench(design.changed(change), judges[-1], stage, INSPECTED, progress=progress)
        if len(change) > MOST_CHANGES:
            beyond += [] if beyond or not bench.builds({}) else [change]
            continue
        smallest = change if smallest is None else smallest
        stood, more = bench.errors({}) or [], _as_proposed(bench)
        if more is not None and len(merged := {**change, **more}) <= MOST_CHANGES:
            return Repair(found or stood, merged, [], first)
    if smallest is None:
        return Repair(found, None, found, first, next(iter(beyond), None))
    return _further(Repair(found, smallest, [], first), design, judges, stage)


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


def _further(repair: Repair, design: Design, judges: Sequence[Judge], stage: Stage) -> Repair:
    """Go on from a change that pleases the family, with one dearer judgement after the other."""
    found, change = repair.found, repair.change or {}
    for number, judge in enumerate(judges):
        limits = INSPECTED if number else FAMILY
        bench = Bench(design.changed(change), judge, stage, limits, progress=repair.bench.progress)
        left = bench.errors({}) or []
        if left:
            found = found or left
            more = nearest(bench)
            if more is None:
                return Repair(found, None, left, repair.bench)
            change = {**change, **more}
            if len(change) > MOST_CHANGES:
                last = Bench(design.changed(change), judges[-1], stage, INSPECTED)
                return Repair(found, None, left, repair.bench, change if last.builds({}) else None)
    return Repair(found, change, [], repair.bench)


def judge_of(host: Host, work: Work, *, every: bool = False, wanted: Wanted | None = None) -> Judge:
    """What a run finds of a design; without ``every`` up to the first inspection that finds an error.

    ``wanted`` is asked of it besides.
    """

    def judge(design: Design) -> Sequence[Finding]:
        with Build(design, host, wanted or Wanted()) as build:
            run = Run(build, work)
            run.look(every=every)
            if not work.makes or run.is_stopped():
                return run.findings
            try:
                run.make()
            except RefusedError:
                return run.findings
            except MechwrightError as error:
                return [*run.findings, refused(error, build.path, work.stage)]
            return run.findings

    return judge
