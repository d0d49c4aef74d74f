"""The chart of bores: a row for each, with its diameter, the direction of its axis, and its place."""

import math
from collections.abc import Sequence

from mechwright.contracts.free_form import FormBore, FreeForm
from mechwright.geometry.segments import Point
from mechwright_cad.sheet.sheet import Sheet, Text, width_of

HEIGHT, ROW, PAD = 2.5, 5.0, 2.0
"""Of letters, from row to row, and beside a text, mm."""

RADIAL = 1e-6
"""How far from the centre the axis of a bore passes at most that points at it, mm."""

Row = tuple[str, ...]

HEADS: Row = ("Bore", "Diameter", "Azimuth", "Elevation", "Faces")
FROM_CENTRE = "Faces: distances of both ends of a bore from the centre, or entry and length"


def rows_of(form: FreeForm) -> list[Row]:
    """A row for each bore."""
    return [
        (one.name, _diameter(one), *(_degrees(angle) for angle in direction_of(one)), _faces(one))
        for one in form.bores
    ]


def _diameter(one: FormBore) -> str:
    return f"⌀{one.fit.text}" if one.fit is not None else f"⌀{round(one.diameter, 3):g}"


def direction_of(one: FormBore) -> tuple[float, float]:
    """Azimuth and elevation of its axis, degrees."""
    x, y, z = one.axis
    return math.degrees(math.atan2(y, x)), math.degrees(math.atan2(z, math.hypot(x, y)))


def _degrees(angle: float) -> str:
    return f"{round(angle, 4) + 0.0:g}°"


def _faces(one: FormBore) -> str:
    along = sum(a * b for a, b in zip(one.start, one.axis, strict=True))
    if is_radial(one):
        return f"{round(along, 3):g} to {round(along + one.length, 3):g}"
    start = ", ".join(f"{round(value, 3) + 0.0:g}" for value in one.start)
    return f"from ({start}), {round(one.length, 3):g} long"


def is_radial(one: FormBore) -> bool:
    """Whether its axis goes away from the centre and through it."""
    along = sum(a * b for a, b in zip(one.start, one.axis, strict=True))
    return along > 0 and abs(math.dist(one.start, [along * a for a in one.axis])) < RADIAL


def widths_of(rows: Sequence[Row]) -> list[float]:
    """Of the columns, mm."""
    return [
        max(width_of(text, HEIGHT) for text in column) + 2 * PAD for column in zip(HEADS, *rows, strict=True)
    ]


def size_of(rows: Sequence[Row]) -> Point:
    """Width and height of the chart, mm."""
    return sum(widths_of(rows)), ROW * (len(rows) + 2)


def chart(sheet: Sheet, rows: Sequence[Row], at: Point) -> None:
    """Draw it with its upper left corner at a place."""
    x0, top = at
    wide, widths = size_of(rows)[0], widths_of(rows)
    for k, row in enumerate((HEADS, *rows)):
        y, x = top - ROW * (k + 1), x0
        for text, width in zip(row, widths, strict=True):
            sheet.add(Text((x + PAD, y + 1.2), text, height=HEIGHT))
            x += width
        sheet.lines([(x0, y), (x0 + wide, y)], "DIM")
    foot = top - ROW * (len(rows) + 1)
    for x in (x0, *(x0 + sum(widths[: k + 1]) for k in range(len(widths)))):
        sheet.lines([(x, top), (x, foot)], "DIM")
    sheet.lines([(x0, top), (x0 + wide, top)], "DIM")
    sheet.add(Text((x0, foot - ROW + 1.2), FROM_CENTRE, height=2.0))
