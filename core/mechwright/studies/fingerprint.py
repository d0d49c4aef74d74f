"""What tells installations apart whose tables could differ."""

import hashlib
import platform
from functools import cache
from importlib import import_module
from importlib.metadata import version
from pathlib import Path

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


@cache
def fingerprint(family: str) -> str:
    """What tells installations apart whose tables could differ: versions, and the program's text."""
    found = hashlib.sha256()
    for package in ("mechwright", type(host().family(family)).__module__.partition(".")[0]):
        root = Path(str(import_module(package).__file__)).parent
        files = {path.relative_to(root).as_posix(): path for path in root.rglob("*.py")}
        for name, path in sorted(files.items()):
            found.update(name.encode())
            found.update(path.read_bytes())
    said = [f"{library} {version(library)}" for library in LIBRARIES]
    own = f"program {found.hexdigest()[:12]}"
    return ", ".join([f"python {platform.python_version()}", *said, own, f"{_KERNELS}{kernels()}"])
