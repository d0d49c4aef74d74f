"""The part of a drawing, and what there is to say of it.

A drawing that shows what layers mean: what a design without a drawing is, so that a new one builds.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass

from mechwright import Bore, DesignTable, Finding, Instance, Part, Procedure, Severity, Stage, kept
from mechwright.contracts.details import Thread
from mechwright.contracts.finding import Change
from mechwright.contracts.part import name_from
from mechwright.contracts.rule_list import by_design
from mechwright.drawings.fault import FAULTS
from mechwright.drawings.plate import Cut, part_of
from mechwright.drawings.reading import Drawn, read
from mechwright_plate.params import PlateParams

WIDE, HIGH, ROUND = 90.0, 60.0, 6.0
"""Size of the plate and radius of its corners, mm."""
QUARTER = 0.41421356237309503
"""Bulge of a quarter of a circle."""
Row = tuple[int, object]


def sample() -> bytes:
    """The drawing as a small DXF file.

    >>> sample().decode().split()[-1]
    'EOF'
    """
    rows: list[Row] = [(0, "SECTION"), (2, "HEADER"), (9, "$ACADVER"), (1, "AC1015")]
    rows += [(9, "$INSUNITS"), (70, 4), (0, "ENDSEC"), (0, "SECTION"), (2, "ENTITIES")]
    rows += _entities()
    rows += [(0, "ENDSEC"), (0, "EOF")]
    return "".join(f"{code:>3}\n{value}\n" for code, value in rows).encode()


def _entities() -> Iterator[Row]:
    r, w, h, q = ROUND, WIDE, HIGH, QUARTER
    plate = [
        (r, 0, 0),
        (w - r, 0, q),
        (w, r, 0),
        (w, h - r, q),
        (w - r, h, 0),
        (r, h, q),
        (0, h - r, 0),
        (0, r, q),
    ]
    yield from _polyline("OUTLINE", plate)
    yield from _polyline("POCKET_3", _slot(30, 60, 30, 12))
    yield from _circle("THROUGH", 45, 30, 8)
    for x in (10, w - 10):
        yield from _circle("BORE_H7", x, 10, 3)
        yield from _circle("M5", x, h - 10, 2.5)
    yield from _polyline("THROUGH", _slot(20, 70, 8, 3))
    for stroke in (
        ((40, 48), (40, 54), (43, 51), (46, 54), (46, 48)),
        ((49, 54), (50.5, 48), (52, 52), (53.5, 48), (55, 54)),
    ):
        yield from _polyline("ENGRAVE_0.2", [(x, y, 0) for x, y in stroke], closed=False)


def _slot(x0: float, x1: float, y: float, radius: float) -> list[tuple[float, float, float]]:
    """Corners and bulges of a slot between two centres."""
    return [(x0, y - radius, 0), (x1, y - radius, 1), (x1, y + radius, 0), (x0, y + radius, 1)]


def _polyline(layer: str, corners: list[tuple[float, float, float]], *, closed: bool = True) -> Iterator[Row]:
    yield from [(0, "LWPOLYLINE"), (100, "AcDbEntity"), (8, layer), (100, "AcDbPolyline")]
    yield from [(90, len(corners)), (70, int(closed))]
    for x, y, bulge in corners:
        yield from [(10, x), (20, y), (42, bulge)]


def _circle(layer: str, x: float, y: float, radius: float) -> Iterator[Row]:
    yield from [(0, "CIRCLE"), (100, "AcDbEntity"), (8, layer), (100, "AcDbCircle")]
    yield from [(10, x), (20, y), (40, radius)]


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


RULES = by_design(
    Procedure[DesignTable[PlateParams]](
        tuple(f"plate.{code}" for code in FAULTS), lambda t: made(t.params).findings, stage=Stage.PARTS
    ),
    stage=Stage.PARTS,
)
"""What keeps a drawing from being a plate."""


def _name(file: str) -> str:
    """Name of the part: that of its drawing, as far as it can be one of a file anywhere."""
    stem = re.sub(r"\.dxf$", "", re.split(r"[/\\]", file)[-1], flags=re.IGNORECASE)
    name = name_from(re.sub(r"[^a-z0-9]+", "-", stem.lower())[:40], "")
    # A part and its body are not named alike: an assembly names both.
    return f"{name}-plate" if name == BODY else name or "plate"


def _findings(params: PlateParams, drawn: Drawn, part: Part | None) -> Iterator[Finding]:
    likely = drawn.told.likely
    proposed: tuple[Change, ...] = ({"parameters.layers": {**params.layers, **likely}},) if likely else ()
    for fault in drawn.told.faults:
        yield Finding(
            f"plate.{fault.code}",
            Severity.ERROR,
            fault.key,
            _line(fault.message),
            remedy=_line(fault.remedy),
            stage=Stage.PARTS,
            proposed=proposed if fault.code == "layer" else (),
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
