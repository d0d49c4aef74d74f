"""The sheet of a print: beds, parts, holes, what is corrected, what is done afterwards. Imports jinja2."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from mechwright.contracts.finding import Finding, Severity
from mechwright.output.templates import templates
from mechwright.pipeline.tolerances.units import percent, shown, shown_unit
from mechwright_cad.solids.tessellate import Mesh
from mechwright_print.as_made import AsPrinted
from mechwright_print.compensation.holes import PrintedHole, operations
from mechwright_print.job.print_job import PrintJob, copies
from mechwright_print.meshes.laid_out import Placed
from mechwright_print.meshes.stacked import manifold_of
from mechwright_print.pages.bill import BillLine
from mechwright_print.printer.settings import Printer
from mechwright_print.rules.faces import overhanging_area

SHADOW = 0.05
"""Bodies are shown from above within this, mm."""


@dataclass(frozen=True)
class BedPicture:
    """A bed as SVG has it: y downwards."""

    number: int
    outlines: tuple[str, ...]
    boxes: tuple[Placed, ...]


@dataclass(frozen=True)
class HoleRow:
    """A hole of the sheet: drawn, printed and model diameter, and the play of a shaft of its size, mm."""

    hole: PrintedHole
    model: float
    play: tuple[float, float] | None


def sheet_html(job: PrintJob, found: Sequence[Finding], bill: Sequence[BillLine], running: AsPrinted) -> str:
    """The page: one file without network or script."""
    parts: list[dict[str, Any]] = [
        {
            "name": one.part.name,
            "copies": copies(one.part),
            "size": job.meshes[one.part.name].size,
            "on_top": one.on_top,
            "foot": job.meshes[one.part.name].foot,
            "mass": job.masses[one.part.name],
            "minutes": job.seconds(one.part) / 60,
            "exact": one.part.outline is not None,
            "bores": bool(one.made.holes),
            "overhang": overhanging_area(job.meshes[one.part.name]) if one.part.outline is None else 0.0,
        }
        for one in job.parts
    ]
    holes = [hole_row(hole, job) for one in job.parts for hole in one.made.holes]
    return (
        templates(Path(__file__).parent)
        .get_template("print.html")
        .render(
            name=job.design.name,
            printer=job.printer,
            settings=job.settings,
            parts=parts,
            holes=holes,
            beds=[bed_picture(job, number) for number in range(1, len(job.beds) + 1)],
            operations=[line for one in job.parts for line in operations(list(one.made.holes))],
            told=[one for one in found if one.severity is not Severity.NOTE],
            notes=[one for one in found if one.severity is Severity.NOTE],
            bill=bill,
            running=running.outputs,
            shown=shown,
            shown_unit=shown_unit,
            percent=percent,
            deviations=deviations(job.printer),
            mass=sum(part["mass"] * part["copies"] for part in parts),
            minutes=sum(part["minutes"] * part["copies"] for part in parts),
        )
    )


def hole_row(hole: PrintedHole, job: PrintJob) -> HoleRow:
    """The row of a hole; the shaft is as large as the basic size of its fit."""
    correct = job.settings.compensate == "model"
    model = hole.target - (job.printer.hole_off(hole.target) if correct else 0.0)
    if hole.fit is None or hole.is_finished:
        return HoleRow(hole, model, None)
    scatter, middle = job.printer.scatter("hole"), hole.target - hole.fit.size
    return HoleRow(hole, model, (middle - scatter, middle + scatter))


def deviations(printer: Printer) -> list[tuple[str, str]]:
    """What is corrected, in words and figures."""
    off = printer.deviation
    hole = "by diameter" if off.hole is None else f"{off.hole:+.3f} mm"
    return [
        ("diameter of round holes", hole),
        ("width of slots", f"{off.slot:+.3f} mm"),
        ("diameter of pins", f"{off.pin:+.3f} mm"),
        ("width of walls, outlines, teeth", f"{off.wall:+.3f} mm"),
        ("first layer, each side", f"{off.foot:+.3f} mm"),
        ("lengths along X, Y", f"{100 * (off.scale_x - 1):+.2f} %, {100 * (off.scale_y - 1):+.2f} %"),
    ]


def bed_picture(job: PrintJob, number: int) -> BedPicture:
    """The outlines of the parts on a bed, from above."""
    beds = job.beds[number - 1]
    models = {one.part.name: one.made.model for one in job.parts}
    outlines = []
    for one in beds:
        mesh = job.meshes[one.name]
        outline = models[one.name].outline
        if outline is None:
            there = Mesh(mesh.mesh.points @ one.transform[:3] + one.transform[3], mesh.mesh.triangles)
            rings = manifold_of(there).project().simplify(SHADOW).to_polygons()
            outlines.append("".join(_path(np.asarray(ring), job) for ring in rings))
            continue
        drawn = ""
        for loop in outline.loops:
            points = np.column_stack((loop.flatten(0.05), np.zeros(len(loop.flatten(0.05)))))
            there = mesh.moved(points) @ one.transform[:3] + one.transform[3]
            drawn += _path(there[:, :2], job)
        outlines.append(drawn)
    return BedPicture(number, tuple(outlines), tuple(beds))


def _path(points: "np.ndarray[tuple[int, ...], np.dtype[np.float64]]", job: PrintJob) -> str:
    corners = " ".join(f"{x:.2f},{job.printer.bed.y - y:.2f}" for x, y in points.tolist())
    return f"M{corners}Z"
