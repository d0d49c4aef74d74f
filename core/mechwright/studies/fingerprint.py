"""What tells installations apart whose tables could differ."""

import hashlib
import platform
from functools import cache
from importlib import import_module
from importlib.metadata import version
from pathlib import Path

from mechwright.plugins.host import host

LIBRARIES = ("numpy", "scipy", "pyarrow")
"""Whose versions change the bytes of a table."""


def unlike(said: str, own: str) -> str:
    """What is told of a worker with another fingerprint."""
    return f"it has {said}; here it is {own}: install the same on both"


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
    return ", ".join([f"python {platform.python_version()}", *said, f"program {found.hexdigest()[:12]}"])
