"""Compilation of kernels, cached on disk where there is a place for it."""

from collections.abc import Callable
from typing import Any, TypeVar

njit: Any
try:
    import numba
except ImportError:  # pragma: no cover - a tool that comes with the installation
    njit = None
else:
    njit = numba.njit

F = TypeVar("F", bound=Callable[..., Any])

AVAILABLE = njit is not None
"""Whether there is a compiler; without it the same functions run as plain Python, a hundred times slower."""


def compiled(function: F) -> F:
    """Compile a function of numbers and arrays when it is first called.

    The machine code is kept beside the module, or in the user's cache folder. Where both are read-only it is
    compiled anew in every process. Division by zero gives infinity or NaN, as in numpy.
    """
    if njit is None:  # pragma: no cover
        return function
    try:
        kernel: Any = njit(cache=True, error_model="numpy")(function)
    except RuntimeError:  # numba found no place to write to
        kernel = njit(error_model="numpy")(function)
    found: F = kernel
    return found
