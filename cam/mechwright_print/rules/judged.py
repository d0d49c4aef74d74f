"""What the rules of printing say of a job, part by part, before any mesh is made.

Each rule is a generator of findings of the stage ``machining``. Errors are what cannot be printed; warnings
are what comes out worse than drawn.
"""

import math
from collections.abc import Iterator

from mechwright.contracts.details import Engraving
from mechwright.contracts.finding import Change, Finding
from mechwright.contracts.part import Part
from mechwright.designs.design import Design
from mechwright.errors import MechwrightError
from mechwright.tolerances import exceeds
from mechwright_print.job.print_job import JobPart, PrintJob
from mechwright_print.printer.facts import BRIDGE, LINES, STEEP
from mechwright_print.printer.settings import Printer
from mechwright_print.rules.faces import hanging_faces
from mechwright_print.rules.walls import Narrow, narrowest

NOZZLES = (0.6, 0.5, 0.4, 0.3, 0.25, 0.2, 0.15, 0.1)
"""Nozzles that are sold, mm."""
OFF_LAYER = 0.25
"""A height may miss the layers by this share of one: the rest is rounded by the slicer."""


def least_wall(printer: Printer) -> float:
    """Width of the thinnest wall that has two sides, mm."""
    return LINES * printer.line_width


def wall_rule(job: PrintJob, one: JobPart) -> Iterator[Finding]:
    """Walls, teeth and pins take two lines; an error where the nozzle does not enter them at all."""
    printer = job.printer
    limit = least_wall(printer)
    thin = narrowest(one.made.printed, limit, "wall")
    if thin is not None:
        yield _thin(job.design, one.part, thin, printer)


def _thin(design: Design, part: Part, thin: Narrow, printer: Printer) -> Finding:
    limit = least_wall(printer)
    able = next(
        (size for size in NOZZLES if LINES * size * printer.line_width / printer.nozzle <= thin.width), None
    )
    larger, proposed = _larger(design, part, thin.width, printer)
    ways = [larger] if larger else []
    if able is not None:
        ways.append(f"set nozzle = {able:g} in the file of the printer, with that nozzle")
    kind = Finding.error if thin.width < printer.nozzle else Finding.warning
    key = next(iter(proposed[0])) if proposed else "print.printer"
    return kind(
        "print.thin-wall",
        key,
        f"{part.name} is {thin.width:.2f} mm wide at X{thin.x:.1f} Y{thin.y:.1f}, and two lines of this "
        f"printer take {limit:.2f} mm (nozzle {printer.nozzle:g} mm)",
        thin.width,
        limit,
        "mm",
        " or ".join(ways) or "make that wall thicker",
        proposed=proposed,
    )


def _larger(design: Design, part: Part, width: float, printer: Printer) -> tuple[str, tuple[Change, ...]]:
    """The line by which the whole mechanism grows, where its family has one size for all, and that helps."""
    limit = least_wall(printer)
    for key in design.family.size_keys:
        value = getattr(design.params, key, None)
        if isinstance(value, (int, float)) and not isinstance(value, bool):
            for factor in (limit / width, (limit / width) ** 2):
                made = math.ceil(value * factor * 10) / 10
                change: Change = {f"parameters.{key}": made}
                if _is_wide(design, change, part, limit):
                    return f"set {key} = {made:g}", (change,)
            break
    return "", ()


def _is_wide(design: Design, change: Change, part: Part, limit: float) -> bool:
    """Whether a part has no wall below a limit, mm, once the design is changed."""
    try:
        parts = design.changed(change, settle=False).parts()
    except MechwrightError:
        return False
    return all(narrowest(one, limit, "wall") is None for one in parts if one.name == part.name)


def gap_rule(job: PrintJob, one: JobPart) -> Iterator[Finding]:
    """Openings are wider than the lines beside them run over."""
    limit = job.printer.nozzle / 2
    thin = narrowest(one.made.printed, limit, "gap")
    if thin is not None:
        yield Finding.warning(
            "print.narrow-gap",
            "print.printer",
            f"an opening of {one.part.name} is {thin.width:.2f} mm wide at X{thin.x:.1f} Y{thin.y:.1f}: "
            f"below {limit:.2f} mm, half a nozzle, its walls grow together",
            thin.width,
            limit,
            "mm",
            "make the opening wider, or cut it free by hand",
        )


def bed_rule(job: PrintJob, one: JobPart) -> Iterator[Finding]:
    """The part fits on the bed, lying flat."""
    part, bed = one.part, job.printer.bed
    if part.outline is None:
        return
    x0, y0, x1, y1 = part.outline.bounds
    sides = sorted((x1 - x0, y1 - y0))
    room = sorted((bed.x - 2 * bed.margin, bed.y - 2 * bed.margin))
    if exceeds(sides[0], room[0]) or exceeds(sides[1], room[1]) or exceeds(part.thickness, bed.z):
        needs = [math.ceil(side + 2 * bed.margin) for side in sides]
        yield Finding.error(
            "print.bed",
            "print.printer",
            f"{part.name} takes {sides[1]:.1f} x {sides[0]:.1f} x {part.thickness:g} mm, and the bed has "
            f"{room[1]:g} x {room[0]:g} x {bed.z:g} mm within its margin",
            sides[1],
            room[1],
            "mm",
            f"take a printer with a bed of {needs[1]} x {needs[0]} mm, or give the part to another process: "
            f'process = {{ default = "print", parts.{part.name} = "mill" }}',
        )


def layer_rule(job: PrintJob, one: JobPart) -> Iterator[Finding]:
    """Thickness and depths are whole layers."""
    printer, part = job.printer, one.part
    if part.outline is None:
        return
    heights = {"thickness": part.thickness}
    heights |= {f"floor of {one.name}": part.thickness - one.top - one.depth for one in part.features}
    for what, height in heights.items():
        if height <= 0 or height > part.thickness:
            continue
        layers = (height - printer.first) / printer.layer
        off = (layers - round(layers)) * printer.layer
        if abs(off) > OFF_LAYER * printer.layer:
            yield Finding.warning(
                "print.layers",
                "print.printer",
                f"{part.name}: the {what} is {height:g} mm above the bed, {abs(off):.2f} mm off a whole "
                f"number of layers (first {printer.first:g}, then {printer.layer:g} mm)",
                abs(off),
                OFF_LAYER * printer.layer,
                "mm",
                f"set first_layer = {_first(height, printer):g} in the file of the printer",
            )
            return


def _first(height: float, printer: Printer) -> float:
    """The height of a first layer with which a height is whole layers, near to the printer's own."""
    rest: float = height % printer.layer
    options = [rest + k * printer.layer for k in range(-1, 4)]
    able = [one for one in options if 0.5 * printer.layer < one <= 1.6 * printer.layer]
    near: float = min(able or [printer.first], key=lambda one: abs(one - printer.first))
    return round(near, 3)


def bridge_rule(job: PrintJob, one: JobPart) -> Iterator[Finding]:
    """Level faces over nothing are told; longer bridges than filament spans are a warning."""
    part = one.part
    if part.outline is None:
        return
    faces = hanging_faces(one.made.printed, on_top=one.on_top)
    if not faces:
        return
    worst = max(faces, key=lambda face: face.span)
    said = (
        f"{part.name} has {len(faces)} face{'s' if len(faces) > 1 else ''} over nothing as it lies; the "
        f"widest is {worst.span:.1f} mm across, {worst.height:g} mm above the bed"
    )
    if worst.span <= BRIDGE:
        yield Finding.note("print.bridge", said, worst.span, "mm")
        return
    names = [name for name in job.settings.flip if name != part.name]
    flipped = names if one.on_top else [*names, part.name]
    other = hanging_faces(one.made.printed, on_top=not one.on_top)
    better = max((face.span for face in other), default=0.0) < worst.span
    listed = ", ".join(f'"{name}"' for name in flipped)
    yield Finding.warning(
        "print.bridge",
        "print.flip",
        said,
        worst.span,
        BRIDGE,
        "mm",
        f"set flip = [{listed}] in [print]" if better else "print it with support",
        proposed=({"print.flip": tuple(flipped)},) if better else (),
    )


def loss_rule(job: PrintJob, one: JobPart) -> Iterator[Finding]:  # noqa: ARG001 - a rule like the others
    """Engraved lines are left out."""
    lines = [detail.name for detail in one.part.details if isinstance(detail, Engraving)]
    if lines:
        yield Finding.note(
            "print.engraving", f"{one.part.name}: {', '.join(lines)} is not printed: draw it on"
        )


def form_rule(job: PrintJob, one: JobPart) -> Iterator[Finding]:
    """Of bodies of free form the bores are corrected; that all else is not is told."""
    part = one.part
    if part.outline is None and job.settings.compensate == "model":
        bores = [] if part.free_form is None else [bore.name for bore in part.free_form.bores]
        said = f"its bores {', '.join(bores)} are corrected" if bores else "it has no round holes"
        level = level_bores(job, one)
        drilled = (
            f"; bores that lean by more than {STEEP:g}° sag, drill them: {', '.join(level)}" if level else ""
        )
        off = job.printer.deviation.wall / 2
        yield Finding.note(
            "print.free-form",
            f"{part.name} is of free form: {said}, its other faces stay as drawn and come out by "
            f"{off:+.3f} mm on each side{drilled}",
            off,
            "mm",
        )


def level_bores(job: PrintJob, one: JobPart) -> list[str]:
    """Names of the bores of a body whose axes lean by more than 45 degrees as it lies on the bed."""
    if one.part.free_form is None or not one.part.free_form.bores:
        return []
    upright = job.mesh_of(one).to_bed[2]
    least = math.cos(math.radians(STEEP))
    return [
        bore.name
        for bore in one.part.free_form.bores
        if abs(sum(a * b for a, b in zip(bore.axis, upright.tolist(), strict=True))) < least
    ]


RULES = (
    bed_rule,
    wall_rule,
    gap_rule,
    layer_rule,
    bridge_rule,
    loss_rule,
    form_rule,
)
"""All of them, in the order in which they are told."""
