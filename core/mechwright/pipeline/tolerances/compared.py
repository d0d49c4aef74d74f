"""A design with other tolerances than its own: those of a process, or of parts that were measured."""

from dataclasses import dataclass, replace

from mechwright.contracts.parameters import Parameters
from mechwright.contracts.tolerance_settings import Tolerances
from mechwright.contracts.tolerances import Output
from mechwright.mechanics.tolerance import Result
from mechwright.pipeline.build import Build
from mechwright.pipeline.tolerances.asked import drawn_analysis
from mechwright.pipeline.tolerances.by_process import analysed

ALL_BUT = 0.9973
"""Share of the mechanisms that has to do what is asked, as of three standard deviations."""
SAMPLES = 20_000
"""Mechanisms that are tried: a share of 99.73 % is told to 0.1 %."""


@dataclass(frozen=True, eq=False)
class ComparedOutput:
    """An output as designed and with other tolerances.

    Parameters
    ----------
    output
        What it is.
    designed, half
        What 99.73 % of the mechanisms stay within, as designed and with the others; of a play that has to
        stay above 0, what they reach; mm or rad. ``designed`` is None where the design has none.
    limit
        What is asked, mm or rad; None where nothing is.
    kept
        Share within it; None without one.
    """

    output: Output
    designed: float | None
    half: float
    limit: float | None
    kept: float | None

    @property
    def is_kept(self) -> bool:
        """Whether 99.73 % of them do what is asked."""
        return self.kept is None or self.kept >= ALL_BUT


def compared(build: Build, tolerances: Tolerances, params: Parameters | None = None) -> list[ComparedOutput]:
    """The outputs of a build with other tolerances, and other parameters; none where there is no analysis."""
    samples = min(tolerances.settings.samples, SAMPLES)
    fewer = tolerances.settings.model_copy(update={"samples": samples})
    found = analysed(build, replace(tolerances, settings=fewer), params)
    if found is None:
        return []
    designed = build.made(drawn_analysis)
    before = {} if designed is None else {one.output.name: _worst(one) for one in designed.results}
    outputs = []
    for one in found.results:
        if (worst := _worst(one)) is not None:
            known = before.get(one.output.name)
            outputs.append(ComparedOutput(one.output, None if known is None else known[0], *worst))
    return outputs


def _worst(result: Result) -> tuple[float, float | None, float | None] | None:
    """What 99.73 % stay within, the limit, and the share within it, in the worst of the positions tried."""
    if not result.trials:
        return None
    above = result.output.stays_above
    trial = (min if above else max)(result.trials, key=lambda one: one.half_9973)
    return trial.half_9973, trial.limit, None if trial.kept is None else trial.kept.value
