"""Compilation of kernels to machine code, cached on disk where there is a place for it.

numba takes a second to import, so only modules that need a kernel import this one.
"""

from collections.abc import Callable
from typing import Any, TypeVar

from numba import njit

F = TypeVar("F", bound=Callable[..., Any])


def compiled(function: F) -> F:
    """Compile a function of numbers and arrays when it is first called.

    The machine code is kept beside the module, or in the user's cache folder. Where both are read-only it is
    compiled anew in every process. Division by zero gives infinity or NaN, as in numpy.
    """
    try:
        kernel: Any = njit(cache=True, error_model="numpy")(function)
    except RuntimeError:  # numba found no place to write to
        kernel = njit(error_model="numpy")(function)
    found: F = kernel
    return found
