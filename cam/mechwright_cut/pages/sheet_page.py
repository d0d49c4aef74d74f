"""The page of all that is cut: sheets with their programs, or the order for a service; imports jinja2."""

import math
from pathlib import Path
from typing import Any

from markupsafe import Markup

from mechwright.contracts.materials import MATERIALS
from mechwright.output.svg import number, path, place
from mechwright.output.templates import templates
from mechwright_cut.cuts import Contour, WireContour
from mechwright_cut.cutting import Cutting, ProvenCut
from mechwright_cut.service.drawing import SUFFIX
from mechwright_cut.settings.services import services

ROLES = {"engrave": "mark", "inside": "opening", "common": "common line", "outside": "outside"}
AROUND = 5.0
"""Of the sheet that a picture shows around the parts, mm."""
FINE = 0.3
"""Chord error of pictures, mm."""


def cut_html(cutting: Cutting, design: str) -> str:
    """The page."""
    rules = services()[cutting.settings.service]
    finishing = {cut.part.name: cut.finishing for *_, cut in cutting.cut_parts if cut.finishing}
    orders = [
        {
            "file": cut.part.name + SUFFIX,
            "material": _ordered(cut.part.material),
            "thickness": f"{cut.part.thickness:g}",
            "count": max(1, len(cut.part.instances)),
            "size": _size(cut.outline.bounds),
        }
        for cut in cutting.ordered
    ]
    own = "The service allows for its kerf: the drawing is the finished part."
    theirs = f"Outside the metals a path is the middle of a kerf of {rules.kerf_width:g} mm."
    return (
        templates(Path(__file__).parent)
        .get_template("sheet.html")
        .render(
            design=design,
            service=rules.words,
            sheets=[_sheet(one) for one in cutting.programs],
            orders=orders,
            kerf=own if rules.kerf == "service" else theirs,
            finishing=list(finishing.items()),
        )
    )


def _ordered(material: str) -> str:
    return MATERIALS[material].grades.plate if material in MATERIALS else material


def _size(bounds: tuple[float, float, float, float]) -> str:
    x0, y0, x1, y1 = bounds
    return f"{x1 - x0:.1f} × {y1 - y0:.1f}"


def minutes(item: ProvenCut) -> float | None:
    """Time, min: of a beam by its feeds and pierces, of a wire by the rate of its machine, or else None."""
    settings = item.job.settings
    if item.suffix == ".iso":
        walls = item.job.thickness * sum(one.length for one in item.contours)
        return None if settings.wire_rate is None else walls / settings.wire_rate
    marks = sum(one.length for one in item.contours if one.role == "engrave")
    cuts = sum(one.length for one in item.contours if one.role != "engrave")
    pierces = sum(one.pierces for one in item.contours if isinstance(one, Contour))
    again = settings.passes * (cuts / settings.feed + pierces * settings.pierce / 60)
    return again + marks / settings.engrave_feed


def _sheet(item: ProvenCut) -> dict[str, Any]:
    job, time = item.job, minutes(item)
    return {
        "name": item.name,
        "file": item.name + item.suffix,
        "minutes": "" if time is None else f", {time:.1f} min",
        "process": job.process.words,
        "material": _ordered(job.material),
        "thickness": f"{job.thickness:g}",
        "length": f"{job.size[0]:g}",
        "width": f"{job.size[1]:g}",
        "picture": Markup(_picture(item)),  # noqa: S704 - drawn here, of numbers
        "steps": _steps(item),
        "contours": [
            {"name": one.name, "role": ROLES[one.role], "length": one.length} for one in item.contours
        ],
        "proof": f"Proven from its text: {'; '.join(c.message for c in item.proof.checks if c.message)}.",
    }


def _steps(item: ProvenCut) -> list[str]:
    job, settings = item.job, item.job.settings
    kerf = job.kerf
    laser = job.process.name.endswith("laser")
    lines = [
        "Set X0 Y0 at the lower left corner of the sheet; the program has no Z: set the focus by hand."
        if laser
        else "Set X0 Y0 at the lower left corner of the sheet.",
        f"The kerf is {kerf.width:g} mm ({kerf.source}). Cut one square of 20 mm on its line and measure it: "
        "what it lacks is the kerf; set cut.kerf."
        if not kerf.measured
        else f"The kerf is {kerf.width:g} mm ({kerf.source}).",
    ]
    if settings.passes > 1 and item.suffix != ".iso":
        lines.append(f"Each contour is run {settings.passes} times.")
    if item.suffix == ".nc":
        lines.append(f"Grbl: $32=1 and $30={settings.full_power} now; $32=0 again before milling.")
    if item.suffix == ".iso":
        registers = enumerate(settings.registers(kerf.width), start=1)
        lines.append(f"Enter {', '.join(f'D{n} = {value:g} mm' for n, value in registers)}.")
        lines.append(
            f"Drill start holes of {settings.start_hole:g} mm where the picture has dots. The program stops "
            "(M1) before each tab: hold what falls."
        )
    if laser:
        lines.append("Switch on air and extraction. Stay beside it until the last piece is cold.")
    if job.common:
        lines.append(
            f"{len(job.common)} common lines are cut before the outsides: each is an edge of two parts. Its "
            "cut is one kerf wide, so that another kerf changes both parts."
        )
    if settings.joints and job.process.joints:
        lines.append(f"Each part hangs on {settings.joints} micro-joints: break it out, and file them off.")
    if job.process.taper >= 0.05:
        lines.append(
            f"The faces differ by up to {job.process.taper:g} mm: the face that is up here is the drawn one."
        )
    return lines


def _picture(item: ProvenCut) -> str:
    drawn = []
    every = [piece.outline.bounds for piece in item.job.pieces]
    x0, y0 = (min(box[k] for box in every) - AROUND for k in (0, 1))
    x1, y1 = (max(box[k] for box in every) + AROUND for k in (2, 3))
    for piece in item.job.pieces:
        polygon = piece.outline.polygon(FINE / 10)
        rings = [polygon.exterior, *polygon.interiors]
        data = "".join(path(list(ring.simplify(FINE / 3).coords)[:-1], close=True) for ring in rings)
        drawn.append(f'<path class="kept" fill-rule="evenodd" d="{data}"/>')
    for contour in item.contours:
        kind = "mark" if contour.role == "engrave" else "beam"
        for stroke in contour.strokes:
            points = stroke.points(max(FINE, math.sqrt(stroke.length) / 20)).tolist()
            drawn.append(f'<path class="{kind}" d="{path(points)}"/>')
        if kind == "beam" and (isinstance(contour, WireContour) or contour.pierces):
            x, y = place(*contour.start).split(",")
            drawn.append(f'<circle class="pierce" cx="{x}" cy="{y}" r="0.8"/>')
    return (
        f'<svg viewBox="{number(x0)} {number(-y1)} {number(x1 - x0)} {number(y1 - y0)}" role="img" '
        f'aria-label="The corner of the sheet with its parts and the way of the beam">{"".join(drawn)}</svg>'
    )
