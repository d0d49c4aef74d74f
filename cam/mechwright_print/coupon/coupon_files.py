"""The files of the coupon: its pieces on the bed, their meshes, the sheet and the table."""

from pathlib import Path

import numpy as np

from mechwright.contracts.part import Bore, Part, Pocket, Profile
from mechwright.errors import DesignError
from mechwright.output.templates import templates
from mechwright_cad.exporters.mesh import stl_of
from mechwright_cad.exporters.threemf import BuildItem, MeshObject, package
from mechwright_print.compensation.plates import Compensated
from mechwright_print.coupon.features import GAPS, ROWS, UP, WORDS, trial_name
from mechwright_print.coupon.filled import TRIAL_HOW, empty_table
from mechwright_print.coupon.pieces import pieces
from mechwright_print.meshes.laid_out import laid_out
from mechwright_print.meshes.printed_mesh import printed_mesh
from mechwright_print.printer.settings import Printer

SHEET, TABLE = "coupon.html", "coupon.csv"
GAP = 5.0
"""Between the pieces on the bed, mm."""
_ROOMY = 9.0
"""A hole that is wider has its label inside, mm."""
COLOUR = (0.75, 0.82, 0.9)


def coupon_files(printer: Printer) -> dict[str, str | bytes]:
    """Name to content; raises DesignError where the bed is too small for a piece."""
    parts = pieces()
    meshes = {
        part.name: printed_mesh(Compensated(part, part, part), printer, on_top=False, correct=False)
        for part in parts
    }
    try:
        beds = laid_out([(name, mesh, 1) for name, mesh in meshes.items()], printer.bed, GAP, turn=False)
    except DesignError as error:
        raise DesignError(f"the coupon: {error}") from error
    files: dict[str, str | bytes] = {}
    for number, bed in enumerate(beds, start=1):
        names = [one.name for one in bed]
        objects = [MeshObject(name, meshes[name].mesh, printer.material.title, COLOUR) for name in names]
        items = [BuildItem(place, one.transform) for place, one in enumerate(bed)]
        files[f"coupon-{number}.3mf"] = package(f"coupon, plate {number}", objects, items)
    files |= {f"{name}.stl": stl_of(name, mesh.mesh) for name, mesh in meshes.items()}
    return {**files, SHEET: sheet_html(printer, parts, len(beds)), TABLE: empty_table()}


def sheet_html(printer: Printer, parts: list[Part], beds: int) -> str:
    """The sheet: a picture of each piece with the names of its features, and the rows to write on."""
    return (
        templates(Path(__file__).parent)
        .get_template("coupon.html")
        .render(
            printer=printer,
            beds=beds,
            pictures=[_picture(part) for part in parts],
            rows=[
                *((row.name, f"{row.nominal:g}", row.how) for row in ROWS),
                *((trial_name(gap), f"{gap:.2f}", TRIAL_HOW) for gap in GAPS),
            ],
            words=WORDS,
            up=UP,
            table=TABLE,
        )
    )


def _picture(part: Part) -> dict[str, object]:
    """A plate from above as SVG has it, y downwards: paths, labels and the view."""
    assert part.outline is not None  # noqa: S101 - the pieces are plates
    x0, y0, x1, y1 = part.outline.bounds
    paths = [(_path(loop.flatten(0.05)), "rim") for loop in part.outline.loops]
    labels = []
    for feature in part.features:
        if isinstance(feature, Bore):
            below = feature.diameter / 2 + 3.0 if feature.diameter < _ROOMY else 0.0
            labels.append((feature.centre[0], feature.centre[1] - below, feature.name.partition("-")[2]))
        elif isinstance(feature, Profile) and feature.side == "inside":
            a0, b0, a1, b1 = feature.loop.bounds
            tall = b1 - b0 > a1 - a0
            text = feature.name.removeprefix("slot-")
            labels.append(((a0 + a1) / 2, b0 - 3.0, text) if tall else (x0 - 4.0, (b0 + b1) / 2, text))
        elif isinstance(feature, Pocket):
            for island in feature.islands:
                paths.append((_path(island.flatten(0.05)), "island"))
                a0, b0, a1, b1 = island.bounds
                labels.append(((a0 + a1) / 2, b0 - 3.0, f"{round(min(a1 - a0, b1 - b0), 2):g}"))
    return {
        "name": part.name,
        "view": f"{x0 - 8:.1f} {-y1 - 4:.1f} {x1 - x0 + 12:.1f} {y1 - y0 + 8:.1f}",
        "width": x1 - x0 + 12,
        "paths": paths,
        "labels": [(x, -y, text) for x, y, text in labels],
    }


def _path(points: "np.ndarray[tuple[int, ...], np.dtype[np.float64]]") -> str:
    return "M" + " ".join(f"{x:.2f},{-y:.2f}" for x, y in points.tolist()) + "Z"
