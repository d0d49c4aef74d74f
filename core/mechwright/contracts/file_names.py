"""Names of files that every file system takes and keeps apart."""

import unicodedata
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Annotated

from mechwright.contracts.guard import UnsoundError
from mechwright.systems import SYSTEM

DEVICES = frozenset(
    (
        *("con", "prn", "aux", "nul", "conin$", "conout$"),
        *(f"{port}{n}" for port in ("com", "lpt") for n in "0123456789¹²³"),
    )
)
"""Devices of Windows: with any ending, ``con.step``, they are no files there."""

RESERVED = '<>:"|?*'
"""Characters that Windows takes in no file name, beside those that lead into folders."""

LONGEST = 255
"""Bytes of a file name, on common file systems."""


def file_key(name: str) -> str:
    r"""What two names share where they are one file on some system.

    Windows and macOS do not tell upper from lower case. macOS does not tell composed characters from
    decomposed ones. Windows drops dots and spaces at the end.

    >>> file_key("Wheel.STEP") == file_key("wheel.step"), file_key("\u00e9") == file_key("e\u0301")
    (True, True)
    >>> file_key("gear.") == file_key("gear"), file_key("gear-1") == file_key("gear-2")
    (True, False)
    """
    return unicodedata.normalize("NFC", unicodedata.normalize("NFD", name).casefold()).rstrip(". ")


def name_fault(name: str) -> str:
    """Why a name is no plain file name on every system, in words that follow the name; empty if it is one.

    >>> name_fault("wheel.step"), name_fault("con.step")
    ('', 'is no plain file name: on Windows it is that of a device')
    >>> name_fault("a/b"), name_fault("gear.")
    ('is no plain file name', 'is no plain file name: it ends in a dot or a space, which Windows drops')
    """
    said = "is no plain file name"
    if name in {"", ".", ".."} or not name.isprintable() or any(one in "/\\" for one in name):
        return said
    if wrong := [one for one in name if one in RESERVED]:
        return f"{said}: Windows takes no {wrong[0]} in one"
    if name[-1] in ". ":
        return f"{said}: it ends in a dot or a space, which Windows drops"
    if name.partition(".")[0].rstrip().casefold() in DEVICES:
        return f"{said}: on Windows it is that of a device"
    size = len(name.encode(errors="surrogatepass"))
    return f"{said}: it is {size} bytes long, and file systems take {LONGEST}" if size > LONGEST else ""


def free_name(name: str, taken: Iterable[str]) -> str:
    """The name, or with the least number from 2 behind it with which it is no file of the others.

    >>> free_name("assembly", ("gear",)), free_name("assembly", ("gear", "Assembly", "assembly-2"))
    ('assembly', 'assembly-3')
    """
    others = {file_key(one) for one in taken}
    found, number = name, 1
    while file_key(found) in others:
        number += 1
        found = f"{name}-{number}"
    return found


def path_fault(path: Path, system: str = SYSTEM) -> str:
    """What is wrong with a name that a user gives on this system: :func:`name_fault` on Windows alone.

    There a name ``a:b`` is a stream of the file ``a``, and ``nul`` takes everything and holds nothing. A path
    that is no text on any system is shown by no page and no program that is written of it.
    """
    if not is_text(str(path)):
        return "is no text in UTF-8"
    return name_fault(path.name) if system == "win32" and path.name not in {"", ".."} else ""


def is_text(text: str) -> bool:
    """Whether a text can be written in UTF-8: what a system gives as a name may hold any bytes.

    >>> is_text("gear"), is_text("gear-" + chr(0xDCFF))
    (True, False)
    """
    try:
        text.encode()
    except UnicodeEncodeError:
        return False
    return True


def _hold_text(text: str, what: str) -> None:
    try:
        text.encode()
    except UnicodeEncodeError as error:
        raise UnsoundError(f"{what} cannot be written: {error.reason}") from error


def hold_files(files: Mapping[str, object], *_: object) -> None:
    """Raise UnsoundError where a name is no plain one, or a text cannot be written."""
    for name, content in files.items():
        if fault := name_fault(name):
            raise UnsoundError(f"{name!r} {fault}")
        if isinstance(content, str):
            _hold_text(content, f"the text of {name!r}")


Text = Annotated[str, lambda text, *_: _hold_text(text, "the text")]
"""A text that can be written."""
Files = Annotated[dict[str, str], hold_files]
"""Texts by the names of their files."""
File = Annotated[tuple[str, str], lambda file, *_: hold_files({file[0]: file[1]} if any(file) else {})]
"""The name of a file and its text; both are empty where there is none."""
