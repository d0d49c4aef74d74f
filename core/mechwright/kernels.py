"""Which kernels numpy computes with on this processor: last digits of its results are theirs."""

import contextlib
import ctypes
import platform
from functools import cache
from importlib import import_module

_CORE_NAMES = ("scipy_openblas_get_corename64_", "scipy_openblas_get_corename", "openblas_get_corename")
"""Functions of OpenBLAS, by how numpy was built."""


@cache
def kernels() -> str:
    """Machine, kernel of the linear algebra, and the extensions of the processor that numpy uses.

    Linear algebra is OpenBLAS, whose kernel ``OPENBLAS_CORETYPE`` sets; extensions are those that
    ``NPY_DISABLE_CPU_FEATURES`` leaves. Libraries of other makers have no name here.
    """
    import numpy as np

    found = np.show_config(mode="dicts").get("SIMD Extensions", {}).get("found", [])
    return ", ".join([platform.machine().lower(), _core_name(), *map(str, found)])


def _core_name() -> str:
    with contextlib.suppress(OSError, AttributeError, ImportError):
        library = ctypes.CDLL(import_module("numpy.linalg._umath_linalg").__file__)
        for name in _CORE_NAMES:
            if hasattr(library, name):
                function = getattr(library, name)
                function.restype = ctypes.c_char_p
                return str(function().decode())
    return "unknown"
