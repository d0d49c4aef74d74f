"""Filament by mass, inserts and tools of a print, for the bill of materials of the machine."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from mechwright.pipeline import Blank, Build, Feedstock, RawStock
from mechwright.standards.supply import Supply

if TYPE_CHECKING:
    from mechwright_print.job.print_job import PrintJob


class PrintStock(RawStock):
    """Where the design gives parts to the printer; turned parts take rods, as in every machine."""

    name = "print-stock"
    commands = frozenset({"build"})

    def blanks(self, build: Build) -> Sequence[Blank]:  # noqa: ARG002 - a printer has no plates
        """None."""
        return ()

    def feedstock(self, build: Build) -> Sequence[Feedstock]:
        """The filament of the printed parts."""
        from mechwright_print.pages.bill import laid_down

        job = _job(build)
        if job is None:
            return ()
        filament = job.printer.material.title
        return [Feedstock(filament, job.masses, f"{filament} filament", f"printed, {laid_down(job)}")]

    def supplies(self, build: Build, items: Mapping[str, int]) -> Sequence[Supply]:
        """Inserts, bushes, screws with nuts, reamers and taps of what is done after printing."""
        from mechwright_print.pages.bill import fittings

        job = _job(build)
        if job is None:
            return ()
        return [
            Supply(one.kind, one.name, f"for {_items(items, one.parts)}, after printing", one.qty, one.unit)
            for one in fittings(job)
        ]


def _job(build: Build) -> "PrintJob | None":
    """The print that a build writes; None where it prints nothing."""
    from mechwright_print.job.print_job import PrintJob, gives_parts

    return build.made(PrintJob) if gives_parts(build.design, build.parts) else None


def _items(items: Mapping[str, int], parts: Sequence[str]) -> str:
    found = sorted({items[name] for name in parts})
    return f"item{'s' if len(found) > 1 else ''} {', '.join(map(str, found))}"
