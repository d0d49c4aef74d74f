"""What every sheet has round its views: sizes of paper, frame, title block, notes."""

from collections.abc import Sequence

from mechwright_cad.sheet.circles import ring
from mechwright_cad.sheet.sheet import HEIGHT, Sheet, Text

SHEETS = ((297.0, 210.0), (420.0, 297.0), (594.0, 420.0), (841.0, 594.0))
"""A4 to A1, lying; mm."""

MARGIN, EDGE = 10.0, 8.0
"""From the paper's edge to the frame, and from the frame to what is drawn, mm."""

TITLE = (125.0, 34.0)
"""Width and height of the title block, mm."""

LINE = 5.5
"""From one line of notes to the next, mm."""

Row = tuple[tuple[str, str], tuple[str, str]]
"""Two fields of the title block beside each other: name and value of each."""


def ratio(scale: float) -> str:
    """A scale as drawings write it.

    >>> ratio(2.0), ratio(0.5)
    ('2 : 1', '1 : 2')
    """
    return f"{scale:g} : 1" if scale >= 1 else f"1 : {1 / scale:g}"


def frame(sheet: Sheet, rows: Sequence[Row], notes: Sequence[str]) -> None:
    """Frame, title block (ISO 7200), and the notes beside it."""
    x1, y1 = sheet.width - MARGIN, sheet.height - MARGIN
    sheet.lines([(MARGIN, MARGIN), (x1, MARGIN), (x1, y1), (MARGIN, y1), (MARGIN, MARGIN)], "FRAME")
    x0, top = x1 - TITLE[0], MARGIN + TITLE[1]
    sheet.lines([(x0, MARGIN), (x0, top), (x1, top)], "FRAME")
    step = TITLE[1] / len(rows)
    split = x0 + 0.6 * TITLE[0]
    sheet.lines([(split, MARGIN), (split, top)], "DIM")
    for k, row in enumerate(rows):
        y = top - step * (k + 1)
        if k < len(rows) - 1:
            sheet.lines([(x0, y), (x1, y)], "DIM")
        for x, (name, value) in zip((x0, split), row, strict=True):
            sheet.add(Text((x + 2, y + step - 3.5), name, height=2.0))
            sheet.add(Text((x + 2, y + 2), value, height=HEIGHT))
    for k, line in enumerate(notes):
        sheet.add(Text((MARGIN + EDGE, top - LINE * (k + 1)), line, height=2.5))


def first_angle(sheet: Sheet) -> None:
    """The sign of ISO 5456-2 in the title block: a cone from the side, and to its right its end."""
    x, y = sheet.width - MARGIN - 22.0, MARGIN + 5 * TITLE[1] / 6
    sheet.lines([(x, y - 1.5), (x + 7, y - 3), (x + 7, y + 3), (x, y + 1.5), (x, y - 1.5)], "DIM")
    sheet.lines([(x - 1.5, y), (x + 8.5, y)], "CENTRE")
    for radius in (1.5, 3.0):
        sheet.lines(ring((x + 14, y), radius), "DIM")
    sheet.lines([(x + 10, y), (x + 18, y)], "CENTRE")
    sheet.lines([(x + 14, y - 4), (x + 14, y + 4)], "CENTRE")
