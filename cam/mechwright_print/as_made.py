"""What the mechanism does with printed parts: the family's own analysis of tolerances, with a printer's.

A joint has the play of its design, and what stands around its bushing and its pin in holes that are printed.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING

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

        job = build.made(PrintJob)
        asked = build.design.table(TolerancesTable)
        tolerances = with_spread(asked, printed_spread(job, job.parts), over=True)
        self.outputs: list[ComparedOutput] = compared(build, tolerances)


def printed_spread(job: "PrintJob", parts: "Sequence[JobPart]") -> Spread:
    """How far printed parts stray, with the play of the loosest hole that has a fit and is not reamed."""
    holes = [hole for one in parts for hole in one.made.holes if hole.fit is not None]
    loose = [hole.target - hole.fit.size for hole in holes if hole.fit is not None and hole.kind != "ream"]
    scatter = job.printer.scatter("hole") if loose else 0.0
    return Spread(job.printer.scatter("wall"), 0.0, max([0.0, *loose]), scatter)
