"""What the mechanism does with printed parts: the family's own analysis of tolerances, with a printer's.

Lengths between holes, centre distances and eccentricities scatter by 0.6 of a size: they are the middle of
two walls each. A wall stands off by half of a size. A joint has the play of its design, and what stands
around its bushing and its pin in holes that are printed.
"""

from dataclasses import dataclass

from mechwright.contracts.parameters import Parameters
from mechwright.contracts.tolerance_settings import Tolerances
from mechwright.contracts.tolerances import Contributor, Zone
from mechwright.pipeline import Build
from mechwright.pipeline.tolerances.compared import ComparedOutput, compared
from mechwright.pipeline.tolerances.table import TolerancesTable
from mechwright_print.job.print_job import PrintJob

MIDDLE = 0.6
"""Scatter of the middle of two walls in that of a size; handbook, unchecked."""


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

    def pin(
        self, name: str, diameter: float, own: float | str, *, member: bool = False, joint: str = ""
    ) -> Contributor:
        """A joint with the play of the printed holes around it."""
        found = super().pin(name, diameter, own, member=member, joint=joint)
        if not self.scatter:
            return found
        more = Zone(self.play - self.scatter, self.play + self.scatter, self.settings.distribution)
        return Contributor(
            found.name, found.key, found.unit, found.nominal, (*found.zones, more), found.directions
        )


class AsPrinted:
    """The outputs of a build whose parts are printed; none where its family has no analysis."""

    def __init__(self, build: Build) -> None:
        self.outputs: list[ComparedOutput] = outputs_of(build, build.made(PrintJob))


_SET = ("length", "centre", "eccentricity", "gouge", "leftover")
"""Keys of ``[tolerances]`` that follow from the printer."""


def outputs_of(
    build: Build,
    job: PrintJob,
    *,
    params: Parameters | None = None,
    spread: float | None = None,
    reamed: bool = False,
) -> list[ComparedOutput]:
    """The outputs with other parameters, a printer of another spread, mm, or with all holes reamed."""
    return compared(build, printed_tolerances(build, job, spread=spread, reamed=reamed), _SET, params)


def printed_tolerances(
    build: Build, job: PrintJob, *, spread: float | None = None, reamed: bool = False
) -> PrintedTolerances:
    """What a printer's scatter makes of lengths, walls and joints."""
    printer = job.printer if spread is None else job.printer.model_copy(update={"spread": spread})
    size = printer.scatter("wall")
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
        }
    )
    holes = [hole for one in job.parts for hole in one.made.holes if hole.fit is not None]
    loose = [hole.target - hole.fit.size for hole in holes if hole.fit is not None and not hole.is_finished]
    if reamed:
        loose = []
    scatter = printer.scatter("hole") if loose else 0.0
    return PrintedTolerances(settings, {}, max([0.0, *loose]), scatter)
