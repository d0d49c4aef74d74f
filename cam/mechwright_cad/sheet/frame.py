"""What every sheet has round its views: sizes of paper, frame, title block, notes."""

from collections.abc import Sequence

from mechwright_cad.sheet.sheet import HEIGHT, Sheet, Text, width_of

SHEETS = ((297.0, 210.0), (420.0, 297.0), (594.0, 420.0), (841.0, 594.0))
"""A4 to A1, lying; mm."""

MARGIN, EDGE = 10.0, 8.0
"""From the paper's edge to the frame, and from the frame to what is drawn, mm."""

TITLE = (150.0, 34.0)
"""Width and height of the title block, mm."""

LINE = 5.5
"""From one line of notes to the next, mm."""

Fields = Sequence[Sequence[tuple[str, str, float]]]
"""Rows of the title block: name, value and width of each field, in tenths of the block's width."""


def ratio(scale: float) -> str:
    """A scale as drawings write it.

    >>> ratio(2.0), ratio(0.5)
    ('2 : 1', '1 : 2')
    """
    return f"{scale:g} : 1" if scale >= 1 else f"1 : {1 / scale:g}"


def frame(sheet: Sheet, rows: Fields, notes: Sequence[str]) -> None:
    """Frame, title block (ISO 7200), and the notes beside it."""
    x1, y1 = sheet.width - MARGIN, sheet.height - MARGIN
    sheet.lines([(MARGIN, MARGIN), (x1, MARGIN), (x1, y1), (MARGIN, y1), (MARGIN, MARGIN)], "FRAME")
    x0, top = x1 - TITLE[0], MARGIN + TITLE[1]
    sheet.lines([(x0, MARGIN), (x0, top), (x1, top)], "FRAME")
    step = TITLE[1] / len(rows)
    for k, row in enumerate(rows):
        x, y = x0, top - step * (k + 1)
        if k < len(rows) - 1:
            sheet.lines([(x0, y), (x1, y)], "DIM")
        for count, (name, value, share) in enumerate(row):
            wide = share * TITLE[0] / 10
            if count:
                sheet.lines([(x, y), (x, y + step)], "DIM")
            sheet.add(Text((x + 1.5, y + step - 3.0), name, height=2.0))
            if value:
                height = min(HEIGHT, HEIGHT * (wide - 3.0) / width_of(value))
                sheet.add(Text((x + 1.5, y + 1.3), value, height=height))
            x += wide
    for k, line in enumerate(notes):
        sheet.add(Text((MARGIN + EDGE, top - LINE * (k + 1)), line, height=2.5))
