"""What the mechanism does with printed parts: the family's own analysis of tolerances, with a printer's.

Lengths between holes, centre distances and eccentricities scatter by 0.6 of a size: they are the middle of
two walls each. A wall stands off by half of a size. A joint has the play of its design, and what stands
around its bushing and its pin in holes that are printed.
"""

from dataclasses import dataclass

from mechwright.contracts.tolerance_settings import Tolerances, ToleranceSettings
from mechwright.contracts.tolerances import Contributor, Output, ToleranceModel, Zone
from mechwright.mechanics.tolerance import Analysis, Result, analyse
from mechwright.pipeline import Build
from mechwright.pipeline.tolerances.asked import analysis_of
from mechwright.pipeline.tolerances.table import TolerancesTable
from mechwright_print.job.print_job import PrintJob

MIDDLE = 0.6
"""Scatter of the middle of two walls in that of a size; handbook, unchecked."""
SAMPLES = 20_000
"""Mechanisms that are tried: a yield of 99.73 % is told to 0.1 %."""
ALL_BUT = 0.9973
"""Share of the prints that has to turn, as of three standard deviations."""


@dataclass(frozen=True)
class PrintedTolerances(Tolerances):
    """What a printer's sizes do, in place of those of ``[tolerances]``.

    Parameters
    ----------
    play
        What a joint has besides its own play, on the diameter, mm: that of the loosest printed hole.
    scatter
        Of that, plus and minus, mm.
    """

    play: float = 0.0
    scatter: float = 0.0

    def pin(self, name: str, diameter: float, own: float | str, *, member: bool = False) -> Contributor:
        """A joint with the play of the printed holes around it."""
        found = super().pin(name, diameter, own, member=member)
        if not self.scatter:
            return found
        more = Zone(self.play - self.scatter, self.play + self.scatter, self.settings.distribution)
        return Contributor(
            found.name, found.key, found.unit, found.nominal, (*found.zones, more), found.directions
        )


@dataclass(frozen=True, eq=False)
class PrintedOutput:
    """An output as designed and as printed.

    ``half`` is what 99.73 % of the mechanisms stay within; of a play that stays above 0, what they reach; mm
    or rad. ``kept`` is the share within what is asked, None where nothing is.
    """

    output: Output
    designed: float | None
    half: float
    limit: float | None
    kept: float | None

    @property
    def is_kept(self) -> bool:
        """Whether 99.73 % of the prints do what is asked."""
        return self.kept is None or self.kept >= ALL_BUT


class AsPrinted:
    """The outputs of a build whose parts are printed; none where its family has no analysis."""

    def __init__(self, build: Build) -> None:
        job = build.made(PrintJob)
        designed, printed = build.made(analysis_of), analysis(build, job)
        self.outputs: list[PrintedOutput] = []
        if printed is None:
            return
        known = {} if designed is None else {one.output.name: one for one in designed.results}
        for one in printed.results:
            if (found := _worst(one)) is not None:
                half, limit, kept = found
                before = _worst(known[one.output.name]) if one.output.name in known else None
                self.outputs.append(
                    PrintedOutput(one.output, None if before is None else before[0], half, limit, kept)
                )


def _worst(result: Result) -> tuple[float, float | None, float | None] | None:
    """What 99.73 % stay within, the limit, and the share within it, in the worst of the positions tried."""
    if not result.trials:
        return None
    above = result.output.stays_above
    trial = (min if above else max)(result.trials, key=lambda one: one.half_9973)
    return trial.half_9973, trial.limit, None if trial.kept is None else trial.kept.value


def analysis(build: Build, job: PrintJob) -> Analysis | None:
    """The family's analysis with the printer's tolerances; None where it has none."""
    model, tolerances = _model(build, printed_tolerances(build, job))
    if model is None:
        return None
    used = {key for one in model.contributors for key in one.key.split()}
    own = tolerances.settings.model_copy(
        update={
            key: field.default
            for key, field in ToleranceSettings.model_fields.items()
            if key in _SET and key not in used
        }
    )
    model, tolerances = _model(build, _with(tolerances, own))
    return None if model is None else analyse(model, tolerances)


_SET = ("length", "centre", "eccentricity", "gouge", "leftover")
"""Keys of ``[tolerances]`` that follow from the printer."""


def _with(tolerances: PrintedTolerances, settings: ToleranceSettings) -> PrintedTolerances:
    return PrintedTolerances(settings, tolerances.own, tolerances.play, tolerances.scatter)


def _model(build: Build, tolerances: PrintedTolerances) -> tuple[ToleranceModel | None, PrintedTolerances]:
    return build.design.family.tolerances(build.design.params, tolerances), tolerances


def printed_tolerances(build: Build, job: PrintJob) -> PrintedTolerances:
    """What the printer's scatter makes of lengths, walls and joints."""
    size = job.printer.scatter("wall")
    asked = build.design.table(TolerancesTable)
    middle = round(MIDDLE * size, 6)
    settings = asked.settings.model_copy(
        update={
            "length": middle,
            "centre": middle,
            "eccentricity": middle,
            "gouge": round(size / 2, 6),
            "leftover": round(size / 2, 6),
            "fit": None,
            "clearance": None,
            "samples": min(asked.settings.samples, SAMPLES),
        }
    )
    holes = [hole for one in job.parts for hole in one.made.holes if hole.fit is not None]
    loose = [hole.target - hole.fit.size for hole in holes if hole.fit is not None and hole.kind != "ream"]
    scatter = job.printer.scatter("hole") if loose else 0.0
    return PrintedTolerances(settings, {}, max([0.0, *loose]), scatter)
