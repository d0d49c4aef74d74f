"""The one place where a file that somebody names is opened to be read.

What a user names may be anything that a system calls a file: a pipe that nobody writes into, a device without
an end, a folder, a socket, a link to one of them. Only regular files are read, no more of them than a limit,
and no longer than a time.

A file may also change while a command works on it. Within :func:`once` each is read once, and whoever asks
for it later gets the same bytes: parts, programs and the hashes in the manifest are of one reading.
"""

import os
import stat
import time
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path

from mechwright.errors import DesignError, MechwrightError, OutputError
from mechwright.systems import READ_FLAGS

INPUT_LIMIT = 20_000_000
"""Bytes: files of other programs that a design names, such as libraries of thousands of tools."""

SECONDS = 60.0
"""A file that is not read by then hangs: disks and networks that work give the largest in a second or two."""

_WAITS = (0.0, 0.1, 0.4)
"""Seconds before each try to read a file: who saves one in place is done with it by the last of them."""

_PIECE = 1 << 20

_KINDS = (
    (stat.S_ISDIR, "a folder"),
    (stat.S_ISFIFO, "a pipe"),
    (stat.S_ISSOCK, "a socket"),
    (stat.S_ISCHR, "a device"),
    (stat.S_ISBLK, "a device"),
)


_known: ContextVar[dict[str, bytes] | None] = ContextVar("known", default=None)


@contextmanager
def once() -> Iterator[None]:
    """Have each file of up to :data:`INPUT_LIMIT` bytes be read once in this thread while the block lasts.

    A block inside of another one is part of it.
    """
    if _known.get() is not None:
        yield
        return
    token = _known.set({})
    try:
        yield
    finally:
        _known.reset(token)


def read_bytes(path: Path, limit: int = INPUT_LIMIT, *, anew: bool = False) -> bytes:
    """Content of a regular file, or of one that a link leads to.

    Parameters
    ----------
    path
        The file.
    limit
        Bytes that it may have.
    anew
        Read it as it is now, also within :func:`once`: what this program itself writes.

    Raises
    ------
    OutputError
        It is not there, is no regular file, cannot be read, or not in :data:`SECONDS`.
    DesignError
        It is larger than ``limit``.
    """
    known, name = None if anew else _known.get(), os.path.abspath(path)  # noqa: PTH100 - keeps links
    if known is None or name not in known:
        data = _read(path, limit)
        if known is not None and len(data) <= INPUT_LIMIT:
            known[name] = data
        return data
    if len(known[name]) > limit:
        raise _too_large(path, limit)
    return known[name]


def _read(path: Path, limit: int) -> bytes:
    try:
        for wait in _WAITS:
            time.sleep(wait)
            # Asked before it is opened: opening alone rewinds a tape.
            _require_regular(path, path.stat().st_mode)
            handle = os.open(path, READ_FLAGS)
            try:
                before = os.fstat(handle)
                data = _content(path, handle, limit)
                if _as_before(before, os.fstat(handle)):
                    return data
            finally:
                os.close(handle)
        raise OutputError(f"{path}: cannot be read: it changes meanwhile; try again when it is written")
    except MechwrightError:
        raise
    except (OSError, ValueError) as error:  # a null byte in its name
        reason = getattr(error, "strerror", None) or error
        raise OutputError(f"{path}: cannot be read: {reason}") from error


def _as_before(before: os.stat_result, after: os.stat_result) -> bool:
    """Whether nobody has written to a file: half of the old and half of the new would be nobody's design."""
    return (before.st_size, before.st_mtime_ns) == (after.st_size, after.st_mtime_ns)


def _content(path: Path, handle: int, limit: int) -> bytes:
    status = os.fstat(handle)
    _require_regular(path, status.st_mode)  # it may be another one since it was asked
    pieces, size, end = [], status.st_size, time.monotonic() + SECONDS
    while size <= limit and (piece := os.read(handle, min(_PIECE, limit + 1))):
        pieces.append(piece)
        size = max(size, sum(map(len, pieces)))  # what system files hold has no size before it is read
        if time.monotonic() > end:
            raise OutputError(
                f"{path}: cannot be read: it takes more than {SECONDS:g} s; copy it to a disk here"
            )
    if size > limit:
        raise _too_large(path, limit)
    return b"".join(pieces)


def _too_large(path: Path, limit: int) -> DesignError:
    return DesignError(f"{path}: is larger than {limit:,} bytes; is it the right file?")


def regular(path: Path) -> bool:
    """Whether a regular file is there, behind any link; no error is raised whatever else it is."""
    try:
        return stat.S_ISREG(path.stat().st_mode)
    except (OSError, ValueError):
        return False


def kind_of(mode: int) -> str:
    """What the mode of a file that is not regular says it is, in words; empty of a regular one."""
    if stat.S_ISREG(mode):
        return ""
    return next((kind for test, kind in _KINDS if test(mode)), "no regular file")


def _require_regular(path: Path, mode: int) -> None:
    kind = kind_of(mode)
    if kind:
        raise OutputError(f"{path}: cannot be read: it is {kind}; name a regular file")
