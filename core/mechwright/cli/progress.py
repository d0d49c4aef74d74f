"""A progress bar on a terminal; nothing in a pipe, or lines for a program that asks for them."""

import json
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from mechwright.cli.stopping import NOTHING, StoppedError
from mechwright.output.folder import MANIFEST

if TYPE_CHECKING:
    from mechwright.contracts.synthesis import Progress

IN_LINES = "MECHWRIGHT_PROGRESS"
"""Environment variable; if it is not empty, a program listens, and each step is a line of standard error."""

_MARK = "@progress "


@contextmanager
def standing(folder: Path | None = None) -> Iterator[None]:
    """Run a block; raises StoppedError where the keyboard stops it, with what stands in ``folder``."""
    before = stamp(folder)
    try:
        yield
    except KeyboardInterrupt:
        if folder is None:
            raise StoppedError(NOTHING) from None
        stands = "is as it was" if stamp(folder) == before else "is written, all of it"
        raise StoppedError(f"{folder} {stands}") from None


def stamp(folder: Path | None) -> tuple[int, int] | None:
    """What tells one run's folder from the next one's: they are exchanged as a whole."""
    try:
        stat = (folder / MANIFEST).stat() if folder is not None else None
    except OSError:
        return None
    return None if stat is None else (stat.st_ino, stat.st_mtime_ns)


@contextmanager
def fraction() -> "Iterator[Progress]":
    """Show how far a piece of work is, 0 to 1, what it is at, and the time that remains.

    It is shown on standard error, if that is a terminal, and gone when the work is done.
    """
    if os.environ.get(IN_LINES):
        yield in_line
        return
    if not sys.stderr.isatty():
        yield lambda done, what: None  # noqa: ARG005 - nothing is shown
        return
    from rich.console import Console
    from rich.progress import BarColumn, TextColumn, TimeElapsedColumn, TimeRemainingColumn
    from rich.progress import Progress as Bar

    columns = (BarColumn(20), TextColumn("{task.description}"), TimeElapsedColumn())
    left = (TextColumn("left"), TimeRemainingColumn())
    with Bar(*columns, *left, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("", total=1.0)
        yield lambda done, what: bar.update(task, completed=done, description=what)


def in_line(done: float, what: str) -> None:
    """Progress as a line of standard error, which :func:`line_of` reads."""
    sys.stderr.write(f"{_MARK}{json.dumps({'done': done, 'doing': what})}\n")
    sys.stderr.flush()


def line_of(line: str) -> dict[str, object] | None:
    """What a line of progress says: ``done``, 0 to 1, and ``doing``; None of any other line."""
    if not line.startswith(_MARK):
        return None
    found = json.loads(line[len(_MARK) :])
    return found if isinstance(found, dict) else None
