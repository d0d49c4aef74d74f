"""What stands on a page of figures, and the page."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from mechwright.output.templates import templates


@dataclass(frozen=True)
class Figure:
    """A picture (SVG of our own, its text escaped) under a heading, with a caption."""

    title: str
    svg: str
    caption: str


@dataclass(frozen=True)
class Grid:
    """A table: a caption, the heads of its columns, and rows of as many cells."""

    caption: str
    head: Sequence[str]
    rows: Sequence[Sequence[str]]


def figures_page(
    name: str, title: str, notes: Sequence[str], figures: Sequence[Figure], tables: Sequence[Grid]
) -> str:
    """The page: heading, notes, figures, then tables."""
    return (
        templates(Path(__file__).parent)
        .get_template("page.html")
        .render(name=name, title=title, notes=notes, figures=figures, tables=tables)
    )
