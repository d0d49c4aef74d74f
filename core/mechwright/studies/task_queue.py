"""What hands out the tasks of a sweep, and what takes them."""

import contextlib
from collections.abc import Iterator
from typing import Protocol

from mechwright.studies.portion import Portion
from mechwright.studies.task import Source, Task

AHEAD = 3
"""Tasks that are given out for each worker: one that is done, one that waits, and one at work."""

Found = bytes | Portion
"""The table of a task, or what came of a slice of it."""


class Queue(Protocol):
    """Tasks that workers take."""

    def take(self) -> Task | None:
        """The next task; None where there is none before another one is back, or none at all."""
        ...

    def again(self, task: Task) -> None:
        """Take back a task that nobody does any more."""
        ...


class Workers(Protocol):
    """Does tasks of a study, in any order.

    ``count`` of them work at once, 0 where nobody knows before; ``local`` are the cores of this machine for
    work that only it can do.
    """

    @property
    def count(self) -> int:
        """How many tasks are done at once."""
        ...

    @property
    def local(self) -> int:
        """How many cores of this machine may be used besides."""
        ...

    def done(self, source: Source, tasks: Queue) -> Iterator[tuple[Task, Found]]:
        """Each task with what came of it, as soon as it is there; more tasks may be taken then."""
        ...


@contextlib.contextmanager
def returned(tasks: Queue, task: Task) -> Iterator[None]:
    """Take back a task that could not be given out."""
    try:
        yield
    except Exception:
        tasks.again(task)
        raise


def some(tasks: Queue, count: int) -> Iterator[Task]:
    """So many tasks at most."""
    for _ in range(count):
        task = tasks.take()
        if task is None:
            return
        yield task
