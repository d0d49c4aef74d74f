"""Whether the mechanism runs with plates that stray as their process does."""

from collections.abc import Iterator

from mechwright.contracts.finding import Finding
from mechwright.pipeline import Build
from mechwright.pipeline.process import Spread
from mechwright.pipeline.tolerances import TolerancesTable, running
from mechwright.pipeline.tolerances.by_process import with_spread, worst_spread
from mechwright.pipeline.tolerances.compared import ComparedOutput, compared
from mechwright_cut.cutting import Cutting
from mechwright_cut.settings.figures import Process

WORDING = running.Wording(
    code="cut",
    parts="mechanisms of cut plates",
    key="process",
    kind=Finding.warning,
    otherwise="take a process that strays less; check --figures lists them",
)


class StrayingCuts:
    """The outputs of a build with its cut plates; none where none is cut, or its family has no analysis."""

    def __init__(self, build: Build) -> None:
        cutting = build.made(Cutting)
        self.processes: list[Process] = [process for _, process, *_ in cutting.cut_parts]
        spread = worst_spread(Spread(one.size, one.taper) for one in self.processes)
        asked = build.design.table(TolerancesTable)
        self.outputs: list[ComparedOutput] = []
        if spread is not None:
            self.outputs = compared(build, with_spread(asked, spread))


def running_findings(build: Build) -> Iterator[Finding]:
    """Plays that jam, errors beyond limits, and teeth with less backlash than the process wants."""
    made = build.made(StrayingCuts)
    yield from running.running_rule(build, WORDING, made.outputs)
    if made.processes:
        need = max(one.backlash for one in made.processes)
        yield from running.backlash_rule(build, WORDING, made.outputs, need)
