"""A design with other tolerances than its own: those of a process, or of parts that were measured."""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import TypeVar

from mechwright.contracts.parameters import Parameters
from mechwright.contracts.tolerance_settings import Tolerances, ToleranceSettings
from mechwright.contracts.tolerances import Output
from mechwright.mechanics.tolerance import Analysis, Result, analyse
from mechwright.pipeline.build import Build
from mechwright.pipeline.tolerances.asked import analysis_of

T = TypeVar("T", bound=Tolerances)

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


def compared(
    build: Build, tolerances: Tolerances, set_: Iterable[str], params: Parameters | None = None
) -> list[ComparedOutput]:
    """The outputs of a build with other tolerances; none where its family has no analysis.

    ``set_`` are the keys of the settings that are not the design's: those on which nothing depends go back to
    their defaults. ``params`` are other parameters than the design's.
    """
    found = _analysis(build, tolerances, set_, params)
    if found is None:
        return []
    designed = build.made(analysis_of)
    before = {} if designed is None else {one.output.name: _worst(one) for one in designed.results}
    outputs = []
    for one in found.results:
        if (worst := _worst(one)) is not None:
            known = before.get(one.output.name)
            outputs.append(ComparedOutput(one.output, None if known is None else known[0], *worst))
    return outputs


def _analysis(build: Build, tolerances: T, set_: Iterable[str], params: Parameters | None) -> Analysis | None:
    family = build.design.family
    params = build.design.params if params is None else params
    model = family.tolerances(params, tolerances)
    if model is None:
        return None
    used = {key for one in model.contributors for key in one.key.split()}
    fields = ToleranceSettings.model_fields
    changes = {key: fields[key].default for key in set_ if key not in used}
    changes["samples"] = min(tolerances.settings.samples, SAMPLES)
    tolerances = replace(tolerances, settings=tolerances.settings.model_copy(update=changes))
    again = family.tolerances(params, tolerances)
    return None if again is None else analyse(again, tolerances)


def _worst(result: Result) -> tuple[float, float | None, float | None] | None:
    """What 99.73 % stay within, the limit, and the share within it, in the worst of the positions tried."""
    if not result.trials:
        return None
    above = result.output.stays_above
    trial = (min if above else max)(result.trials, key=lambda one: one.half_9973)
    return trial.half_9973, trial.limit, None if trial.kept is None else trial.kept.value
