"""Names that a file can have on every system: what is written on one is copied to others."""

import sys
from pathlib import Path

DEVICES = frozenset(
    (
        *("con", "prn", "aux", "nul", "conin$", "conout$"),
        *(f"{port}{n}" for port in ("com", "lpt") for n in "0123456789¹²³"),
    )
)
"""With any ending, ``con.step``, they are no files on Windows."""

_FORBIDDEN = frozenset('<>:"/\\|?*')


def name_fault(name: str) -> str:
    """What keeps a text from being the name of a file on every system; empty if nothing does.

    >>> name_fault("gear-2.step"), name_fault("aux.nc"), name_fault("a.")
    ('', 'is that of a device on Windows', 'ends in a dot or a space, which Windows drops')
    """
    if wrong := sorted(_FORBIDDEN & set(name)):
        return f"has {' '.join(wrong)}, which Windows allows in no name"
    if any(ord(one) < 32 for one in name):
        return "has a control character, which Windows allows in no name"
    if name.endswith((".", " ")):
        return "ends in a dot or a space, which Windows drops"
    return "is that of a device on Windows" if name.partition(".")[0].rstrip().lower() in DEVICES else ""


def path_fault(path: Path, system: str = sys.platform) -> str:
    """What is wrong with a name that a user gives on this system: :func:`name_fault` on Windows alone.

    There a name ``a:b`` is a stream of the file ``a``, and ``nul`` takes everything and holds nothing.
    """
    return name_fault(path.name) if system == "win32" and path.name not in {"", ".."} else ""
