"""What the mechanism does with printed parts: the family's own analysis of tolerances, with a printer's.

A joint has the play of its design, and what stands around its bushing and its pin in holes that are printed.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from mechwright.contracts.parameters import Parameters
from mechwright.pipeline import Build
from mechwright.pipeline.process import Spread
from mechwright.pipeline.tolerances.by_process import with_spread
from mechwright.pipeline.tolerances.compared import ComparedOutput, compared
from mechwright.pipeline.tolerances.table import TolerancesTable

if TYPE_CHECKING:
    from mechwright_print.job.print_job import JobPart, PrintJob


class AsPrinted:
    """The outputs of a build whose parts are printed; none where its family has no analysis."""

    def __init__(self, build: Build) -> None:
        from mechwright_print.job.print_job import PrintJob

        self.outputs: list[ComparedOutput] = outputs_of(build, build.made(PrintJob))


def outputs_of(
    build: Build,
    job: "PrintJob",
    *,
    params: Parameters | None = None,
    spread: float | None = None,
    reamed: bool = False,
) -> list[ComparedOutput]:
    """The outputs with other parameters, a printer of another spread, mm, or with all holes reamed."""
    asked = build.design.table(TolerancesTable)
    own = printed_spread(job, job.parts, spread=spread, reamed=reamed)
    return compared(build, with_spread(asked, own, over=True), params)


def printed_spread(
    job: "PrintJob", parts: "Sequence[JobPart]", *, spread: float | None = None, reamed: bool = False
) -> Spread:
    """How far printed parts stray, with the play of the loosest hole that has a fit and is not finished."""
    printer = job.printer if spread is None else job.printer.model_copy(update={"spread": spread})
    holes = [] if reamed else [hole for one in parts for hole in one.made.holes if hole.fit is not None]
    loose = [hole.target - hole.fit.size for hole in holes if hole.fit is not None and not hole.is_finished]
    scatter = printer.scatter("hole") if loose else 0.0
    return Spread(printer.scatter("wall"), 0.0, max([0.0, *loose]), scatter)
