"""The printed parts: a 3MF file for each bed, an STL file for each part, and the sheet."""

from typing import TYPE_CHECKING

from mechwright.pipeline import Build, FileName, Page, Wanted
from mechwright_print.settings import PRINT

if TYPE_CHECKING:
    from mechwright_print.job.print_job import PrintJob

SHEET = "print.html"
"""The sheet."""
BILL = "print-bill.csv"
"""What is needed besides the printer."""
MESH = ".print.stl"
"""Ending of the mesh of a part as it is printed: ``--also stl`` writes parts as they are drawn."""


class PrintFiles(Page):
    """``plate-1.3mf`` and on, ``NAME.print.stl``, ``print.html`` and ``print-bill.csv``.

    ``build`` has them where the design gives plates to the printer.
    """

    name = "print"
    commands = frozenset({"print", "build"})
    doing = "printed parts"
    share = 10.0

    def names(self, build: Build, wanted: Wanted) -> list[FileName]:
        """The meshes, the sheet and the bill; one bed at least."""
        from mechwright_print.job.print_job import PrintJob

        if not _wanted(build, wanted):
            return []
        job = build.made(PrintJob)
        own = [FileName(one.part.name + MESH, f"part {one.part.name} as printed") for one in job.parts]
        beds = [FileName("plate-1.3mf", "the first bed")] if own else []
        rest = [FileName(SHEET, "the sheet of the print"), FileName(BILL, "its bill")] if own else []
        return [*own, *beds, *rest]

    def files(self, build: Build) -> dict[str, str | bytes]:
        """Name to content; raises GeometryError where a mesh cannot be made."""
        from mechwright_print.job.print_job import PrintJob

        job = build.made(PrintJob) if _wanted(build, build.wanted) else None
        return _files(build, job) if job is not None and job.parts else {}


def _files(build: Build, job: "PrintJob") -> dict[str, str | bytes]:
    """The files of a job with parts; imports the CAD kernel."""
    from mechwright_cad.exporters.mesh import stl_of
    from mechwright_print.as_made import AsPrinted
    from mechwright_print.pages.bill import bill_csv, bill_lines
    from mechwright_print.pages.sheet import sheet_html
    from mechwright_print.rules.inspection import findings_of

    found = build.made(findings_of)
    lines = bill_lines(job)
    plates = {f"plate-{number}.3mf": plate_file(job, number) for number in range(1, len(job.beds) + 1)}
    meshes = {name + MESH: stl_of(name, mesh.mesh) for name, mesh in job.meshes.items()}
    return {
        **plates,
        **meshes,
        SHEET: sheet_html(job, found, lines, build.made(AsPrinted)),
        BILL: bill_csv(lines),
    }


def _wanted(build: Build, wanted: Wanted) -> bool:
    """Whether a command writes printed parts: ``print`` does, others where the design gives plates to it."""
    from mechwright_print.job.print_job import gives_parts

    return wanted.command == PRINT or gives_parts(build.design, build.parts)


def plate_file(job: "PrintJob", number: int) -> bytes:
    """The 3MF file of a bed, by its number from 1: an object for each part, an item for each copy."""
    from mechwright_cad.exporters.threemf import BuildItem, MeshObject, package

    bed = job.beds[number - 1]
    names = list(dict.fromkeys(one.name for one in bed))
    parts = {one.part.name: one.part for one in job.parts}
    filament = job.printer.material.title
    objects = [MeshObject(name, job.meshes[name].mesh, filament, parts[name].colour) for name in names]
    items = [BuildItem(names.index(one.name), one.transform) for one in bed]
    return package(f"{job.design.name}, plate {number}", objects, items)
