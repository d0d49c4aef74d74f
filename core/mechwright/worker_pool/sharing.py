"""Items of one work, distributed over worker processes."""

from collections.abc import Callable, Generator, Sequence
from concurrent.futures import Future
from itertools import chain
from queue import SimpleQueue
from typing import TypeVar

from mechwright.contracts.synthesis import Progress
from mechwright.worker_pool.budget import available_cores, limited_cores, split_cores
from mechwright.worker_pool.pool import Known, LostError, WorkerPool
from mechwright.worker_pool.serving import report_progress
from mechwright.worker_pool.store import ResultStore

T = TypeVar("T")
R = TypeVar("R")

START = 1.25
"""Seconds until a worker has begun and its answer has arrived: imports take most of them."""

GRACE = 10.0
"""Seconds that an interrupted item has to tidy up before its process is killed."""


def side_by_side(
    work: Callable[[T, Progress], R],
    items: Sequence[T],
    budget: int,
    progress: Callable[[int, float, str], None] = lambda *_: None,
) -> Generator[tuple[int, R | None], None, None]:
    """The index of each item and its result, as soon as it is there; None if its process ended.

    Parameters
    ----------
    work
        A function of a module, called with an item and a progress callback. Its errors are raised.
    budget
        Cores for all items: at most as many processes work at once. Of fewer items each has several cores.
    progress
        Called with the index of an item, the part of it that is done, 0 to 1, and its present step.

    If the generator is closed, as by the keyboard, the items under way are interrupted, and killed where they
    have not tidied up within ``GRACE`` seconds.
    """
    events: SimpleQueue[tuple[int, float, str] | Future[R]] = SimpleQueue()

    def report(index: int) -> Progress:
        return lambda done, what: events.put((index, done, what))

    with WorkerPool(split_cores(budget, min(budget, len(items))), grace=GRACE) as pool:
        running: dict[Future[R], int] = {}
        for index, item in enumerate(items):
            running[pool.submit(work, item, report_progress, progress=report(index))] = index
        for future in running:
            future.add_done_callback(events.put)
        while running:
            event = events.get()
            if not isinstance(event, Future):
                progress(*event)
                continue
            try:
                found = pool.result(event)
            except LostError:
                found = None
            yield running.pop(event), found


def assign(seconds: Sequence[float], most: int) -> list[list[int]]:
    """Indices of items by process, this one first; processes without an item are omitted.

    The longest items are assigned first, each to the process that would end it first.

    >>> assign([1, 1], most=4)
    [[0, 1]]
    >>> assign([3, 4, 2, 6], most=2)
    [[2, 3], [0, 1]]
    """
    ends = [0.0] + [START] * (most - 1)
    found: list[list[int]] = [[] for _ in ends]
    for index in sorted(range(len(seconds)), key=lambda index: -seconds[index]):
        process = min(range(len(ends)), key=ends.__getitem__)
        ends[process] += seconds[index]
        found[process].append(index)
    return [sorted(indices) for indices in found if indices]


def shared(
    work: Callable[[T], R],
    items: Sequence[T],
    seconds: Sequence[float],
    known: Known | None = None,
    progress: Callable[[float], None] = lambda _: None,
    store: ResultStore | None = None,
) -> list[R]:
    """The result of ``work`` for every item, in order; raises the error of the first item that fails.

    Workers make the work faster, never different. An item that fails in a worker is done once more in this
    process, which then raises its error.

    Parameters
    ----------
    work
        A function of a module without side effects. Items and results are copied by pickle.
    seconds
        The estimated time of each item.
    known
        The objects of an item that its result refers to: they stay those of this process.
    progress
        Called with the part of this process's own items that is done, 0 to 1.
    store
        What it holds is not made again, and what is made is kept there.
    """
    places = [None if store is None else store.kept(work, item, known) for item in items]
    kept = [[] if place is None else place.read() for place in places]
    lacking = [index for index, found in enumerate(kept) if not found]
    made = _made(work, [items[k] for k in lacking], [seconds[k] for k in lacking], known, progress)
    for index, result in zip(lacking, made, strict=True):
        kept[index] = [result]
        if (place := places[index]) is not None:
            place.write(result)
    return [found[0] for found in kept]


def _made(
    work: Callable[[T], R],
    items: Sequence[T],
    seconds: Sequence[float],
    known: Known | None,
    progress: Callable[[float], None],
) -> list[R]:
    own, *others = assign(seconds, available_cores()) or [[]]
    here, *cores = split_cores(available_cores(), 1 + len(others))
    found: dict[int, R] = {}
    failed: dict[int, Exception] = {}
    with WorkerPool(cores, quiet=True) as pool, limited_cores(here):
        futures: dict[int, Future[R]] = {
            index: pool.submit(work, items[index], known=known)
            for index in sorted(chain(*others), key=lambda index: -seconds[index])
        }
        for done, index in enumerate(own):
            progress(done / len(own))
            try:
                found[index] = work(items[index])
            except Exception as error:  # noqa: BLE001,RUF100 - an item before it may fail first
                failed[index] = error
                break
        for index, future in futures.items():
            if future.exception() is None:
                found[index] = pool.result(future)
    for index, item in enumerate(items):
        if index in failed:
            raise failed[index]
        if index not in found:
            found[index] = work(item)
    return [found[index] for index in range(len(items))]
