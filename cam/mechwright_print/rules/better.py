"""The printer with which printed parts do what is asked."""

from bisect import bisect_left
from collections.abc import Sequence

from mechwright.contracts.finding import Change
from mechwright.pipeline import Build
from mechwright.pipeline.tolerances.compared import ComparedOutput
from mechwright_print.as_made import outputs_of
from mechwright_print.job.print_job import PrintJob

REAMED: Change = {"print.fits": "ream"}
"""Takes the printer's scatter out of the holes."""
SPREADS = (0.1, 0.07, 0.05, 0.03, 0.02, 0.01, 0.005)
"""Of printers that are tried where this one's is too large, mm: the last one is that of a good mill."""


def better_printer(build: Build, job: PrintJob, broken: Sequence[ComparedOutput]) -> str:
    """The largest spread with which outputs are kept, as a line for the file of the printer."""
    smaller = [spread for spread in SPREADS if spread < job.printer.spread]
    for reamed in (False, True):
        # The smaller the spread, the more is kept: the first of those with which it is, by halves.
        place = bisect_left(
            smaller, True, key=lambda spread: _are_kept(build, job, broken, spread=spread, reamed=reamed)
        )
        if place < len(smaller):
            also = 'set fits = "ream" in [print] and ' if reamed else "set "
            return f"{also}spread = {smaller[place]:g} in the file of the printer, with one that keeps it"
    return "make its limit in [tolerances] wider: no printer keeps it"


def _are_kept(
    build: Build, job: PrintJob, broken: Sequence[ComparedOutput], *, spread: float, reamed: bool
) -> bool:
    names = {one.output.name for one in broken}
    again = outputs_of(build, job, spread=spread, reamed=reamed)
    return all(one.is_kept for one in again if one.output.name in names)
