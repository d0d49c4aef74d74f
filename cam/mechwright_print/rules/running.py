"""Whether the printed mechanism runs: flanks of gears, plays over the spread, errors beyond limits."""

from collections.abc import Iterator

from mechwright.contracts.finding import Finding
from mechwright.pipeline import Build
from mechwright.pipeline.tolerances import running
from mechwright_print.as_made import AsPrinted, outputs_of
from mechwright_print.job.print_job import PrintJob
from mechwright_print.rules.better import REAMED, better_printer
from mechwright_print.rules.holes import MEASURE


def _wording(build: Build, job: PrintJob) -> running.Wording:
    measured = job.printer.measured
    return running.Wording(
        code="print",
        parts="prints",
        key="print.fits",
        kind=Finding.error if measured else Finding.warning,
        otherwise=lambda broken: better_printer(build, job, broken),
        again=lambda params, change: outputs_of(build, job, params=params, reamed="print.fits" in change),
        tail="" if measured else MEASURE,
        tighter=None if job.settings.fits == "ream" else REAMED,
    )


def backlash_rule(build: Build, job: PrintJob) -> Iterator[Finding]:
    """Teeth have more backlash than their flanks scatter, where the family does not analyse it."""
    need = job.printer.scatter("wall", "wall")
    yield from running.backlash_rule(build, _wording(build, job), build.made(AsPrinted).outputs, need)


def running_rule(build: Build, job: PrintJob) -> Iterator[Finding]:
    """What the family's analysis says of prints that jam, or miss what is asked by more than they may."""
    yield from running.running_rule(build, _wording(build, job), build.made(AsPrinted).outputs)


RUNNING = (backlash_rule, running_rule)
"""Rules of the whole mechanism."""
