"""Work on several cores: planar geometry and large arrays let go of the interpreter's lock."""

import contextlib
import os
import threading
import warnings
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

T = TypeVar("T")
R = TypeVar("R")


_allowed: list[int] = []


def keep_to(count: int) -> None:
    """Let this process use no more than so many cores: others of the same work use the rest."""
    _allowed[:] = [count]


@contextlib.contextmanager
def keeping(count: int) -> Iterator[None]:
    """Let this process use no more than so many cores meanwhile."""
    before = _allowed[:]
    keep_to(count)
    try:
        yield
    finally:
        _allowed[:] = before


def cores() -> int:
    """How many processor cores this process may use: those it is bound to, where the system can tell."""
    if _allowed:
        return _allowed[0]
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def together(function: Callable[[T], R], items: Iterable[T]) -> list[R]:
    """Apply a function to every item, several at once; results in the order of the items.

    The calls must not depend on each other, nor change what they share. The error of the first item that
    fails is raised, as it would be if they ran one after another.
    """
    work = list(items)
    count = min(len(work), cores())
    if count < 2:
        return [function(item) for item in work]
    # Libraries that set the filters of warnings aside and back, as shapely does in ``is_valid``, leave those
    # of another thread when two of them cross.
    alone = threading.current_thread() is threading.main_thread()
    with warnings.catch_warnings() if alone else contextlib.nullcontext(), ThreadPoolExecutor(count) as pool:
        return list(pool.map(function, work))
