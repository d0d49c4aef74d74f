"""Compilation of kernels to machine code, cached on disk where there is a place for it.

numba takes a second to import, so only modules that need a kernel import this one.
"""

import contextlib
import hashlib
from collections.abc import Callable, Iterator
from typing import Any, TypeVar

from numba import njit
from numba.core.caching import FunctionCache, IndexDataCacheFile

F = TypeVar("F", bound=Callable[..., Any])


class _Files(IndexDataCacheFile):
    """Machine code of one function, in a file of its own for every signature.

    numba numbers the files. Two processes that compile a function for different arguments at the same time
    take the same number, and the code of one is then run with the arguments of the other.
    """

    def save(self, key: Any, data: Any) -> None:
        """Write machine code, then enter it; what another process enters meanwhile is compiled once more."""
        own: Any = self
        digest = hashlib.sha256(repr((own._source_stamp, key)).encode()).hexdigest()
        name = own._data_name(int(digest[:12], 16))
        own._save_data(name, data)
        own._save_index(own._load_index() | {key: name})


class _Cache(FunctionCache):
    """The cache of one function, whose files several processes may write."""

    def __init__(self, function: Callable[..., Any]) -> None:
        super().__init__(function)  # type: ignore[no-untyped-call]
        files: Any = _Files
        stamp = self._cache_file._source_stamp, *_called_stamps(function)
        self._cache_file = files(self._cache_path, self._impl.filename_base, stamp)


def _called_stamps(function: Callable[..., Any]) -> Iterator[Any]:
    """Stamps of the sources of the kernels that a function calls, whose machine code goes into its own."""
    for name in function.__code__.co_names:
        cache = getattr(function.__globals__.get(name), "_cache", None)
        if isinstance(cache, _Cache):
            own: Any = cache._cache_file
            yield name, own._source_stamp


def compiled(function: F) -> F:
    """Compile a function of numbers and arrays when it is first called.

    The machine code is kept beside the module, or in the user's cache folder. Where both are read-only it is
    compiled anew in every process. Division by zero gives infinity or NaN, as in numpy.
    """
    kernel: Any = njit(error_model="numpy")(function)
    if hasattr(kernel, "enable_caching"):  # with numba switched off it is the function itself
        with contextlib.suppress(RuntimeError):  # numba finds no place to write to
            kernel._cache = _Cache(function)
    found: F = kernel
    return found
