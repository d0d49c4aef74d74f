"""A progress bar on a terminal; nothing in a pipe, or lines for a program that asks for them."""

import json
import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.progress import Progress


IN_LINES = "MECHWRIGHT_PROGRESS"
"""Environment variable; if it is not empty, a program listens, and each step is a line of standard error."""

_MARK = "@progress "

Step = Callable[[str], None]
"""Called when a piece of work begins; says what it is."""


@contextmanager
def progress(total: int) -> Iterator[Step]:
    """Show ``total`` pieces of work on standard error while the block runs, if that is a terminal."""
    if os.environ.get(IN_LINES):
        yield _in_lines(total)
        return
    if not sys.stderr.isatty():
        yield lambda what: None  # noqa: ARG005 - nothing is shown
        return
    with _bar() as bar:
        task = bar.add_task("", total=total)
        started = False

        def step(what: str) -> None:
            nonlocal started
            bar.update(task, description=what, advance=1 if started else 0)
            started = True

        yield step


@contextmanager
def fraction() -> Iterator[Callable[[float, str], None]]:
    """Show how far one long piece of work is, 0 to 1, and what it is at, if standard error is a terminal."""
    if not sys.stderr.isatty():
        yield lambda done, what: None  # noqa: ARG005 - nothing is shown
        return
    with _bar() as bar:
        task = bar.add_task("", total=1.0)
        yield lambda done, what: bar.update(task, completed=done, description=what)


def _bar() -> "Progress":
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    columns = (BarColumn(20), TextColumn("{task.description}"), TimeElapsedColumn())
    return Progress(*columns, console=Console(stderr=True), transient=True)


def _in_lines(total: int) -> Step:
    done = -1

    def step(what: str) -> None:
        nonlocal done
        done += 1
        said = json.dumps({"done": done, "of": total, "doing": what})
        sys.stderr.write(f"{_MARK}{said}\n")
        sys.stderr.flush()

    return step


def line_of(line: str) -> dict[str, object] | None:
    """What a line of progress says: ``done``, ``of`` and ``doing``; None of any other line."""
    if not line.startswith(_MARK):
        return None
    found = json.loads(line[len(_MARK) :])
    return found if isinstance(found, dict) else None
