"""A progress bar on a terminal; in a pipe nothing, a line now and then, or lines for a program."""

import json
import os
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from mechwright.cli.stopping import NOTHING, StoppedError
from mechwright.cli.streams import say
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
def fraction(*, lines: bool = False) -> "Iterator[Progress]":
    """Show how far a piece of work is, 0 to 1, what it is at, and the time that remains.

    It is shown on standard error, if that is a terminal, and gone when the work is done. Elsewhere nothing is
    shown, or with ``lines`` a line now and then.
    """
    if os.environ.get(IN_LINES):
        yield in_line
        return
    if not sys.stderr.isatty():
        if lines:
            with now_and_then() as progress:
                yield progress
        else:
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


EVERY = 20.0
"""Seconds between two lines of progress where there is no terminal; work that takes less has none."""


@contextmanager
def now_and_then(every: float = EVERY) -> "Iterator[Progress]":
    """Say how far a piece of work is in a line of standard error every so many seconds, and at its end.

    A thread says it: the work may be in one long call.
    """
    begun, last, ended = time.monotonic(), (0.0, "has begun"), threading.Event()
    first: list[float] = []

    def progress(done: float, what: str) -> None:
        nonlocal last
        last = done, what
        if not first:
            first.append(done)

    def speak() -> None:
        while not ended.wait(every):
            done, what = last
            so_far, before = time.monotonic() - begun, first[0] if first else 0.0
            left = so_far * (1 - done) / (done - before) if done > before else None
            about = "" if left is None else f", about {_duration(left)} left"
            say(f"mechwright: {100 * done:.0f} %: {what}; {_duration(so_far)} so far{about}")

    thread = threading.Thread(target=speak, daemon=True)
    thread.start()
    try:
        yield progress
    finally:
        ended.set()
        thread.join()
    if (so_far := time.monotonic() - begun) >= every:
        say(f"mechwright: 100 %: done; {_duration(so_far)}")


def _duration(seconds: float) -> str:
    """A time as people say it.

    >>> _duration(59.6), _duration(600), _duration(7265)
    ('1 min 00 s', '10 min 00 s', '2 h 01 min')
    """
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    minutes, rest = divmod(whole, 60)
    return f"{minutes} min {rest:02d} s" if minutes < 60 else f"{minutes // 60} h {minutes % 60:02d} min"


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
