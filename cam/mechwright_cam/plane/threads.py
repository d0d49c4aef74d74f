"""Work on several cores: planar geometry and large arrays let go of the interpreter's lock."""

import os
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from typing import Any, TypeVar

import shapely

T = TypeVar("T")
R = TypeVar("R")


def together(function: Callable[[T], R], items: Iterable[T]) -> list[R]:
    """Apply a function to every item, several at once; results in the order of the items.

    The calls must not depend on each other, nor change what they share. The error of the first item that
    fails is raised, as it would be if they ran one after another.
    """
    work = list(items)
    count = min(len(work), os.cpu_count() or 1)
    if count < 2:
        return [function(item) for item in work]
    with ThreadPoolExecutor(count) as pool:
        return list(pool.map(function, work))


def prepared(shape: Any) -> Any:
    """A copy of a shape, prepared for many questions.

    A prepared shape builds indices while it is asked, and threads that ask the same one at once spoil them:
    so what is prepared is never what others may hold.
    """
    own = shapely.force_2d(shape)
    shapely.prepare(own)
    return own
