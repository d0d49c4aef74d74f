"""Tables with commas, as spreadsheets open them."""

import csv
import io
from collections.abc import Iterable

_FORMULAS = ("=", "+", "-", "@", "\t", "\r")
"""What makes a spreadsheet take a cell for a formula, which may start programs."""


def csv_text(rows: Iterable[Iterable[object]]) -> str:
    r"""Rows as text: quoted where that is needed, and no text is a formula.

    >>> csv_text([["a", 1.5, "-2"], ["=1+1", 'M6 "long", of steel', ""]])
    'a,1.5,-2\n\'=1+1,"M6 ""long"", of steel",\n'
    """
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerows([_cell(cell) for cell in row] for row in rows)
    return text.getvalue()


def _cell(cell: object) -> object:
    return f"'{cell}" if isinstance(cell, str) and cell.startswith(_FORMULAS) and not _number(cell) else cell


def _number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True
