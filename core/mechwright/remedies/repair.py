"""Making a design build: the changes of ``mechwright fix``, from cheap judgements to dear ones."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from mechwright.build import Build, Inspection, Wanted
from mechwright.contracts.finding import Change, Finding, Stage, errors
from mechwright.contracts.synthesis import Progress, unheard
from mechwright.designs.design import Design
from mechwright.errors import MechwrightError
from mechwright.plugins.host import Host
from mechwright.remedies.bench import Bench, Judge, Limits, of_family
from mechwright.remedies.nearest import MOST_CHANGES, candidates, nearest

FAMILY = Limits(tries=1500, seconds=60.0)
"""For what the family itself judges: milliseconds each."""
INSPECTED = Limits(tries=60, seconds=120.0)
"""For what inspections judge: a second or so each, of cutters and of bodies that meet."""
_OWN = 2
"""Of what is asked, what the family answers."""
REFUSED = "build.refused"
"""Code of the finding that work ended with an error: no cutter, no parts, a program that is not proven."""

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
    """

    found: list[Finding]
    change: Change | None
    left: list[Finding]
    bench: Bench

    @property
    def builds(self) -> bool:
        """Whether the design builds with the change."""
        return self.change is not None


def repaired(design: Design, host: Host, stage: Stage, progress: Progress = unheard) -> Repair:
    """The smallest change found with which a design passes all that ``build`` asks up to a stage."""
    asks = _asks(host, stage)
    first = of_family(design, FAMILY, stage, progress)
    found = first.errors({}) or []
    whole = judge_of(host, asks, stage)
    start: Change = {}
    if found:
        possible = [change for change in candidates(first) if len(change) <= MOST_CHANGES]
        if not possible:
            return Repair(found, None, found, first)
        for change in possible:
            if not errors(whole(design.changed(change)), stage):
                return Repair(found, change, [], first)
        start = possible[0]
    return _further(Repair(found, start, [], first), design, host, stage, asks)


def _further(repair: Repair, design: Design, host: Host, stage: Stage, asks: Sequence[Ask]) -> Repair:
    """Go on from a change that pleases the family, with one dearer judgement after the other."""
    found, change = repair.found, repair.change or {}
    progress = repair.bench.progress
    for number in range(_OWN, len(asks) + 1):
        limits = FAMILY if number == _OWN else INSPECTED
        judge = judge_of(host, asks[:number], stage)
        bench = Bench(design.changed(change), judge, stage, limits, progress=progress)
        left = bench.errors({}) or []
        if left:
            found = found or left
            more = nearest(bench)
            if more is None or len({**change, **more}) > MOST_CHANGES:
                return Repair(found, None, left, repair.bench)
            change = {**change, **more}
    return Repair(found, change, [], repair.bench)


def judge_of(host: Host, asks: Sequence[Ask], stage: Stage) -> Judge:
    """Ask one after the other, up to the first that finds an error."""

    def judge(design: Design) -> list[Finding]:
        found: list[Finding] = []
        with Build(design, host, Wanted("build")) as build:
            for ask in asks:
                try:
                    found += ask(build)
                except MechwrightError as error:
                    found.append(Finding.error(REFUSED, "", str(error), stage=stage))
                if errors(found, stage):
                    break
        return found

    return judge


def _family(build: Build) -> Sequence[Finding]:
    return build.findings


def _parts(build: Build) -> Sequence[Finding]:
    """Nothing, or the error of parts that cannot be made."""
    _ = build.parts
    return ()


def _asks(host: Host, stage: Stage) -> list[Ask]:
    """The family; its parts; what ``check`` asks; what ``build`` asks besides, which takes longest."""
    order = list(Stage)
    wanted = [
        one
        for one in sorted(host.all(Inspection), key=lambda one: one.order)
        if "build" in one.commands and order.index(one.stage) <= order.index(stage)
    ]

    def ask(inspections: list[Inspection]) -> Ask:
        return lambda build: [finding for one in inspections for finding in one.findings(build)]

    quick = [one for one in wanted if "check" in one.commands]
    return [_family, _parts, ask(quick), ask([one for one in wanted if one not in quick])]
