"""The copies of cut parts on one sheet: boxes side by side, or rows that share edges."""

import math
from collections.abc import Iterable, Sequence

from mechwright.errors import DesignError
from mechwright.geometry import Line, Outline
from mechwright.geometry.packing import on_plate
from mechwright.geometry.segments import Point
from mechwright_cut.jobs import CommonLine, CutJob, CutPart, CutPiece, gap_of
from mechwright_cut.rows import Place, Row, rows_of, single_rows
from mechwright_cut.settings.cut_settings import CutSettings
from mechwright_cut.settings.figures import Kerf, Process

MOST = 400
"""Copies on one sheet at most: their number comes from a file, and each costs time."""


def nested(
    name: str, parts: Iterable[CutPart], process: Process, kerf: Kerf, settings: CutSettings
) -> CutJob:
    """The copies of some parts on one sheet; raises DesignError where they do not fit.

    The largest first, each turned by 90 degrees where it then lies lower. With ``common_lines``, parts that
    share straight edges are laid as one row.
    """
    items: list[tuple[CutPart, str]] = []
    for one in parts:
        count = max(1, len(one.part.instances))
        items += [(one, one.part.name if count == 1 else f"{one.part.name} no {n + 1}") for n in range(count)]
    if len(items) > MOST:
        raise DesignError(
            f"cut.sheet: {len(items)} copies on one sheet, at most {MOST}; cut fewer parts at once"
        )
    sizes = {id(one): _size(one.outline) for one, _ in items}
    items.sort(key=lambda item: (-max(sizes[id(item[0])]), -min(sizes[id(item[0])])))
    nest = _Nest([one for one, _ in items], process, kerf, settings)
    laid = nest.laid(settings.sheet.length, settings.sheet.width)
    if laid is None:
        raise DesignError(nest.too_small(name))
    pieces, lines = {}, []
    for row, (x, y, turned) in laid:
        x0, y0, _, y1 = row.bounds
        left, low = (-y1, x0) if turned else (x0, y0)
        before: tuple[int, tuple[Point, Point]] | None = None
        for member in row.members:
            place = member.place.then(nest.rim + x - left, nest.rim + y - low, turned)
            one, label = items[member.number]
            pieces[member.number] = CutPiece(one, label, place.x, place.y, place.angle)
            if before is not None and member.before is not None:
                stretch = _off_wall(place, member.before, kerf.width / 2)
                lines.append(CommonLine((before[0], member.number), (before[1], stretch)))
            if member.behind is not None:
                before = member.number, _off_wall(place, member.behind, kerf.width / 2)
    first = items[0][0].part
    return CutJob(
        name,
        process,
        first.material,
        first.thickness,
        kerf,
        settings,
        tuple(pieces[number] for number in range(len(items))),
        tuple(lines),
    )


def _off_wall(place: Place, side: Line, off: float) -> tuple[Point, Point]:
    """The ends of a side, so far off the part, mm, which is on its left."""
    (x0, y0), (x1, y1) = place.of(side.start), place.of(side.end)
    length = math.dist((x0, y0), (x1, y1))
    dx, dy = off * (y1 - y0) / length, off * (x0 - x1) / length
    return (x0 + dx, y0 + dy), (x1 + dx, y1 + dy)


class _Nest:
    """Cut parts that are laid on a sheet of any size, in rows where they share edges."""

    def __init__(self, parts: Sequence[CutPart], process: Process, kerf: Kerf, settings: CutSettings) -> None:
        self._outlines = [one.outline for one in parts]
        self._kerf, self._settings = kerf, settings
        self._gap = gap_of(settings, kerf, process, parts[0].part.thickness)
        self.rim = settings.sheet.margin + self._gap / 2

    def laid(self, length: float, width: float) -> list[tuple[Row, tuple[float, float, bool]]] | None:
        """Each row with its place on a sheet; None where they do not go on it."""
        room = length - 2 * self.rim, width - 2 * self.rim
        if min(room) <= 0:
            return None
        rows = single_rows(self._outlines)
        if self._settings.common_lines:
            rows = rows_of(self._outlines, self._kerf.width, room)
            rows.sort(key=lambda row: (-max(row.size), -min(row.size)))
        layout = on_plate([row.size for row in rows], *room, self._gap, True)
        return None if layout is None else list(zip(rows, layout.spots, strict=True))

    def too_small(self, name: str) -> str:
        """What is wrong with the sheet, and one that is not too small."""
        sheet, scale = self._settings.sheet, 1.05
        while True:
            length, width = math.ceil(scale * sheet.length), math.ceil(scale * sheet.width)
            if self.laid(length, width):
                count = len(self._outlines)
                what = f"the part of {name} does" if count == 1 else f"the {count} parts of {name} do"
                apart = "" if count == 1 else f" with {self._gap:g} mm between them"
                return (
                    f"cut.sheet: {what} not fit on {sheet.length:g} x {sheet.width:g} mm{apart}; set "
                    f"cut.sheet = {{ length = {length}, width = {width} }}"
                )
            scale *= 1.1


def _size(outline: Outline) -> tuple[float, float]:
    x0, y0, x1, y1 = outline.bounds
    return x1 - x0, y1 - y0
