"""Tables of a sheet: rows of texts in columns, parted by thin lines."""

from collections.abc import Sequence
from dataclasses import dataclass

from mechwright.geometry.segments import Point
from mechwright_cad.sheet.sheet import Sheet, Text, width_of

SMALL = 2.5
"""Height of letters of tables and labels, mm."""

STEP = 4.5
"""From one row to the next, mm."""

_AIR = 1.2
"""Between a line and the text beside it, mm."""


@dataclass(frozen=True)
class Row:
    """Texts of the columns; a ``head`` has a line under it. A text may run on over columns left empty."""

    cells: tuple[str, ...]
    head: bool = False


def widths(rows: Sequence[Row]) -> tuple[float, ...]:
    """Width of each column, mm: what its texts take, where the next cell is not empty."""
    count = max(len(row.cells) for row in rows)
    found = [0.0] * count
    for row in rows:
        for k, text in enumerate(row.cells):
            runs_on = k + 1 < len(row.cells) and not any(row.cells[k + 1 :])
            if text and not runs_on:
                found[k] = max(found[k], width_of(text, SMALL) + 2 * _AIR)
    for row in rows:
        last = max((k for k, text in enumerate(row.cells) if text), default=0)
        short = width_of(row.cells[last], SMALL) + 2 * _AIR - sum(found[last:])
        if row.cells[last] and short > 0:
            found[-1] += short
    return tuple(found)


def draw(sheet: Sheet, rows: Sequence[Row], at: Point) -> None:
    """Draw rows from their upper left corner ``at`` downwards."""
    x0, y = at
    columns = widths(rows)
    for row in rows:
        x = x0
        for text, wide in zip(row.cells, columns, strict=False):
            if text:
                sheet.add(Text((x + _AIR, y - STEP + (STEP - SMALL) / 2), text, height=SMALL))
            x += wide
        y -= STEP
        if row.head:
            sheet.lines([(x0, y), (x0 + sum(columns), y)], "DIM")


def split(rows: Sequence[Row], most: int) -> list[list[Row]]:
    """Rows in lots of at most so many, each beginning with the first one, its head."""
    head, rest = rows[0], rows[1:]
    size = max(most - 1, 1)
    return [[head, *rest[k : k + size]] for k in range(0, len(rest), size)]
