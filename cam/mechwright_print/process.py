"""Printing as a process: ``process = "print"`` in a design file."""

from collections.abc import Sequence

from mechwright.contracts.finding import Finding, errors
from mechwright.contracts.part import Part
from mechwright.pipeline import Build
from mechwright.pipeline.process import Process, Spread
from mechwright_print.as_made import printed_spread
from mechwright_print.settings import PRINT


class Printing(Process):
    """Filament laid down in layers."""

    name = PRINT
    title = "the printer"

    def refuses(self, part: Part, build: Build) -> str | None:
        """The first error of its rules; fits are told as findings, each with its line."""
        from mechwright_print.job.print_job import PrintJob
        from mechwright_print.rules.judged import bed_rule, wall_rule

        job = build.made(PrintJob)
        one = job.of(part)
        found = errors([*bed_rule(job, one), *wall_rule(job, one)])
        return found[0].message if found else None

    def objections(self, part: Part, build: Build) -> Sequence[Finding]:
        """What its rules find of the part."""
        from mechwright_print.job.print_job import PrintJob
        from mechwright_print.rules.inspection import part_findings

        job = build.made(PrintJob)
        return part_findings(job, job.of(part))

    def loses(self, part: Part, build: Build) -> Sequence[str]:
        """The material, fits and threads."""
        from mechwright_print.job.print_job import PrintJob

        job = build.made(PrintJob)
        one = job.of(part)
        lost = [f"{job.printer.filament.upper()} in place of {part.material}, and little pull across layers"]
        fits = [hole.name for hole in one.made.holes if hole.fit is not None and not hole.is_finished]
        if fits:
            lost.append(f"the fits of {', '.join(fits)}: ±{job.printer.scatter('hole'):.2f} mm")
        if threads := [hole.name for hole in one.made.holes if hole.kind in {"insert", "screw", "tap"}]:
            lost.append(f"the threads of {', '.join(threads)}")
        return lost

    def spread(self, part: Part, build: Build) -> Spread | None:
        """The printer's scatter, and the play of holes that are wider than their fits."""
        from mechwright_print.job.print_job import PrintJob

        job = build.made(PrintJob)
        return printed_spread(job, [job.of(part)])

    def correction(self, off: float, walls: str, part: Part, build: Build) -> str:
        """Deviations in the file of the printer: of holes, and of outlines."""
        from mechwright_print.compensation.holes import round_holes
        from mechwright_print.job.print_job import PrintJob

        printer = build.made(PrintJob).printer
        said = []
        if walls != "outside":
            sizes = [bore.diameter for bore in round_holes(part)] or [0.0]
            hole = printer.hole_off(sum(sizes) / len(sizes))
            said.append(f"hole = {hole - 2 * off:.4f} (now {hole:g})")
        if walls != "inside":
            wall = printer.deviation.wall
            said.append(f"wall = {wall + 2 * off:.4f} (now {wall:g})")
        return f"set {' and '.join(said)} in [deviation] of the file of the printer"

    def seconds(self, part: Part, build: Build) -> float | None:
        """Filament by its volume and the printer's flow."""
        from mechwright_print.job.print_job import PrintJob

        return build.made(PrintJob).seconds(part)
