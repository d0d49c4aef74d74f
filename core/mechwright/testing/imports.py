"""What an import brings in, seen by a fresh interpreter."""

import os
import subprocess
import sys

HEAVY = ("cadquery", "ezdxf", "flint", "jinja2", "numba", "OCP", "scipy", "shapely")
"""Libraries that take from 30 ms to seconds to import; work that does not need them never pays for them."""


def heavy_imports(module: str) -> list[str]:
    """Give the heavy libraries that importing ``module`` loads; AssertionError if it cannot be imported.

    >>> heavy_imports("mechwright.geometry")
    []
    """
    command = f"import sys, importlib; importlib.import_module({module!r}); print(*sorted(sys.modules))"
    done = subprocess.run(  # noqa: S603 - our own interpreter and our own words
        [sys.executable, "-c", command],
        env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode:
        raise AssertionError(f"import {module} fails:\n{done.stderr}")
    return sorted(set(done.stdout.split()) & set(HEAVY))
