"""Whether the mechanism runs with plates that stray as their process does."""

from collections.abc import Iterator

from mechwright.contracts.finding import Finding
from mechwright.contracts.parameters import Parameters
from mechwright.pipeline import Build
from mechwright.pipeline.process import Spread
from mechwright.pipeline.tolerances import TolerancesTable, running
from mechwright.pipeline.tolerances.by_process import with_spread, worst_spread
from mechwright.pipeline.tolerances.compared import ComparedOutput, compared
from mechwright_cut.cutting import Cutting
from mechwright_cut.settings.figures import Process


class StrayingCuts:
    """The outputs of a build with its cut plates; none where none is cut, or its family has no analysis."""

    def __init__(self, build: Build) -> None:
        cutting = build.made(Cutting)
        self.processes: list[Process] = [process for _, process, *_ in cutting.cut_parts]
        self._spread = worst_spread(Spread(one.size, one.taper) for one in self.processes)
        self._build = build
        self.outputs = self.with_params(build.design.params)

    def with_params(self, params: Parameters) -> list[ComparedOutput]:
        """The same with other parameters."""
        if self._spread is None:
            return []
        asked = self._build.design.table(TolerancesTable)
        return compared(self._build, with_spread(asked, self._spread), params)


def running_findings(build: Build) -> Iterator[Finding]:
    """Plays that jam, errors beyond limits, and teeth with less backlash than the process wants."""
    made = build.made(StrayingCuts)
    wording = running.Wording(
        code="cut",
        parts="mechanisms of cut plates",
        key="process",
        kind=Finding.warning,
        otherwise=lambda _: "take a process that strays less; check --figures lists them",
        again=lambda params, _: made.with_params(params),
    )
    yield from running.running_rule(build, wording, made.outputs)
    if made.processes:
        need = max(one.backlash for one in made.processes)
        yield from running.backlash_rule(build, wording, made.outputs, need)
