"""What tells installations apart whose tables could differ."""

import hashlib
import platform
from functools import cache
from importlib import import_module
from importlib.metadata import version
from pathlib import Path
from typing import Any

from mechwright.contracts.family import Family
from mechwright.kernels import kernels
from mechwright.plugins.host import host

LIBRARIES = ("numpy", "scipy", "pyarrow")
"""Whose versions change the bytes of a table."""
_KERNELS = "kernels "


def unlike(said: str, own: str) -> str:
    """What is told of a worker with another fingerprint."""
    if said.partition(_KERNELS)[0] == own.partition(_KERNELS)[0]:
        remedy = "take processors of one kind, or set OPENBLAS_CORETYPE and NPY_DISABLE_CPU_FEATURES alike"
    else:
        remedy = "install the same on both"
    return f"it has {said}; here it is {own}: {remedy}"


def fingerprint(family: str) -> str:
    """What tells installations apart whose tables of a family could differ."""
    return fingerprint_of(host().family(family))


def fingerprint_of(family: Family[Any]) -> str:
    """The same of a family that is at hand."""
    return _fingerprint(type(family).__module__.partition(".")[0])


@cache
def _fingerprint(package: str) -> str:
    """Versions, the text of the program and of a family's package, and the processor's kernels."""
    found = hashlib.sha256()
    for name in ("mechwright", package):
        root = Path(str(import_module(name).__file__)).parent
        files = {path.relative_to(root).as_posix(): path for path in root.rglob("*.py")}
        for place, path in sorted(files.items()):
            found.update(place.encode())
            found.update(path.read_bytes())
    said = [f"{library} {version(library)}" for library in LIBRARIES]
    own = f"program {found.hexdigest()[:12]}"
    return ", ".join([f"python {platform.python_version()}", *said, own, f"{_KERNELS}{kernels()}"])
