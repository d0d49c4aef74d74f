"""The budget of cores of this process, and threads within it.

Planar geometry and large arrays release the interpreter's lock, so threads do that work side by side.
"""

import contextlib
import threading
import warnings
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

from mechwright.systems import usable_cores

T = TypeVar("T")
R = TypeVar("R")

_limit: list[int] = []


def limit_cores(count: int) -> None:
    """Let this process use at most ``count`` cores: other processes of the same work use the rest."""
    _limit[:] = [count]


@contextlib.contextmanager
def limited_cores(count: int) -> Iterator[None]:
    """Let this process use at most ``count`` cores within the block."""
    before = _limit[:]
    limit_cores(count)
    try:
        yield
    finally:
        _limit[:] = before


def available_cores() -> int:
    """How many cores this process may use: its limit, else the cores that the system binds it to."""
    return _limit[0] if _limit else usable_cores()


def split_cores(budget: int, count: int) -> list[int]:
    """The cores of each of ``count`` processes; every process has at least one.

    >>> split_cores(5, 2), split_cores(1, 2)
    ([3, 2], [1, 1])
    """
    return [max(budget // count + (number < budget % count), 1) for number in range(count)]


def threaded_map(function: Callable[[T], R], items: Iterable[T]) -> list[R]:
    """The function's result for every item, in the order of the items; several threads compute them.

    The calls must not depend on each other, nor change what they share. The error of the first item that
    fails is raised.
    """
    work = list(items)
    count = min(len(work), available_cores())
    if count < 2:
        return [function(item) for item in work]
    # Libraries that set the filters of warnings aside and back, as shapely does in ``is_valid``, leave those
    # of another thread when two of them cross.
    alone = threading.current_thread() is threading.main_thread()
    with warnings.catch_warnings() if alone else contextlib.nullcontext(), ThreadPoolExecutor(count) as pool:
        return list(pool.map(function, work))
