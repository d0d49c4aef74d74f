"""Pages from templates: nothing undefined is let through, and what designs are named is escaped."""

from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import jinja2


@cache
def templates(*folders: Path) -> "jinja2.Environment":
    """The templates of some folders; the first that has a name gives it. Imports jinja2 when it is called.

    Behind them all comes this folder, with the style of pages that are lists. The same folders give the same
    environment, which keeps the templates that it has compiled.
    """
    import jinja2

    return jinja2.Environment(
        loader=jinja2.FileSystemLoader([*folders, Path(__file__).parent]),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
