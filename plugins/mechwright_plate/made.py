"""The part of a drawing, and what there is to say of it."""

import re
from collections.abc import Iterator
from dataclasses import dataclass

from mechwright import Bore, Finding, Instance, Part, Severity, Stage, kept
from mechwright.contracts.details import Thread
from mechwright.contracts.part import name_from
from mechwright.drawings.plate import Cut, part_of
from mechwright.drawings.reading import Drawn, read
from mechwright_plate.params import PlateParams
from mechwright_plate.sample import sample

BODY = "bench"
"""On which the plate stands: the one body of the assembly."""


@dataclass(frozen=True)
class Made:
    """A part, or None, and the findings."""

    part: Part | None
    findings: tuple[Finding, ...]


@kept
def made(params: PlateParams) -> Made:
    """What a design comes to."""
    drawn = read(params.drawing.data if params.drawing.name else sample(), params.asked)
    cut = Cut(_name(params.drawing.name), params.thickness, params.material, (Instance(BODY),))
    part = part_of(drawn, params.asked, cut)
    return Made(part, tuple(_findings(params, drawn, part)))


def _name(file: str) -> str:
    """Name of the part: that of its drawing, as far as it can be one of a file anywhere."""
    stem = re.sub(r"\.dxf$", "", re.split(r"[/\\]", file)[-1], flags=re.IGNORECASE)
    name = name_from(re.sub(r"[^a-z0-9]+", "-", stem.lower())[:40], "")
    # A part and its body are not named alike: an assembly names both.
    return f"{name}-plate" if name == BODY else name or "plate"


def _findings(params: PlateParams, drawn: Drawn, part: Part | None) -> Iterator[Finding]:
    for fault in drawn.told.faults:
        yield Finding(
            f"plate.{fault.code}",
            Severity.ERROR,
            fault.key,
            _line(fault.message),
            remedy=_line(fault.remedy),
            stage=Stage.PARTS,
        )
    notes = list(drawn.told.notes)
    if not params.drawing.name:
        notes = ['no drawing is named: this is the sample; name one by drawing = "FILE.dxf"']
    if part is not None:
        notes += [*_meanings(drawn), _size(part)]
    for note in notes:
        yield Finding("plate.read", Severity.NOTE, "drawing", _line(note), stage=Stage.PARTS)


def _line(text: str) -> str:
    """Names in a drawing may hold anything; a message is one line."""
    return " ".join("".join(c if c.isprintable() else " " for c in text).split())


def _meanings(drawn: Drawn) -> Iterator[str]:
    """What became of each layer."""
    closed = [(meant, [one.stroke for one in some]) for meant, some in drawn.contours.items()]
    for meant, strokes in [*closed, *drawn.strokes.items()]:
        layers = ", ".join(sorted({one.layer for one in strokes}))
        if layers:
            yield f"{layers}: {meant.text} ({len(strokes)})"


def _size(part: Part) -> str:
    assert part.outline is not None  # noqa: S101 - a plate has one
    x0, y0, x1, y1 = part.outline.bounds
    bores = [feature for feature in part.features if isinstance(feature, Bore)]
    fits = sum(bore.fit is not None for bore in bores)
    threads = sum(isinstance(detail, Thread) for detail in part.details)
    return (
        f"the plate is {x1 - x0:.6g} x {y1 - y0:.6g} x {part.thickness:g} mm, from X{x0:.6g} Y{y0:.6g}; "
        f"{len(bores)} round holes, {fits} of them to a fit, {threads} threaded"
    )
