"""Processes that work side by side, each on one thing after the other, within one budget of cores.

Unlike a pool of the standard library this says which work a process was at when it was killed, hears how far
each is, and lets work that the keyboard stops tidy up.
"""

import contextlib
import multiprocessing
import os
import signal
import threading
from collections.abc import Callable, Generator, Iterator, Sequence
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from typing import Any, TypeVar

from mechwright.beside import end_with_parent, without_script
from mechwright.contracts.synthesis import Progress
from mechwright.cores import keep_to

T = TypeVar("T")
R = TypeVar("R")

STAY = 10.0
"""Seconds that a process has to tidy up after it was stopped."""

Heard = Callable[[int, float, str], None]
"""Told the place of an item, the part of it that is done, 0 to 1, and what it is at."""


@dataclass
class _Worker:
    """A process with so many cores, the pipe to it, and the place of the item that it is at."""

    process: Any
    pipe: "Connection[Any, Any]"
    cores: int
    place: int = -1

    def begin(self, place: int, item: object) -> None:
        """Give it an item; one that is dead by now is found so when it is asked."""
        self.place = place
        with contextlib.suppress(OSError):
            self.pipe.send(item)


def side_by_side(
    work: Callable[[T, Progress], R], items: Sequence[T], budget: int, heard: Heard = lambda *_: None
) -> Generator[tuple[int, R | None], None, None]:
    """Each item's place with what a function makes of it, as soon as it is there.

    Parameters
    ----------
    work
        A function of a module; items and what it gives go through pickle.
    budget
        Cores for all of it: no more processes than that, and where there are fewer items each has several.

    Gives None for an item whose process was killed. Whoever stops asking, as by the keyboard, ends what is
    under way: it is interrupted, and killed where it has not tidied up within ``STAY`` seconds.
    """
    count = min(budget, len(items))
    waiting = iter(range(len(items)))
    crew: dict[Any, _Worker] = {}

    def begin(cores: int) -> None:
        """Have a new process work on the next item, if there is one."""
        place = next(waiting, None)
        if place is not None:
            worker = _hired(work, cores)
            crew[worker.pipe] = worker
            worker.begin(place, items[place])

    try:
        for number in range(count):
            begin(budget // count + (number < budget % count))
        while crew:
            for pipe in wait(list(crew)):
                worker = crew[pipe]
                try:
                    done, said = worker.pipe.recv()
                except (EOFError, OSError):  # it was killed
                    _end([crew.pop(pipe)])
                    begin(worker.cores)
                    yield worker.place, None
                    continue
                if not done:
                    heard(worker.place, *said)
                    continue
                place, following = worker.place, next(waiting, None)
                if following is None:
                    _end([crew.pop(pipe)])
                else:
                    worker.begin(following, items[following])
                yield place, said
    finally:
        _end(list(crew.values()))


def _hired(work: Callable[[T, Progress], R], cores: int) -> _Worker:
    context = multiprocessing.get_context("spawn")
    here, there = context.Pipe()
    process = context.Process(target=_serve, args=(there, work, cores), daemon=True)
    with _deaf(), without_script():
        process.start()
    there.close()
    return _Worker(process, here, cores)


@contextlib.contextmanager
def _deaf() -> Iterator[None]:
    """Have a process that is started ignore the keyboard until it says otherwise."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


def _end(workers: Sequence[_Worker]) -> None:
    """Interrupt what some processes are at, and wait until they have tidied up."""
    for worker in workers:
        worker.pipe.close()
        if worker.process.is_alive():
            os.kill(worker.process.pid, signal.SIGINT)
    for worker in workers:
        worker.process.join(STAY)
        worker.process.kill()
        worker.process.join()


def _serve(pipe: "Connection[Any, Any]", work: Callable[[T, Progress], R], cores: int) -> None:
    """The other process: take an item, give what is made of it, until nobody is there any more."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # without work there is nothing to stop
    end_with_parent()
    keep_to(cores)
    try:
        while True:
            item = pipe.recv()
            signal.signal(signal.SIGINT, _once)
            made = work(item, lambda done, what: pipe.send((False, (done, what))))
            signal.signal(signal.SIGINT, signal.SIG_IGN)
            pipe.send((True, made))
    except (EOFError, OSError, KeyboardInterrupt):
        return


def _once(*_: object) -> None:
    """Stop the work; the keyboard and the caller may both ask for it, and tidying up is not stopped."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    raise KeyboardInterrupt
