"""How values are shown in notebooks: tables of plain HTML, every text escaped."""

from collections.abc import Iterable, Sequence
from html import escape


def html_table(header: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """A table; numbers are given to six digits.

    >>> html_table(["name", "value"], [["a < b", 0.12345678]])
    '<table><tr><th>name</th><th>value</th></tr><tr><td>a &lt; b</td><td>0.123457</td></tr></table>'
    """
    head = "".join(f"<th>{escape(name)}</th>" for name in header)
    body = "".join("<tr>" + "".join(f"<td>{_cell(one)}</td>" for one in row) + "</tr>" for row in rows)
    return f"<table><tr>{head}</tr>{body}</table>"


def _cell(value: object) -> str:
    return escape("" if value is None else f"{value:.6g}" if isinstance(value, float) else str(value))
