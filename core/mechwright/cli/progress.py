"""A progress bar on a terminal, and nothing in a pipe."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Protocol


class Step(Protocol):
    """Called when a piece of work begins; says what it is."""

    def __call__(self, what: str) -> None:
        """Begin the next piece of work."""
        ...


@contextmanager
def progress(total: int) -> Iterator[Step]:
    """Show ``total`` pieces of work on standard error while the block runs, if that is a terminal."""
    if not sys.stderr.isatty():
        yield lambda what: None  # noqa: ARG005 - nothing is shown
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    console = Console(stderr=True)
    columns = (BarColumn(20), TextColumn("{task.description}"), TimeElapsedColumn())
    with Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task("", total=total)
        started = False

        def step(what: str) -> None:
            nonlocal started
            bar.update(task, description=what, advance=1 if started else 0)
            started = True

        yield step
